// meshSurface: the liquid's surface of each time as a closed triangle mesh, <time>/surface/liquid.ply.

#include "core/arguments/runApplication.H"
#include "core/messages/Progress.H"
#include "core/time/Time.H"
#include "device/Device.H"
#include "geometry/LiquidFiles.H"
#include "geometry/PlyFile.H"
#include "particles/Units.H"
#include "surface/CaseSurface.H"

#include <iostream>

namespace shizuku
{

namespace
{

void meshSurface(const Arguments& args)
{
    const DeviceInfo device = openDevice();
    std::cout << "Device : " << device.backend << ", " << device.name << "\n\n";

    const double spacing = readSpacing(args.casePath());
    const Units units = Units::near(spacing, 1, 1);
    LiquidSurface surface(readSurfaceParameters(args.casePath(), units.toScaled(spacing, dimensions::length)));
    const auto times = selectTimes(args);
    Progress progress("Meshing");
    for (std::size_t t = 0; t < times.size(); ++t)
    {
        std::vector<Vec3> positions;
        for (const Vector3& x : readLiquidPositions(times[t].path))
        {
            positions.push_back({float(x.x / units.length), float(x.y / units.length), float(x.z / units.length)});
        }
        const TriangleMesh mesh = toTriangleMesh(surface.extract(positions), units.length);
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
