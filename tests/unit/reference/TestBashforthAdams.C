// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/BashforthAdams.H"

#include "core/messages/Error.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace shizuku;

namespace
{

constexpr double pi = std::numbers::pi, noGravity = HUGE_VAL;
constexpr double capillaryLength = 2.73e-3;         // of water
constexpr double integration = 1e-9;                // steps of 1e-12, some hundred of them, interpolated

}

TEST(BashforthAdams, WithoutGravityIsACap)
{
    for (double theta = 15; theta <= 180; theta += 15)
    {
        const double radius = 1e-3, c = std::cos(theta*pi/180);
        const DropProfile drop = bashforthAdams(radius, noGravity, theta);
        // At the sphere's lower pole sin(phi)/x is 0/0, which enlarges the error to 1e-6.
        const double error = theta < 180 ? integration*radius : 1e-6*radius;
        EXPECT_NEAR(drop.height(), radius*(1 - c), error) << theta;
        EXPECT_NEAR(drop.contactRadius(), radius*std::sin(theta*pi/180), error) << theta;
        EXPECT_NEAR(drop.volume()/(pi/3*std::pow(radius, 3)*(2 + c)*(1 - c)*(1 - c)), 1, integration/(1 - c)) << theta;
        EXPECT_NEAR(drop.points.back().s, radius*theta*pi/180, error) << theta;
        EXPECT_EQ(drop.points.size(), 201u);
    }
}

// Forces on the whole drop along the vertical: weight + the wall's pull at the line = pressure on the wall. With
// lengths l and sigma = 1:  V/l^2 = pi r^2 (2/b + h/l^2) - 2 pi r sin(theta). Holds for any exact solution.
TEST(BashforthAdams, BalancesForces)
{
    for (const double apexRadius : {0.3e-3, 3e-3, 100e-3})
    {
        for (const double theta : {20.0, 90.0, 150.0, 180.0})
        {
            const DropProfile drop = bashforthAdams(apexRadius, capillaryLength, theta);
            const double r = drop.contactRadius(), l2 = capillaryLength*capillaryLength;
            const double pressure = pi*r*r*(2/apexRadius + drop.height()/l2);
            const double line = 2*pi*r*std::sin(theta*pi/180);
            EXPECT_NEAR(drop.volume()/l2, pressure - line, integration*10*(pressure + line)) << apexRadius << ' ' << theta;
        }
    }
}

// The wide puddle's height is 2 l sin(theta/2) to first order; its rim's curvature takes off terms of l/r.
TEST(BashforthAdams, ALargeDropIsAPuddle)
{
    const double theta = 90, puddle = 2*capillaryLength*std::sin(theta*pi/360);
    double last = 0;
    for (const double radius : {10.0, 20.0, 40.0})      // of the puddle, in capillary lengths
    {
        const double volume = pi*std::pow(radius*capillaryLength, 2)*puddle;
        const DropProfile drop = bashforthAdamsOfVolume(volume, capillaryLength, theta);
        const double excess = std::abs(drop.height()/puddle - 1);
        EXPECT_LT(excess, 0.5/radius) << radius;
        if (last > 0)
        {
            EXPECT_NEAR(excess/last, 0.5, 0.1) << radius;
        }
        last = excess;
    }
}

TEST(BashforthAdams, FindsTheDropOfAVolume)
{
    for (const double volume : {1e-12, 4e-9, 1e-6})     // Bond numbers from 1e-3 to ten
    {
        for (const double theta : {15.0, 90.0, 165.0})
        {
            EXPECT_NEAR(bashforthAdamsOfVolume(volume, capillaryLength, theta).volume()/volume, 1, 1e-8)
                << volume << ' ' << theta;
        }
    }
    const double radius = 1e-3;
    const DropProfile cap = bashforthAdamsOfVolume(2*pi/3*std::pow(radius, 3), noGravity, 90, 11);
    EXPECT_NEAR(cap.apexRadius, radius, 1e-8*radius);
    EXPECT_EQ(cap.points.size(), 11u);
}

TEST(BashforthAdams, RefusesWhatIsNoDrop)
{
    EXPECT_THROW(bashforthAdams(0, 1, 90), FatalError);
    EXPECT_THROW(bashforthAdams(1, -1, 90), FatalError);
    EXPECT_THROW(bashforthAdams(1, 1, 0), FatalError);
    EXPECT_THROW(bashforthAdams(1, 1, 181), FatalError);
    EXPECT_THROW(bashforthAdamsOfVolume(0, 1, 90), FatalError);
    EXPECT_THROW(bashforthAdamsOfVolume(std::nan(""), 1, 90), FatalError);
}
