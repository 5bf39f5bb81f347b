// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/LiquidBridge.H"

#include "core/angles/Degrees.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace shizuku;

// Of 90 degrees it is a cylinder, which pulls by pi R sigma.
TEST(LiquidBridge, IsACylinderAtARightAngle)
{
    const double H = 2e-3, R = 1.5e-3;
    const LiquidBridge bridge = LiquidBridge::between(H, std::numbers::pi*R*R*H, 90);
    // Bisections end at 1e-12 of their ranges.
    EXPECT_NEAR(bridge.neck, R, 1e-9*R);
    EXPECT_NEAR(bridge.foot, R, 1e-9*R);
    EXPECT_NEAR(bridge.pressure, 1/R, 1e-8/R);
    EXPECT_NEAR(bridge.force, std::numbers::pi*R, 1e-8*R);
}

// The force is the same by the balance at the plates: the line's and the pressure's.
TEST(LiquidBridge, PullsAlikeAtTheNeckAndAtThePlates)
{
    for (const double theta : {40.0, 60.0, 120.0})
    {
        const LiquidBridge bridge = LiquidBridge::between(1.5e-3, 8e-9, theta);
        const double atPlate = 2*std::numbers::pi*(bridge.foot*std::sin(radians(theta)) - bridge.pressure*bridge.foot*bridge.foot/2);
        // Runge and Kutta's error over 400 steps.
        EXPECT_NEAR(bridge.force, atPlate, 1e-7*bridge.foot) << theta;
        EXPECT_EQ(bridge.foot > bridge.neck, theta < 90) << theta;
    }
}

// A thin film between plates: Laplace's pressure 2 cos(theta)/H of the gap on the wetted area, up to terms of H/R.
TEST(LiquidBridge, IsHeldByLaplacesPressureInANarrowGap)
{
    const double H = 1e-5, R = 2e-3;
    const LiquidBridge bridge = LiquidBridge::between(H, std::numbers::pi*R*R*H, 60);
    EXPECT_NEAR(bridge.force, std::numbers::pi*R*R*2*0.5/H, 0.01*std::numbers::pi*R*R/H);
}

// V^(1/3) (1 + theta/2) is about where it breaks: far beyond there is none.
TEST(LiquidBridge, IsNoneWherePlatesAreTooFarApart)
{
    EXPECT_THROW(LiquidBridge::between(4e-3, 1e-9, 60), std::domain_error);
}
