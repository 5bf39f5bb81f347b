// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/PairForceMeter.H"

using namespace shizuku;
using namespace shizuku::test;

// kappa W r with the cubic spline, times m [N]; whatever the case's kernel. Single precision: 1e-5.
TEST(Becker2007, IsTheKernelTimesTheDistance)
{
    for (const std::string kernel : {"cubicSpline", "WendlandC2"})
    {
        LiquidCase drop({.kernel = "type " + kernel + "; support 2;"});
        const auto tension = makeTension(drop, "Becker2007", "kappa 3e-6;");
        const Reference<CubicSpline> W{2e-3};
        for (const double r : {0.1, 0.7, 1.0, 1.5, 1.9})
        {
            const double expected = 3e-6 * 1e-6 * W.W(1e-3 * r) * 1e-3 * r;
            EXPECT_NEAR(attraction(drop, *tension, r), expected, 2e-5 * expected) << r;       // r is rounded by 1e-6, near the support of 2 that is 1e-5 of W
        }
        EXPECT_EQ(attraction(drop, *tension, 2.01), 0);
    }
}

TEST(Becker2007, HasTheTensionOfTheLiquid)
{
    expectTensionOfTheLiquid("Becker2007");
}

TEST(Becker2007, RefusesANegativeCoefficient)
{
    LiquidCase drop;
    EXPECT_TRUE(holds(messageOf([&] { makeTension(drop, "Becker2007", "kappa -1;"); }), {"constant/models", "kappa"}));
}
