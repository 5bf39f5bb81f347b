// meshSurface: the liquid's surface of each time as a closed triangle mesh, <time>/surface/liquid.ply.
//
// system/meshSurfaceDict, lengths in particle spacings:
//     cell     0.5;       // edge of the marching cubes' cells
//     support  2;         // of the smoothing kernel

#include "core/arguments/runApplication.H"
#include "core/messages/Progress.H"
#include "core/time/Time.H"
#include "device/Device.H"
#include "geometry/LiquidFiles.H"
#include "geometry/PlyFile.H"
#include "particles/Units.H"
#include "surface/LiquidSurface.H"

#include <iostream>

namespace shizuku
{

namespace
{

SurfaceParameters readParameters(const std::filesystem::path& casePath, double spacing, const Units& units)
{
    const auto file = casePath / "system/meshSurfaceDict";
    const Dictionary dict = std::filesystem::exists(file) ? Dictionary::read(file) : Dictionary();
    const double cell = dict.lookupOr("cell", 0.5), support = dict.lookupOr("support", 2.0);
    dict.refuseUnused();
    if (!(cell >= 0.1 && cell <= 2)) throw FatalInputError(dict.where("cell"), "The cell is out of range", "0.1 to 2 spacings");
    if (!(support >= 1 && support <= 8))
    {
        throw FatalInputError(dict.where("support"), "The support is out of range", "1 to 8 spacings");
    }
    const float d = units.toScaled(spacing, dimensions::length);
    return {d, float(cell) * d, float(support) * d};
}

TriangleMesh toSI(const SurfaceMesh& mesh, double unit)
{
    TriangleMesh result;
    for (const Vec3& p : mesh.vertices) result.vertices.push_back({p.x * unit, p.y * unit, p.z * unit});
    for (const Vec3& n : mesh.normals) result.normals.push_back({n.x, n.y, n.z});
    for (std::size_t k = 0; k < mesh.triangles.size(); k += 3)
    {
        result.faces.push_back({int(mesh.triangles[k]), int(mesh.triangles[k + 1]), int(mesh.triangles[k + 2])});
    }
    return result;
}

void meshSurface(const Arguments& args)
{
    const DeviceInfo device = openDevice();
    std::cout << "Device : " << device.backend << ", " << device.name << "\n\n";

    const double spacing = readSpacing(args.casePath());
    const Units units = Units::near(spacing, 1, 1);
    LiquidSurface surface(readParameters(args.casePath(), spacing, units));
    const auto times = selectTimes(args);
    Progress progress("Meshing");
    for (std::size_t t = 0; t < times.size(); ++t)
    {
        std::vector<Vec3> positions;
        for (const Vector3& x : readLiquidPositions(times[t].path))
        {
            positions.push_back({float(x.x / units.length), float(x.y / units.length), float(x.z / units.length)});
        }
        const TriangleMesh mesh = toSI(surface.extract(positions), units.length);
        writePly(liquidSurfaceFile(times[t].path), mesh);
        std::cout << "Time = " << times[t].name << " s: " << mesh.faces.size() << " triangles, volume "
                  << mesh.volume() << " m3" << std::endl;
        progress.update(double(t + 1) / double(times.size()));
    }
}

}

}

extern "C" int runOnDevice(int argc, char** argv)
{
    using namespace shizuku;
    ApplicationInfo info
    {
        .name = "meshSurface",
        .summary = "Mesh the liquid's surface by marching cubes.",
        .options = {{"device", "auto|cuda|cpu", "where to compute; auto takes a GPU where there is one", "auto"}}
    };
    for (const Option& option : timeSelectionOptions()) info.options.push_back(option);
    return runApplication(argc, argv, info, meshSurface);
}
