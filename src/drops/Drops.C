// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/Drops.H"

#include "meshes/MeshTopology.H"
#include "meshes/PointsInside.H"

#include <algorithm>

namespace shizuku
{

std::vector<Drop> separateDrops(const TriangleMesh& mesh, double smallest)
{
    std::vector<Drop> drops;
    std::vector<Vector3> cavityPoints;          // one of each cavity
    std::vector<double> cavityVolumes;
    for (TriangleMesh& piece : connectedComponents(mesh))
    {
        const double volume = piece.volume();
        if (volume > smallest) drops.push_back({std::move(piece), volume});
        else if (volume < 0)
        {
            cavityPoints.push_back(piece.vertices.front());
            cavityVolumes.push_back(volume);
        }
    }
    if (!cavityPoints.empty())
    {
        for (Drop& drop : drops)
        {
            const auto inside = windingNumbers(drop.surface, cavityPoints);
            for (std::size_t i = 0; i < inside.size(); ++i) drop.volume += inside[i]*cavityVolumes[i];
        }
    }
    std::sort(drops.begin(), drops.end(), [](const Drop& a, const Drop& b) { return a.volume > b.volume; });
    return drops;
}

}
