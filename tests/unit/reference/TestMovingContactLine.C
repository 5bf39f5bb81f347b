// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/MovingContactLine.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace shizuku;

// By hand: 60 degrees are 1.0472, whose cube is 1.14838; with 9 x 0.01 x 3 it is 1.41838, of 1.12356 or 64.375 degrees.
TEST(MovingContactLine, OfAnAdvancingLineIsSteeper)
{
    EXPECT_NEAR(movingAngle(60, 0.01, 3), 64.375, 1e-3);
    EXPECT_NEAR(movingAngle(60, 0, 3), 60, 1e-12);
    EXPECT_EQ(movingAngle(60, -1, 3), 0);
    EXPECT_EQ(movingAngle(60, 10, 3), 180);
}

// Tanner's law: from 0 degrees on the angle's cube is 9 Ca ln(L/lambda) alone.
TEST(MovingContactLine, OfCompleteWettingIsTanners)
{
    EXPECT_NEAR(movingAngle(0, 8e-4, 10)/movingAngle(0, 1e-4, 10), 2, 1e-12);
}

// The wedge's friction: terms of the order of the third power of Ca are 1e-6 of it at 1e-5.
TEST(MovingContactLine, HoldsASlowDropByItsWedge)
{
    const double theta = std::numbers::pi/3, ca = 1e-5;
    EXPECT_NEAR(slidingForce(60, ca, 3), 3*std::numbers::pi*ca*3*std::sin(theta)/(theta*theta), 1e-6*slidingForce(60, ca, 3));
}

// Rounding of the angles' cosines: 1e-13 of the force.
TEST(MovingContactLine, SpeedIsThatOfTheForce)
{
    EXPECT_NEAR(slidingForce(60, 0, 3), 0, 1e-12);
    for (const double ca : {1e-3, 0.01, 0.03}) EXPECT_NEAR(slidingSpeed(60, slidingForce(60, ca, 3), 3), ca, 1e-9) << ca;
    EXPECT_NEAR(slidingLogarithm(60, 0.01, slidingForce(60, 0.01, 3)), 3, 1e-9);
    EXPECT_TRUE(std::isnan(slidingSpeed(60, 2, 3))) << "more than the rear bears";
}
