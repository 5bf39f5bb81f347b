// SPDX-License-Identifier: GPL-3.0-or-later
// Puts solid particles onto the walls of type particles: constant/triSurface -> constant/solid.

#include "LoadSurface.H"
#include "caseFiles/SampledWall.H"
#include "core/arguments/runApplication.H"
#include "core/dictionary/CalcExpression.H"
#include "core/time/Controls.H"
#include "drops/KnownFaults.H"
#include "sampling/SeedMethod.H"
#include "sampling/SurfaceSampler.H"

#include <algorithm>
#include <iostream>

using namespace shizuku;

namespace
{

const ApplicationInfo info
{
    "sampleSurface", "Cover the surfaces of the walls with solid particles (constant/triSurface to constant/solid).",
    {}
};

// The solver's, with its support in spacings; the solver checks the support's range.
KernelChoice readKernel(const Dictionary& dict)
{
    const std::string type = dict.lookupChoiceOr("type", kernelWords(), CubicSpline::word);
    return makeKernel(type, float(dict.lookupOr("support", 2.0)));
}

// system/sampleSurfaceDict may be absent: every entry has a default.
SamplingParameters readParameters(const std::filesystem::path& casePath)
{
    SamplingParameters parameters;
    const Dictionary solution = Dictionary::read(casePath/"system"/"solution");
    parameters.spacing = solution.lookupPositive("spacing", dimensions::length);
    parameters.kernel = readKernel(solution.subDictOrEmpty("kernel"));
    const std::filesystem::path file = casePath/"system"/"sampleSurfaceDict";
    if (std::filesystem::exists(file))
    {
        const Dictionary dict = Dictionary::read(file);
        parameters.method = dict.lookupChoiceOr("method", SeedMethodTable::words(), parameters.method);
        parameters.offset = dict.lookupOr("offset", parameters.offset);
        parameters.iterations = dict.lookupOr("iterations", parameters.iterations);
        if (parameters.iterations < 0)
        {
            throw FatalInputError(dict.where("iterations"), "A negative number of iterations", "0 or more");
        }
        if (!(std::abs(parameters.offset) <= 1))
        {
            throw FatalInputError
            (
                dict.where("offset"), "The offset is " + numberText(parameters.offset) + " spacings",
                "spacings along the normal, -1 to 1, -0.5 as a rule"
            );
        }
        dict.refuseUnused();
    }
    return parameters;
}

void report(const std::string& wall, const LayerQuality& quality, double spacing)
{
    const double cube = spacing*spacing*spacing;
    std::cout
        << wall << ": " << quality.count << " particles\n"
        << "    minimal gap        " << quality.minGap/spacing << " spacings\n"
        << "    mean gap           " << quality.meanGap/spacing << " spacings\n"
        << "    maximal gap        " << quality.maxGap/spacing << " spacings\n"
        << "    largest hole       " << quality.largestHole/spacing << " spacings\n"
        << "    virtual volumes    " << quality.minVolume/cube << " to " << quality.maxVolume/cube << ", mean "
        << quality.meanVolume/cube << " cubic spacings\n";
    if (quality.wallDensity == 0)
    {
        std::cout << "    wall density       not measured: no place is a support away from open borders\n";
        return;
    }
    std::cout
        << "    wall density       " << quality.wallDensity << " of the liquid's, half a spacing outside\n"
        << "    density variation  " << 100*quality.densityVariation << " %\n";
}

// Most scenes have no liquid in them: checkCase and the solver warn of those that have.
void reportGrooves(const SolidParticles& layer, double spacing)
{
    const std::string places = describeGrooves(layer, spacing);
    if (places.empty()) return;
    std::cout << "    narrow grooves     " << places << "\n"
              << "                       Where liquid is in them, round them by two spacings: they can keep single particles moving (doc/guide/limits.md)\n";
}

// Contact angles are given by the name of a patch, so a name must mean one patch.
void refuseSharedPatches(const SolidParticles& solid, const SolidParticles& added, const SampledWall& wall)
{
    for (const std::string& name : added.patches)
    {
        if (std::find(solid.patches.begin(), solid.patches.end(), name) == solid.patches.end()) continue;
        throw FatalInputError
        (
            wall.where, "The patch '" + name + "' of wall '" + wall.name + "' is a patch of an earlier wall too",
            "another name behind `solid` in " + wall.file.string()
        );
    }
}

void run(const Arguments& args)
{
    const WriteFormat format = readControls(Dictionary::read(args.casePath()/"system"/"controlDict")).format;
    const SamplingParameters parameters = readParameters(args.casePath());
    const std::vector<SampledWall> walls = readSampledWalls(args.casePath());
    if (walls.empty())
    {
        std::cout << "No wall in constant/walls is of type particles: there is nothing to sample\n";
        return;
    }

    SolidParticles solid;
    for (const SampledWall& wall : walls)
    {
        const RepairedSurface surface = loadSurface(wall, parameters.spacing);
        const SampledSurface sampled = sampleSurface(surface.surface, parameters, "Sampling " + wall.file.filename().string());
        report(wall.name, sampled.quality, parameters.spacing);
        reportGrooves(sampled.particles, parameters.spacing);
        refuseSharedPatches(solid, sampled.particles, wall);
        solid.append(sampled.particles);
        solid.marks.push_back(SurfaceMark::of(wall));
        solid.marks.back().patches = sampled.particles.patches;
        solid.marks.back().form = surface.closed ? "closed" : surface.branches ? "branching" : "open";
    }
    writeSolidParticles(args.casePath(), solid, format);
    std::cout << "Wrote constant/solid: " << solid.positions.size() << " particles\n";
}

}

int main(int argc, char** argv)
{
    return runApplication(argc, argv, info, run);
}
