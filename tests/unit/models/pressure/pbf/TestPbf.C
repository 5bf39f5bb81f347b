// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/density/Density.H"
#include "support/PressureReference.H"
#include "support/VectorSum.H"

#include <algorithm>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// Average of max(rho/rho0 - 1, 0) at the predicted positions.
double errorOf(LiquidCase& drop)
{
    computeDensity(drop.liquid, drop.near, drop.walls);
    double sum = 0;
    for (const scalar density : drop.liquid.density.download()) sum += std::max(density - 1, scalar(0));
    return sum / drop.liquid.owned();
}

}

// A lattice of 0.94 spacings is 20 % too dense inside. Every correction must leave a smaller error than the one before,
// down to 1e-6, the rounding of densities near one.
TEST(Pbf, LowersTheDensityErrorInEveryIteration)
{
    for (const char* kernel : {"type cubicSpline; support 2;", "type poly6Spiky; support 2.5;"})
    {
        LiquidCase drop({.kernel = kernel});
        const auto model = makePressure(drop, "pbf", "maxIterations 15; tolerance 0; relaxation 0.4;");
        drop.place(latticeBlock(8, 8, 8, 0.94f));
        double error = errorOf(drop);
        const double first = error;
        EXPECT_GT(first, 0.02);
        model->begin(1);
        while (!model->converged(drop.liquid, drop.near, drop.walls))
        {
            model->correct(drop.liquid, drop.near, drop.walls);
            const double now = errorOf(drop);
            EXPECT_LT(now, std::max(error, 1e-6)) << kernel << ", " << model->iterations();
            error = now;
        }
        EXPECT_EQ(model->iterations(), 15);
        EXPECT_LT(error, 0.05 * first) << kernel;
    }
}

// Pairs push each other alike. Positions of up to eight units are rounded to 5e-7: 512 of them leave about 1e-5.
TEST(Pbf, ConservesMomentumWithoutWalls)
{
    LiquidCase drop;
    const auto model = makePressure(drop, "pbf", "maxIterations 3; tolerance 0; relaxation 1;");
    RandomNumbers random(4);
    auto points = latticeBlock(8, 8, 8, 0.92f);
    disorder(points, 0.1f, random);
    drop.place(points);
    const auto before = vectors(drop.liquid.predicted);
    iterate(*model, drop, 1);
    const auto after = vectors(drop.liquid.predicted);
    const VectorSum steps = sumOfSteps(before, after);
    EXPECT_GT(steps.sizes, 5);
    for (const double component : steps.components) EXPECT_NEAR(component, 0, 1e-4);
}

TEST(Pbf, PushesLiquidOffWallsAlongTheirNormals)
{
    for (const bool particles : {true, false})
    {
        LiquidCase drop(caseOnFloor(particles ? latticeBlock(11, 11, 1, 1, {-5, -5, -0.5f}) : std::vector<Vec3>()));
        const auto model = makePressure(drop, "pbf", "maxIterations 1; minIterations 1; tolerance 0; relaxation 1;");
        drop.place({{0, 0, particles ? -0.3f : -0.9f}});        // in the solid, where it alone is denser than liquid
        const Vec3 before = vectors(drop.liquid.predicted)[0];
        EXPECT_FALSE(model->converged(drop.liquid, drop.near, drop.walls));
        EXPECT_GT(drop.liquid.density.download()[0], 1);
        model->correct(drop.liquid, drop.near, drop.walls);
        const Vec3 after = vectors(drop.liquid.predicted)[0];
        EXPECT_GT(after.z, before.z + 0.01f);
        EXPECT_NEAR(after.x, 0, 1e-6);
        EXPECT_NEAR(after.y, 0, 1e-6);
    }
}

TEST(Pbf, StopsAtTheToleranceButNotBeforeTheLeastIterations)
{
    LiquidCase drop;
    const auto model = makePressure(drop, "pbf", "minIterations 2; maxIterations 50; tolerance 1e-4; relaxation 1;");
    drop.place(latticeBlock(7, 7, 7, 1));
    EXPECT_EQ(iterate(*model, drop, 1), 2);                            // the lattice is at rest density already
    drop.place(latticeBlock(7, 7, 7, 0.9f));
    const int needed = iterate(*model, drop, 1);
    EXPECT_GT(needed, 2);
    EXPECT_LT(needed, 50);
    EXPECT_LE(errorOf(drop), 1e-4);
    drop.place({});
    EXPECT_EQ(iterate(*model, drop, 1), 0);
}

// Unilateral: C < 0 counts as zero, so a pair in the gas feels nothing. Bilateral: it is drawn together.
TEST(Pbf, PullsOnlyWhereItMay)
{
    for (const bool unilateral : {true, false})
    {
        LiquidCase drop;
        const std::string choice = unilateral ? "yes" : "no";
        const auto model = makePressure(drop, "pbf", "relaxation 1; unilateral " + choice + ";");
        drop.place({{0, 0, 0}, {1.2f, 0, 0}});
        const scalar before = rounded(1.2f * drop.liquid.spacing());
        ASSERT_FALSE(model->converged(drop.liquid, drop.near, drop.walls));
        model->correct(drop.liquid, drop.near, drop.walls);
        const auto x = drop.inOrder(drop.liquid.predicted);
        if (unilateral)
        {
            EXPECT_EQ(x[1].x - x[0].x, before);
        }
        else
        {
            EXPECT_LT(x[1].x - x[0].x, before - 0.01f);
        }
    }
}

TEST(Pbf, RefusesControlsOutOfRange)
{
    LiquidCase drop;
    const std::pair<std::string, std::string> wrong[]
    {
        {"maxIterations", "0"}, {"minIterations", "11"}, {"minIterations", "-1"}, {"tolerance", "-1"},
        {"relaxation", "2"}, {"relaxation", "0"}, {"epsilon", "-1"}
    };
    for (const auto& entry : wrong)
    {
        const auto make = [&] { makePressure(drop, "pbf", entry.first + " " + entry.second + ";"); };
        EXPECT_TRUE(holds(messageOf(make), {"system/solution", "'" + entry.first + "'"}));
    }
}
