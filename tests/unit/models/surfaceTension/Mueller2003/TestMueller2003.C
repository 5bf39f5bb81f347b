// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/PairForceMeter.H"
#include "support/PairReference.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

double poly6(double r, double h)
{
    return r >= h ? 0 : 315 / (64 * std::numbers::pi * std::pow(h, 9)) * std::pow(h * h - r * r, 3);
}

}

// The colour field of all particles in double precision, its gradient and Laplacian by differences: -sigma lap c n/|n| over
// rho_i. Differences over 1e-3 h are right to 1e-5, sums of twenty floats of either sign to 1e-4 of the largest.
TEST(Mueller2003, IsTheCurvatureOfTheColourField)
{
    const auto points = randomPoints(150, {0, 0, 0}, {5, 5, 5});
    LiquidCase drop;
    const auto tension = makeTension(drop, "Mueller2003", "threshold 0.2;");
    drop.place(points);
    auto system = pairSystem<CubicSpline>(drop, points);
    system.prepare();
    const double h = system.h, V = std::pow(system.spacing, 3), e = 1e-3 * h;
    const auto colour = [&](const Vector3& x)
    {
        double sum = 0;
        for (std::size_t j = 0; j < points.size(); ++j) sum += V / system.density[j] * poly6(length(x - system.liquid[j]), h);
        return sum;
    };
    std::vector<Vector3> expected;
    int active = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const Vector3 x = system.liquid[i], steps[3] = {{e, 0, 0}, {0, e, 0}, {0, 0, e}};
        double slope[3], laplacian = 0;
        for (int c = 0; c < 3; ++c)
        {
            const double up = colour(x + steps[c]), down = colour(x - steps[c]);
            slope[c] = (up - down) / (2 * e);
            laplacian += (up - 2 * colour(x) + down) / (e * e);
        }
        const Vector3 n(slope[0], slope[1], slope[2]);
        const bool surface = length(n) > 0.2 * 315 / (256 * h);         // of the integral of poly6 over a plane
        active += surface;
        expected.push_back(surface ? -0.072 * laplacian / (1000 * system.density[i]) * normalized(n) : Vector3());
    }
    EXPECT_GT(active, 75);
    EXPECT_LT(active, 150);
    EXPECT_TRUE(agree(accelerationsOf(drop, *tension), drop.liquid.units(), expected, 1e-4));
}

// A ball is drawn together, and nothing happens inside it.
TEST(Mueller2003, PullsABallTogether)
{
    LiquidCase drop;
    const auto tension = makeTension(drop, "Mueller2003");
    const auto ball = latticeBall(6);
    drop.place(ball);
    const auto a = accelerationsOf(drop, *tension);
    double inwards = 0;
    for (std::size_t i = 0; i < ball.size(); ++i)
    {
        inwards -= dot(a[i], ball[i]) / norm(ball[i]);
        if (norm(ball[i]) >= 3.5f) continue;
        ASSERT_EQ(norm(a[i]), 0);
    }
    EXPECT_GT(inwards, 0);
}

TEST(Mueller2003, RefusesAThresholdOutOfRange)
{
    LiquidCase drop;
    for (const std::string threshold : {"0", "1", "-1"})
    {
        const auto make = [&] { makeTension(drop, "Mueller2003", "threshold " + threshold + ";"); };
        EXPECT_TRUE(holds(messageOf(make), {"constant/models", "threshold"})) << threshold;
    }
}
