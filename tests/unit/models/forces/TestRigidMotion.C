// SPDX-License-Identifier: GPL-3.0-or-later
// What displacements move and turn the liquid as a whole, along and about what no wall holds.

#include "models/forces/RigidMotion.H"

#include "support/LiquidCase.H"
#include "support/PointSets.H"

#include <gtest/gtest.h>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// Momentum and angular momentum about the centroid, over the number of particles; double precision.
struct Motion
{
    Vector3 mean, turn;
};

Motion motionOf(const LiquidCase& drop)
{
    const auto x = vectors(drop.liquid.position), u = drop.liquid.velocity.download();
    const auto wide = [](Vec3 v) { return Vector3(v.x, v.y, v.z); };
    Vector3 centroid, mean, turn;
    const double n = double(x.size());
    for (const Vec3 p : x) centroid += wide(p)/n;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        mean += wide(u[i])/n;
        turn += cross(wide(x[i]) - centroid, wide(u[i]))/n;
    }
    return {mean, turn};
}

constexpr scalar reach = 4;                     // spacings, from which on walls are seen

// A block of 7 x 5 x 3 particles off the origin, the lowest ones so many spacings above z = 0, with velocities of up to 0.1 at
// random and 0.05 along (1 2 3), made by displacements in a step of 0.01, which are then taken back.
Motion leftOver
(
    const std::string& walls, scalar height = 0.5f, const std::vector<Vec3>& solidPositions = {}, const std::string& wettability = {}
)
{
    LiquidCase drop({.walls = walls, .wettability = wettability, .solidPositions = solidPositions});
    if (!wettability.empty()) drop.useWalls();
    drop.useWalls(reach * drop.liquid.spacing());
    RandomNumbers random(5);
    const auto points = latticeBlock(7, 5, 3, 1, {20, -30, height});
    std::vector<Vec3> velocities;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        velocities.push_back(random({-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}) + Vec3{0.05f, 0.1f, 0.15f});
    }
    drop.place(points, velocities);
    const scalar dt = 0.01f;
    const Buffer<Vec3> all(drop.liquid.velocity.download());
    const auto part = [&](scalar share) { return InternalDisplacement{all.span(), share * dt}; };
    RigidMotion().remove(drop.liquid, part(-0.5f), part(1.5f), drop.walls, reach * drop.liquid.spacing(), dt);
    return motionOf(drop);
}

// Velocities are rounded to 1e-8, turns to that times the block's 4 spacings; means of 105.
constexpr double rounding = 1e-7;

}

TEST(RigidMotion, IsNoneOfFreeLiquid)
{
    const Motion left = leftOver("");
    EXPECT_LT(length(left.mean), rounding);
    EXPECT_LT(length(left.turn), rounding);
}

// Of forces that turn it the displacements tell a part alone: angular momentum is what it was before. Momentum is what displacements leave of it.
TEST(RigidMotion, LeavesFreeLiquidTheAngularMomentumOfBefore)
{
    LiquidCase drop;
    RandomNumbers random(5);
    const auto points = latticeBlock(7, 5, 3, 1, {20, -30, 5});
    std::vector<Vec3> velocities, changed;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        velocities.push_back(random({-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}));
        changed.push_back(velocities[i] + cross(Vec3{0.01f, 0, -0.02f}, points[i]) + Vec3{0.05f, 0, 0});
    }
    drop.place(points, velocities);
    const Motion before = motionOf(drop);
    const scalar dt = 0.01f;
    RigidMotion rigid;
    rigid.begin(drop.liquid, drop.walls, dt);
    drop.liquid.velocity.upload(changed);
    const Motion made = motionOf(drop);
    const Buffer<Vec3> known(std::vector<Vec3>(points.size(), dt * Vec3{0.03f, 0, 0}));
    rigid.remove(drop.liquid, {known.span(), 1}, {}, drop.walls, reach * drop.liquid.spacing(), dt);
    const Motion after = motionOf(drop);
    const double turned = length(made.turn - before.turn);
    EXPECT_GT(turned, 0.01);
    // The turn is found in single precision through a determinant: some hundred roundings of 6e-8. A GPU's divisions had 1.3e-6 of 0.1 here.
    EXPECT_LT(length(after.turn - before.turn), 3e-5 * turned);
    EXPECT_LT(length(after.mean - made.mean + Vector3(0.03, 0, 0)), rounding);
}

// As long as one layer of particles has the plane within reach.
TEST(RigidMotion, StaysAcrossAPlaneAndAboutAxesInIt)
{
    for (const scalar height : {scalar(0.5), reach - 0.1f})
    {
        const Motion left = leftOver(floorPlane, height);
        EXPECT_LT(std::hypot(left.mean.x, left.mean.y), rounding);
        EXPECT_NEAR(left.mean.z, 0.15, 0.03);                   // and the mean of 105 numbers at random
        // The axes of inertia are not exactly the block's.
        EXPECT_LT(std::abs(left.turn.z), 0.02*std::hypot(left.turn.x, left.turn.y));
        EXPECT_GT(std::hypot(left.turn.x, left.turn.y), 1e-3);
    }
}

// A plane bears nothing of what is not within its reach, nor do solid particles in one, whose plane is half a spacing above.
TEST(RigidMotion, IsNoneOfLiquidThatHasLeftAPlane)
{
    const auto layer = latticeBlock(21, 21, 1, 1, {13, -38, -0.5f});
    const Motion left = leftOver(floorPlane, reach + 0.1f), sampled = leftOver(sampledFloor, reach + 0.1f, layer);
    for (const Motion& motion : {left, sampled})
    {
        EXPECT_LT(length(motion.mean), rounding);
        EXPECT_LT(length(motion.turn), rounding);
    }
    EXPECT_NEAR(leftOver(sampledFloor, reach - 0.1f, layer).mean.z, 0.15, 0.03);
}

// Of a plane that nothing wets only what the pressure moved is left across it, -0.5 of all; as long as one layer has it within reach.
TEST(RigidMotion, StaysAcrossAPlaneThatNothingWetsIfPressureMadeIt)
{
    const double all = leftOver(floorPlane, 0.5f, {}, "floor { theta 170; }").mean.z;
    EXPECT_NEAR(all, 0.15, 0.03);
    EXPECT_NEAR(leftOver(floorPlane, 0.5f, {}, "floor { theta 180; }").mean.z, -0.5*all, rounding);
    EXPECT_NEAR(leftOver(floorPlane, reach + 0.1f, {}, "floor { theta 180; }").mean.z, 0, rounding);
}

TEST(RigidMotion, StaysInACornerButForItsEdge)
{
    const Motion left = leftOver(floorPlane + "side { type plane; point (0.0195 0 0); normal (1 0 0); }");
    EXPECT_NEAR(left.mean.x, 0.05, 0.03);
    EXPECT_LT(std::abs(left.mean.y), rounding);
    EXPECT_NEAR(left.mean.z, 0.15, 0.03);
    EXPECT_GT(std::abs(left.turn.z), 1e-4);
}
