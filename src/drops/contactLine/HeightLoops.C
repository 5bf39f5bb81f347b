// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/contactLine/HeightLoops.H"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace shizuku
{

std::vector<Loop> loopsAt(const TriangleMesh& mesh, const std::vector<double>& height, double level)
{
    struct Crossing { Vector3 point; std::pair<int, int> next; };
    std::map<std::pair<int, int>, Crossing> crossings;          // by edge, lower vertex first
    for (const auto& face : mesh.faces)
    {
        std::optional<std::pair<int, int>> down, up;
        for (int side = 0; side < 3; ++side)
        {
            const int from = face[side], to = face[(side + 1) % 3];
            const bool fromAbove = height[from] > level, toAbove = height[to] > level;
            if (fromAbove != toAbove) (fromAbove ? down : up) = std::minmax(from, to);
        }
        if (!down) continue;
        const auto [a, b] = *down;
        const double share = (level - height[a])/(height[b] - height[a]);
        crossings[*down] = {mesh.vertices[a] + share*(mesh.vertices[b] - mesh.vertices[a]), *up};
    }

    std::vector<Loop> loops;
    while (!crossings.empty())
    {
        Loop& loop = loops.emplace_back();
        for (auto at = crossings.begin(); at != crossings.end();)
        {
            loop.push_back(at->second.point);
            const auto next = at->second.next;
            crossings.erase(at);
            at = crossings.find(next);
        }
    }
    return loops;
}

double lengthOf(const Loop& loop)
{
    double sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) sum += length(loop[(i + 1) % loop.size()] - loop[i]);
    return sum;
}

}
