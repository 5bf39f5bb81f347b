// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/PointsInside.H"
#include "sampling/SeedMethod.H"
#include "sampling/Slivers.H"
#include "sampling/SurfaceRepair.H"
#include "sampling/SurfaceSampler.H"
#include "sampling/ThinSolid.H"
#include "support/ScratchFolder.H"
#include "support/Shapes.H"
#include "support/Surfaces.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numbers>
#include <numeric>
#include <tuple>

namespace shizuku::test
{

namespace
{

// Spacing 1 throughout. What is asked of every layer: no gap below 0.7 and no hole above 1.0 spacings.
void expectGoodCover(const LayerQuality& quality)
{
    EXPECT_GE(quality.minGap, 0.7);
    EXPECT_LE(quality.largestHole, 1.0);
}

SampledSurface sample(const PatchedSurface& surface, const std::string& method = "poissonDisk", double offset = -0.5)
{
    return sampleSurface(surface, {1, offset, method, 30, CubicSpline(2)}, "test");
}

// A wedge along y, 40 long and 20 deep, whose edge at z = 0 looks upwards.
PatchedSurface wedge(double degrees)
{
    const double half = 20*std::tan(0.5*degrees*std::numbers::pi/180);
    PatchedSurface surface;
    for (const double y : {0.0, 40.0})
    {
        for (const Vector3& v : {Vector3(0, y, 0), Vector3(-half, y, -20), Vector3(half, y, -20)}) surface.mesh.vertices.push_back(v);
    }
    surface.mesh.faces = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1}, {0, 2, 5}, {0, 5, 3}, {1, 4, 5}, {1, 5, 2}};
    surface.patch.assign(8, 0);
    surface.patches = {"wedge"};
    return surface;
}

// A cone 20 deep, whose tip looks upwards.
PatchedSurface cone(double degrees)
{
    constexpr int sides = 48;
    const double radius = 20*std::tan(0.5*degrees*std::numbers::pi/180);
    PatchedSurface surface;
    surface.mesh.vertices = {{0, 0, 0}, {0, 0, -20}};
    for (int i = 0; i < sides; ++i)
    {
        const double angle = 2*std::numbers::pi*i/sides;
        surface.mesh.vertices.emplace_back(radius*std::cos(angle), radius*std::sin(angle), -20);
        const int a = 2 + i, b = 2 + (i + 1) % sides;
        surface.mesh.faces.push_back({0, a, b});
        surface.mesh.faces.push_back({1, b, a});
    }
    surface.patch.assign(surface.mesh.faces.size(), 0);
    surface.patches = {"cone"};
    return surface;
}

PatchedSurface plate(double thickness)
{
    PatchedSurface surface = cube(20);
    for (Vector3& v : surface.mesh.vertices) v.z *= thickness/20;
    return surface;
}

// A triangle 10 long and `height` high.
PatchedSurface sliver(double height)
{
    PatchedSurface surface;
    surface.mesh.vertices = {{0, 0, 0}, {10, 0, 0}, {6, height, 0}};
    surface.mesh.faces = {{0, 1, 2}};
    surface.patch = {0};
    surface.patches = {"flat"};
    return surface;
}

// The least distance between any two of the points, by comparing all pairs.
double leastGap(const std::vector<Vector3>& points)
{
    double least2 = 1e30;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j) least2 = std::min(least2, squaredLength(points[i] - points[j]));
    }
    return std::sqrt(least2);
}

}

