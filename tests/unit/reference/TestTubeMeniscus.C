// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/TubeMeniscus.H"

#include "core/messages/Error.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace shizuku;

namespace
{

constexpr double pi = std::numbers::pi;
constexpr double capillaryLength = 2.73e-3;     // of water

}

// In a narrow tube the surface is a sphere of radius r/cos(theta): height r (1 - sin)/cos, mean height of the cap around.
TEST(TubeMeniscus, IsASphereInANarrowTube)
{
    const double r = 1e-2*capillaryLength;
    for (const double theta : {0.0, 30.0, 60.0, 120.0, 150.0})
    {
        const TubeMeniscus meniscus = tubeMeniscus(r, capillaryLength, theta);
        const double s = std::sin(theta*pi/180), c = std::cos(theta*pi/180);
        // Gravity counts by (r/l)^2 = 1e-4.
        EXPECT_NEAR(meniscus.height(r), r*(1 - s)/c, 3e-4*r) << theta;
        EXPECT_NEAR(meniscus.apexCurvature, c/r, 3e-4/r) << theta;
        if (theta == 0)
        {
            EXPECT_NEAR(meniscus.meanHeight, r/3, 3e-4*r);      // cylinder without half a ball
        }
    }
}

// The liquid above the level of a large vessel is held by the wall: weight = 2 pi r sigma cos(theta), for any radius. The
// axis stands at 2 l^2 (curvature of the apex) above that level.
TEST(TubeMeniscus, HoldsTheWeightOfItsLiquid)
{
    for (const double r : {0.3e-3, 2e-3, 10e-3})
    {
        for (const double theta : {10.0, 45.0, 89.0, 135.0})
        {
            const TubeMeniscus meniscus = tubeMeniscus(r, capillaryLength, theta);
            const double l2 = capillaryLength*capillaryLength;
            const double lifted = pi*r*r*(2*l2*meniscus.apexCurvature + meniscus.meanHeight)/l2;
            const double line = 2*pi*r*std::cos(theta*pi/180);
            EXPECT_NEAR(lifted, line, 1e-7*std::abs(line)) << r << ' ' << theta;
        }
    }
}

// Beside a plane wall z^2 = 2 l^2 (1 - sin theta); the curvature of a tube of forty lengths l takes off some l/r.
TEST(TubeMeniscus, ComesToThatOfAPlaneWall)
{
    const double r = 40*capillaryLength;
    const TubeMeniscus meniscus = tubeMeniscus(r, capillaryLength, 30);
    EXPECT_NEAR(meniscus.height(r), capillaryLength*std::sqrt(2*(1 - 0.5)), 0.02*capillaryLength);
    EXPECT_NEAR(meniscus.height(0.5*r), 0, 1e-6*capillaryLength);
}

TEST(TubeMeniscus, IsFlatAtNinetyDegreesAndTurnsOver)
{
    EXPECT_EQ(tubeMeniscus(1e-3, capillaryLength, 90).height(0.5e-3), 0);
    const TubeMeniscus up = tubeMeniscus(2e-3, capillaryLength, 30), down = tubeMeniscus(2e-3, capillaryLength, 150);
    for (const double r : {0.0, 1e-3, 1.9e-3, 2e-3}) EXPECT_DOUBLE_EQ(up.height(r), -down.height(r));
    EXPECT_THROW(tubeMeniscus(0, 1, 30), FatalError);
    EXPECT_THROW(tubeMeniscus(1, 1, 181), FatalError);
}
