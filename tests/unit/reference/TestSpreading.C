// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/Spreading.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace shizuku;

// The fit is theirs: it passes their points by no more than the 0.021 that they scatter about it.
TEST(Spreading, MeasuredSharesFollowTheirFit)
{
    double before = 0;
    for (const auto& [time, area] : lavi2004())
    {
        EXPECT_NEAR(fittedWettedShare(time), area, 0.021) << time;
        EXPECT_GT(area, before);
        before = area;
    }
    EXPECT_EQ(fittedWettedShare(0), 0);
}

// By hand: a cap of 41 degrees has a contact radius of 1.896 R, the fit comes to 1/1.896^2 = 0.2782 at 5.06, and that times (4 pi/3)^(1/3).
TEST(Spreading, TimesOfADiscOfTheDropsRadius)
{
    EXPECT_NEAR(viscousSpreadingTime(), 8.16, 0.02);
    EXPECT_NEAR(inertialSpreadingTime(), 0.77, 0.005);
}

// With dimensions: a litre of syrup of 0.01 m2/s is 0.18 m wide on each side after ten seconds.
TEST(Spreading, HuppertsDrop)
{
    EXPECT_NEAR(huppertRadius(9.81, 1e-3, 0.01, 10), 0.1844, 1e-4);
    EXPECT_NEAR(huppertRadius(9.81, 1e-3, 0.01, 1000)/huppertRadius(9.81, 1e-3, 0.01, 10), std::pow(100, 0.125), 1e-12);
}
