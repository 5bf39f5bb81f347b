// SPDX-License-Identifier: GPL-3.0-or-later
#include "CurvedWalls.H"

#include "core/dictionary/Dictionary.H"
#include "core/paths/Existence.H"
#include "meshes/ObjFile.H"
#include "meshes/PlyFile.H"
#include "meshes/StlFile.H"
#include "wallMotions/WallMotions.H"

#include <optional>

namespace shizuku
{

namespace
{

// Nothing of a kind that is not drawn.
std::optional<PatchedSurface> readDrawn(const std::filesystem::path& file, const std::string& name)
{
    const auto extension = file.extension();
    if (!isThere(file)) return std::nullopt;
    if (extension == ".stl") return readStl(file, name);
    if (extension == ".obj") return readObj(file, name);
    if (extension != ".ply") return std::nullopt;
    PatchedSurface surface;
    surface.mesh = readPly(file);
    surface.patches = {name};
    surface.patch.assign(surface.mesh.faces.size(), 0);
    return surface;
}

}

CurvedWalls readCurvedWalls(const std::filesystem::path& casePath, const std::set<std::string>& patches, double time)
{
    CurvedWalls curved;
    if (patches.empty()) return curved;
    const Dictionary walls = Dictionary::read(casePath/"constant/walls");
    const WallMotions motions = WallMotions::read(casePath);
    for (const std::string& name : walls.dictKeys())
    {
        const Dictionary wall = walls.subDict(name);
        if (wall.lookupOr<std::string>("type", "") != "particles") continue;
        const auto file = casePath/"constant/triSurface"/wall.lookupOr<std::string>("surface", "");
        const std::optional<PatchedSurface> drawn = readDrawn(file, name);
        if (!drawn) continue;

        const double scale = wall.lookupOr("scale", 1.0);
        const int moving = motions.indexOf(name);
        const Pose pose = moving < 0 ? Pose() : motions.walls()[moving].motion->at(time);
        const PatchedSurface& surface = *drawn;
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
