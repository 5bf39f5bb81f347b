// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh of pictures: bumps go, the body and its edges stay.
#include "core/angles/Degrees.H"
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
