// SPDX-License-Identifier: GPL-3.0-or-later
// Tension in steps that do not resolve the shortest waves: what it leaves alone, what it keeps, and that free liquid at rest stays at rest in such steps.

#include "freeSurface/SemiImplicitTension.H"

#include "motion/Motion.H"
#include "stepping/SubStep.H"
#include "support/DisorderedBall.H"
#include "support/LiquidCase.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// A disordered ball without walls, its free surface known.
class Ball : public LiquidCase
{
public:
    explicit Ball(scalar radius = 5)
    {
        surface.requireUsual(liquid);
        place(disorderedBall(radius));
    }

    // Of the particles near the surface, in their order there.
    std::size_t count() const { return std::size_t(surface.particles().before.download().back()); }

    // What a step of so many capillary ones applies of these jumps.
    std::vector<scalar> smoothed(const std::vector<scalar>& given, double steps)
    {
        const auto x = vectors(liquid.predicted);
        const auto indices = surface.particles().indices.download();
        std::vector<scalar> jumps(indices.size());
        std::vector<Vec3> normals(indices.size());
        for (std::size_t k = 0; k < given.size(); ++k)
        {
            jumps[k] = given[k];
            normals[k] = 1 / norm(x[indices[k]]) * x[indices[k]];
        }
        Buffer<scalar> jump(jumps);
        SemiImplicitTension(liquid).smooth(liquid, near, surface, capillarySteps(steps), Buffer<Vec3>(normals), jump);
        std::vector<scalar> result = jump.download();
        result.resize(given.size());
        return result;
    }

    std::vector<scalar> random() const
    {
        RandomNumbers numbers(11);
        std::vector<scalar> f(count());
        for (scalar& v : f) v = numbers({-1, -1, -1}, {1, 1, 1}).x;
        return f;
    }
};

double product(const std::vector<scalar>& a, const std::vector<scalar>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += double(a[i]) * double(b[i]);
    return sum;
}

}

TEST(SemiImplicitTension, IsForStepsLongerThanTheCapillaryOne)
{
    const Ball ball;
    const SemiImplicitTension tension(ball.liquid);
    EXPECT_FALSE(tension.isNeeded(ball.capillarySteps(0.99)));
    EXPECT_TRUE(tension.isNeeded(ball.capillarySteps(1.01)));
    EXPECT_EQ(tension.resolved(ball.capillarySteps(0.5)), 1);
    EXPECT_FLOAT_EQ(tension.resolved(ball.capillarySteps(2.5)), 0.4f);
    EXPECT_GT(tension.iterations(ball.capillarySteps(10)), tension.iterations(ball.capillarySteps(2.8)));
}

// Each move is no larger than that of two capillary steps, (2.8/2)^2 = 1.96: two; in steps of four and more than that of sqrt(2), 5^2/2 = 12.5: 13. Between 2.8 and four it goes over.
TEST(SemiImplicitTension, MovesInPartsOfFewCapillarySteps)
{
    const Ball ball;
    const SemiImplicitTension tension(ball.liquid);
    EXPECT_EQ(tension.parts(ball.capillarySteps(0.7)), 1);
    EXPECT_EQ(tension.parts(ball.capillarySteps(1.99)), 1);
    EXPECT_EQ(tension.parts(ball.capillarySteps(2.8)), 2);
    EXPECT_EQ(tension.parts(ball.capillarySteps(3)), 3);
    EXPECT_EQ(tension.parts(ball.capillarySteps(4)), 8);
    EXPECT_EQ(tension.parts(ball.capillarySteps(5)), 13);
}

// A drop at rest has one jump along its surface: all differences are zero, so it stays to the bit.
TEST(SemiImplicitTension, LeavesAJumpThatIsTheSameEverywhereAlone)
{
    Ball ball;
    const std::vector<scalar> same(ball.count(), 0.7f);
    for (const double steps : {1.1, 2.8, 10.0}) EXPECT_EQ(ball.smoothed(same, steps), same);
}

// The map is that of an inverse of a symmetric matrix that is no smaller than one, but for the fiftieth: it is symmetric, makes nothing larger, turns nothing against its force, and keeps the
// sum, since K has none.
TEST(SemiImplicitTension, IsSymmetricAndOnlyEverSmoother)
{
    Ball ball;
    const std::vector<scalar> f = ball.random(), one(f.size(), 1), g(f.rbegin(), f.rend());
    const double squares = product(f, f);
    for (const double steps : {2.8, 10.0})
    {
        const std::vector<scalar> a = ball.smoothed(f, steps), b = ball.smoothed(g, steps);
        EXPECT_NEAR(product(a, g), product(f, b), 1e-5 * squares);         // rounding of single precision over some hundred products
        EXPECT_NEAR(product(a, one), product(f, one), 1e-5 * squares);
        EXPECT_LT(product(a, a), 1.05 * squares);
        EXPECT_GT(product(a, f), 0);
    }
}

