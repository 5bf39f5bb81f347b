// SPDX-License-Identifier: GPL-3.0-or-later
#include "LoadSurface.H"

#include "meshes/Bounds.H"
#include "sampling/SeedMethod.H"
#include "sampling/SurfaceFile.H"
#include "sampling/Slivers.H"
#include "sampling/SurfaceRepair.H"
#include "sampling/ThinSolid.H"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>
#include <utility>

namespace shizuku
{

namespace
{

constexpr double maxParticles = 1e8;
constexpr double closedHole = 4;        // spacings: too narrow to be meant
constexpr double suspectSize[2] = {5, 3000};    // spacings: smaller or larger surfaces are allowed, and said to be strange

std::string sizeText(const SampledWall& wall, const Vector3& size, const std::string& reason, double spacing)
{
    std::ostringstream text;
    text << "The surface " << wall.file.string() << " is " << size.x << " x " << size.y << " x " << size.z << " m large, "
         << reason << " at the particle spacing of " << spacing << " m";
    return text.str();
}

std::string advice(const SampledWall& wall)
{
    return "a surface in metres: give the wall '" + wall.name
      + "' a scale, such as `scale 0.001;` for a file in millimetres, or change the spacing in system/solution";
}

[[noreturn]] void refuseSize(const SampledWall& wall, const Vector3& size, const std::string& reason, double spacing)
{
    throw FatalInputError(wall.where, sizeText(wall, size, reason, spacing), advice(wall));
}

// Refused where it is too thin, warned of where it is sharp.
void lookForNarrowPlaces(const SampledWall& wall, const PatchedSurface& surface, double spacing)
{
    const NarrowPlaces narrow = findNarrowPlaces(surface, spacing);
    std::ostringstream found, expected;
    if (const auto& thin = narrow.thin)
    {
        found << "The solid of wall '" << wall.name << "' is " << thin->thickness << " m thin at " << str(thin->position) << " m, "
              << thin->thickness/spacing << " spacings: liquid on either side of it feels the particles of both";
        expected << "at least " << leastThickness << " spacings, " << leastThickness*spacing << " m, or a spacing up to "
                 << thin->thickness/leastThickness << " m in system/solution; or a sheet, an open surface that is wetted from one side";
        throw FatalInputError(wall.where, found.str(), expected.str());
    }
    if (const auto& sharp = narrow.sharp)
    {
        found << "The sides of wall '" << wall.name << "' meet at " << std::round(sharp->angle) << " degrees near " << str(sharp->position)
              << " m: liquid that meets so sharp an edge or tip loses single particles, the faster the shorter the steps are\n"
              << "Expected: at least " << sharpest << " degrees, or a round edge; else a deltaT as long as what is written asks for, which the solver divides by itself";
        warning(found.str(), wall.where);
    }
}

// Which side the liquid is on, for those whose file has it wrong.
std::string description(const RepairedSurface& repaired)
{
    std::ostringstream text;
    const std::size_t n = repaired.shells;
    text << n << (n == 1 ? " shell" : " shells") << (repaired.closed ? ", closed" : ", open")
         << ", patches";
    for (const std::string& patch : repaired.surface.patches) text << ' ' << patch;
    if (repaired.closed)
    {
        text << (repaired.surface.mesh.volume() > 0 ? "; the liquid belongs outside" : "; the liquid belongs inside")
             << " (normals)";
    }
    return text.str();
}

}

RepairedSurface loadSurface(const SampledWall& wall, double spacing)
{
    refuseMissingSurface(wall);
    PatchedSurface raw = readSurface(wall.file, wall.name);
    for (Vector3& vertex : raw.mesh.vertices) vertex *= wall.scale;
    if (wall.flip) for (auto& face : raw.mesh.faces) std::swap(face[0], face[1]);
    std::cout << wall.name << ": read " << raw.mesh.faces.size() << " triangles from " << wall.file.filename().string()
              << (wall.flip ? ", turned round" : "") << "\n";

    const Vector3 size = boundsOf(raw.mesh.vertices).size();
    const double longest = std::max({size.x, size.y, size.z});
    if (longest < spacing) refuseSize(wall, size, "less than one particle", spacing);
    const double particles = latticeDensity(spacing)*raw.mesh.area();
    if (particles > maxParticles)
    {
        std::ostringstream reason;
        reason << "which would take " << particles << " particles (more than " << maxParticles << ")";
        refuseSize(wall, size, reason.str(), spacing);
    }

    if (longest < suspectSize[0]*spacing || longest > suspectSize[1]*spacing)
    {
        std::ostringstream reason;
        reason << longest/spacing << " times as long as a particle";
        warning(sizeText(wall, size, reason.str(), spacing) + "\nExpected: " + advice(wall), wall.where);
    }

    RepairedSurface repaired = repairSurface(raw, wall.closeHoles.value_or(closedHole*spacing), wall.file.string());
    leaveOutSlivers(repaired.surface, spacing, wall.file.string(), repaired.report);
    for (const std::string& line : repaired.report) std::cout << wall.name << ": " << line << "\n";
    std::cout << wall.name << ": " << description(repaired) << "\n";
    lookForNarrowPlaces(wall, repaired.surface, spacing);
    return repaired;
}

}
