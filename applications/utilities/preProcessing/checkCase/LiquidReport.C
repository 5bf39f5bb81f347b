// SPDX-License-Identifier: GPL-3.0-or-later
#include "LiquidReport.H"

#include "caseFiles/SolidParticles.H"
#include "drops/KnownFaults.H"
#include "drops/MotionWarnings.H"
#include "drops/SuspectNumbers.H"
#include "meshes/ConnectedPoints.H"

#include <algorithm>
#include <iostream>
#include <limits>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr std::size_t mostReported = 10;
constexpr double mostLiquidGap = 1.4;         // spacings

void checkSpacing(const std::vector<Vector3>& positions, double spacing, Findings& findings)
{
    const double gap = measureGaps(positions, 3 * spacing).mean / spacing;
    if (positions.size() < 2 || gap <= mostLiquidGap) return;
    std::ostringstream text;
    text << "The liquid's particles are " << gap << " spacings apart on average, not about 1: they were filled in at "
            "another spacing\n    run fillLiquid again";
    findings.error(text.str());
}

void report(const SeparateBody& body, std::size_t number, const LiquidProperties& p, double gravity)
{
    std::cout << "Body " << number << ": " << describe(body, p.spacing);
    const double diameter = body.diameter();
    const std::string numbers =
        describe(FlowScales{diameter, length(body.velocity), gravity, p.density, p.viscosity, p.surfaceTension});
    if (!numbers.empty()) std::cout << "    " << numbers << "\n";
}

}

void reportLiquid(const std::filesystem::path& casePath, const Liquid& liquid, const Models* models, Findings& findings)
{
    const double gravity = models ? models->bodyForce->acceleration() : std::numeric_limits<double>::quiet_NaN();
    const LiquidProperties& p = liquid.properties();
    const auto positions = liquid.positions();
    checkSpacing(positions, p.spacing, findings);
    const std::vector<SeparateBody> bodies = separateBodies(positions, liquid.velocities(), p.spacing);
    std::cout << "Liquid: " << liquid.owned() << " particles of spacing " << p.spacing << " m, volume "
              << liquid.owned() * p.particleVolume() << " m3, separate bodies " << bodies.size() << "\n";
    for (std::size_t i = 0; i < std::min(bodies.size(), mostReported); ++i) report(bodies[i], i + 1, p, gravity);
    if (bodies.size() > mostReported) std::cout << "and " << bodies.size() - mostReported << " smaller ones\n";
    if (models)
    {
        const FlowScales scales{0, 0, gravity, p.density, p.viscosity, p.surfaceTension};
        for (const std::string& warning : motionWarnings(models->dict.lookup<std::string>("viscosity"), bodies, scales)) findings.warn(warning);
    }
    for (const std::string& warning : resolutionWarnings(bodies, p.spacing)) findings.warn(warning);
    findings.attempt([&]
    {
        const SolidParticles solid = haveSolidParticles(casePath) ? readSolidParticles(casePath) : SolidParticles();
        const auto walls = readAnalyticSurfaces(Dictionary::read(casePath / "constant/walls"));
        for (const Suspect& suspect : suspectPlaces(casePath, bodies, walls, solid.positions)) findings.warn(suspect.text);
        for (const Suspect& suspect : knownFaults(casePath, solid, walls, positions, p.spacing)) findings.warn(suspect.text);
    });
}

}
