// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/MeshCurvature.H"
#include "meshes/MeshTopology.H"
#include "meshes/PointsInside.H"
#include "meshes/TriangleMesh.H"
#include "meshes/VolumeOffset.H"
#include "support/CapMesh.H"

#include <gtest/gtest.h>

#include <numbers>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// Sums of a few hundred terms of order one.
constexpr double rounding = 1e-13;

TriangleMesh moved(TriangleMesh mesh, const Vector3& by)
{
    for (Vector3& v : mesh.vertices) v += by;
    return mesh;
}

}

// 1/R on spheres, within the second order of the edges: 0.07, and five around a corner of the icosahedron.
TEST(TriangleMesh, CurvatureIsThatOfSpheres)
{
    for (const double radius : {1.0, 0.5})
    {
        TriangleMesh sphere = icosphereMesh(4);
        for (Vector3& v : sphere.vertices) v *= radius;
        double sum = 0;
        for (const double curvature : meanCurvature(sphere))
        {
            EXPECT_NEAR(curvature, 1/radius, 0.01/radius);
            sum += curvature;
        }
        EXPECT_NEAR(sum/double(sphere.vertices.size()), 1/radius, 0.005/radius);
        for (auto& face : sphere.faces) std::swap(face[0], face[1]);
        for (const double curvature : meanCurvature(sphere)) EXPECT_LT(curvature, -0.9/radius);         // inside out
    }
}

TEST(TriangleMesh, CubeIsExact)
{
    const TriangleMesh cube = cubeMesh(2);
    EXPECT_NEAR(cube.volume(), 8, 8*rounding);
    EXPECT_NEAR(cube.area(), 24, 24*rounding);
    EXPECT_NEAR(length(cube.centroid() - Vector3(1, 1, 1)), 0, rounding);
}

TEST(TriangleMesh, IcosahedronIsExact)
{
    // Edge of the icosahedron in the unit sphere; V = 5 (3 + sqrt 5) a^3/12, A = 5 sqrt(3) a^2.
    const double edge = 4/std::sqrt(10 + 2*std::sqrt(5.0));
    const TriangleMesh mesh = icosphereMesh(0);
    EXPECT_NEAR(mesh.volume(), 5*(3 + std::sqrt(5.0))/12*edge*edge*edge, 10*rounding);
    EXPECT_NEAR(mesh.area(), 5*std::sqrt(3.0)*edge*edge, 10*rounding);
}

TEST(TriangleMesh, IcosphereTendsToTheSphereWithTheSquareOfTheEdge)
{
    const double sphere = 4*std::numbers::pi/3;
    const double coarse = sphere - icosphereMesh(3).volume(), fine = sphere - icosphereMesh(4).volume();
    EXPECT_GT(fine, 0);                         // an inscribed body is smaller
    EXPECT_NEAR(coarse/fine, 4, 0.05);          // second order; the next order is 1 % of it here
}

// The offset of a sphere by t has the radius 1 + t, less what the icosphere lacks of a sphere, in both alike.
TEST(VolumeOffset, MovesASphereToAnotherRadius)
{
    TriangleMesh mesh = icosphereMesh(4);
    mesh.normals = mesh.vertices;
    const double before = mesh.volume(), wanted = 1.1*1.1*1.1*before;
    EXPECT_NEAR(offsetToVolume(mesh, wanted, 0.2), 0.1, 1e-4);      // its tolerance of the volume, 1e-4, over 3/R
    EXPECT_NEAR(mesh.volume(), wanted, 1e-4*wanted);
    EXPECT_TRUE(std::isnan(offsetToVolume(mesh, 2*wanted, 0.2)));   // 0.28 would be needed
    EXPECT_NEAR(mesh.volume(), wanted, 1e-4*wanted);
}

TEST(TriangleMesh, FarFromTheOriginNoDigitsAreLost)
{
    // Positions of 1000 are kept to 1e-13, and the volume is their differences' product.
    const TriangleMesh cube = moved(cubeMesh(1), {1000, -1000, 1000});
    EXPECT_NEAR(cube.volume(), 1, 1e-12);
    EXPECT_NEAR(length(cube.centroid() - Vector3(1000.5, -999.5, 1000.5)), 0, 1e-12);
}

TEST(TriangleMesh, InwardFacesGiveNegativeVolume)
{
    TriangleMesh cube = cubeMesh(1);
    for (auto& face : cube.faces) std::swap(face[0], face[1]);
    EXPECT_NEAR(cube.volume(), -1, rounding);
}

