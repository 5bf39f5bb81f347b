// SPDX-License-Identifier: GPL-3.0-or-later
// Fills bodies with liquid particles: system/fillLiquidDict -> 0/liquid/{positions,U}.

#include "caseFiles/LiquidFiles.H"
#include "core/arguments/runApplication.H"
#include "core/fieldFile/AtomicFile.H"
#include "core/time/Time.H"
#include "drops/SuspectNumbers.H"
#include "liquidBodies/LiquidChecks.H"
#include "meshes/Bounds.H"

#include <algorithm>
#include <iostream>

using namespace shizuku;

namespace
{

const ApplicationInfo info
{
    "fillLiquid", "Fill bodies with liquid particles on a lattice (system/fillLiquidDict to 0/liquid).", {}
};

void report(const FilledBody& body, double spacing)
{
    const double volume = body.positions.size()*spacing*spacing*spacing, exact = body.shape->volume();
    std::cout << body.name << ": " << body.positions.size() << " particles, volume " << volume << " m3, of the shape "
              << exact << " m3 (" << std::showpos << 100*(volume/exact - 1) << std::noshowpos << " %), velocity "
              << str(body.velocity) << " m/s";
    if (body.angularVelocity != Vector3()) std::cout << ", angular velocity " << str(body.angularVelocity) << " rad/s";
    std::cout << "\n";
    if (const std::string text = body.shape->describe(); !text.empty()) std::cout << "    " << text << "\n";
    for (const std::string& line : body.leftOut) std::cout << "    left out " << line << "\n";
}

// As separateBodies() has them, by what was asked for: looking for neighbours would take longer than filling.
std::vector<SeparateBody> bodiesOf(const std::vector<FilledBody>& filled, double spacing)
{
    std::vector<SeparateBody> bodies;
    for (const FilledBody& each : filled)
    {
        const Bounds bounds = boundsOf(each.positions);
        SeparateBody body;
        body.low = bounds.low;
        body.high = bounds.high;
        body.volume = each.positions.size()*spacing*spacing*spacing;
        bodies.push_back(body);
    }
    std::sort(bodies.begin(), bodies.end(), [](const SeparateBody& a, const SeparateBody& b) { return a.volume > b.volume; });
    return bodies;
}

void run(const Arguments& args)
{
    const std::filesystem::path& casePath = args.casePath();
    const WriteFormat format = readControls(Dictionary::read(casePath/"system"/"controlDict")).format;
    const double spacing = readSpacing(casePath);
    std::vector<FilledBody> bodies = readBodies(Dictionary::read(casePath/"system"/"fillLiquidDict"), casePath, spacing);
    const std::vector<AnalyticSurface> walls = readAnalyticSurfaces(Dictionary::read(casePath/"constant"/"walls"));
    const std::optional<BoxSides> sides = BoxSides::read(casePath);
    const SolidParticles solid = haveSolidParticles(casePath) ? readSolidParticles(casePath) : SolidParticles();

    std::cout << "Particle spacing " << spacing << " m\n";
    warnOf(suspectEntries(casePath));
    for (FilledBody& body : bodies)
    {
        if (sides) keepBeforePlanes(body, *sides, spacing);
        keepOutOfWalls(body, walls, spacing);
    }
    keepOutOfSolid(bodies, solid, spacing);
    keepApart(bodies, spacing);
    for (const FilledBody& body : bodies) report(body, spacing);
    writeFolderAtomically(casePath/"0"/"liquid", [&](const std::filesystem::path& partial)
    {
        writeBodies(partial, bodies, spacing, format);
    });
    std::size_t count = 0;
    for (const FilledBody& body : bodies) count += body.positions.size();
    warnOf(suspectPlaces(casePath, bodiesOf(bodies, spacing), walls, solid.positions));
    std::cout << "Wrote 0/liquid: " << count << " particles\n";
    const std::vector<TimeFolder> times = timeFolders(casePath);
    if (times.back().value <= 0) return;
    warning
    (
        "The case has later times, up to " + times.back().name + " s, of other liquid: with startFrom latestTime a run goes on from there. "
        "Allclean removes them"
    );
}

}

int main(int argc, char** argv)
{
    return runApplication(argc, argv, info, run);
}
