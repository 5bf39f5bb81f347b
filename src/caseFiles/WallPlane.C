// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/WallPlane.H"

#include <algorithm>

namespace shizuku
{

namespace
{

constexpr double flat = 0.1;        // spacings; particles further than that from their plane bound a curved wall

std::optional<Plane> planeOfPatch(const SolidParticles& solid, int patch, double spacing)
{
    std::vector<Vector3> positions;
    Vector3 outward;
    for (std::size_t i = 0; i < solid.positions.size(); ++i)
    {
        if (solid.patch[i] != patch) continue;
        positions.push_back(solid.positions[i]);
        outward += solid.normals[i];
    }
    const auto fit = fitPlane(positions);
    if (!fit || fit->rms > flat*spacing) return std::nullopt;
    Plane plane = fit->plane;
    if (dot(plane.normal, outward) < 0) plane.normal = -plane.normal;
    plane.point += 0.5*spacing*plane.normal;
    return plane;
}

}

CaseWalls readCaseWalls(const std::filesystem::path& casePath)
{
    CaseWalls walls;
    const auto file = casePath/"constant/walls";
    if (std::filesystem::exists(file))
    {
        for (const AnalyticSurface& surface : readAnalyticSurfaces(Dictionary::read(file)))
        {
            walls.names.push_back(surface.name);
            walls.analytic.push_back(surface);
        }
    }
    if (haveSolidParticles(casePath))
    {
        walls.solid = readSolidParticles(casePath);
        walls.names.insert(walls.names.end(), walls.solid.patches.begin(), walls.solid.patches.end());
    }
    return walls;
}

std::optional<Plane> planeOf(const CaseWalls& walls, const std::string& name, double spacing)
{
    for (const AnalyticSurface& surface : walls.analytic)
    {
        if (surface.name != name) continue;
        if (surface.type != AnalyticSurface::Type::plane) return std::nullopt;
        return Plane{surface.point, surface.direction};
    }
    const auto& patches = walls.solid.patches;
    const auto patch = std::find(patches.begin(), patches.end(), name);
    if (patch == patches.end()) return std::nullopt;
    return planeOfPatch(walls.solid, int(patch - patches.begin()), spacing);
}

}
