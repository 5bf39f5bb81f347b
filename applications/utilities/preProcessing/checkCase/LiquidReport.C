// SPDX-License-Identifier: GPL-3.0-or-later
#include "LiquidReport.H"

#include "drops/MotionWarnings.H"
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

std::vector<Vector3> toHost(const Buffer<Vec3>& field, double unit, int count)
{
    std::vector<Vector3> result;
    const auto values = field.download();
    for (int i = 0; i < count; ++i) result.push_back(unit * Vector3(values[i].x, values[i].y, values[i].z));
    return result;
}

// Of no liquid that is met in a laboratory: most likely in another unit.
void checkProperties(const LiquidProperties& p, Findings& findings)
{
    struct Range { const char* name; double value, least, most; const char* unit; const char* water; };
    const Range ranges[] =
    {
        {"sigma", p.surfaceTension, 1e-4, 2, "N/m", "0.0728"},      // liquids near their critical points, molten metals
        {"rho", p.density, 50, 25000, "kg/m3", "998"},              // liquid hydrogen, molten osmium
        {"nu", p.viscosity, 1e-8, 1e3, "m2/s", "1e-6"}              // superheated metals, pitch
    };
    for (const Range& range : ranges)
    {
        if (range.value == 0 || (range.value >= range.least && range.value <= range.most)) continue;
        std::ostringstream text;
        text << range.name << " is " << range.value << " " << range.unit << ": is that meant? Water has " << range.water << " " << range.unit
             << ", and no liquid less than " << range.least << " or more than " << range.most;
        findings.warn(text.str());
    }
}

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

void reportLiquid(const Liquid& liquid, const Models* models, Findings& findings)
{
    const double gravity = models ? models->bodyForce->acceleration() : std::numeric_limits<double>::quiet_NaN();
    const LiquidProperties& p = liquid.properties();
    const auto positions = liquid.positions();
    checkSpacing(positions, p.spacing, findings);
    checkProperties(p, findings);
    const auto velocities = toHost(liquid.velocity, liquid.units().of(dimensions::velocity), liquid.owned());
    const std::vector<SeparateBody> bodies = separateBodies(positions, velocities, p.spacing);
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
}

}
