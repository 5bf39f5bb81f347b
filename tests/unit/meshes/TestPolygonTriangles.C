// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/PolygonTriangles.H"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

namespace shizuku::test
{

namespace
{

// Sum of the triangles' areas as seen along z, and of their sizes: the same where none overlaps another.
std::array<double, 2> areasOf(const std::vector<Vector3>& points)
{
    std::vector<int> corners(points.size());
    std::iota(corners.begin(), corners.end(), 0);
    std::array<double, 2> areas{};
    const auto triangles = trianglesOf(points, corners);
    EXPECT_EQ(triangles.size(), points.size() - 2);
    for (const auto& [i, j, k] : triangles)
    {
        const double z = 0.5*cross(points[j] - points[i], points[k] - points[i]).z;
        areas[0] += z;
        areas[1] += std::abs(z);
    }
    return areas;
}

}

TEST(PolygonTriangles, AConvexPolygonIsAFan)
{
    const std::vector<std::array<int, 3>> expected{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
    EXPECT_EQ(trianglesOf({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}}, {0, 1, 2, 3, 4}), expected);
}

TEST(PolygonTriangles, AStarIsCoveredOnceEitherWayRoundAndWhenItIsNotPlane)
{
    for (const double sense : {1, -1}) for (const double bump : {0.0, 0.1})
    {
        std::vector<Vector3> star;
        for (int k = 0; k < 24; ++k)
        {
            const double angle = sense*std::numbers::pi*k/12, r = k % 2 ? 1 : 3;
            star.emplace_back(10 + r*std::cos(angle), r*std::sin(angle), k % 4 == 0 ? bump : 0);
        }
        // 24 triangles between the centre and neighbouring corners.
        const double exact = 24*0.5*1*3*std::sin(std::numbers::pi/12);
        const auto [along, total] = areasOf(star);
        EXPECT_NEAR(along, sense*exact, 1e-12);     // rounding
        EXPECT_NEAR(total, exact, 1e-12);
    }
}

TEST(PolygonTriangles, CornersOnALineAreNoEars)
{
    // A square with the middles of its sides, begun at each of its corners.
    for (int first = 0; first < 8; ++first)
    {
        const std::vector<Vector3> square{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
        std::vector<Vector3> turned;
        for (int k = 0; k < 8; ++k) turned.push_back(square[(first + k) % 8]);
        const auto [along, total] = areasOf(turned);
        EXPECT_NEAR(along, 4, 1e-12);
        EXPECT_NEAR(total, 4, 1e-12);
    }
}

}
