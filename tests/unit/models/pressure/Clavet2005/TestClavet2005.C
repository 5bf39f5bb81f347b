// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/PressureReference.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// Sums over the lattice of spacing a (in spacings) within h = 2 of (1 - r/h)^power, times r where `arm`.
double latticeSumOf(double a, int power, bool arm)
{
    double sum = 0;
    for (const Vec3& x : latticeBlock(7, 7, 7, 1, {-3, -3, -3}))
    {
        const double r = a * norm(x);
        if (r > 0 && r < 2) sum += std::pow(1 - r / 2, power) * (arm ? r : 1);
    }
    return sum;
}

struct Coefficients
{
    double rest, k, near;           // k: m/s2
};

// The lattice has no virial pressure, and dp/drho = c^2 there: by the difference between lattices 2 % closer and wider.
Coefficients coefficientsOf(double c, double near)
{
    const double rest = latticeSumOf(1, 2, false)
        + near * latticeSumOf(1, 3, false) * latticeSumOf(1, 2, true) / latticeSumOf(1, 1, true);
    const auto p = [&](double D)
    {
        const double a = std::pow(D, -1.0 / 3);
        const double P = latticeSumOf(a, 2, false) - rest, nearP = near * latticeSumOf(a, 3, false);
        return D / 6 * (P * latticeSumOf(a, 1, true) + nearP * latticeSumOf(a, 2, true));
    };
    return {rest, c * c / 1e-3 / ((p(1.01) - p(0.99)) / 0.02), near};
}

}

// All pairs of a random set in double precision, half of (P_i + P_j)(1 - r/h) + (P'_i + P'_j)(1 - r/h)^2. Scalars: 1e-4 of the
// largest; the difference of lattices enters k, 1e-3.
TEST(Clavet2005, EqualsTheSumOverAllPairs)
{
    const auto points = randomPoints(250, {-3, -3, 0.1f}, {3, 3, 5});
    constexpr scalar dt = 0.01f;
    LiquidCase drop;
    const auto pressure = makePressure(drop, "Clavet2005", "maxSpeed 1; maxDensityVariation 0.04; near 2;");
    drop.place(points);
    const auto before = drop.inOrder(drop.liquid.predicted);
    EXPECT_EQ(iterate(*pressure, drop, dt), 1);

    const Coefficients of = coefficientsOf(5, 2);
    const auto system = pairSystem<CubicSpline>(drop, points);
    const auto open = [&](std::size_t i, std::size_t j)
    {
        return j == i ? 0 : std::max(1 - length(system.liquid[i] - system.liquid[j]) / system.h, 0.0);
    };
    std::vector<double> P, nearP;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        double sum = 0, nearSum = 0;
        for (std::size_t j = 0; j < points.size(); ++j)
        {
            sum += std::pow(open(i, j), 2);
            nearSum += std::pow(open(i, j), 3);
        }
        P.push_back(of.k * (sum - of.rest));
        nearP.push_back(of.k * of.near * nearSum);
    }
    std::vector<Vector3> expected(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        for (std::size_t j = 0; j < points.size(); ++j)
        {
            const double q = open(i, j);
            if (q > 0)
            {
                expected[i] += 0.5 * q * (P[i] + P[j] + q * (nearP[i] + nearP[j])) * normalized(system.liquid[i] - system.liquid[j]);
            }
        }
    }
    EXPECT_TRUE(agree(accelerationsSince(before, drop, dt), drop.liquid.units(), expected, 2e-3));
}

// A solid particle pushes alike: two particles, one of them solid with V_k = 1/W(0).
TEST(Clavet2005, TakesSolidParticlesForLiquidThatStays)
{
    constexpr scalar dt = 0.05f;
    LiquidCase drop({.walls = sampledFloor, .solidPositions = {{0, 0, 0}}});
    const auto pressure = makePressure(drop, "Clavet2005", "maxSpeed 1;");
    drop.place({{0, 0, 1.2f}});
    const auto before = drop.inOrder(drop.liquid.predicted);
    iterate(*pressure, drop, dt);
    const Coefficients of = coefficientsOf(10, 2.5);
    const double V = 1 / Reference<CubicSpline>{2}.W(0), q = 1 - 1.2 / 2;
    const double P = of.k * (V * q * q - of.rest), nearP = of.k * of.near * V * q * q * q;
    const double expected = 0.5 * V * q * (P + nearP * q);
    const double found = drop.liquid.units().toSI(accelerationsSince(before, drop, dt)[0].z, dimensions::acceleration);
    EXPECT_LT(found, 0);                        // alone it has too few neighbours, and is drawn
    EXPECT_NEAR(found, expected, 2e-3 * std::abs(expected));
}

TEST(Clavet2005, RefusesAnalyticWallsAndAbsurdCoefficients)
{
    LiquidCase tank({.walls = floorPlane});
    EXPECT_TRUE(holds(messageOf([&] { makePressure(tank, "Clavet2005", ""); }), {"analytic walls", "type particles"}));
    LiquidCase drop;
    EXPECT_TRUE(holds(messageOf([&] { makePressure(drop, "Clavet2005", "near 0;"); }), {"system/solution", "near"}));
}