TEST(Sampling, PlaneGetsALatticeHalfASpacingBelow)
{
    const SampledSurface floor = sample(rectangle(47.3, 31.7));
    expectGoodCover(floor.quality);
    EXPECT_LE(floor.quality.densityVariation, 0.02);
    // A triangular lattice has 2/sqrt(3) particles a squared spacing. Fitting it to the sides changes rows and columns
    // by half of one at most: 1/60 + 1/70.
    EXPECT_NEAR(floor.quality.count, 2/std::sqrt(3.0)*47.3*31.7, 0.04*47.3*31.7);
    for (const Vector3& x : floor.particles.positions)
    {
        ASSERT_NEAR(x.z, -0.5, 1e-12);
        // To rounding: a particle may slide along the border.
        ASSERT_TRUE(x.x > -1e-9 && x.x < 47.3 + 1e-9 && x.y > -1e-9 && x.y < 31.7 + 1e-9) << str(x);
    }
    for (const Vector3& n : floor.particles.normals) ASSERT_EQ(n, Vector3(0, 0, 1));
    // Neighbours in a lattice that was fitted to the sides by less than half a row of 30.
    EXPECT_NEAR(floor.quality.maxGap, 1, 0.02);
    // A triangular lattice of spacing 1: V = 1/sum W = 1.24 (cubic spline, support 2), more at the border, which has
    // half of the neighbours.
    EXPECT_NEAR(floor.quality.minVolume, 1.24, 0.02);
    EXPECT_LT(floor.quality.maxVolume, 4*1.24);
    EXPECT_GT(floor.quality.meanVolume, floor.quality.minVolume);
    EXPECT_DOUBLE_EQ(leastGap(floor.particles.positions), floor.quality.minGap);
}

TEST(Sampling, SphereIsCoveredEvenlyByBothMethods)
{
    for (const std::string& method : SeedMethodTable::words())
    {
        SCOPED_TRACE(method);
        const SampledSurface ball = sample(sphere(10, 4), method);
        expectGoodCover(ball.quality);
        EXPECT_NEAR(leastGap(ball.particles.positions), ball.quality.minGap, 1e-12);
        // Defects between patches of lattice, which a sphere must have, vary the density by 3 to 4 percent.
        EXPECT_LE(ball.quality.densityVariation, 0.06);
        for (std::size_t i = 0; i < ball.particles.positions.size(); ++i)
        {
            // The layer has the radius 9.5; facets of 3072 triangles on a sphere of radius 10 lie up to 0.03 deeper.
            ASSERT_NEAR(length(ball.particles.positions[i]), 9.5, 0.03);
            // Smoothed normals are within a degree of the sphere's.
            ASSERT_GT(dot(ball.particles.normals[i], normalized(ball.particles.positions[i])), 0.9998);
        }
    }
}

TEST(Sampling, CubeHasNoParticleNearerToAFaceThanItsOwn)
{
    for (const double edge : {6.0, 8.74, 12.0, 18.33})
    {
        const SampledSurface box = sample(cube(edge));
        expectGoodCover(box.quality);
        for (const Vector3& x : box.particles.positions)
        {
            const double depth = std::min({x.x, x.y, x.z, edge - x.x, edge - x.y, edge - x.z});
            ASSERT_NEAR(depth, 0.5, 0.05 + 1e-9);       // 0.9 of the offset is what beside an edge passes for clear
        }
    }
}

// Liquid on either side of an edge has to find solid particles of its own side; one beyond the edge, outside of the solid, would hold
// the liquid a spacing off the other side.
TEST(Sampling, SharpEdgesBelongToBothSidesAndNothingStandsOutOfThem)
{
    for (const double degrees : {20.0, 30.0, 45.0, 60.0, 68.0, 90.0})
    {
        SCOPED_TRACE(degrees);
        const PatchedSurface surface = wedge(degrees);
        const SampledSurface sampled = sample(surface);
        expectGoodCover(sampled.quality);
        const auto& [x, n] = std::tie(sampled.particles.positions, sampled.particles.normals);
        int left = 0, right = 0;
        for (const int w : windingNumbers(surface.mesh, x)) ASSERT_EQ(w, 1);
        for (std::size_t i = 0; i < x.size(); ++i)
        {
            // The row below the edge, where both layers meet.
            const double depth = 0.5/std::sin(0.5*degrees*std::numbers::pi/180);
            if (std::abs(x[i].z + depth) > 0.05 || std::abs(x[i].x) > 0.05 || std::abs(x[i].y - 20) > 18) continue;
            ++(n[i].x < 0 ? left : right);
        }
        EXPECT_GT(left + right, 30);                // 36 long, a particle every 0.95 to 1.2
        EXPECT_NEAR(left, right, 3);                // in turn, but for the ends of rows
    }
}

