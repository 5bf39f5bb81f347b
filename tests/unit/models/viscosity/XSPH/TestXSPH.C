// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/viscosity/Viscosity.H"

#include "support/LiquidCase.H"
#include "support/ReferenceKernels.H"

using namespace shizuku;
using namespace shizuku::test;

// u_i += c sum_j V (u_j - u_i) W_ij over all pairs in double precision.
TEST(XSPH, SmoothsVelocitiesByItsFormula)
{
    LiquidCase drop;
    const auto points = randomPoints(300, {0, 0, 0}, {6, 6, 6});
    const auto velocities = randomPoints(300, {-1, -1, -1}, {1, 1, 1}, 2);
    drop.place(points, velocities);
    const auto model = Viscosity::New(Dictionary::parse("viscosity XSPH; XSPHCoeffs { c 0.2; perCapillaryStep 0; }"), drop.liquid);
    model->apply(drop.liquid, drop.near, drop.walls, 0.02f);
    EXPECT_EQ(model->stepLimit(drop.liquid.properties()), std::numeric_limits<double>::infinity());

    const auto smoothed = drop.inOrder(drop.liquid.velocity);
    const Reference<CubicSpline> W{2};                  // in spacings, in which V = 1
    for (int i = 0; i < 300; ++i)
    {
        double expected = velocities[i].x;
        for (int j = 0; j < 300; ++j)
        {
            expected += 0.2 * (double(velocities[j].x) - velocities[i].x) * W.W(norm(points[i] - points[j]));
        }
        ASSERT_NEAR(smoothed[i].x, expected, 2e-6) << i;        // some twenty terms of order 0.1, each rounded to 6e-8
    }
}

// noSlip yes (the default) adds -c u_i times the walls' kernel density: the integral over a half-space, the sum of virtual
// volumes over solid particles; of both the sum. noSlip no leaves them out.
TEST(XSPH, HoldsBackAtWallsWithoutSlip)
{
    const auto points = randomPoints(200, {-3, -3, 0.1f}, {3, 3, 4});
    const auto velocities = randomPoints(200, {-1, -1, -1}, {1, 1, 1}, 2);
    const auto solid = latticeBlock(13, 13, 1, 0.9f, {-5.4f, -5.4f, -0.5f});
    const Reference<CubicSpline> W{2};                  // in spacings, in which V = 1
    for (const bool sampled : {false, true})
    {
        for (const std::string noSlip : {"slipAbove 0;", "noSlip yes; slipAbove 0;", "noSlip no;"})
        {
            CaseText text{.walls = "side { type plane; point (-3.5e-3 0 0); normal (1 0 0); }"};
            if (sampled)
            {
                text.walls += sampledFloor;
                text.solidPositions = solid;
            }
            LiquidCase drop(text);
            drop.place(points, velocities);
            const auto model = Viscosity::New
            (
                Dictionary::parse("viscosity XSPH; XSPHCoeffs { c 0.3; perCapillaryStep 0; " + noSlip + " }"), drop.liquid
            );
            model->apply(drop.liquid, drop.near, drop.walls, 0.02f);
            const auto smoothed = drop.inOrder(drop.liquid.velocity);
            std::vector<double> volume;
            for (const Vec3& k : solid)
            {
                double sum = 0;
                for (const Vec3& l : solid) sum += W.W(norm(k - l));
                volume.push_back(1 / sum);
            }
            scalar atWalls = 0;
            for (int i = 0; i < 200; ++i)
            {
                double neighbours = 0, wall = 0;
                for (int j = 0; j < 200; ++j)
                {
                    neighbours += (double(velocities[j].y) - velocities[i].y) * W.W(norm(points[i] - points[j]));
                }
                const double s = points[i].x + 3.5;
                const auto cap = [&](double r) { return 2 * std::numbers::pi * r * (r - s) * W.W(r); };
                if (s < 2) wall += integrate(s, 2, 200, cap);
                for (std::size_t k = 0; sampled && k < solid.size(); ++k) wall += volume[k] * W.W(norm(points[i] - solid[k]));
                if (noSlip == "noSlip no;") wall = 0;
                const double expected = velocities[i].y + 0.3 * (neighbours - wall * velocities[i].y);
                ASSERT_NEAR(smoothed[i].y, expected, 5e-5) << i;       // 0.3 times the table's interpolation, 1e-4
                atWalls = std::max(atWalls, std::abs(scalar(0.3 * wall * velocities[i].y)));
            }
            EXPECT_EQ(atWalls > 0.02f, noSlip != "noSlip no;");
        }
    }
}

