// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh of pictures: bumps go, the body and its edges stay.
#include "core/angles/Degrees.H"
#include "meshes/Creases.H"
#include "meshes/SmoothMesh.H"
#include "support/CapMesh.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// Of the sphere of radius 1: root mean square of the distances, and of the angles of the normals [rad].
struct Roughness
{
    double distance = 0, angle = 0;

    explicit Roughness(const TriangleMesh& mesh)
    {
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        {
            const double off = length(mesh.vertices[i]) - 1;
            const double turn = std::acos(std::min(1.0, dot(mesh.normals[i], normalized(mesh.vertices[i]))));
            distance += off*off;
            angle += turn*turn;
        }
        distance = std::sqrt(distance/double(mesh.vertices.size()));
        angle = std::sqrt(angle/double(mesh.vertices.size()));
    }
};

// Each vertex pushed in or out by up to the amplitude.
TriangleMesh bumpySphere(double amplitude)
{
    TriangleMesh mesh = icosphereMesh(4);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> push(1 - amplitude, 1 + amplitude);
    for (Vector3& x : mesh.vertices) x *= push(random);
    return mesh;
}

}

TEST(SmoothMesh, BumpsGoAndTheBodyStays)
{
    const TriangleMesh bumpy = bumpySphere(0.01), smooth = smoothMesh(bumpy, 10, 15);
    const Roughness before(smoothMesh(bumpy, 0, 0)), after(smooth);
    EXPECT_NEAR(before.distance, 0.01/std::sqrt(3.0), 5e-4);
    // (0.75 1.265)^10 = 0.6 of the waves of six edges is left, and less of shorter ones, which turn the normals most.
    EXPECT_LT(after.distance, 0.5*before.distance);
    EXPECT_LT(after.angle, 0.25*before.angle);
    // The way back is longer by 0.03 of e^2/2, the mean of the neighbours' depth below a vertex (edges e of 0.07), in each of
    // ten passes: the radius grows by 0.0007.
    EXPECT_NEAR(smooth.volume()/bumpy.volume(), 1, 3e-3);
    EXPECT_EQ(smooth.faces, bumpy.faces);
}

TEST(SmoothMesh, NormalsTurnAtAnEdgeOnly)
{
    // Half a sphere on its disc: further than eight cells from the edge the normals are those of the sphere and of the disc.
    const double cell = 0.05;
    const Cap cap = capOfVolume(90, 2*std::numbers::pi/3, Plane{{0, 0, 0}, {0, 0, 1}}, {0, 0, 0});
    const TriangleMesh smooth = smoothMesh(capMesh(cap, cell), 0, 15);
    for (std::size_t i = 0; i < smooth.vertices.size(); ++i)
    {
        const Vector3& x = smooth.vertices[i];
        ASSERT_NEAR(length(smooth.normals[i]), 1, 1e-12);
        const bool above = x.z > 8*cell, below = x.z < 0.5*cell && std::hypot(x.x, x.y) < 1 - 8*cell;
        if (above || below)
        {
            const Vector3 exact = above ? normalized(x) : Vector3(0, 0, -1);
            EXPECT_GT(dot(smooth.normals[i], exact), std::cos(radians(5)));
        }
    }
}

// Each of the 8 corners of a cube has three sides, whose normals are those of the faces whatever is averaged.
TEST(Creases, ACubeHasSharpEdges)
{
    const TriangleMesh cube = cubeMesh(1);
    const TriangleMesh split = splitCreases(cube, 60);
    EXPECT_EQ(split.vertices.size(), 24u);
    ASSERT_EQ(split.faces.size(), cube.faces.size());
    for (std::size_t f = 0; f < cube.faces.size(); ++f)
    {
        for (int k = 0; k < 3; ++k) EXPECT_EQ(length(split.vertices[split.faces[f][k]] - cube.vertices[cube.faces[f][k]]), 0);
    }
    const TriangleMesh smooth = smoothMesh(split, 0, 5);
    for (const auto& [i, j, k] : smooth.faces)
    {
        const Vector3 own = normalized(cross(smooth.vertices[j] - smooth.vertices[i], smooth.vertices[k] - smooth.vertices[i]));
        for (const int v : {i, j, k}) EXPECT_NEAR(dot(smooth.normals[v], own), 1, 1e-12);
    }
    EXPECT_EQ(splitCreases(cube, 100).vertices.size(), 8u);
}

// Of a cap of 90 degrees vertices near the rim alone are split, which the mesh cuts obliquely within an edge's length. Of one of 150, whose faces meet at 30 degrees there, none is.
TEST(Creases, ACapHasThemAtItsRim)
{
    constexpr double edge = 5e-5;
    for (const double theta : {90.0, 150.0})
    {
        const TriangleMesh mesh = capMesh(capOfVolume(theta, 4e-9, {{0, 0, 0}, {0, 0, 1}}, {0, 0, 0}), edge), split = splitCreases(mesh, 60);
        const std::size_t added = split.vertices.size() - mesh.vertices.size();
        if (theta > 90) EXPECT_EQ(added, 0u);
        else EXPECT_GT(added, 50u);             // of 156 edges around it
        for (std::size_t v = mesh.vertices.size(); v < split.vertices.size(); ++v) EXPECT_LT(split.vertices[v].z, edge);
    }
}
