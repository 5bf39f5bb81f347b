// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/ContactAngle.H"
#include "support/DropMeshes.H"

#include <gtest/gtest.h>

#include <numbers>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr double spacing = 1e-4;

// A ball of solid particles as sampleSurface places them: half a spacing below the surface, about a spacing apart.
CaseWalls sampledBall(double radius)
{
    CaseWalls walls;
    walls.solid.patches = {"other", "ball"};
    const double inner = radius - 0.5*spacing;
    const int count = int(4*std::numbers::pi*inner*inner/(spacing*spacing));
    for (int i = 0; i < count; ++i)
    {
        const double z = 1 - 2*(i + 0.5)/count, phi = i*2*std::numbers::pi/std::numbers::phi, r = std::sqrt(1 - z*z);
        const Vector3 normal(r*std::cos(phi), r*std::sin(phi), z);
        walls.solid.positions.push_back(inner*normal);
        walls.solid.normals.push_back(normal);
        walls.solid.patch.push_back(1);
    }
    walls.solid.positions.push_back({0, 0, 2*radius});      // of another patch: not to be seen
    walls.solid.normals.push_back({0, 0, -1});
    walls.solid.patch.push_back(0);
    return walls;
}

}

TEST(WallShape, ACurvedPatchIsTheSurfaceThatItWasSampledFrom)
{
    const double radius = 30*spacing;
    const auto wall = makeWallShape(sampledBall(radius), "ball", spacing);
    for (const double distance : {-0.3, 0.0, 1.0, 5.0, 20.0})
    {
        for (const Vector3& direction : {Vector3(0, 0, 1), normalized({1, 2, 3}), normalized({-3, 1, -0.2})})
        {
            const WallPoint at = wall->at((radius + distance*spacing)*direction);
            // Exact on spheres but for the iteration, whose error halves three times or better.
            EXPECT_NEAR(at.distance, distance*spacing, 0.01*spacing) << distance;
            EXPECT_NEAR(length(at.normal - direction), 0, 0.01) << distance;
        }
    }
}

TEST(WallShape, DropOnABallOfParticlesHasTheAngleOfThatOnTheExactBall)
{
    const double volume = 2000*spacing*spacing*spacing, radius = 30*spacing;
    const auto wall = makeWallShape(sampledBall(radius), "ball", spacing);
    for (const double theta : {45.0, 90.0, 135.0})
    {
        const DropOnBall drop = dropOnBall(theta, volume, radius, normalized({0.3, 0.1, 1}));
        const ContactAngle measured = measureContactAngle(dropOnBallMesh(drop, 0.5*spacing), *wall, spacing);
        EXPECT_EQ(measured.state, DropState::attached);
        EXPECT_NEAR(measured.angle, theta, 1);
        EXPECT_NEAR(measured.mean, theta, 1);
    }
}