// perCapillaryStep p: the share of a step is 1 - (1 - p)^(dt/t_c), but no less than c.
TEST(XSPH, SmoothsAsMuchInATimeWhateverTheStep)
{
    LiquidCase drop;
    const auto points = latticeBlock(2, 1, 1, 1);
    const scalar capillary = drop.liquid.units().toScaled(drop.liquid.properties().capillaryStep(), dimensions::time);
    const auto smoothed = [&](const std::string& coeffs, scalar steps)
    {
        drop.place(points, {{1, 0, 0}, {0, 0, 0}});
        const auto model = Viscosity::New(Dictionary::parse("viscosity XSPH; XSPHCoeffs { " + coeffs + " }"), drop.liquid);
        model->apply(drop.liquid, drop.near, drop.walls, steps * capillary);
        return drop.inOrder(drop.liquid.velocity)[1].x;
    };
    const scalar whole = smoothed("c 1; perCapillaryStep 0;", 1);           // of two particles: W at their distance
    EXPECT_GT(whole, 0.03f);
    EXPECT_EQ(smoothed("c 0.1; perCapillaryStep 0;", 7), smoothed("c 0.1; perCapillaryStep 0;", 1));
    for (const scalar steps : {0.1f, 0.25f, 1.0f, 2.0f, 5.0f})  // the share of 0.1 lies below c
    {
        const double share = std::max(0.05, 1 - std::pow(0.7, steps));
        // To the rounding of a power and of velocities of order 1.
        EXPECT_NEAR(smoothed("c 0.05; perCapillaryStep 0.3;", steps) / whole, share, 4e-6) << steps;
    }
}

// slipAbove s: as long as a particle is faster than s d/t_c walls take as much from it as at that speed, and below what they take without.
TEST(XSPH, HoldsBackFastLiquidNoMore)
{
    LiquidCase drop(caseOnFloor({}));
    const scalar limit = 0.1f * drop.liquid.spacing() / drop.liquid.units().toScaled(drop.liquid.properties().capillaryStep(), dimensions::time);
    const auto taken = [&](const std::string& coeffs, Vec3 velocity)
    {
        drop.place({{0, 0, 0.5f}}, {velocity});
        const auto model = Viscosity::New(Dictionary::parse("viscosity XSPH; XSPHCoeffs { c 0.2; perCapillaryStep 0; " + coeffs + " }"), drop.liquid);
        model->apply(drop.liquid, drop.near, drop.walls, 0.02f);
        return velocity - drop.inOrder(drop.liquid.velocity)[0];
    };
    const Vec3 unit{0.6f, 0, -0.8f};
    const Vec3 atLimit = taken("slipAbove 0;", limit * unit);
    EXPECT_GT(norm(atLimit), 0.02f * limit);
    for (const scalar speed : {0.0f, 0.5f, 1.0f, 3.0f, 100.0f})
    {
        const scalar share = std::min(speed, scalar(1));
        // Differences of velocities of order `speed`, in single precision.
        EXPECT_LT(norm(taken("slipAbove 0.1;", speed * limit * unit) - share * atLimit), 2e-7f * (1 + speed) * limit) << speed;
    }
    EXPECT_GT(norm(taken("slipAbove 0;", 100 * limit * unit)), 99 * norm(atLimit));
}

TEST(XSPH, RefusesACapillaryStepWithoutTension)
{
    LiquidCase drop(CaseText{.liquidProperties = "rho 1000; nu 1e-6; sigma 0;"});
    const auto make = [&](const std::string& coeff)
    {
        Viscosity::New(Dictionary::parse("viscosity XSPH; XSPHCoeffs { " + coeff + "; }", "constant/models"), drop.liquid);
    };
    EXPECT_TRUE(holds(messageOf([&] { make("perCapillaryStep 0.5"); }), {"constant/models", "surface tension", "perCapillaryStep 0"}));
    EXPECT_TRUE(holds(messageOf([&] { make("slipAbove 0.5"); }), {"constant/models", "surface tension", "slipAbove 0"}));
    EXPECT_NO_THROW(make("perCapillaryStep 0; slipAbove 0"));
    EXPECT_NO_THROW(make("c 0.2"));                 // what is not said needs none
}

TEST(XSPH, RefusesACoefficientOutOfRange)
{
    LiquidCase drop;
    const Dictionary negative = Dictionary::parse("viscosity XSPH; XSPHCoeffs { slipAbove -1; }", "constant/models");
    EXPECT_TRUE(holds(messageOf([&] { Viscosity::New(negative, drop.liquid); }), {"constant/models", "slipAbove", "0 or more"}));
    for (const std::string c : {"c -0.1", "c 1.5", "perCapillaryStep 1.5"})
    {
        const Dictionary models = Dictionary::parse("viscosity XSPH; XSPHCoeffs { " + c + "; }", "constant/models");
        EXPECT_TRUE(holds(messageOf([&] { Viscosity::New(models, drop.liquid); }), {"constant/models", "0 to 1"}));
    }
}

// A word alone means what the ladder validates: shares of 0.2 and 0.7, and walls up to a tenth of a spacing a capillary step.
TEST(XSPH, WithoutCoefficientsIsTheDefault)
{
    const auto smoothed = [](const std::string& models)
    {
        LiquidCase drop(caseOnFloor({}));
        drop.place(latticeBlock(3, 3, 3, 1, {-1, -1, 0.5f}), randomPoints(27, {-1, -1, -1}, {1, 1, 1}, 2));
        Viscosity::New(Dictionary::parse(models), drop.liquid)->apply(drop.liquid, drop.near, drop.walls, 0.05f);
        return drop.inOrder(drop.liquid.velocity);
    };
    const auto bare = smoothed("viscosity XSPH;");
    const auto said = smoothed("viscosity XSPH; XSPHCoeffs { c 0.2; perCapillaryStep 0.7; noSlip yes; slipAbove 0.1; }");
    for (std::size_t i = 0; i < bare.size(); ++i) EXPECT_EQ(norm(bare[i] - said[i]), 0) << i;
}
