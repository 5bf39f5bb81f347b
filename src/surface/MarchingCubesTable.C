// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/MarchingCubesTable.H"

#include <algorithm>
#include <stdexcept>

namespace shizuku
{

namespace
{

int edgeBetween(int a, int b)
{
    const int low = a < b ? a : b;
    const int bit = a ^ b;
    const int axis = bit == 1 ? 0 : bit == 2 ? 1 : 2;
    const int others[3][2] = {{1, 2}, {0, 2}, {0, 1}};
    return 4 * axis + (low >> others[axis][0] & 1) + 2 * (low >> others[axis][1] & 1);
}

// The corners of a face in order, counter-clockwise seen from outside of the cell.
std::array<int, 4> cornersOfFace(int axis, int side)
{
    const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, base = side << axis;
    return side ? std::array{base, base | u, base | u | v, base | v} : std::array{base, base | v, base | u | v, base | u};
}

// next[e]: the edge that the contour goes to from edge e; -1 where it does not pass.
std::array<int, cellEdges> contourOf(int inside)
{
    std::array<int, cellEdges> next;
    next.fill(-1);
    for (int axis = 0; axis < 3; ++axis)
    {
        for (int side = 0; side < 2; ++side)
        {
            const auto corner = cornersOfFace(axis, side);
            const auto in = [&](int k) { return inside >> corner[k & 3] & 1; };
            // A run of inside corners k ... l is cut off by one segment. With two opposite corners inside there are
            // two runs of one corner each.
            for (int k = 0; k < 4; ++k)
            {
                if (!in(k) || in(k + 3)) continue;
                int l = k;
                while (in(l + 1)) ++l;
                const int enter = edgeBetween(corner[(k + 3) & 3], corner[k]);
                const int leave = edgeBetween(corner[l & 3], corner[(l + 1) & 3]);
                next[enter] = leave;
            }
        }
    }
    return next;
}

bool shareFace(int edge, int other)
{
    const auto [a, b] = cornersOfEdge(edge);
    const auto [c, d] = cornersOfEdge(other);
    const int bitsOfAll = a & b & c & d, bitsOfAny = a | b | c | d;
    return (bitsOfAll | (7 & ~bitsOfAny)) != 0;
}

// The place in the loop from which a fan has no side within a face of the cell, but for the loop's own. The neighbour's
// fan might have the same side there: four triangles would meet in it.
std::size_t fanApex(const std::vector<int>& loop)
{
    for (std::size_t apex = 0; apex < loop.size(); ++apex)
    {
        bool free = true;
        for (std::size_t k = 2; k + 1 < loop.size(); ++k)
        {
            free = free && !shareFace(loop[apex], loop[(apex + k) % loop.size()]);
        }
        if (free) return apex;
    }
    throw std::logic_error("marching cubes: a loop has no fan inside of the cell");
}

}

std::array<int, 2> cornersOfEdge(int edge)
{
    const int axis = edge / 4, others[3][2] = {{1, 2}, {0, 2}, {0, 1}};
    const int low = (edge & 1) << others[axis][0] | (edge >> 1 & 1) << others[axis][1];
    return {low, low | 1 << axis};
}

MarchingCubesTable makeMarchingCubesTable()
{
    MarchingCubesTable table;
    for (int inside = 0; inside < 256; ++inside)
    {
        auto next = contourOf(inside);
        int count = 0;
        for (int first = 0; first < cellEdges; ++first)
        {
            if (next[first] < 0) continue;
            std::vector<int> loop;
            for (int e = first; next[e] >= 0;)
            {
                loop.push_back(e);
                const int following = next[e];
                next[e] = -1;
                e = following;
            }
            std::rotate(loop.begin(), loop.begin() + fanApex(loop), loop.end());
            for (std::size_t k = 2; k < loop.size(); ++k)
            {
                if (count == MarchingCubesTable::mostTriangles) throw std::logic_error("marching cubes: too many triangles");
                auto& edges = table.edges[inside];
                edges[3 * count] = std::uint8_t(loop[0]);
                edges[3 * count + 1] = std::uint8_t(loop[k - 1]);
                edges[3 * count + 2] = std::uint8_t(loop[k]);
                ++count;
            }
        }
        table.triangles[inside] = std::uint8_t(count);
    }
    return table;
}

}