TEST(Sampling, ThinPlateIsCoveredByParticlesThatBothSidesShare)
{
    expectGoodCover(sample(plate(0.6)).quality);
}

TEST(ThinSolid, PlatesAndRodsThinnerThanTwoSpacingsAreFound)
{
    for (const double thickness : {0.01, 0.3, 0.6, 1.0, 1.2, 1.7, 1.99})
    {
        SCOPED_TRACE(thickness);
        const auto thin = findThinPlace(plate(thickness), 1);
        ASSERT_TRUE(thin);
        EXPECT_NEAR(thin->thickness, thickness, 2e-3);      // rays start 1e-3 inside
    }
    // The sharpest edges throw liquid.
    for (const double degrees : {20, 27, 29}) EXPECT_TRUE(findThinPlace(wedge(degrees), 1)) << degrees;
    PatchedSurface rod = sphere(0.9, 3);
    for (Vector3& v : rod.mesh.vertices) v.z *= 20;
    ASSERT_TRUE(findThinPlace(rod, 1));
}

TEST(ThinSolid, BlocksEdgesAndSheetsAreNotThin)
{
    for (const PatchedSurface& surface : {cube(12), sphere(6, 3), rectangle(20, 20), plate(2), plate(2.5), wedge(30), wedge(60)})
    {
        EXPECT_FALSE(findThinPlace(surface, 1)) << surface.patches.front();
    }
    // Two blocks with a slit of liquid of half a spacing.
    EXPECT_FALSE(findThinPlace(joined(cube(12), moved(cube(12), Vector3(0, 0, 12.5))), 1));
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

TEST(Sampling, TipsGetARingAndNothingAboveIt)
{
    for (const double degrees : {30, 45, 60})
    {
        SCOPED_TRACE(degrees);
        const SampledSurface sampled = sample(cone(degrees));
        expectGoodCover(sampled.quality);
        std::vector<std::size_t> order(sampled.particles.positions.size());
        std::iota(order.begin(), order.end(), 0u);
        const auto& x = sampled.particles.positions;
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x[a].z > x[b].z; });
        // A layer half a spacing inside of a cone of the angle 2h is r wide where it is 0.5/sin h + r/tan h deep.
        const double half = 0.5*degrees*std::numbers::pi/180, deep = 0.5/std::sin(half) + 0.45/std::tan(half);
        for (int i = 0; i < 3; ++i)
        {
            const Vector3& at = x[order[i]];
            const Vector3& n = sampled.particles.normals[order[i]];
            EXPECT_NEAR(std::hypot(at.x, at.y), 0.45, 0.05);        // normals of three of 48 facets do not meet the axis exactly
            EXPECT_NEAR(at.z, -deep, 0.15);
            EXPECT_GT(at.x*n.x + at.y*n.y, 0.4*std::cos(half));     // looks away from the axis
        }
        EXPECT_LT(x[order[3]].z, x[order[2]].z - 0.2);
    }
}

// A disc 30 wide of so many slivers round its middle, the middle of a plate 4 thick.
PatchedSurface discOfSlivers(int slivers)
{
    PatchedSurface surface;
    surface.mesh.vertices = {{0, 0, 0}, {0, 0, -4}};
    for (int i = 0; i < slivers; ++i)
    {
        const double angle = 2*std::numbers::pi*i/slivers;
        for (const double z : {0.0, -4.0}) surface.mesh.vertices.emplace_back(15*std::cos(angle), 15*std::sin(angle), z);
        const int a = 2 + 2*i, b = 2 + 2*((i + 1) % slivers);
        for (const auto& face : {std::array{0, a, b}, {1, b + 1, a + 1}, {a, a + 1, b + 1}, {a, b + 1, b}}) surface.mesh.faces.push_back(face);
    }
    surface.patch.assign(surface.mesh.faces.size(), 0);
    surface.patches = {"disc"};
    return surface;
}

