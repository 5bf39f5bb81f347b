// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/PressureReference.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// 250 points in 180 cells: most of them compressed, some alone.
const auto points = randomPoints(250, {-3, -3, 0.1f}, {3, 3, 5});

constexpr scalar dt = 0.01f;             // scaled; moves the most compressed particle by about a spacing

}

// Tait's equation and the momentum equation over all pairs. The density's rounding of 1e-6 enters p seven times, positions
// are rounded by 1e-7 of some units, half-space tables are interpolated: 1e-3 of the largest acceleration beside a floor,
// 1e-4 else.
TEST(WCSPH, EqualsTheSumOverAllPairs)
{
    for (auto& [drop, system] : pressureCases(points))
    {
        const auto pressure = makePressure(*drop, "WCSPH", "maxSpeed 1; maxDensityVariation 0.04;");
        drop->place(points);
        const auto before = drop->inOrder(drop->liquid.predicted);
        EXPECT_EQ(iterate(*pressure, *drop, dt), 1);

        const double B = system.restDensity * 25 / 7;           // c = 1 m/s over 0.2
        const auto p = [&, &system = system](std::size_t i) { return std::max(B * (std::pow(system.density[i], 7) - 1), 0.0); };
        const auto expected = pressureForces(system, [&, &system = system](std::size_t i, int j)
        {
            const double own = p(i) / std::pow(system.density[i], 2);
            return j < 0 ? own : own + p(j) / std::pow(system.density[j], 2);
        });
        EXPECT_TRUE(agree(accelerationsSince(before, *drop, dt), drop->liquid.units(), expected, system.floor ? 1e-3 : 1e-4));
        const auto kept = drop->inOrder(*pressure->keepPressure());
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const double found = drop->liquid.units().toSI(kept[i], dimensions::pressure);
            ASSERT_NEAR(found, p(i), 1e-3 * p(i) + 1e-4 * B);
        }
    }
}

// Forces belong to the positions at the beginning: what has been predicted since changes nothing.
TEST(WCSPH, TakesItsForcesAtTheBeginningOfTheStep)
{
    LiquidCase drop;
    const auto pressure = makePressure(drop, "WCSPH", "maxSpeed 0.1;");
    drop.place(latticeBlock(6, 6, 6, 0.9f));
    const auto moves = [&]
    {
        const auto before = drop.inOrder(drop.liquid.predicted);
        iterate(*pressure, drop, 0.05f);
        return accelerationsSince(before, drop, 1);
    };
    const auto first = moves(), second = moves();
    scalar most = 0;
    for (const Vec3& way : first) most = std::max(most, norm(way));
    EXPECT_GT(most, 0.01f);
    for (std::size_t i = 0; i < first.size(); ++i) ASSERT_NEAR(norm(second[i] - first[i]), 0, 2e-6);    // of positions up to 6
}

// A lattice is at rest density inside and below it at its faces: it feels nothing but the rounding of its densities. Ten
// per cent closer it flies apart.
TEST(WCSPH, LeavesALatticeAlone)
{
    for (const bool closer : {false, true})
    {
        LiquidCase drop;
        const auto pressure = makePressure(drop, "WCSPH", "maxSpeed 1;");
        const auto block = latticeBlock(7, 7, 7, closer ? 0.9f : 1);
        drop.place(block);
        const auto before = drop.inOrder(drop.liquid.predicted);
        iterate(*pressure, drop, 0.01f);
        const auto a = accelerationsSince(before, drop, 0.01f);
        scalar most = 0;
        for (const Vec3& accelerated : a) most = std::max(most, norm(accelerated));
        const scalar c2 = std::pow(drop.liquid.units().toScaled(10, dimensions::velocity), 2);
        EXPECT_EQ(most > 0.01f * c2, closer);       // c^2/d and the relative compression, here some 1e-6 or tenths
    }
}

TEST(WCSPH, LimitsTheStepBySound)
{
    LiquidCase drop;                        // spacing 1 mm, support 2 mm
    EXPECT_NEAR(makePressure(drop, "WCSPH", "maxSpeed 1;")->stepLimit(drop.liquid.properties()), 0.4 * 1e-3 / 10, 1e-11);
    EXPECT_NEAR(makePressure(drop, "WCSPH", "maxSpeed 3; maxDensityVariation 0.09;")->stepLimit(drop.liquid.properties()), 0.4 * 1e-3 / 10, 1e-11);
    // Water's tension: 2 sqrt(0.072/(1000 1e-3)) = 0.5367 m/s.
    EXPECT_NEAR(makePressure(drop, "WCSPH", "")->stepLimit(drop.liquid.properties()), 0.4 * 1e-3 / 5.3666, 1e-9);
}

TEST(WCSPH, RefusesWhatIsOutOfRange)
{
    LiquidCase drop;
    for (const std::string entry : {"maxDensityVariation 0;", "maxDensityVariation 2;", "maxSpeed 0;", "maxSpeed -1;"})
    {
        const std::string key = entry.substr(0, entry.find(' '));
        EXPECT_TRUE(holds(messageOf([&] { makePressure(drop, "WCSPH", entry); }), {"system/solution", key})) << entry;
    }
    LiquidCase still({.liquidProperties = "rho 1000; nu 1e-6; sigma 0;"});
    EXPECT_TRUE(holds(messageOf([&] { makePressure(still, "WCSPH", ""); }), {"maxSpeed"}));
}
