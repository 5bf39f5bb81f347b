// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/PressureReference.H"

#include <algorithm>

using namespace shizuku;
using namespace shizuku::test;

// The first iteration over all pairs: p = delta (rho - rho0) with delta from the sums of a particle in the lattice, and the
// displacement of (8) to (10). Tolerances as for WCSPH.
TEST(PCISPH, MakesTheFirstIterationOfThePaper)
{
    const auto points = randomPoints(250, {-3, -3, 0.1f}, {3, 3, 5});
    constexpr scalar dt = 0.05f;
    for (auto& [drop, system] : pressureCases(points))
    {
        const auto pressure = makePressure(*drop, "PCISPH", "minIterations 1; maxIterations 1;");
        drop->place(points);
        const auto before = drop->inOrder(drop->liquid.predicted);
        EXPECT_EQ(iterate(*pressure, *drop, dt), 1);

        const double d = system.spacing, m = system.restDensity * d * d * d;
        double squares = 0;
        for (const Vec3& r : latticeBlock(5, 5, 5, 1, {-2, -2, -2}))
        {
            if (norm(r) > 0) squares += std::pow(system.slope(d * norm(r)), 2);
        }
        const double seconds = drop->liquid.units().toSI(dt, dimensions::time);
        const double beta = 2 * std::pow(seconds * m / system.restDensity, 2), delta = 1 / (beta * squares);
        const auto p = [&, &system = system](std::size_t i) { return std::max(delta * system.restDensity * (system.density[i] - 1), 0.0); };
        const auto expected = pressureForces(system, [&](std::size_t i, int j) { return j < 0 ? p(i) : p(i) + p(j); });
        EXPECT_TRUE(agree(accelerationsSince(before, *drop, dt), drop->liquid.units(), expected, system.floor ? 1e-3 : 1e-4));
        const auto kept = drop->inOrder(*pressure->keepPressure());
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const double found = drop->liquid.units().toSI(kept[i], dimensions::pressure);
            ASSERT_NEAR(found, p(i), 1e-3 * p(i) + 1e-4 * delta * system.restDensity);
        }
    }
}

// 6 % too dense inside: at rest density to the tolerance, in less than the iterations allowed.
TEST(PCISPH, ExpandsACompressedBlockToTheTolerance)
{
    LiquidCase drop;
    const auto pressure = makePressure(drop, "PCISPH", "tolerance 1e-3;");
    drop.place(latticeBlock(8, 8, 8, 0.98f));
    const int iterations = iterate(*pressure, drop, 0.05f);
    EXPECT_GE(iterations, 3);
    EXPECT_LT(iterations, 50);
    double sum = 0;
    for (const scalar density : drop.liquid.density.download()) sum += std::max(density - 1, scalar(0));
    EXPECT_LE(sum / drop.liquid.owned(), 1e-3);
}

// An iteration adds what the change of p adds, so that forces between iterations stay in: the paper starts anew each time.
TEST(PCISPH, IsLinearInItsPressure)
{
    constexpr scalar dt = 0.05f;
    LiquidCase drop;
    const auto pressure = makePressure(drop, "PCISPH", "minIterations 4; maxIterations 4; tolerance 0;");
    const auto points = latticeBlock(6, 6, 6, 0.97f);
    drop.place(points);
    const auto before = drop.inOrder(drop.liquid.predicted);
    EXPECT_EQ(iterate(*pressure, drop, dt), 4);
    auto system = pairSystem<CubicSpline>(drop, points);
    const auto kept = drop.inOrder(*pressure->keepPressure());
    const auto p = [&](std::size_t i) { return drop.liquid.units().toSI(kept[i], dimensions::pressure); };
    const auto expected = pressureForces(system, [&](std::size_t i, int j) { return p(i) + p(j); });
    EXPECT_TRUE(agree(accelerationsSince(before, drop, dt), drop.liquid.units(), expected, 1e-4));
}

TEST(PCISPH, RefusesControlsOutOfRange)
{
    LiquidCase drop;
    for (const std::string entry : {"maxIterations 0;", "minIterations 51;", "tolerance -1;"})
    {
        const std::string key = entry.substr(0, entry.find(' '));
        EXPECT_TRUE(holds(messageOf([&] { makePressure(drop, "PCISPH", entry); }), {"system/solution", key})) << entry;
    }
}
