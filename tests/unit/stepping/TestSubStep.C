#include "stepping/SubStep.H"

#include "motion/Motion.H"
#include "support/LiquidCase.H"

#include <gtest/gtest.h>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// A block that a step drives to half its size, onto a sampled floor: lists find no room. prepared: they are known to be long.
std::vector<Vec3> positionsAfterStep(bool prepared)
{
    constexpr float dt = 0.1f;
    const auto layer = latticeBlock(17, 17, 1, 0.5f, {-4, -4, -0.5f});
    LiquidCase drop({.walls = sampledFloor, .solidPositions = layer, .solidTheta = std::vector<double>(layer.size(), 60)});
    drop.folder.write
    (
        "constant/models",
        "pressure completedPbf; surfaceTension continuumSurfaceForce; wetting extendedSurface; viscosity XSPH; bodyForce none;"
    );
    Models models(drop.folder.path(), Dictionary(), drop.liquid, drop.walls);
    const auto positions = latticeBlock(9, 9, 9, 1, {-4, -4, 0.5f});
    std::vector<Vec3> velocities;
    for (const Vec3 p : positions) velocities.push_back(-0.5f * drop.liquid.spacing() / dt * (p - Vec3{0, 0, 0.5f}));
    drop.place(positions, velocities);
    if (prepared)
    {
        predictPositions(drop.liquid, dt);
        drop.near.update(drop.liquid, models.freeSurface->support());
        drop.walls.update(drop.liquid);
    }
    subStep(drop.liquid, drop.near, drop.walls, models, dt);
    return drop.inOrder(drop.liquid.position);
}

}

// Lists that are cut off, found out in the midst of a step, change nothing of it.
TEST(SubStep, IsTheSameWhenListsFindNoRoom)
{
    const auto found = positionsAfterStep(false), expected = positionsAfterStep(true);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
        ASSERT_EQ(found[i].x, expected[i].x);
        ASSERT_EQ(found[i].y, expected[i].y);
        ASSERT_EQ(found[i].z, expected[i].z);
    }
}
