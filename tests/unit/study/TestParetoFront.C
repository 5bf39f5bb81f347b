// SPDX-License-Identifier: GPL-3.0-or-later
// The Pareto front of points with numbers one can check by eye.

#include "study/ParetoFront.H"

#include <gtest/gtest.h>

#include <cmath>

namespace shizuku::test
{

namespace
{

TEST(ParetoFront, HoldsWhatNothingBeats)
{
    const double nan = std::nan("");
    const std::vector<CostAndError> points{{1, 10}, {2, 5}, {3, 5}, {4, 1}, {4, 2}, {nan, 0}, {0, nan}, {2, 5}};
    const std::vector<bool> expected{true, true, false, true, false, false, false, true};
    EXPECT_EQ(paretoFront(points), expected);
    EXPECT_TRUE(paretoFront({}).empty());
}

}

}
