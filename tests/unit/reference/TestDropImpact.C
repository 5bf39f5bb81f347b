// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/DropImpact.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace shizuku;

// In the middle of a bin its mean, between two of them something between, beyond all the outermost.
TEST(DropImpact, ReboundIsThatOfTheBins)
{
    EXPECT_NEAR(measuredRebound(std::sqrt(2)).contactTime, 2.41, 1e-12);
    EXPECT_NEAR(measuredRebound(std::sqrt(2)).restitution, 0.70, 1e-12);
    EXPECT_NEAR(measuredRebound(std::sqrt(0.05*0.1)).contactTime, 3.48, 1e-12);
    EXPECT_NEAR(measuredRebound(std::pow(20, 0.25)).restitution, (0.70 + 0.58)/2, 1e-12);     // halfway from sqrt(2) to sqrt(10)
    EXPECT_EQ(measuredRebound(1e-4).contactTime, 3.94);
    EXPECT_EQ(measuredRebound(100).contactTime, 2.265);
    for (double weber = 0.02; weber < 10; weber *= 1.1) EXPECT_GE(measuredRebound(weber).contactTime, measuredRebound(1.1*weber).contactTime);
}

// By hand: P = 27*2000^(-2/5) = 1.2914, its root 1.1364, the right side 0.47820, times 2000^(1/5) = 4.5731: 2.1869.
TEST(DropImpact, SpreadIsThatOfLaanAndLee)
{
    EXPECT_NEAR(largestSpread(27, 2000, 0), 2.1869, 1e-3);
    EXPECT_NEAR(largestSpread(27, 2000, 1.25), std::hypot(2.1869, 1.25), 1e-3);
    EXPECT_NEAR(largestSpread(1e-12, 2000, 1.25), 1.25, 1e-3);                      // laid down
    // Without tension viscosity alone holds it: Re^(1/5).
    EXPECT_NEAR(largestSpread(1e12, 2000, 0)/std::pow(2000, 0.2), 1, 1e-4);
}
