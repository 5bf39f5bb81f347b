#include "walls/WallSurface.H"

#include <gtest/gtest.h>

using namespace shizuku;

namespace
{

void expectPlace(const WallSurface& wall, Vec3 x, scalar distance, Vec3 normal)
{
    const auto place = wall(x);
    // Numbers up to five with roundings of 6e-8 each.
    EXPECT_NEAR(place.distance, distance, 2e-6);
    EXPECT_NEAR(norm(place.normal - normal), 0, 2e-6);
}

}

TEST(WallSurface, PlaneHasTheDistanceAlongItsNormal)
{
    const WallSurface plane{WallSurface::plane, {1, 2, 3}, {0.6f, 0, 0.8f}, 0, 1, 0};
    expectPlace(plane, {1, 2, 3}, 0, {0.6f, 0, 0.8f});
    expectPlace(plane, {2.2f, 7, 4.6f}, 2, {0.6f, 0, 0.8f});
    expectPlace(plane, {0.4f, -9, 2.2f}, -1, {0.6f, 0, 0.8f});
}

TEST(WallSurface, SphereHoldsOrIsSurroundedByLiquid)
{
    const WallSurface ball{WallSurface::sphere, {1, 0, 0}, {}, 2, 1, 0};
    const WallSurface shell{WallSurface::sphere, {1, 0, 0}, {}, 2, -1, 0};
    expectPlace(ball, {1, 3, 4}, 3, {0, 0.6f, 0.8f});
    expectPlace(shell, {1, 3, 4}, -3, {0, -0.6f, -0.8f});
    expectPlace(ball, {1, 0, -0.5f}, -1.5f, {0, 0, -1});
    expectPlace(shell, {1, 0, -0.5f}, 1.5f, {0, 0, 1});
    EXPECT_EQ(shell({1, 0, 0}).distance, 2);        // at the centre the distance is known, the normal is finite
    EXPECT_TRUE(std::isfinite(norm(shell({1, 0, 0}).normal)));
}

TEST(WallSurface, CylinderHasNoEnds)
{
    const Vec3 point{1, 1, 1}, axis{0, 0.6f, 0.8f}, across{0, -0.8f, 0.6f};
    const WallSurface rod{WallSurface::cylinder, point, axis, 0.5f, 1, 0};
    const WallSurface tube{WallSurface::cylinder, point, axis, 0.5f, -1, 0};
    expectPlace(rod, point + 3 * axis + 2 * across, 1.5f, across);
    expectPlace(tube, point - 2 * axis + 0.25f * across, 0.25f, -across);
    expectPlace(tube, point + 1 * axis + 0.75f * Vec3{1, 0, 0}, -0.25f, {-1, 0, 0});
}
