// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/MarchingCubesTable.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

using namespace shizuku;

namespace
{

const MarchingCubesTable table = makeMarchingCubesTable();

bool isInside(int corners, int corner) { return corners >> corner & 1; }

bool isCrossed(int corners, int edge)
{
    const auto [a, b] = cornersOfEdge(edge);
    return isInside(corners, a) != isInside(corners, b);
}

// Directed sides of the triangles of a case, each with the number of times that it occurs.
std::map<std::pair<int, int>, int> sidesOf(int corners)
{
    std::map<std::pair<int, int>, int> sides;
    for (int t = 0; t < table.triangles[corners]; ++t)
    {
        const auto* e = &table.edges[corners][3 * t];
        for (int k = 0; k < 3; ++k) ++sides[{e[k], e[(k + 1) % 3]}];
    }
    return sides;
}

// On the face across `axis` at `side`, 0 or 1?
bool onFace(int edge, int axis, int side)
{
    const auto [a, b] = cornersOfEdge(edge);
    return (a >> axis & 1) == side && (b >> axis & 1) == side;
}

// The edge at the same place on the opposite face, for an edge on a face across `axis`.
int mirrored(int edge, int axis)
{
    const auto [a, b] = cornersOfEdge(edge);
    for (int other = 0; other < cellEdges; ++other)
    {
        if (cornersOfEdge(other) == std::array{a ^ 1 << axis, b ^ 1 << axis}) return other;
    }
    return -1;
}

std::array<double, 3> middleOf(int edge)
{
    const auto [a, b] = cornersOfEdge(edge);
    std::array<double, 3> middle;
    for (int axis = 0; axis < 3; ++axis) middle[axis] = 0.5 * ((a >> axis & 1) + (b >> axis & 1));
    return middle;
}

}

TEST(MarchingCubesTable, NumbersTheEdgesOfACell)
{
    std::set<std::array<int, 2>> edges;
    for (int edge = 0; edge < cellEdges; ++edge)
    {
        const auto [a, b] = cornersOfEdge(edge);
        EXPECT_EQ(a ^ b, 1 << edge / 4);        // along its axis
        EXPECT_LT(a, b);
        edges.insert({a, b});
    }
    EXPECT_EQ(edges.size(), 12u);
}

TEST(MarchingCubesTable, UsesEveryCrossedEdgeAndNoOther)
{
    for (int corners = 0; corners < 256; ++corners)
    {
        std::set<int> used;
        for (int k = 0; k < 3 * table.triangles[corners]; ++k) used.insert(table.edges[corners][k]);
        for (int edge = 0; edge < cellEdges; ++edge)
        {
            ASSERT_EQ(used.contains(edge), isCrossed(corners, edge)) << "case " << corners << ", edge " << edge;
        }
    }
}

// Inside of a cell the patch is a surface with an edge, which runs over the cell's faces: a side is used once in each
// direction within the cell, or it lies in a face and is used once.
TEST(MarchingCubesTable, IsASurfaceWithinTheCell)
{
    for (int corners = 0; corners < 256; ++corners)
    {
        const auto sides = sidesOf(corners);
        for (const auto& [side, times] : sides)
        {
            ASSERT_EQ(times, 1) << "case " << corners;
            if (sides.contains({side.second, side.first})) continue;
            int faces = 0;
            for (int axis = 0; axis < 3; ++axis)
            {
                for (int at : {0, 1}) faces += onFace(side.first, axis, at) && onFace(side.second, axis, at);
            }
            ASSERT_EQ(faces, 1) << "case " << corners << ", side " << side.first << " " << side.second;
        }
    }
}

// Every pair of cells that share a face: each side in the face belongs to two triangles in all, which run through it in
// opposite directions.
TEST(MarchingCubesTable, ClosesTheSurfaceAcrossEveryFace)
{
    long pairs = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        for (int low = 0; low < 256; ++low)
        {
            for (int high = 0; high < 256; ++high)
            {
                bool share = true;
                for (int c = 0; c < 8; ++c)
                {
                    if (c >> axis & 1) share = share && isInside(low, c) == isInside(high, c ^ 1 << axis);
                }
                if (!share) continue;
                ++pairs;
                std::map<std::pair<int, int>, int> together;        // by the edges of the upper cell
                for (const auto& [side, times] : sidesOf(low))
                {
                    if (onFace(side.first, axis, 1) && onFace(side.second, axis, 1))
                    {
                        together[{mirrored(side.first, axis), mirrored(side.second, axis)}] += times;
                    }
                }
                for (const auto& [side, times] : sidesOf(high))
                {
                    if (onFace(side.first, axis, 0) && onFace(side.second, axis, 0)) together[side] += times;
                }
                for (const auto& [side, times] : together)
                {
                    ASSERT_EQ(times, 1) << "cases " << low << " and " << high << " across axis " << axis;
                    ASSERT_TRUE(together.contains({side.second, side.first}))
                        << "cases " << low << " and " << high << " across axis " << axis;
                }
            }
        }
    }
    EXPECT_EQ(pairs, 3 * 16 * 16 * 16);     // four shared corners, four free ones on either side
}

// One corner inside: one triangle whose normal points away from it. The opposite case looks the other way.
TEST(MarchingCubesTable, OrientsTrianglesOutOfTheInside)
{
    for (int c = 0; c < 8; ++c)
    {
        for (const bool inverted : {false, true})
        {
            const int corners = inverted ? 255 ^ 1 << c : 1 << c;
            ASSERT_EQ(table.triangles[corners], 1);
            const auto p = middleOf(table.edges[corners][0]), q = middleOf(table.edges[corners][1]);
            const auto r = middleOf(table.edges[corners][2]);
            double out = 0;         // triple product of p, q, r from the corner: positive where it lies behind them
            for (int k = 0; k < 3; ++k)
            {
                const int i = (k + 1) % 3, j = (k + 2) % 3;
                const auto from = [c](const auto& x, int axis) { return x[axis] - (c >> axis & 1); };
                out += from(p, k) * (from(q, i) * from(r, j) - from(q, j) * from(r, i));
            }
            EXPECT_EQ(out > 0, !inverted) << corners;
        }
    }
}

TEST(MarchingCubesTable, LeavesEmptyAndFullCellsAlone)
{
    EXPECT_EQ(table.triangles[0], 0);
    EXPECT_EQ(table.triangles[255], 0);
    EXPECT_LE(*std::max_element(table.triangles.begin(), table.triangles.end()), MarchingCubesTable::mostTriangles);
}