// Random jumps differ from particle to particle, as waves do that no step resolves: of these little is left in long steps.
TEST(SemiImplicitTension, SlowsShortWaves)
{
    Ball ball;
    const std::vector<scalar> f = ball.random();
    const double all = product(f, f), some = product(ball.smoothed(f, 2.8), f), less = product(ball.smoothed(f, 20), f);
    EXPECT_LT(some, 0.8 * all);
    EXPECT_LT(less, 0.5 * some);
}

// Water, R = 0.94 mm, in steps of 2.8 capillary ones for 0.1 s, and of five for 0.05 s. With explicit tension it swings itself up from 8e-3 to 0.025 v_c on the way, and to 0.14 later; in steps
// of five it bursts. What is left in steps of 2.8 decays further; in those of five it is 0.03 of so few particles, and less of more.
TEST(SemiImplicitTension, LetsAFreeBallRestInLongSteps)
{
    struct Run
    {
        double steps, end, most;
    };
    for (const auto& [steps, end, most] : {Run{2.8, 0.1, 0.006}, Run{5, 0.05, 0.06}})
    {
        LiquidCase ball({.spacing = 1.5e-4, .liquidProperties = "rho 998; nu 1e-6; sigma 0.0728;"});
        ball.folder.write
        (
            "constant/models", "pressure completedPbf; surfaceTension laplacePressure; wetting extendedSurface; viscosity newtonian; bodyForce none;"
        );
        Models models(ball.folder.path(), Dictionary(), ball.liquid, ball.walls);
        models.takeEffect(ball.liquid, ball.walls);
        ball.place(latticeBall(6.667f));
        const LiquidProperties& p = ball.liquid.properties();
        const double step = steps * p.capillaryStep();
        const scalar dt = ball.liquid.units().toScaled(step, dimensions::time);
        settle(ball.liquid, ball.near, ball.walls, models, dt);
        SubStep subStep(ball.liquid, ball.near, ball.walls, models);
        for (double time = 0; time < end; time += step) subStep(dt);
        double squares = 0;
        const auto u = ball.liquid.velocity.download();
        for (const Vec3 v : u) squares += double(squared(v));
        const double speed = std::sqrt(squares / double(u.size())) * ball.liquid.units().of(dimensions::velocity);
        const double capillarySpeed = std::sqrt(p.surfaceTension / (p.density * 1e-3));
        EXPECT_LT(speed, most * capillarySpeed) << steps;
    }
}

// A move in parts is the whole move, whether the pressure's iterations are as many as its parts or none. Seven roundings of places, 2^-24 of a particle's way each.
TEST(SemiImplicitTension, MovesTheSameWayInParts)
{
    LiquidCase ball({.spacing = 1.5e-4, .liquidProperties = "rho 998; nu 1e-6; sigma 0.0728;"});
    ball.folder.write("constant/models", "pressure completedPbf; surfaceTension laplacePressure; wetting extendedSurface; viscosity none; bodyForce none;");
    Models models(ball.folder.path(), Dictionary(), ball.liquid, ball.walls);
    models.takeEffect(ball.liquid, ball.walls);
    ball.place(latticeBall(5));
    const scalar dt = ball.capillarySteps(3.75);          // seven parts
    std::vector<Vec3> reached[2];
    for (const int iterations : {0, 100})
    {
        predictPositions(ball.liquid, 0);
        ball.near.search(ball.liquid, models.freeSurface->support(), models.forces.reach());
        models.freeSurface->search(ball.liquid, ball.near, ball.walls);
        models.forces.applyBeforeIterations(ball.liquid, ball.near, ball.walls, dt);
        int made = 0;
        while (made < iterations && models.forces.applyInIteration(ball.liquid, ball.near, ball.walls, dt)) ++made;
        EXPECT_EQ(made, iterations == 0 ? 0 : 6);
        models.forces.finish(ball.liquid, dt);
        reached[iterations > 0] = vectors(ball.liquid.predicted);
        models.forces.commit();
    }
    const auto before = vectors(ball.liquid.position);
    scalar farthest = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
    {
        farthest = std::max(farthest, norm(reached[0][i] - before[i]));
        EXPECT_LT(norm(reached[1][i] - reached[0][i]), 1e-5f);
    }
    EXPECT_GT(farthest, 0.3f * ball.liquid.spacing());
}
