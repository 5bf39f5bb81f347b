// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/NearestPoint.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace shizuku::test
{

namespace
{

std::vector<Vector3> pointsAtRandom(int n)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-1, 1);
    std::vector<Vector3> points;
    for (int i = 0; i < n; ++i)
    {
        const double x = place(random), y = place(random), z = place(random);
        points.emplace_back(x, y, z);
    }
    return points;
}

std::size_t nearestOf(const std::vector<Vector3>& points, const Vector3& x)
{
    const auto closer = [&](const Vector3& a, const Vector3& b) { return squaredLength(a - x) < squaredLength(b - x); };
    return std::min_element(points.begin(), points.end(), closer) - points.begin();
}

}

// 300 points in a cube of 2: some 0.2 apart, so that about half of the places have one within 0.15.
TEST(NearestPoint, WithinAReachIsTheNearestOfAllOrNone)
{
    const std::vector<Vector3> points = pointsAtRandom(300);
    const NearestPoint nearest(points);
    constexpr double reach = 0.15;
    int found = 0, none = 0;
    for (const Vector3& x : pointsAtRandom(1000))
    {
        const Vector3 place = 1.2*x;
        const std::size_t expected = nearestOf(points, place);
        EXPECT_EQ(nearest(place), expected);
        const auto within = nearest.within(place, reach);
        EXPECT_EQ(within.has_value(), length(points[expected] - place) <= reach);
        if (within)
        {
            EXPECT_EQ(*within, expected);
        }
        ++(within ? found : none);
    }
    EXPECT_GT(found, 100);
    EXPECT_GT(none, 100);
}

}