TEST(ThinSolid, ManySliversTakeNoLongerThanTheirAreaDoes)
{
    const auto secondsFor = [](int slivers)
    {
        const auto start = std::chrono::steady_clock::now();
        EXPECT_FALSE(findThinPlace(discOfSlivers(slivers), 1));
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    EXPECT_LT(secondsFor(1000), 5);         // 0.1 s as a rule, 28 s where each sliver sends rays through all others
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

TEST(Slivers, AreLeftOutAndSaid)
{
    std::vector<std::string> report;
    PatchedSurface surface = joined(rectangle(30, 30), moved(sliver(0.05), Vector3(50, 0, 0)));
    leaveOutSlivers(surface, 1, "floor.obj", report);
    EXPECT_EQ(surface.mesh.faces, rectangle(30, 30).mesh.faces);
    EXPECT_EQ(surface.patch.size(), 2u);
    ASSERT_EQ(report.size(), 1u);
    EXPECT_TRUE(holds(report.front(), {"1 sliver ", "left out", "(50 0 0)"}));
}

TEST(Slivers, AloneTheyAreRefusedByName)
{
    for (const double height : {0.3, 0.05, 1e-3})
    {
        PatchedSurface surface = sliver(height);
        std::vector<std::string> report;
        EXPECT_TRUE(holds(messageOf([&] { leaveOutSlivers(surface, 1, "sliver.obj", report); }), {"sliver.obj", "0.25 m"}));
    }
}

TEST(Slivers, AFineMeshOfSingleTrianglesStays)
{
    PatchedSurface soup = soupOf(sphere(3, 4));         // triangles of 0.3 spacings
    const std::size_t faces = soup.mesh.faces.size();
    std::vector<std::string> report;
    leaveOutSlivers(soup, 1, "ball.stl", report);
    EXPECT_EQ(soup.mesh.faces.size(), faces);
    EXPECT_TRUE(report.empty());
}

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

TEST(Sampling, FacesThatLieOnEachOtherHaveNoRowBetweenThem)
{
    PatchedSurface folded = joined(rectangle(20, 20), turnedOver(rectangle(20, 20)));
    folded.mesh.faces[2] = {0, 2, 1};
    folded.mesh.faces[3] = {0, 3, 2};
    folded.mesh.vertices.resize(4);
    for (const Vector3& x : sample(folded).particles.positions) ASSERT_TRUE(std::isfinite(squaredLength(x)));
}

TEST(Sampling, SameInputGivesTheSameParticles)
{
    const PatchedSurface ball = sphere(6, 3);
    EXPECT_EQ(sample(ball).particles.positions, sample(ball).particles.positions);
}

TEST(Sampling, PatchesAreKept)
{
    PatchedSurface surface = rectangle(20, 20);
    surface.patches = {"left", "right"};
    surface.patch = {0, 1};
    const SampledSurface sampled = sample(surface);
    expectGoodCover(sampled.quality);
    const auto right = std::count(sampled.particles.patch.begin(), sampled.particles.patch.end(), 1);
    // Half of the particles, but for those along the diagonal of 28 spacings.
    EXPECT_NEAR(double(right), 0.5*sampled.quality.count, 28);
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

TEST(SurfaceRepair, NothingLeftIsRefused)
{
    PatchedSurface line = rectangle(10, 0);
    EXPECT_TRUE(holds(messageOf([&] { repairSurface(line, 8, "line.stl"); }), {"line.stl", "degenerate"}));
}

}
