// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/AnalyticSurface.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

namespace shizuku::test
{

namespace
{

AnalyticSurface read(const std::string& text)
{
    return readAnalyticSurfaces(Dictionary::parse("wall { " + text + " }", "constant/walls")).at(0);
}

// The normal is the gradient of the signed distance: central differences, exact to rounding for a plane and to the
// step squared times the curvature, 1e-8, for the others.
void expectGradient(const AnalyticSurface& surface, const Vector3& x)
{
    const double step = 1e-4;
    const Vector3 normal = surface.normal(x);
    for (int c = 0; c < 3; ++c)
    {
        Vector3 low = x, high = x;
        low[c] -= step;
        high[c] += step;
        EXPECT_NEAR(normal[c], (surface.signedDistance(high) - surface.signedDistance(low))/(2*step), 1e-7) << str(x);
    }
    EXPECT_NEAR(length(normal), 1, 1e-14);
}

}

TEST(AnalyticSurface, PlaneIsPositiveOnTheSideOfItsNormal)
{
    const AnalyticSurface plane = read("type plane; point (0 0 1); normal (0 0 2);");
    EXPECT_DOUBLE_EQ(plane.signedDistance({5, -3, 4}), 3);
    EXPECT_DOUBLE_EQ(plane.signedDistance({0, 0, 0}), -1);
    expectGradient(plane, {1, 2, 3});
}

TEST(AnalyticSurface, SphereHoldsLiquidInsideOrOutside)
{
    const AnalyticSurface outside = read("type sphere; centre (1 0 0); radius 2; liquid outside;");
    EXPECT_DOUBLE_EQ(outside.signedDistance({1, 5, 0}), 3);
    EXPECT_DOUBLE_EQ(outside.signedDistance({1, 0, 0}), -2);
    expectGradient(outside, {2, 3, 4});

    const AnalyticSurface inside = read("type sphere; centre (1 0 0); radius 2; liquid inside;");
    EXPECT_DOUBLE_EQ(inside.signedDistance({1, 5, 0}), -3);
    expectGradient(inside, {1.5, 0.5, -0.5});
    EXPECT_NEAR(length(inside.normal({1, 0, 0})), 1, 1e-15);    // at the centre: any direction, but one
}

TEST(AnalyticSurface, CylinderIsInfinitelyLong)
{
    const AnalyticSurface tube = read("type cylinder; point (0 0 7); axis (0 0 3); radius 2; liquid inside;");
    EXPECT_DOUBLE_EQ(tube.signedDistance({1.5, 0, -1000}), 0.5);
    EXPECT_DOUBLE_EQ(tube.signedDistance({0, 3, 50}), -1);
    expectGradient(tube, {0.6, 0.8, 2});
    EXPECT_NEAR(dot(tube.normal({0, 0, 1}), {0, 0, 1}), 0, 1e-15);      // on the axis: across it
}

TEST(AnalyticSurface, BoxHoldsLiquidInside)
{
    const AnalyticSurface box = read("type box; min (0 0 0); max (4 4 2);");
    EXPECT_DOUBLE_EQ(box.signedDistance({2, 2, 0.25}), 0.25);
    EXPECT_DOUBLE_EQ(box.signedDistance({3.9, 2, 1}), 4 - 3.9);
    EXPECT_DOUBLE_EQ(box.signedDistance({-3, -4, 1}), -5);              // beyond an edge: distance to the edge
    expectGradient(box, {2, 2, 0.25});
    expectGradient(box, {-3, -4, 1});
    EXPECT_EQ(box.normal({2, 2, 1.9}), Vector3(0, 0, -1));
}

TEST(AnalyticSurface, WallsOfParticlesAreSkipped)
{
    const Dictionary walls = Dictionary::parse
    (
        "floor { type particles; surface \"floor.stl\"; } lid { type plane; point (0 0 1); normal (0 0 -1); }"
    );
    const auto surfaces = readAnalyticSurfaces(walls);
    ASSERT_EQ(surfaces.size(), 1u);
    EXPECT_EQ(surfaces[0].name, "lid");
    EXPECT_EQ(typeName(surfaces[0].type), "plane");
    EXPECT_NO_THROW(walls.refuseUnused());
}

TEST(AnalyticSurface, BadEntriesAreRefused)
{
    EXPECT_TRUE(holds(messageOf([] { read("type wall;"); }), {"wall", "plane", "cylinder"}));
    EXPECT_TRUE(holds(messageOf([] { read("type plane; point (0 0 0); normal (0 0 0);"); }), {"normal", "no direction"}));
    EXPECT_TRUE(holds(messageOf([] { read("type sphere; centre (0 0 0); radius -1; liquid inside;"); }), {"radius", "-1"}));
    EXPECT_TRUE(holds(messageOf([] { read("type sphere; centre (0 0 0); radius 1;"); }), {"liquid"}));
    EXPECT_TRUE(holds(messageOf([] { read("type box; min (0 0 0); max (1 0 1);"); }), {"min", "max"}));
}

}
