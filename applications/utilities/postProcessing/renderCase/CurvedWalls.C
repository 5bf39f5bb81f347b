// SPDX-License-Identifier: GPL-3.0-or-later
#include "CurvedWalls.H"

#include "core/dictionary/Dictionary.H"
#include "core/paths/Existence.H"
#include "meshes/StlFile.H"
#include "wallMotions/WallMotions.H"

namespace shizuku
{

CurvedWalls readCurvedWalls(const std::filesystem::path& casePath, const std::set<std::string>& patches, double time, TriangleMesh others)
{
    CurvedWalls curved{.mesh = std::move(others), .patches = {}};
    if (patches.empty()) return curved;
    const Dictionary walls = Dictionary::read(casePath/"constant/walls");
    const WallMotions motions = WallMotions::read(casePath);
    for (const std::string& name : walls.dictKeys())
    {
        const Dictionary wall = walls.subDict(name);
        if (wall.lookupOr<std::string>("type", "") != "particles") continue;
        const auto file = casePath/"constant/triSurface"/wall.lookupOr<std::string>("surface", "");
        if (file.extension() != ".stl" || !isThere(file)) continue;

        const double scale = wall.lookupOr("scale", 1.0);
        const int moving = motions.indexOf(name);
        const Pose pose = moving < 0 ? Pose() : motions.walls()[moving].motion->at(time);
        const PatchedSurface surface = readStl(file, name);
        for (std::size_t f = 0; f < surface.mesh.faces.size(); ++f)
        {
            const std::string& patch = surface.patches[surface.patch[f]];
            if (!patches.contains(patch)) continue;
            curved.patches.insert(patch);
            const int first = int(curved.mesh.vertices.size());
            for (const int v : surface.mesh.faces[f]) curved.mesh.vertices.push_back(pose(scale*surface.mesh.vertices[v]));
            curved.mesh.faces.push_back({first, first + 1, first + 2});
        }
    }
    return curved;
}

}
