// SPDX-License-Identifier: GPL-3.0-or-later
// meshSurface: the liquid's surface of each time as a closed triangle mesh, <time>/surface/liquid.<format>.
//
// With -parallel each part meshes some layers of the space; files are those of one process, or, as pvtp, pieces that the parts write.

#include "CleanedMesh.H"
#include "MeshTimes.H"
#include "caseFiles/LiquidFiles.H"
#include "core/arguments/runApplication.H"
#include "core/messages/Progress.H"
#include "core/time/Time.H"
#include "device/DeviceApplication.H"
#include "device/Processors.H"
#include "drops/SeparateBodies.H"
#include "meshes/surfaceFormats/SurfaceFormat.H"
#include "parallel/AllParts.H"
#include "parallel/ParallelRun.H"
#include "particles/Unfold.H"
#include "particles/Units.H"
#include "surface/CaseSurface.H"
#include "surface/MeshOfParts.H"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <utility>

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

// What came of moving the mesh to enclose N d^3, no farther than half a spacing.
std::string conserved(double offset, double spacing)
{
    if (std::isnan(offset)) return ", left there: N d^3 is more than half a spacing away";
    std::ostringstream text;
    text << ", moved by " << std::setprecision(2) << offset / spacing << " spacings to enclose N d^3";
    return text.str();
}

int repeatsOf(const Arguments& args, const Communicator& parts)
{
    const double repeats = args.getDouble("repeats");
    if (!(repeats >= 0 && repeats <= 1e6 && repeats == std::floor(repeats)))
    {
        throw FatalInputError({}, "Option -repeats has the value " + args.get("repeats"), "a number of meshes, 0 to 1000000");
    }
    if (repeats > 0 && parts.parts() > 1) throw FatalInputError({}, "Both -repeats and -parallel are given", "one of them");
    return int(repeats);
}

// A part's share of the particles of a time, and how many there are in all.
struct Share
{
    std::size_t all = 0;
    std::vector<Position> positions;
};

// The liquid of a time: bodies across cyclic sides in one piece, with the mirror images across symmetry planes.
class WholeLiquid
{
public:
    WholeLiquid(const std::filesystem::path& casePath, double spacing, double unit) : unit_(unit), reach_(bodyReach * spacing / unit), sides_(Sides::read(casePath, unit)) {}

    // A part's share. Where bodies are to be joined, each part has to see all particles.
    Share share(const TimeFolder& time, const Communicator& parts) const
    {
        Share share;
        const bool joins = sides_ && sides_->box().has(Sides::Kind::cyclic);
        std::pair<std::size_t, std::size_t> own;
        const auto choose = [&](std::size_t n)
        {
            share.all = n;
            own = shareOf(parts, n);
            return joins ? ElementRange{0, n} : ElementRange{own.first, own.second};
        };
        inAllParts(parts, [&] { share.positions = scaled(readLiquidPositions(time.path, choose), unit_); });
        if (!sides_) return share;
        if (joins)
        {
            const std::vector<Position> all = joinedAcross(std::move(share.positions), *sides_, reach_);
            share.positions.assign(all.begin() + long(own.first), all.begin() + long(own.second));
        }
        share.positions = unfolded(std::move(share.positions), *sides_);
        share.all *= unfolded(std::vector<Position>(1), *sides_).size();
        return share;
    }

    // All of it, m.
    std::vector<Vector3> positions(const TimeFolder& time) const
    {
        std::vector<Vector3> positions = readLiquidPositions(time.path);
        if (!sides_) return positions;
        const auto whole = unfolded(joinedAcross(scaled(positions, unit_), *sides_, reach_), *sides_);
        positions.clear();
        for (const Position& each : whole)
        {
            const Place x = placeOf(each);
            positions.push_back(unit_ * Vector3(quanta::lengthOf(x.x), quanta::lengthOf(x.y), quanta::lengthOf(x.z)));
        }
        return positions;
    }

private:
    double unit_, reach_;
    std::optional<Sides> sides_;
};

// What the files have.
struct MeshNumbers
{
    double filled, spacing;             // m3: N d^3; m
    bool conserves;
    const WholeLiquid& liquid;
    CleanedMesh* cleaned;          // null: the mesh as it is
};

void writeWhole(const Formats& formats, const TimeFolder& time, TriangleMesh mesh, const MeshNumbers& numbers, std::string& text)
{
    double offset = 0;
    if (numbers.cleaned) offset = numbers.cleaned->clean(mesh, time, numbers.liquid.positions(time), numbers.conserves ? numbers.filled : mesh.volume());
    else if (numbers.conserves) offset = offsetToVolume(mesh, numbers.filled, 0.5 * numbers.spacing);
    if (numbers.conserves) text = conserved(offset, numbers.spacing);
    for (const auto& [word, format] : formats)
    {
        if (!format->takesPieces()) format->write(liquidSurfaceFile(time.path, word), mesh);
    }
}

