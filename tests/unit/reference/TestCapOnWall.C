// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/CapOnWall.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shizuku::test
{

namespace
{

constexpr double pi = std::numbers::pi;
constexpr double digits = 1e-12;        // doubles
const double half = std::cbrt(2);       // radius of the half sphere of the volume of a unit sphere

TEST(CapOnWall, EnergyOfAHalfSphereAndASphere)
{
    // pi r^2 (2 - cos theta) over pi.
    EXPECT_NEAR(capEnergy(90, 90), 2*half*half, digits);
    EXPECT_NEAR(capEnergy(90, 180), 3*half*half, digits);
    EXPECT_NEAR(capEnergy(90, 120), 2.5*half*half, digits);
    for (const double theta : {0, 77, 180}) EXPECT_NEAR(capEnergy(180, theta), 4, digits);
    // The height of a half sphere's centroid is 3/8 of its radius.
    EXPECT_NEAR(capCentroid(90), 3*half/8, digits);
    EXPECT_NEAR(capCentroid(180), 1, digits);
    EXPECT_NEAR(capFootRadius(90), half, digits);
    EXPECT_NEAR(capFootRadius(180), 0, digits);
}

// The energy's first variation vanishes at Young's angle alone.
TEST(CapOnWall, TheLeastEnergyIsAtTheContactAngle)
{
    constexpr double step = 0.1;        // degrees: what is left is of step^2
    for (const double theta : {20, 60, 90, 140, 170})
    {
        EXPECT_LT(capEnergy(theta, theta), capEnergy(theta - step, theta));
        EXPECT_LT(capEnergy(theta, theta), capEnergy(theta + step, theta));
    }
}

TEST(CapOnWall, AngleFromTheLiquidNextToTheWall)
{
    constexpr double depth = 0.1, found = 1e-9;         // degrees; where a share of 0.1 has 16 digits
    // Of a half sphere of radius r pi (r^2 d - d^3/3), of a sphere pi (d^2 - d^3/3).
    const double ofHalf = 0.75*(half*half*depth - std::pow(depth, 3)/3), ofSphere = 0.75*(depth*depth - std::pow(depth, 3)/3);
    EXPECT_NEAR(capAngleOf(ofHalf, depth), 90, found);
    EXPECT_GT(capAngleOf(1.01*ofSphere, depth), 170);
    EXPECT_LT(capAngleOf(1.01*ofSphere, depth), 180);
    EXPECT_EQ(capAngleOf(0.5*ofSphere, depth), 180);
    // A film, all of it below: of height h = (1 - c) r and volume pi h^2 (r - h/3).
    const double low = capAngleOf(0.999999, depth), c = std::cos(low*pi/180);
    EXPECT_NEAR((1 - c)*std::cbrt(4/((2 + c)*(1 - c)*(1 - c))), depth, 2e-3*depth);    // the top's millionth: its root
}

// By hand: E(90, theta) = (2 - cos theta) 2^(2/3) reaches 4 where cos theta = 2 - 4/2^(2/3) = -0.5198, 121.3 degrees.
TEST(CapOnWall, HalfSpheresLeaveFrom121Degrees)
{
    const double turn = std::acos(2 - 4/(half*half))*180/pi;
    EXPECT_NEAR(turn, 121.3, 0.05);
    EXPECT_FALSE(jumpOff({90, turn - 1e-6}).excess());
    EXPECT_TRUE(jumpOff({90, turn + 1e-6}).excess());
    // Whatever is steeper than the angle has less.
    for (const double theta : {30, 90, 150}) EXPECT_FALSE(jumpOff({theta + 29, theta}).excess());
    EXPECT_EQ(jumpOff({90, 120}).flattest, 90);
}

TEST(CapOnWall, WhatAStartHasToSpare)
{
    const JumpOff jump = jumpOff({90, 140});
    EXPECT_NEAR(jump.start, (2 - std::cos(140*pi/180))*half*half, digits);
    EXPECT_NEAR(jump.free, 4, digits);
    EXPECT_NEAR(jump.rest, capEnergy(140, 140), digits);
    EXPECT_NEAR(capEnergy(jump.flattest, 140), 4, digits*10);           // a root of it
    EXPECT_GT(jump.flattest, 90);
    EXPECT_LT(jump.flattest, 140);
    // A film that a wetting wall has no part in goes on spreading.
    EXPECT_FALSE(jumpOff({5, 0}).excess());
}

TEST(CapOnWall, ThickOrHeavyLiquidStays)
{
    EXPECT_TRUE((CapStart{90, 140, 0.4, 0.6}).staysAnyhow());
    EXPECT_FALSE((CapStart{90, 140, 0.4, 0.59}).staysAnyhow());
    EXPECT_FALSE((CapStart{90, 140, 0.39, 0.6}).staysAnyhow());
}

TEST(CapOnWall, WeightHoldsItDown)
{
    // To leave it, a half sphere must rise from 3/8 of its radius to 1: 4/3 Bo (1 - 3 2^(1/3)/8) more.
    const double excess = (2 - std::cos(140*pi/180))*half*half - 4, bond = 0.75*excess/(1 - 3*half/8);
    EXPECT_TRUE(jumpOff({90, 140, bond*(1 - 1e-6)}).excess());
    EXPECT_FALSE(jumpOff({90, 140, bond*(1 + 1e-6)}).excess());
    EXPECT_TRUE(jumpOff({90, 115, -1}).excess());                       // hanging
}

}

}
