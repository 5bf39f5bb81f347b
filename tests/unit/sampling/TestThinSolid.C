// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/ThinSolid.H"
#include "support/Shapes.H"
#include "unit/sampling/SampledShapes.H"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <numbers>

namespace shizuku::test
{

namespace
{

TEST(ThinSolid, PlatesAndRodsThinnerThanTwoSpacingsAreFound)
{
    for (const double thickness : {0.01, 0.3, 0.6, 1.0, 1.2, 1.7, 1.99})
    {
        SCOPED_TRACE(thickness);
        const auto thin = findNarrowPlaces(plate(thickness), 1).thin;
        ASSERT_TRUE(thin);
        EXPECT_NEAR(thin->thickness, thickness, 2e-3);      // rays start 1e-3 inside
    }
    // The sharpest edges throw liquid.
    for (const double degrees : {20, 27, 29}) EXPECT_TRUE(findNarrowPlaces(wedge(degrees), 1).thin) << degrees;
    PatchedSurface rod = sphere(0.9, 3);
    for (Vector3& v : rod.mesh.vertices) v.z *= 20;
    ASSERT_TRUE(findNarrowPlaces(rod, 1).thin);
}

TEST(ThinSolid, BlocksEdgesAndSheetsAreNotThin)
{
    for (const PatchedSurface& surface : {cube(12), sphere(6, 3), rectangle(20, 20), plate(2), plate(2.5), wedge(30), wedge(60)})
    {
        EXPECT_FALSE(findNarrowPlaces(surface, 1).thin) << surface.patches.front();
    }
    // Two blocks with a slit of liquid of half a spacing.
    EXPECT_FALSE(findNarrowPlaces(joined(cube(12), moved(cube(12), Vector3(0, 0, 12.5))), 1).thin);
}

TEST(ThinSolid, EdgesAndTipsBelow45DegreesAreSharp)
{
    const auto sharpness = [](const PatchedSurface& surface) { return findNarrowPlaces(surface, 1).sharp; };
    for (const double degrees : {30.0, 35.0, 44.0})
    {
        SCOPED_TRACE(degrees);
        ASSERT_TRUE(sharpness(wedge(degrees)));
        EXPECT_NEAR(sharpness(wedge(degrees))->angle, degrees, 1e-6);
    }
    // Sides of 48 facets do not look at each other exactly: rays from a facet's corner meet one beside that which is opposite.
    ASSERT_TRUE(sharpness(cone(38)));
    EXPECT_NEAR(sharpness(cone(38))->angle, 38, 1.5);
    for (const PatchedSurface& surface : {wedge(46), wedge(60), cone(60), cube(12), sphere(6, 3), plate(2.5), rectangle(20, 20)})
    {
        EXPECT_FALSE(sharpness(surface)) << surface.patches.front();
    }
}

std::vector<Tip> tipsOf(const PatchedSurface& surface)
{
    return findTips(SurfaceGeometry(surface), SurfaceDistance(surface.mesh), 1);
}

TEST(ThinSolid, TipsOfConesAreFoundWhereTheyAre)
{
    for (const double degrees : {20, 30, 45, 60, 65})
    {
        SCOPED_TRACE(degrees);
        const std::vector<Tip> tips = tipsOf(cone(degrees));
        ASSERT_EQ(tips.size(), 1u);
        EXPECT_EQ(length(tips[0].position), 0);
        EXPECT_GT(tips[0].axis.z, 0.999);           // sides and rays of 48 facets do not meet the axis exactly
    }
    for (const PatchedSurface& surface : {cone(90), wedge(35), wedge(60), cube(12), sphere(6, 3), plate(2), rectangle(20, 20)})
    {
        EXPECT_TRUE(tipsOf(surface).empty()) << surface.patches.front();
    }
}

TEST(ThinSolid, ManySliversTakeNoLongerThanTheirAreaDoes)
{
    const auto secondsFor = [](int slivers)
    {
        const auto start = std::chrono::steady_clock::now();
        EXPECT_FALSE(findNarrowPlaces(discOfSlivers(slivers), 1).thin);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    EXPECT_LT(secondsFor(1000), 5);         // 0.1 s as a rule, 28 s where each sliver sends rays through all others
}

}

}