// Files of the whole are those of one process, and part 0 writes them.
std::string write(const Formats& formats, const TimeFolder& time, MeshOfParts& mesh, const MeshNumbers& numbers, const Communicator& parts)
{
    std::string text;
    const auto takesPieces = [](const auto& format) { return format.second->takesPieces(); };
    if (!std::all_of(formats.begin(), formats.end(), takesPieces))
    {
        TriangleMesh whole = mesh.whole();
        inAllParts(parts, [&]
        {
            if (parts.part() == 0) writeWhole(formats, time, std::move(whole), numbers, text);
        });
    }
    if (std::any_of(formats.begin(), formats.end(), takesPieces))
    {
        if (numbers.conserves) text = conserved(mesh.offsetPieces(numbers.filled, 0.5 * numbers.spacing), numbers.spacing);
        for (const auto& [word, format] : formats)
        {
            if (format->takesPieces()) format->writePiece(liquidSurfaceFile(time.path, word), mesh.piece(), parts);
        }
    }
    return text;
}

void reportMemory(const Communicator& parts, std::size_t mostParticles)
{
    const std::vector<std::size_t> bytes = parts.gather(deviceCounters().peakBytes), particles = parts.gather(mostParticles);
    const std::size_t most = std::max_element(bytes.begin(), bytes.end()) - bytes.begin();
    std::cout << "\nMemory : " << bytes[most] / 1000000.0 << " MB on the device";
    if (particles[most] > 0) std::cout << ", " << bytes[most] / particles[most] << " bytes a particle";
    std::cout << (parts.parts() > 1 ? ", of the part that needs most\n" : "\n");
}

void meshSurface(const Arguments& args, const Communicator& parts)
{
    const int repeats = repeatsOf(args, parts);
    shareProcessors(parts.partsOfHost());
    openNamedDevice(parts.partOfHost());

    const double spacing = readSpacing(args.casePath());
    const Units units = Units::near(spacing, 1, 1);
    const SurfaceParameters parameters = readSurfaceParameters(args.casePath(), units.toScaled(spacing, dimensions::length));
    LiquidSurface surface(parameters);
    const SurfaceFileControls controls = readSurfaceFileControls(args.casePath());
    const WholeLiquid liquid(args.casePath(), spacing, units.length);
    const Formats formats = chosenFormats(args, controls.formats);
    const auto times = timesWithLiquid(args);
    std::optional<CleanedMesh> cleaned;
    inAllParts(parts, [&]
    {
        if (controls.clean && parts.part() == 0) cleaned.emplace(args.casePath(), spacing, units.toSI(parameters.support, dimensions::length));
    });
    Progress progress("Meshing");
    std::size_t most = 0;
    for (std::size_t t = 0; t < times.size(); ++t)
    {
        Share share = liquid.share(times[t], parts);
        const auto [cut, own] = surface.particlesOfLayers(std::exchange(share.positions, {}), parts);
        const Buffer<Position> particles(own);
        surface.build(particles.span(), cut);
        MeshOfParts mesh(surface, units.length, cut);
        const double volume = mesh.volume(), filled = double(share.all) * spacing * spacing * spacing;
        std::cout << "Time = " << times[t].name << " s: " << mesh.triangles() << " triangles, "
                  << mesh.vertices() << " vertices, volume " << volume << " m3";
        if (filled > 0) std::cout << " (" << signedPercent(volume / filled - 1) << " against the particles' N d^3)";
        std::cout << write(formats, times[t], mesh, {filled, spacing, controls.conserveVolume && filled > 0, liquid, cleaned ? &*cleaned : nullptr}, parts) << std::endl;
        if (repeats > 0 && filled > 0) reportMeshTimes(surface, particles.span(), repeats);
        progress.update(double(t + 1) / double(times.size()));
        most = std::max(most, own.size());
    }
    reportMemory(parts, most);
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
        .summary = "Mesh the surface of the liquid by marching cubes.",
        .options =
        {
            deviceOption(),
            precisionOption(),
            parallelOption("meshSurface"),
            {"formats", "LIST", "File formats, of " + words + ", e.g. \"(ply stl)\" (default: those of system/meshSurfaceDict, or ply)", ""},
            {"repeats", "N", "Make each mesh N more times and print the time", "0"}
        }
    };
    for (const Option& option : timeSelectionOptions()) info.options.push_back(option);
    return runInParts(argc, argv, [&](const Communicator& parts)
    {
        return runApplication(argc, argv, info, [&](const Arguments& args) { meshSurface(args, parts); });
    });
}
