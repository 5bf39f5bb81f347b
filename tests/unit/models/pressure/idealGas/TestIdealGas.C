// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/PressureReference.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

const auto points = randomPoints(250, {-3, -3, 0.1f}, {3, 3, 5});

}

// p = k (rho - rho0), f_i = -sum_j m (p_i + p_j)/(2 rho_j) grad W_ij over all pairs, k = 2 c^2. Tolerances as for WCSPH.
TEST(IdealGas, EqualsTheSumOverAllPairs)
{
    constexpr scalar dt = 0.05f;
    for (auto& [drop, system] : pressureCases(points))
    {
        const auto pressure = makePressure(*drop, "idealGas", "maxSpeed 1; maxDensityVariation 0.04;");
        drop->place(points);
        const auto before = drop->inOrder(drop->liquid.predicted);
        EXPECT_EQ(iterate(*pressure, *drop, dt), 1);

        const auto& D = system.density;
        const double k = 2 * 25;                                // c = 1 m/s over 0.2
        const auto p = [&, &system = system](std::size_t i) { return std::max(k * system.restDensity * (D[i] - 1), 0.0); };
        const auto expected = pressureForces(system, [&](std::size_t i, int j)
        {
            return j < 0 ? p(i) / (2 * D[i] * D[i]) : (p(i) + p(j)) / (2 * D[i] * D[j]);
        });
        EXPECT_TRUE(agree(accelerationsSince(before, *drop, dt), drop->liquid.units(), expected, system.floor ? 1e-3 : 1e-4));
        const auto kept = drop->inOrder(*pressure->keepPressure());
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const double acting = drop->liquid.units().toSI(kept[i], dimensions::pressure);
            ASSERT_NEAR(acting, p(i) / 2, 1e-3 * p(i) + 1e-4 * k * system.restDensity);
        }
    }
}

// What the class says of its pressure: in a full neighbourhood a gradient of p/2 is what accelerates. A lattice that is
// denser by 1e-3 a spacing along x.
TEST(IdealGas, ActsWithHalfOfItsPressure)
{
    LiquidCase drop;
    const auto pressure = makePressure(drop, "idealGas", "maxSpeed 1;");
    auto block = latticeBlock(11, 11, 11, 0.97f, {-4.85f, -4.85f, -4.85f});
    for (Vec3& x : block) x.x -= 0.5e-3f * x.x * x.x;
    drop.place(block);
    const auto before = drop.inOrder(drop.liquid.predicted);
    constexpr scalar dt = 0.01f;
    iterate(*pressure, drop, dt);
    const auto a = accelerationsSince(before, drop, dt);
    const auto p = drop.inOrder(*pressure->keepPressure());
    const int middle = 5 + 11 * (5 + 11 * 5);
    const scalar slope = (p[middle + 1] - p[middle - 1]) / (norm(before[middle + 1] - before[middle - 1]));
    const scalar density = drop.liquid.restDensity() / std::pow(0.97f, 3.0f);
    // The kernel's own error of a gradient on a lattice is some per cent, that of the difference above far below.
    EXPECT_NEAR(a[middle].x, -slope / density, 0.05f * slope / density);
}

TEST(IdealGas, LimitsTheStepBySound)
{
    LiquidCase drop;
    EXPECT_NEAR(makePressure(drop, "idealGas", "maxSpeed 1;")->stepLimit(drop.liquid.properties()), 0.4 * 1e-3 / 10, 1e-11);
}
