// SPDX-License-Identifier: GPL-3.0-or-later
// meshSurface: the liquid's surface of each time as a closed triangle mesh, <time>/surface/liquid.<format>.

#include "MeshTimes.H"
#include "caseFiles/LiquidFiles.H"
#include "core/arguments/runApplication.H"
#include "core/messages/Progress.H"
#include "core/time/Time.H"
#include "device/DeviceApplication.H"
#include "meshes/VolumeOffset.H"
#include "meshes/surfaceFormats/SurfaceFormat.H"
#include "particles/Units.H"
#include "surface/CaseSurface.H"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace shizuku
{

namespace
{

using Formats = std::vector<std::pair<std::string, std::unique_ptr<SurfaceFormat>>>;

Formats chosenFormats(const Arguments& args, const std::vector<std::string>& ofCase)
{
    Formats formats;
    for (const std::string& word : args.found("formats") ? args.getList("formats") : ofCase)
    {
        formats.emplace_back(word, SurfaceFormatTable::New("surface format", word, {}));
    }
    if (formats.empty()) throw FatalInputError({}, "No format is chosen", "some of those below", SurfaceFormatTable::words());
    return formats;
}

std::vector<TimeFolder> timesWithLiquid(const Arguments& args)
{
    const auto holds = [](const TimeFolder& time) { return std::filesystem::exists(time.path/"liquid"); };
    return selectTimesWith(args, holds, "liquid", "<time>/liquid/positions, of fillLiquid or the solver");
}

std::vector<Position> scaled(const std::vector<Vector3>& positions, double unit)
{
    std::vector<Position> result;
    result.reserve(positions.size());
    for (const Vector3& x : positions)
    {
        const double farthest = std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)});
        if (!(farthest < quanta::farthest * unit))
        {
            std::ostringstream text;
            text << "A particle is " << farthest << " m away from the origin, and places are told apart within " << quanta::farthest * unit
                 << " m.\n    Look for particles that flew away.";
            throw FatalError(text.str());
        }
        result.push_back(positionAt(x.x / unit, x.y / unit, x.z / unit));
    }
    return result;
}

std::string signedPercent(double fraction)
{
    std::ostringstream text;
    text << std::showpos << std::fixed << std::setprecision(2) << 100 * fraction << " %";
    return text.str();
}

// Moves the mesh to the volume, no farther than half a spacing, and says what came of it.
std::string conserved(TriangleMesh& mesh, double volume, double spacing)
{
    const double offset = offsetToVolume(mesh, volume, 0.5 * spacing);
    if (std::isnan(offset)) return "left there: N d^3 is more than half a spacing away";
    std::ostringstream text;
    text << "moved by " << std::setprecision(2) << offset / spacing << " spacings to enclose N d^3";
    return text.str();
}

int repeatsOf(const Arguments& args)
{
    const double repeats = args.getDouble("repeats");
    if (repeats >= 0 && repeats <= 1e6 && repeats == std::floor(repeats)) return int(repeats);
    throw FatalInputError({}, "Option -repeats has the value " + args.get("repeats"), "a number of meshes, 0 to 1000000");
}

void meshSurface(const Arguments& args)
{
    const int repeats = repeatsOf(args);
    openNamedDevice();

    const double spacing = readSpacing(args.casePath());
    const Units units = Units::near(spacing, 1, 1);
    LiquidSurface surface(readSurfaceParameters(args.casePath(), units.toScaled(spacing, dimensions::length)));
    const SurfaceFileControls controls = readSurfaceFileControls(args.casePath());
    const Formats formats = chosenFormats(args, controls.formats);
    const auto times = timesWithLiquid(args);
    Progress progress("Meshing");
    std::size_t most = 0;
    for (std::size_t t = 0; t < times.size(); ++t)
    {
        const std::vector<Vector3> positions = readLiquidPositions(times[t].path);
        const Buffer<Position> particles(scaled(positions, units.length));
        surface.build(particles.span());
        TriangleMesh mesh = toTriangleMesh(surface.download(), units.length);
        const double volume = mesh.volume(), filled = double(positions.size()) * spacing * spacing * spacing;
        std::cout << "Time = " << times[t].name << " s: " << mesh.faces.size() << " triangles, "
                  << mesh.vertices.size() << " vertices, volume " << volume << " m3";
        if (filled > 0) std::cout << " (" << signedPercent(volume / filled - 1) << " against the particles' N d^3)";
        if (controls.conserveVolume && filled > 0) std::cout << ", " << conserved(mesh, filled, spacing);
        std::cout << std::endl;
        if (repeats > 0 && filled > 0) reportMeshTimes(surface, particles.span(), repeats);
        for (const auto& [word, format] : formats) format->write(liquidSurfaceFile(times[t].path, word), mesh);
        progress.update(double(t + 1) / double(times.size()));
        most = std::max(most, positions.size());
    }

    const std::size_t bytes = deviceCounters().peakBytes;
    std::cout << "\nMemory : " << bytes / 1000000.0 << " MB on the device";
    if (most > 0) std::cout << ", " << bytes / most << " bytes a particle";
    std::cout << "\n";
}

}

}

extern "C" int runOnDevice(int argc, char** argv)
{
    using namespace shizuku;
    std::string words;
    for (const std::string& word : SurfaceFormatTable::words()) words += (words.empty() ? "" : ", ") + word;
    ApplicationInfo info
    {
        .name = "meshSurface",
        .summary = "Mesh the liquid's surface by marching cubes.",
        .options =
        {
            deviceOption(),
            precisionOption(),
            {"formats", "LIST", "of " + words + ", e.g. \"(ply stl)\"; default: those of system/meshSurfaceDict, or ply", ""},
            {"repeats", "N", "make each mesh N times more, and print what it takes", "0"}
        }
    };
    for (const Option& option : timeSelectionOptions()) info.options.push_back(option);
    return runApplication(argc, argv, info, meshSurface);
}
