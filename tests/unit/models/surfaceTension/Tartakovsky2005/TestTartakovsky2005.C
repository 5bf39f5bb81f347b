// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/PairForceMeter.H"

using namespace shizuku;
using namespace shizuku::test;

// s cos(3 pi r/(2h)) [N], repulsive up to h/3 = 2/3 spacings. Single precision: 1e-5 of s.
TEST(Tartakovsky2005, IsTheCosineOfThePaper)
{
    LiquidCase drop;
    const auto tension = makeTension(drop, "Tartakovsky2005", "s 2e-6;");
    for (const double r : {0.1, 0.5, 0.66, 0.67, 1.0, 1.4, 1.9, 1.99})
    {
        EXPECT_NEAR(attraction(drop, *tension, r), -2e-6 * std::cos(1.5 * std::numbers::pi * r / 2), 2e-11) << r;
    }
    EXPECT_EQ(attraction(drop, *tension, 2.01), 0);
}

// The strength that follows from sigma, against the integral in closed form: with a = 3 pi/2, minus int q^4 cos(a q) is
// 1/a - 12/a^3 + 24/a^5; and against the quadrature of what the model does.
TEST(Tartakovsky2005, HasTheTensionOfTheLiquid)
{
    expectTensionOfTheLiquid("Tartakovsky2005");
    for (const double support : {2.0, 3.0})
    {
        LiquidCase drop({.kernel = "type cubicSpline; support " + std::to_string(support) + ";"});
        const auto tension = makeTension(drop, "Tartakovsky2005");
        const double a = 1.5 * std::numbers::pi, integral = 1 / a - 12 / std::pow(a, 3) + 24 / std::pow(a, 5);
        const double s = 8 * 0.072 * 1e-18 / (std::numbers::pi * std::pow(support * 1e-3, 5) * integral);
        EXPECT_NEAR(attraction(drop, *tension, support * 2 / 3), s, 1e-4 * s) << support;
    }
}

TEST(Tartakovsky2005, RefusesANegativeStrength)
{
    LiquidCase drop;
    EXPECT_TRUE(holds(messageOf([&] { makeTension(drop, "Tartakovsky2005", "s -1;"); }), {"constant/models", "strength s"}));
}
