// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/SurfaceRepair.H"
#include "support/ScratchFolder.H"
#include "support/Shapes.H"
#include "unit/sampling/SampledShapes.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>

namespace shizuku::test
{

namespace
{

// A hole as wide as the sheet would be closed by its own back: a solid without thickness, whose layers meet nowhere.
TEST(SurfaceRepair, TheOutlineOfAFlatSheetIsNoHole)
{
    for (const PatchedSurface& sheet : {rectangle(2, 1), sliver(1)})
    {
        PatchedSurface far = joined(rectangle(40, 40), moved(sheet, Vector3(0, 0, 20)));
        const RepairedSurface repaired = repairSurface(far, 12, "sheet.obj");
        EXPECT_EQ(repaired.surface.mesh.faces.size(), far.mesh.faces.size());
        EXPECT_TRUE(sample(repaired.surface).quality.largestHole < 1);
    }
}

TEST(SurfaceRepair, SoupBecomesAClosedMesh)
{
    const RepairedSurface repaired = repairSurface(soupOf(cube(10)), 8, "cube.stl");
    EXPECT_EQ(repaired.surface.mesh.vertices.size(), 8u);
    EXPECT_DOUBLE_EQ(repaired.surface.mesh.volume(), 1000);
    EXPECT_TRUE(repaired.report.empty());
}

TEST(SurfaceRepair, DefectsAreMendedAndSaid)
{
    PatchedSurface dirty = cube(10);
    std::swap(dirty.mesh.faces[3][0], dirty.mesh.faces[3][1]);      // flipped
    dirty.mesh.faces.push_back(dirty.mesh.faces[0]);                // duplicate
    dirty.mesh.faces.push_back({0, 1, 1});                          // degenerate
    dirty.patch.assign(dirty.mesh.faces.size(), 0);
    const RepairedSurface repaired = repairSurface(soupOf(dirty), 8, "cube.stl");
    EXPECT_DOUBLE_EQ(repaired.surface.mesh.volume(), 1000);
    EXPECT_EQ
    (
        repaired.report,
        (std::vector<std::string>
        {
            "1 degenerate triangle removed", "1 duplicate triangle removed",
            "1 flipped triangle turned to agree with the others"
        })
    );
}

TEST(SurfaceRepair, SmallHolesAreClosedAndLargeBordersLeftOpen)
{
    PatchedSurface ball = sphere(10, 3);
    const double volume = ball.mesh.volume();
    ball.mesh.faces.pop_back();
    ball.patch.pop_back();
    // One of 768 triangles on a sphere of radius 10 has edges of about 2.
    const RepairedSurface closed = repairSurface(soupOf(ball), 4, "ball.stl");
    EXPECT_EQ(closed.report, std::vector<std::string>{"1 small hole closed"});
    EXPECT_TRUE(closed.closed);
    EXPECT_NEAR(closed.surface.mesh.volume(), volume, 1e-9*volume);
    const RepairedSurface open = repairSurface(soupOf(ball), 1, "ball.stl");
    ASSERT_EQ(open.report.size(), 1u);
    EXPECT_TRUE(holds(open.report[0], {"1 open border left open", "m wide"}));
    EXPECT_FALSE(open.closed);
}

TEST(SurfaceRepair, CracksAlongAFinerFaceAreJoined)
{
    const RepairedSurface repaired = repairSurface(soupOf(crackedBox()), 4, "cracked.stl");
    ASSERT_EQ(repaired.report.size(), 2u);
    EXPECT_TRUE(holds(repaired.report[0], {"pieces that touch in a vertex"}));      // top and rest, in four corners
    EXPECT_EQ(repaired.report[1], "16 edges along cracks joined");                  // twice 5 and 3
    EXPECT_TRUE(repaired.closed);
    EXPECT_EQ(repaired.shells, 1u);
    // Nothing has moved: only rounding.
    EXPECT_NEAR(repaired.surface.mesh.volume(), 12*9*7, 1e-9*12*9*7);
    EXPECT_EQ(repaired.surface.patch.size(), repaired.surface.mesh.faces.size());
    EXPECT_TRUE(repairSurface(repaired.surface, 4, "again.stl").report.empty());
}

TEST(SurfaceRepair, ShellsThatCrossAreUnited)
{
    const RepairedSurface repaired = repairSurface
    (
        soupOf(joined(box({0, 0, 0}, {4, 4, 4}), box({2, 2, 2}, {6, 6, 6}))), 1, "boxes.stl"
    );
    EXPECT_EQ(repaired.report, std::vector<std::string>{"2 shells that cross each other united"});
    EXPECT_EQ(repaired.shells, 1u);
    EXPECT_NEAR(repaired.surface.mesh.volume(), 64 + 64 - 8, 1e-12*120);     // constructed in double precision
}

TEST(SurfaceRepair, AShellThatCrossesItselfLosesItsInside)
{
    const PatchedSurface eight = tube([](double t)
    {
        const double a = 2*std::numbers::pi*t;
        return Vector3(14*std::sin(a), 14*std::sin(a)*std::cos(a), 0.3*std::cos(a));
    }, true, 2.2, 60, 12);
    const RepairedSurface repaired = repairSurface(eight, 1, "eight.stl");
    ASSERT_EQ(repaired.report.size(), 1u);
    EXPECT_TRUE(holds(repaired.report[0], {"cross each other cut", "inside of the solid removed"}));
    EXPECT_TRUE(repaired.closed);
    // Two straight rods of these 12-sided sections, at right angles and 0.6 apart, share 48.592: the integral of the product of
    // their widths over height. Those of the figure bend a little.
    EXPECT_NEAR(eight.mesh.volume() - repaired.surface.mesh.volume(), 48.592, 0.05);
    EXPECT_TRUE(repairSurface(repaired.surface, 1, "again.stl").report.empty());
}

TEST(SurfaceRepair, SolidsThatShareAnEdgeAreCutApartAndDoNotCross)
{
    const RepairedSurface repaired =
        repairSurface(soupOf(joined(box({0, 0, 0}, {4, 4, 4}), box({4, 4, 0}, {8, 8, 4}))), 1, "boxes.stl");
    EXPECT_EQ(repaired.report, std::vector<std::string>{"1 edge of more than two triangles cut apart"});
    EXPECT_EQ(repaired.shells, 2u);
    EXPECT_TRUE(repaired.closed);
    EXPECT_DOUBLE_EQ(repaired.surface.mesh.volume(), 128);
}

TEST(SurfaceRepair, AFaceThatTwoSolidsShareGoes)
{
    const auto expectOneBlock = [](const RepairedSurface& repaired, double volume, double area)
    {
        EXPECT_TRUE(repaired.closed);
        EXPECT_EQ(repaired.shells, 1u);
        EXPECT_DOUBLE_EQ(std::abs(repaired.surface.mesh.volume()), volume);
        EXPECT_DOUBLE_EQ(repaired.surface.mesh.area(), area);
    };
    for (const bool turned : {false, true})
    {
        PatchedSurface second = moved(cube(10), Vector3(10, 0, 0));
        if (turned) second = turnedOver(second);
        expectOneBlock(repairSurface(joined(soupOf(cube(10)), soupOf(second)), 8, "blocks.stl"), 2000, 1000);
    }
    // Three in a row, the middle one between two walls.
    PatchedSurface row = cube(10);
    for (const double x : {10.0, 20.0}) row = joined(row, moved(cube(10), Vector3(x, 0, 0)));
    expectOneBlock(repairSurface(row, 8, "blocks.stl"), 3000, 1400);

    // The face's other diagonal, as of another program's triangles.
    PatchedSurface other = moved(cube(10), Vector3(10, 0, 0));
    other.mesh.faces[8] = {0, 4, 2};
    other.mesh.faces[9] = {4, 6, 2};
    ASSERT_DOUBLE_EQ(other.mesh.volume(), 1000);
    expectOneBlock(repairSurface(joined(cube(10), other), 8, "blocks.stl"), 2000, 1000);

    // A smaller block on a larger one, in the middle of its face.
    PatchedSurface small = moved(cube(4), Vector3(3, 3, 10));
    expectOneBlock(repairSurface(joined(cube(10), small), 8, "blocks.stl"), 1064, 664);
}

TEST(SurfaceRepair, ASheetThatIsThereTwiceStaysOnce)
{
    const PatchedSurface sheet = rectangle(10, 10);
    const RepairedSurface repaired = repairSurface(joined(sheet, turnedOver(sheet)), 2, "sheet.stl");
    EXPECT_DOUBLE_EQ(repaired.surface.mesh.area(), 100);
}

TEST(SurfaceRepair, ATankKeepsItsNormalsInwards)
{
    PatchedSurface tank = cube(10);
    for (auto& face : tank.mesh.faces) std::swap(face[0], face[1]);
    EXPECT_DOUBLE_EQ(repairSurface(soupOf(tank), 8, "tank.stl").surface.mesh.volume(), -1000);
}

// A sheet of so many triangles round one vertex, which goes round it twice and crosses itself in one ray, in the middle of two triangles.
PatchedSurface doubleFan(int triangles)
{
    PatchedSurface surface;
    surface.mesh.vertices = {{0, 0, 0}};
    const double step = 4*std::numbers::pi/triangles;
    for (int i = 0; i < triangles; ++i)
    {
        const double angle = (i + 0.5)*step;
        surface.mesh.vertices.emplace_back(10*std::cos(angle), 10*std::sin(angle), 5*std::sin(angle/2));
        surface.mesh.faces.push_back({0, 1 + i, 1 + (i + 1) % triangles});
    }
    surface.patch.assign(surface.mesh.faces.size(), 0);
    surface.patches = {"fan"};
    return surface;
}

TEST(SurfaceRepair, CrossingsRoundAVertexAreFoundHoweverManyTrianglesItHas)
{
    for (const int triangles : {20, 100})
    {
        const auto report = repairSurface(doubleFan(triangles), 0.1, "fan.obj").report;
        EXPECT_TRUE(std::any_of(report.begin(), report.end(), [](const std::string& line)
        {
            return line.starts_with("1 pair of triangles that cross each other");
        })) << triangles;
    }
}

TEST(SurfaceRepair, ManyTrianglesRoundAVertexTakeLittleTime)
{
    const std::clock_t start = std::clock();
    EXPECT_TRUE(repairSurface(discOfSlivers(4000), 0.1, "disc.obj").report.empty());
    EXPECT_LT(double(std::clock() - start)/CLOCKS_PER_SEC, 5);      // 0.7 s as a rule; a test of each of 16 million pairs takes half a microsecond
}

TEST(SurfaceRepair, NothingLeftIsRefused)
{
    PatchedSurface line = rectangle(10, 0);
    EXPECT_TRUE(holds(messageOf([&] { repairSurface(line, 8, "line.stl"); }), {"line.stl", "degenerate"}));
}

}

}