TEST(MeshTopology, FindsEachDefect)
{
    EXPECT_TRUE(findDefects(icosphereMesh(2)).none());

    TriangleMesh open = cubeMesh(1);
    open.faces.pop_back();
    EXPECT_EQ(findDefects(open).boundaryEdges, 3);
    EXPECT_FALSE(findDefects(open).closed());

    TriangleMesh flipped = cubeMesh(1);
    std::swap(flipped.faces[0][0], flipped.faces[0][1]);
    EXPECT_EQ(findDefects(flipped).flippedEdges, 3);
    EXPECT_TRUE(findDefects(flipped).closed());
    EXPECT_FALSE(findDefects(flipped).none());

    TriangleMesh fin = cubeMesh(1);             // one face more on the edge 0-1
    fin.vertices.push_back({0.5, -1, -1});
    fin.faces.push_back({0, 1, 8});
    EXPECT_EQ(findDefects(fin).nonManifoldEdges, 1);
    EXPECT_EQ(findDefects(fin).boundaryEdges, 2);

    TriangleMesh degenerate = cubeMesh(1);
    degenerate.faces.push_back({0, 0, 1});
    EXPECT_EQ(findDefects(degenerate).degenerateFaces, 1);
}

TEST(MeshTopology, TakesThePiecesApart)
{
    const auto pieces = connectedComponents(joined(moved(cubeMesh(1), {5, 0, 0}), icosphereMesh(1)));
    ASSERT_EQ(pieces.size(), 2u);
    EXPECT_EQ(pieces[0].vertices.size(), 8u);
    EXPECT_NEAR(pieces[0].volume(), 1, rounding);
    EXPECT_EQ(pieces[1].vertices.size(), 42u);
    EXPECT_NEAR(pieces[1].volume(), icosphereMesh(1).volume(), rounding);
    EXPECT_TRUE(findDefects(pieces[1]).none());
}

TEST(MeshTopology, KeepsNormalsWithTheirVertices)
{
    TriangleMesh sphere = icosphereMesh(1);
    sphere.normals = sphere.vertices;
    TriangleMesh both = joined(moved(sphere, {3, 0, 0}), sphere);
    both.normals.insert(both.normals.end(), sphere.normals.begin(), sphere.normals.end());
    const auto pieces = connectedComponents(both);
    ASSERT_EQ(pieces.size(), 2u);
    ASSERT_EQ(pieces[1].normals.size(), pieces[1].vertices.size());
    for (std::size_t i = 0; i < pieces[1].normals.size(); ++i) EXPECT_EQ(pieces[1].normals[i], pieces[1].vertices[i]);
}

TEST(PointsInside, AgreesWithTheCubeEvenAboveEdgesAndVertices)
{
    // The lattice holds points straight below the cube's vertices, edges and face diagonals.
    std::vector<Vector3> points;
    std::vector<int> expected;
    for (int i = -2; i <= 6; ++i)
    {
        for (int j = -2; j <= 6; ++j)
        {
            for (int k = -2; k <= 6; ++k)
            {
                const Vector3 p(0.25*i, 0.25*j, 0.25*k + 0.1);
                const bool onSide = p.x == 0 || p.x == 1 || p.y == 0 || p.y == 1;
                const bool above = p.z > 0 && p.z < 1;
                if (onSide && above && p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1) continue;     // on the surface
                points.push_back(p);
                expected.push_back(above && p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1);
            }
        }
    }
    EXPECT_EQ(windingNumbers(cubeMesh(1), points), expected);
}

TEST(PointsInside, RaysThroughEveryVertexOfASphereAreCountedOnce)
{
    const TriangleMesh sphere = icosphereMesh(3);
    std::vector<Vector3> inside, outside;
    for (const Vector3& v : sphere.vertices)
    {
        inside.push_back({v.x, v.y, v.z - 1e-3*(v.z > 0 ? 1 : -1)});
        outside.push_back({v.x, v.y, v.z + 1e-3*(v.z > 0 ? 1 : -1)});
    }
    // The vertices of the silhouette leave through the side when moved along z.
    const auto in = windingNumbers(sphere, inside), out = windingNumbers(sphere, outside);
    for (std::size_t i = 0; i < in.size(); ++i)
    {
        if (std::abs(sphere.vertices[i].z) < 0.1) continue;
        EXPECT_EQ(in[i], 1) << i;
        EXPECT_EQ(out[i], 0) << i;
    }
}
