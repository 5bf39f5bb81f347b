#include "WallSurface.H"

#include "geometry/sampling/SeedMethod.H"
#include "geometry/sampling/SurfaceFile.H"
#include "geometry/sampling/SurfaceRepair.H"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr double maxParticles = 1e8;
constexpr double largestHole = 8;       // spacings along its border: two particles fit across

Vector3 sizeOf(const TriangleMesh& mesh)
{
    Vector3 low = mesh.vertices.front(), high = low;
    for (const Vector3& v : mesh.vertices)
    {
        for (int c = 0; c < 3; ++c)
        {
            low[c] = std::min(low[c], v[c]);
            high[c] = std::max(high[c], v[c]);
        }
    }
    return high - low;
}

[[noreturn]] void refuseSize(const SampledWall& wall, const Vector3& size, const std::string& reason, double spacing)
{
    std::ostringstream found, expected;
    found << "The surface " << wall.file.string() << " is " << size.x << " x " << size.y << " x " << size.z << " m large, "
          << reason << " at the particle spacing of " << spacing << " m";
    expected << "a surface in metres: give the wall '" << wall.name
             << "' a scale, such as `scale 0.001;` for a file in millimetres, or change the spacing in system/solution";
    throw FatalInputError(wall.where, found.str(), expected.str());
}

}

PatchedSurface loadSurface(const SampledWall& wall, double spacing)
{
    PatchedSurface raw = readSurface(wall.file, wall.name);
    for (Vector3& vertex : raw.mesh.vertices) vertex *= wall.scale;
    std::cout << wall.name << ": read " << raw.mesh.faces.size() << " triangles from " << wall.file.filename().string()
              << "\n";

    const Vector3 size = sizeOf(raw.mesh);
    if (std::max({size.x, size.y, size.z}) < spacing) refuseSize(wall, size, "less than one particle", spacing);
    const double particles = latticeDensity(spacing)*raw.mesh.area();
    if (particles > maxParticles)
    {
        std::ostringstream reason;
        reason << "which would take " << particles << " particles (more than " << maxParticles << ")";
        refuseSize(wall, size, reason.str(), spacing);
    }

    RepairedSurface repaired = repairSurface(raw, largestHole*spacing, wall.file.string());
    for (const std::string& line : repaired.report) std::cout << wall.name << ": " << line << "\n";
    return std::move(repaired.surface);
}

}
