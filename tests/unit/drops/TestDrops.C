// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/BodyNumbers.H"
#include "drops/DropTable.H"
#include "drops/Drops.H"
#include "caseFiles/WallPlane.H"
#include "support/CapMesh.H"

#include <gtest/gtest.h>

#include <algorithm>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

TriangleMesh cubeAt(const Vector3& corner, double side, bool inward = false)
{
    TriangleMesh cube = cubeMesh(side);
    for (Vector3& v : cube.vertices) v += corner;
    for (auto& face : cube.faces)
    {
        if (inward) std::swap(face[0], face[1]);
    }
    return cube;
}

constexpr double rounding = 1e-12;

}

TEST(Drops, LargestFirstAndSplashesLeftOut)
{
    const TriangleMesh mesh = joined(joined(cubeAt({0, 0, 0}, 1), cubeAt({5, 0, 0}, 2)), cubeAt({9, 0, 0}, 0.1));
    const std::vector<Drop> drops = separateDrops(mesh, 0.01);
    ASSERT_EQ(drops.size(), 2u);
    EXPECT_NEAR(drops[0].volume, 8, rounding);
    EXPECT_NEAR(drops[1].volume, 1, rounding);
    EXPECT_NEAR(length(drops[0].surface.centroid() - Vector3(6, 1, 1)), 0, rounding);
}

TEST(Drops, CavitiesAreTakenOffTheDropAroundThem)
{
    const TriangleMesh bubble = cubeAt({5.5, 0.5, 0.5}, 1, true);
    const TriangleMesh mesh = joined(joined(cubeAt({0, 0, 0}, 1), bubble), cubeAt({5, 0, 0}, 2));
    const std::vector<Drop> drops = separateDrops(mesh, 0.01);
    ASSERT_EQ(drops.size(), 2u);
    EXPECT_NEAR(drops[0].volume, 8 - 1, rounding);
    EXPECT_NEAR(drops[1].volume, 1, rounding);
    EXPECT_EQ(drops[0].surface.faces.size(), 12u);      // the outer surface alone
}

// Six in the larger drop, one in its cavity, which counts, two in the smaller one and one beside both.
TEST(Drops, ParticlesInsideAreCounted)
{
    const TriangleMesh mesh = joined(cubeAt({0, 0, 0}, 1), joined(cubeAt({5, 0, 0}, 2), cubeAt({5.5, 0.5, 0.5}, 1, true)));
    std::vector<Vector3> particles{{0.3, 0.4, 0.5}, {0.6, 0.2, 0.7}, {3, 0.5, 0.5}, {6, 1, 1}};
    for (int k = 0; k < 6; ++k) particles.push_back({5.1, 0.3*k + 0.1, 1.9});
    EXPECT_EQ(particlesInside(separateDrops(mesh, 0.01), particles, Alone()), (std::vector<long>{7, 2}));
}

TEST(WallPlane, LiesHalfASpacingAboveTheParticlesOfATiltedPatch)
{
    const double spacing = 1e-4;
    const Vector3 normal = normalized({0.2, -0.4, 1}), u = perpendicular(normal), v = cross(normal, u);
    CaseWalls walls;
    walls.solid.patches = {"side", "floor"};
    for (int i = -10; i <= 10; ++i)
    {
        for (int j = -10; j <= 10; ++j)
        {
            walls.solid.positions.push_back(spacing*(i*u + j*v));
            walls.solid.normals.push_back(-normal);         // the liquid is below
            walls.solid.patch.push_back(1);
            walls.solid.positions.push_back(spacing*(i*u + 20*normal) + 5e-3*normal);
            walls.solid.normals.push_back(normal);
            walls.solid.patch.push_back(0);
        }
    }
    const auto plane = planeOf(walls, "floor", spacing);
    ASSERT_TRUE(plane);
    EXPECT_NEAR(dot(plane->normal, -normal), 1, 1e-12);
    EXPECT_NEAR(plane->distance({0, 0, 0}), -0.5*spacing, 1e-12*spacing);
    EXPECT_FALSE(planeOf(walls, "side", spacing));          // its particles stand on a line
    EXPECT_FALSE(planeOf(walls, "roof", spacing));
}

TEST(WallPlane, CurvedPatchesAreNone)
{
    const double spacing = 1e-4;
    CaseWalls walls;
    walls.solid.patches = {"bowl"};
    for (int i = -20; i <= 20; ++i)
    {
        for (int j = -20; j <= 20; ++j)
        {
            walls.solid.positions.push_back({i*spacing, j*spacing, 50*(i*i + j*j)*spacing*spacing});    // R = 10 mm
            walls.solid.normals.push_back({0, 0, 1});
            walls.solid.patch.push_back(0);
        }
    }
    EXPECT_FALSE(planeOf(walls, "bowl", spacing));
}

// One answer: of the two fits the one that is nearer to the surface; tangents where neither is near; none where nothing touches.
TEST(DropTable, TheAngleIsThatOfTheFitWhichFollowsTheSurface)
{
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const auto methodOf = [](double profile, double cap, double tangents)
    {
        DropRecord record;
        if (!std::isnan(profile)) record.underGravity = {50, 1e-3, profile};
        record.shape.angle = std::isnan(cap) ? cap : 55;
        record.shape.residual = cap;
        record.shape.mean = tangents;
        const MeasuredAngle chosen = chosenAngle(record);
        return std::pair(word(chosen.method), chosen.angle);
    };
    using Answer = std::pair<std::string, double>;
    EXPECT_EQ(methodOf(0.05, 0.06, 54), Answer("profile", 50));
    EXPECT_EQ(methodOf(0.06, 0.05, 54), Answer("cap", 55));
    EXPECT_EQ(methodOf(none, 0.05, 54), Answer("cap", 55));
    EXPECT_EQ(methodOf(0.3, 0.25, 54), Answer("tangents", 54));
    EXPECT_EQ(methodOf(0.3, 0.25, none), Answer("cap", 55));
    EXPECT_EQ(methodOf(none, none, none).first, "none");
}

namespace
{

// A row of particles along x, a spacing of 1 apart.
void addRow(std::vector<Vector3>& particles, double first, int n)
{
    for (int i = 0; i < n; ++i) particles.push_back({first + i, 0, 0});
}

}

// Three rows in the order 4, 6, 5 have the numbers 3, 1, 2, the largest first. Then the rows of 4 and 6 merge, that of 5 breaks into 2 and 3, and a new one of 2 comes in; last, particles are in another order.
TEST(BodyNumbers, StayWithTheParticles)
{
    BodyNumbers numbers(1);
    std::vector<Vector3> particles;
    addRow(particles, 0, 4);
    addRow(particles, 10, 6);
    addRow(particles, 30, 5);
    std::vector<long> ids;
    for (long id = 100; id < 115; ++id) ids.push_back(id);
    EXPECT_EQ(numbers.next(particles, ids), (std::vector<int>{3, 3, 3, 3, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2}));

    particles.clear();
    addRow(particles, 6, 4);
    addRow(particles, 10, 6);
    addRow(particles, 30, 2);
    addRow(particles, 40, 3);
    addRow(particles, 60, 2);
    ids.push_back(7);
    ids.push_back(8);
    const std::vector<int> later{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 4, 4, 2, 2, 2, 5, 5};
    EXPECT_EQ(numbers.next(particles, ids), later);

    std::reverse(particles.begin(), particles.end());
    std::reverse(ids.begin(), ids.end());
    EXPECT_EQ(numbers.next(particles, ids), std::vector<int>(later.rbegin(), later.rend()));
}
