// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/SphereInBath.H"

#include "core/messages/Error.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace shizuku;

namespace
{

constexpr double pi = std::numbers::pi;

}

// Half as heavy as the liquid, and met at right angles: the surface is level, and the sphere half in it.
TEST(SphereInBath, IsHalfInWhereItIsHalfAsHeavy)
{
    for (const double bath : {1.5, 4.0}) EXPECT_NEAR(SphereInBath(bath, 1, 0.7, 90).depthUnder(0.5*4*pi/3), 1, 1e-7) << bath;
}

// Turned upside down it is a sphere with the other angle, and the rest of its volume is lifted.
TEST(SphereInBath, IsItsOwnMirrorImage)
{
    for (const double theta : {40.0, 75.0})
    {
        const SphereInBath wetted(3, 1, 0.8, theta), dry(3, 1, 0.8, 180 - theta);
        for (const double phi : {60.0, 130.0})
        {
            const SphereInBath::Line a = wetted.at(phi), b = dry.at(180 - phi);
            EXPECT_NEAR(a.depth + b.depth, 2, 1e-7) << theta << ' ' << phi;         // of the steps along the surface
            EXPECT_NEAR(a.lift + b.lift, 4*pi/3, 1e-6) << theta << ' ' << phi;
        }
    }
}

// Archimedes: the line counts by the square of the capillary length over the radius, 2 pi l^2/(4 pi/3).
TEST(SphereInBath, FloatsAsArchimedesHasItWhereItIsLarge)
{
    constexpr double l = 0.1, depth = 0.7, below = pi*depth*depth*(3 - depth)/3;
    for (const double theta : {75.0, 105.0}) EXPECT_NEAR(SphereInBath(1.4, 1, l, theta).lift(depth), below, 2*pi*l*l) << theta;
}

// The meniscus of a thin line in a wide bath: z = r sin(psi) ln(4 l/(gamma r (1 + cos psi))) (Derjaguin 1946).
TEST(SphereInBath, HasDerjaguinsMeniscusWhereItIsSmall)
{
    constexpr double l = 1, radius = 0.01, phi = 90, theta = 120, gamma = 1.781072;
    const double psi = (phi + theta - 180)*pi/180, z = radius*std::sin(psi)*std::log(4*l/(gamma*radius*(1 + std::cos(psi))));
    EXPECT_NEAR(SphereInBath(8, radius, l, theta).at(phi).height, -z, 2e-2*z);       // terms of the radius over the length
}

TEST(SphereInBath, RefusesWhatCannotFloat)
{
    EXPECT_THROW(SphereInBath(1, 2, 1, 90), FatalError);
    EXPECT_THROW(SphereInBath(2, 1, 1, 190), FatalError);
    EXPECT_THROW(SphereInBath(3, 1, 0.1, 60).depthUnder(5*4*pi/3), FatalError);
    EXPECT_THROW(SphereInBath(3, 1, 0.5, 60).lift(9), FatalError);
}
