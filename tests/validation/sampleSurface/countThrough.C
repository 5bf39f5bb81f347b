// SPDX-License-Identifier: GPL-3.0-or-later
// How many liquid particles of a case's last time are behind a surface that its solid particles were sampled from:
//
//     countThrough CASE SURFACE SCALE
//
// prints "<behind> of <all>". Behind is deeper in the solid than the layer, which lies half a spacing below the surface;
// of an open surface, where no point is inside: below the tangent plane of each solid particle that is less than half a
// spacing further than the nearest, unless all of them are a spacing or more aside. A position that is not finite counts
// as behind.

#include "caseFiles/LiquidFiles.H"
#include "caseFiles/SolidParticles.H"
#include "core/messages/Error.H"
#include "core/time/Time.H"
#include "meshes/PointsInside.H"
#include "sampling/SurfaceDistance.H"
#include "sampling/SurfaceFile.H"
#include "sampling/SurfaceRepair.H"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

using namespace shizuku;

namespace
{

bool isFinite(const Vector3& x) { return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z); }

long behindClosed(const TriangleMesh& mesh, const std::vector<Vector3>& liquid, double spacing)
{
    const SurfaceDistance distance(mesh);
    const WindingNumber winding(mesh);
    const bool solidInside = mesh.volume() > 0;
    return std::count_if(liquid.begin(), liquid.end(), [&](const Vector3& x)
    {
        return !isFinite(x) || ((winding(x) != 0) == solidInside && distance(x).distance > 0.5*spacing);
    });
}

long behindOpen(const SolidParticles& solid, const std::vector<Vector3>& liquid, double spacing)
{
    return std::count_if(liquid.begin(), liquid.end(), [&](const Vector3& x)
    {
        if (!isFinite(x)) return true;
        double nearest = std::numeric_limits<double>::infinity();
        for (const Vector3& k : solid.positions) nearest = std::min(nearest, length(x - k));
        bool beside = true;
        for (std::size_t k = 0; k < solid.positions.size(); ++k)
        {
            const Vector3 r = x - solid.positions[k];
            if (length(r) > nearest + 0.5*spacing) continue;
            const double height = dot(r, solid.normals[k]);
            if (height >= 0) return false;
            if (squaredLength(r) - height*height < spacing*spacing) beside = false;
        }
        return !beside;
    });
}

void run(const std::filesystem::path& casePath, const std::filesystem::path& file, double scale)
{
    const auto times = timeFolders(casePath);
    if (times.empty()) throw FatalError("There is no time folder in " + casePath.string());
    const auto liquid = readLiquidPositions(times.back().path);
    const double spacing = readSpacing(casePath);
    PatchedSurface surface = readSurface(file, "wall");
    for (Vector3& v : surface.mesh.vertices) v *= scale;
    const RepairedSurface repaired = repairSurface(surface, 4*spacing, file.string());
    const long behind = repaired.closed
        ? behindClosed(repaired.surface.mesh, liquid, spacing)
        : behindOpen(readSolidParticles(casePath), liquid, spacing);
    std::cout << behind << " of " << liquid.size() << "\n";
}

}

int main(int argc, char** argv)
{
    try
    {
        if (argc != 4) throw FatalError("usage: countThrough CASE SURFACE SCALE");
        run(argv[1], argv[2], std::stod(argv[3]));
        return 0;
    }
    catch (const std::exception& error)
    {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
