// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/Drops.H"

#include "meshes/MeshTopology.H"
#include "meshes/PointsInside.H"
#include "parallel/AllParts.H"

#include <algorithm>
#include <array>

namespace shizuku
{

namespace
{

// The surfaces of part 0's drops, without normals.
std::vector<TriangleMesh> surfacesOfFirst(const Communicator& parts, const std::vector<Drop>& drops)
{
    std::vector<std::array<std::size_t, 2>> sizes;
    TriangleMesh all;
    for (const Drop& drop : drops)
    {
        sizes.push_back({drop.surface.vertices.size(), drop.surface.faces.size()});
        all.vertices.insert(all.vertices.end(), drop.surface.vertices.begin(), drop.surface.vertices.end());
        all.faces.insert(all.faces.end(), drop.surface.faces.begin(), drop.surface.faces.end());
    }
    sizes = listOfFirst(parts, sizes);
    all = {listOfFirst(parts, all.vertices), {}, listOfFirst(parts, all.faces)};
    std::vector<TriangleMesh> surfaces;
    auto vertex = all.vertices.begin();
    auto face = all.faces.begin();
    for (const auto [vertices, faces] : sizes)
    {
        surfaces.push_back({{vertex, vertex + long(vertices)}, {}, {face, face + long(faces)}});
        vertex += long(vertices);
        face += long(faces);
    }
    return surfaces;
}

}

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

std::vector<long> particlesInside(const std::vector<Drop>& drops, const std::vector<Vector3>& positions, const Communicator& parts)
{
    std::vector<long> counts;
    const auto count = [&](const TriangleMesh& surface)
    {
        const std::vector<int> winding = windingNumbers(surface, positions);
        counts.push_back(std::count_if(winding.begin(), winding.end(), [](int w) { return w > 0; }));
    };
    if (parts.parts() == 1)
    {
        for (const Drop& drop : drops) count(drop.surface);
        return counts;
    }
    for (const TriangleMesh& surface : surfacesOfFirst(parts, drops)) count(surface);
    std::vector<long> sums(counts.size(), 0);
    const std::vector<long> all = gatherListsAtFirst(parts, counts);
    for (std::size_t k = 0; k < all.size(); ++k) sums[k % sums.size()] += all[k];
    return sums;
}

}
