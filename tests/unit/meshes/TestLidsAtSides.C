// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/LidsAtSides.H"

#include <gtest/gtest.h>

#include <algorithm>

using namespace shizuku;

namespace
{

// A closed block from a corner on, faces of n x n squares each, without normals.
TriangleMesh block(const Vector3& min, const Vector3& max, int n)
{
    TriangleMesh mesh;
    for (int axis = 0; axis < 3; ++axis)
    {
        for (const bool isUpper : {false, true})
        {
            const int first = int(mesh.vertices.size()), u = (axis + 1)%3, v = (axis + 2)%3;
            for (int i = 0; i <= n; ++i)
            {
                for (int j = 0; j <= n; ++j)
                {
                    Vector3 x;
                    x[axis] = isUpper ? max[axis] : min[axis];
                    x[u] = min[u] + (max[u] - min[u])*i/n;
                    x[v] = min[v] + (max[v] - min[v])*j/n;
                    mesh.vertices.push_back(x);
                }
            }
            for (int i = 0; i < n; ++i)
            {
                for (int j = 0; j < n; ++j)
                {
                    const int a = first + i*(n + 1) + j, b = a + n + 1;
                    if (isUpper) mesh.faces.insert(mesh.faces.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
                    else mesh.faces.insert(mesh.faces.end(), {{a, b + 1, b}, {a, a + 1, b + 1}});
                }
            }
        }
    }
    return mesh;
}

constexpr double spacing = 0.1;
const std::vector<RepeatedSides> alongX{{0, 0, 1}};

}

// A film from side to side, a third of a spacing short of them, as marching cubes leave it: 4 of 6 faces of 2 x 10 x 10 triangles stay.
TEST(LidsAtSides, AFilmIsOpenAtBoth)
{
    const TriangleMesh closed = block({0.03, 0, 0}, {0.97, 0.5, 0.2}, 10);
    ASSERT_NEAR(closed.volume(), 0.94*0.5*0.2, 1e-12);
    const TriangleMesh film = withoutLids(closed, alongX, spacing);
    EXPECT_EQ(film.faces.size(), 800U);
    EXPECT_EQ(film.vertices.size(), 4*11*11U);          // each face of a block has its own
    EXPECT_NEAR(film.area(), 0.94*2*(0.5 + 0.2), 1e-12);
}

// What a lid shares with the surface comes to the side, and its normal along it: a tent over the middle of the lid's edge.
TEST(LidsAtSides, RimsLieOnTheSides)
{
    TriangleMesh mesh = block({0.03, 0, 0}, {0.97, 0.5, 0.2}, 1);
    // Vertices in one place become one.
    for (auto& face : mesh.faces)
    {
        for (int& v : face) v = int(std::find(mesh.vertices.begin(), mesh.vertices.end(), mesh.vertices[v]) - mesh.vertices.begin());
    }
    mesh.normals.assign(mesh.vertices.size(), Vector3(0.6, 0, 0.8));
    const TriangleMesh film = withoutLids(mesh, alongX, spacing);
    EXPECT_EQ(film.faces.size(), 8U);
    EXPECT_EQ(film.vertices.size(), 8U);
    EXPECT_EQ(film.normals.size(), 8U);
    for (const Vector3& x : film.vertices) EXPECT_EQ(x.x, x.x < 0.5 ? 0 : 1);
    for (const Vector3& n : film.normals) EXPECT_NEAR(length(n - Vector3(0, 0, 1)), 0, 1e-12);
    EXPECT_NEAR(film.area(), 2*(0.5 + 0.2), 1e-12);
}

// One side alone has liquid, or liquid elsewhere than the other: no lids. Sides along another axis have none either.
TEST(LidsAtSides, LiquidThatOnlyComesNearASideKeepsItsFaces)
{
    const TriangleMesh drop = block({0.03, 0, 0}, {0.6, 0.5, 0.2}, 4);
    EXPECT_EQ(withoutLids(drop, alongX, spacing).faces.size(), drop.faces.size());
    TriangleMesh two = drop;
    const TriangleMesh other = block({0.7, 0.8, 0}, {0.97, 1.2, 0.2}, 4);
    const int before = int(two.vertices.size());
    two.vertices.insert(two.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& f : other.faces) two.faces.push_back({f[0] + before, f[1] + before, f[2] + before});
    EXPECT_EQ(withoutLids(two, alongX, spacing).faces.size(), two.faces.size());
    EXPECT_EQ(withoutLids(block({0.03, 0, 0}, {0.97, 0.5, 0.2}, 4), {{1, -1, 2}}, spacing).faces.size(), 6*32U);
}
