// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/WallSurface.H"

#include <gtest/gtest.h>

using namespace shizuku;

namespace
{

void expectPlace(const WallSurface& wall, Vec3 x, scalar distance, Vec3 normal)
{
    const auto nearest = wall(placeAt(x.x, x.y, x.z));
    // Places are rounded to 1.9e-6, and normals to 6e-8.
    EXPECT_NEAR(nearest.distance, distance, 4e-6);
    EXPECT_NEAR(norm(nearest.normal - normal), 0, 2e-6);
}

}

TEST(WallSurface, PlaneHasTheDistanceAlongItsNormal)
{
    const WallSurface plane{WallSurface::plane, -1, placeAt(1, 2, 3), {0.6, 0, 0.8}, 0, 1, 0};
    expectPlace(plane, {1, 2, 3}, 0, {0.6f, 0, 0.8f});
    expectPlace(plane, {2.2f, 7, 4.6f}, 2, {0.6f, 0, 0.8f});
    expectPlace(plane, {0.4f, -9, 2.2f}, -1, {0.6f, 0, 0.8f});
}

TEST(WallSurface, SphereHoldsOrIsSurroundedByLiquid)
{
    const WallSurface ball{WallSurface::sphere, -1, placeAt(1, 0, 0), {}, 2, 1, 0};
    const WallSurface shell{WallSurface::sphere, -1, placeAt(1, 0, 0), {}, 2, -1, 0};
    expectPlace(ball, {1, 3, 4}, 3, {0, 0.6f, 0.8f});
    expectPlace(shell, {1, 3, 4}, -3, {0, -0.6f, -0.8f});
    expectPlace(ball, {1, 0, -0.5f}, -1.5f, {0, 0, -1});
    expectPlace(shell, {1, 0, -0.5f}, 1.5f, {0, 0, 1});
    EXPECT_EQ(shell(placeAt(1, 0, 0)).distance, 2);        // at the centre the distance is known, the normal is finite
    EXPECT_TRUE(std::isfinite(norm(shell(placeAt(1, 0, 0)).normal)));
}

TEST(WallSurface, CylinderHasNoEnds)
{
    const Vec3 point{1, 1, 1}, axis{0, 0.6f, 0.8f}, across{0, -0.8f, 0.6f};
    const WallSurface rod{WallSurface::cylinder, -1, placeAt(1, 1, 1), {0, 0.6, 0.8}, 0.5, 1, 0};
    const WallSurface tube{WallSurface::cylinder, -1, placeAt(1, 1, 1), {0, 0.6, 0.8}, 0.5, -1, 0};
    expectPlace(rod, point + 3 * axis + 2 * across, 1.5f, across);
    expectPlace(tube, point - 2 * axis + 0.25f * across, 0.25f, -across);
    expectPlace(tube, point + 1 * axis + 0.75f * Vec3{1, 0, 0}, -0.25f, {-1, 0, 0});
}

// A tilted plane through a point 10^5 units away: along it a place is as far as that, and its distance as exact as near the origin.
TEST(WallSurface, IsAsExactFarAway)
{
    const double far = 1e5;
    const WallSurface plane{WallSurface::plane, -1, placeAt(0, 0, 0), {0.6, 0, 0.8}, 0, 1, 0};
    for (const double height : {0.0, 0.25, 1.5})
    {
        const auto nearest = plane(placeAt(0.8 * far + 0.6 * height, 0, -0.6 * far + 0.8 * height));
        EXPECT_NEAR(nearest.distance, height, 4e-6);
    }
}
