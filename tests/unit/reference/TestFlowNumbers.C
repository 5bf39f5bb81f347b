// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/FlowNumbers.H"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace shizuku::test
{

namespace
{

// Water, 2 mm at 1 m/s: by hand with a table's values.
const FlowScales water{2e-3, 1, 9.81, 998, 1e-6, 0.0728};
constexpr double digits = 1e-12;        // of the numbers below; doubles

TEST(FlowNumbers, OfADropOfWater)
{
    const FlowNumbers n = flowNumbers(water);
    EXPECT_NEAR(n.bond, 998*9.81*4e-6/0.0728, digits);
    EXPECT_NEAR(n.weber, 998*2e-3/0.0728, digits*n.weber);
    EXPECT_NEAR(n.reynolds, 2000, 2000*digits);
    EXPECT_NEAR(n.capillary, 998e-6/0.0728, digits);
    // Oh = sqrt(We)/Re, Ca = We/Re, whatever the scales.
    EXPECT_NEAR(n.ohnesorge, std::sqrt(n.weber)/n.reynolds, digits);
    EXPECT_NEAR(n.capillary, n.weber/n.reynolds, digits);
}

TEST(FlowNumbers, OfLimits)
{
    FlowScales still = water;
    still.speed = 0;
    still.surfaceTension = 0;
    EXPECT_EQ(flowNumbers(still).bond, std::numeric_limits<double>::infinity());
    EXPECT_EQ(flowNumbers(still).weber, 0);
    EXPECT_EQ(flowNumbers(still).reynolds, 0);
    EXPECT_EQ(describe(still), "Reynolds number U D/nu 0");
    still.viscosity = 0;
    EXPECT_EQ(describe(still), "");
}

}

}
