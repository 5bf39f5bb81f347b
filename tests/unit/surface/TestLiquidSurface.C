#include "surface/LiquidSurface.H"

#include "device/Device.H"
#include "geometry/MeshTopology.H"
#include "support/PointSets.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr SurfaceParameters parameters{.spacing = 1, .cell = 0.5f, .support = 2};

TriangleMesh meshOf(const std::vector<Vec3>& particles, const SurfaceParameters& p = parameters)
{
    const SurfaceMesh surface = LiquidSurface(p).extract(particles);
    TriangleMesh mesh;
    for (const Vec3& v : surface.vertices) mesh.vertices.emplace_back(v.x, v.y, v.z);
    for (const Vec3& n : surface.normals) mesh.normals.emplace_back(n.x, n.y, n.z);
    for (std::size_t t = 0; t < surface.triangles.size(); t += 3)
    {
        const auto* corners = &surface.triangles[t];
        mesh.faces.push_back({int(corners[0]), int(corners[1]), int(corners[2])});
    }
    return mesh;
}

void expectSurface(const TriangleMesh& mesh)
{
    const MeshDefects defects = findDefects(mesh);
    EXPECT_EQ(defects.boundaryEdges, 0);
    EXPECT_EQ(defects.nonManifoldEdges, 0);
    EXPECT_EQ(defects.flippedEdges, 0);
    EXPECT_EQ(defects.degenerateFaces, 0);
    EXPECT_EQ(mesh.normals.size(), mesh.vertices.size());
}

}

// The kernel's second moment in a plane is zero, so that a ball has the volume N d^3 whatever its radius: 0.3 % for the
// steps of the lattice's edge and the facets. The plain spline would lose 3 s^2/R^2, 2.6 % and 0.95 %.
TEST(LiquidSurface, ClosesAroundABall)
{
    for (const float radius : {6.0f, 10.0f})
    {
        const auto ball = latticeBall(radius, {3, -2, 40});
        const TriangleMesh mesh = meshOf(ball);
        expectSurface(mesh);
        EXPECT_EQ(connectedComponents(mesh).size(), 1u);
        const double volume = mesh.volume() / double(ball.size());
        EXPECT_NEAR(volume, 1, 0.003) << radius;
        const Vector3 centre = mesh.centroid();
        EXPECT_NEAR(length(centre - Vector3(3, -2, 40)), 0, 1e-3);      // the lattice is symmetric about it
    }
}

TEST(LiquidSurface, HasUnitNormalsOutwards)
{
    const TriangleMesh mesh = meshOf(latticeBall(7));
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    {
        ASSERT_NEAR(length(mesh.normals[v]), 1, 1e-5);
        ASSERT_GT(dot(mesh.normals[v], normalized(mesh.vertices[v])), 0.8);     // steps of the lattice tilt them
    }
}

TEST(LiquidSurface, KeepsTwoBallsApart)
{
    auto balls = latticeBall(5, {-20, 0, 0});
    const auto other = latticeBall(4, {15, 3, -9});
    balls.insert(balls.end(), other.begin(), other.end());
    const TriangleMesh mesh = meshOf(balls);
    expectSurface(mesh);
    const auto pieces = connectedComponents(mesh);
    ASSERT_EQ(pieces.size(), 2u);
    double volumes = 0;
    for (const auto& piece : pieces)
    {
        EXPECT_GT(piece.volume(), 0);
        volumes += piece.volume();
    }
    EXPECT_NEAR(volumes, mesh.volume(), 1e-9 * volumes);
}

// Thin, torn and touching liquid: whatever the cases of cells, the mesh stays closed and manifold.
TEST(LiquidSurface, StaysASurfaceAroundScatteredLiquid)
{
    for (unsigned seed = 1; seed <= 4; ++seed)
    {
        for (const float cell : {0.4f, 0.7f})
        {
            const auto drops = randomPoints(2500, {0, 0, 0}, {17, 17, 17}, seed);
            const TriangleMesh mesh = meshOf(drops, {.spacing = 1, .cell = cell, .support = 2});
            EXPECT_GT(mesh.faces.size(), 10000u);
            expectSurface(mesh);
        }
    }
}

// A plane's face: phi = 1/2 half a spacing above the last layer by symmetry, but for the pattern that the lattice
// prints through. Vertices stand where phi is 1/2 along an edge after one Newton step: 3 % of a spacing for both.
TEST(LiquidSurface, LiesHalfASpacingOutsideOfALayer)
{
    const TriangleMesh mesh = meshOf(latticeBlock(16, 16, 8, 1), {.spacing = 1, .cell = 0.45f, .support = 2});
    expectSurface(mesh);
    for (const Vector3& v : mesh.vertices)
    {
        if (v.x > 5 && v.x < 10 && v.y > 5 && v.y < 10 && v.z > 4)
        {
            ASSERT_NEAR(v.z, 7.5, 0.03);
        }
    }
}

TEST(LiquidSurface, OfNothingIsEmpty)
{
    const long before = deviceCounters().launches;
    const SurfaceMesh mesh = LiquidSurface(parameters).extract(std::vector<Vec3>{});
    EXPECT_TRUE(mesh.vertices.empty());
    EXPECT_TRUE(mesh.triangles.empty());
    EXPECT_EQ(deviceCounters().launches, before);
}

// One particle's phi at its centre is 8/(pi (h/d)^3) (1 + 36 s^2/h^2) = 9.80/(h/d)^3: 0.36 for h = 3 d, below the level,
// and 1.22 for h = 2 d.
TEST(LiquidSurface, OfOneParticleIsEmptyOrClosed)
{
    EXPECT_TRUE(meshOf({{0.2f, 0.1f, -0.3f}}, {.spacing = 1, .cell = 0.2f, .support = 3}).faces.empty());
    const TriangleMesh mesh = meshOf({{0.2f, 0.1f, -0.3f}}, {.spacing = 1, .cell = 0.2f, .support = 2});
    EXPECT_GT(mesh.volume(), 0);
    expectSurface(mesh);
}
