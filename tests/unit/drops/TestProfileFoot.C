// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/ProfileFoot.H"
#include "drops/ContactAngle.H"
#include "support/CapMesh.H"
#include "support/DropMeshes.H"

#include <gtest/gtest.h>

#include <numbers>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr double spacing = 1e-4;
const auto floorWall = makeWallShape(Plane{{0, 0, 0}, {0, 0, 1}});

}

// Down to puddles of two and a half spacings: 2,000 particles at Bond number 10 and 60 degrees.
TEST(ProfileFoot, HasContactRadiusAndAngleOfExactMeshes)
{
    for (const double bond : {0.1, 1.0, 10.0})
    {
        for (const double theta : {60.0, 120.0})
        {
            for (const int particles : {2000, 10000})
            {
                const double volume = particles*spacing*spacing*spacing, R = std::cbrt(3*volume/(4*std::numbers::pi));
                const DropProfile exact = bashforthAdamsOfVolume(volume, R/std::sqrt(bond), theta, 101);
                const auto fit = fitProfile(meridianPoints(revolvedMesh(exact, 0.5*spacing), 1.25*spacing));     // above, as probeAngle has it
                ASSERT_TRUE(fit) << bond << " " << theta;
                const auto foot = footOf(*fit, {}, {0, 0, 1}, *floorWall);
                ASSERT_TRUE(foot) << bond << " " << theta;
                // Cells of half a spacing have a sagitta of (d/2)^2/(8 l), 0.01 d on the tightest rim.
                EXPECT_NEAR(foot->radius, exact.contactRadius(), 0.03*spacing) << bond << " " << theta << " " << particles;
                EXPECT_NEAR(foot->angle, theta, 0.5) << bond << " " << theta << " " << particles;
            }
        }
    }
}

// The picture of a drop that hangs, upside down; the tolerances are those of drops that stand.
TEST(ProfileFoot, HasThatOfDropsThatHang)
{
    const double R = std::cbrt(3*5000*spacing*spacing*spacing/(4*std::numbers::pi));
    for (const double theta : {50.0, 70.0, 110.0})
    {
        const DropProfile exact = hangingDrop(1.3*R, R/std::sqrt(0.2), theta, 101);
        ASSERT_GT(exact.points.back().phi, 0.99*theta*std::numbers::pi/180) << "no such drop hangs";
        const auto fit = fitProfile(meridianPoints(revolvedMesh(exact, 0.5*spacing), 1.25*spacing), true);
        ASSERT_TRUE(fit) << theta;
        const auto foot = footOf(*fit, {}, {0, 0, 1}, *floorWall);
        ASSERT_TRUE(foot) << theta;
        EXPECT_NEAR(foot->radius, exact.contactRadius(), 0.03*spacing) << theta;
        EXPECT_NEAR(foot->angle, theta, 0.5) << theta;
    }
}

// Why tangents do not do: at 1.25 spacings, where they are taken, a puddle's rim is flatter than at the wall.
TEST(ProfileFoot, TangentsMissAPuddlesRim)
{
    const double volume = 5000*spacing*spacing*spacing, R = std::cbrt(3*volume/(4*std::numbers::pi));
    const DropProfile exact = bashforthAdamsOfVolume(volume, R/std::sqrt(10), 60, 101);
    const ContactAngle byTangents = measureContactAngle(revolvedMesh(exact, 0.5*spacing), *floorWall, spacing);
    EXPECT_GT(byTangents.lineRadius/exact.contactRadius(), 1.05);
    EXPECT_LT(byTangents.mean, 40);
}

// Without gravity the profile is a sphere, which meets a ball where two spheres cut.
TEST(ProfileFoot, FollowsAWallThatIsNoPlane)
{
    AnalyticSurface ball;
    ball.name = "ball";
    ball.type = AnalyticSurface::Type::sphere;
    ball.radius = 2e-3;
    ball.liquidInside = false;
    CaseWalls walls;
    walls.analytic = {ball};
    walls.names = {"ball"};
    for (const double theta : {60.0, 120.0})
    {
        const DropOnBall drop = dropOnBall(theta, 4e-9, ball.radius, {0, 0, 1});
        const ProfileFit sphere{.apexRadius = drop.radius, .capillaryLength = HUGE_VAL, .apexHeight = drop.height() + ball.radius};
        const auto foot = footOf(sphere, {}, {0, 0, 1}, *makeWallShape(walls, "ball", spacing));
        ASSERT_TRUE(foot);
        // A thousand pieces of half a circumference: chords within 1e-6 of it.
        EXPECT_NEAR(foot->radius/drop.contactRadius, 1, 1e-4);
        EXPECT_NEAR(foot->angle, theta, 0.01);
    }
}

TEST(ProfileFoot, AProfileThatEndsAboveTheWallHasNone)
{
    const ProfileFit high{.apexRadius = 1e-3, .capillaryLength = 1e-3, .apexHeight = 1};
    EXPECT_FALSE(footOf(high, {}, {0, 0, 1}, *floorWall));
}
