#include "LiquidReport.H"

#include "geometry/ConnectedPoints.H"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr double reach = 1.5;               // spacings between particles of one body
constexpr std::size_t mostReported = 10;
constexpr double coarse = 5;                // spacings a radius
constexpr double thin = 3;                  // spacings
constexpr double leastMeanGap = 0.6, mostMeanGap = 1.4;     // spacings; liquid that moves is nearer than its lattice

struct Body
{
    std::size_t particles = 0;
    Vector3 size;                           // m, of the box around it
    Vector3 velocity;                       // m/s, mean
};

std::vector<Vector3> toHost(const Buffer<Vec3>& field, double unit, int count)
{
    std::vector<Vector3> result;
    const auto values = field.download();
    for (int i = 0; i < count; ++i) result.push_back(unit * Vector3(values[i].x, values[i].y, values[i].z));
    return result;
}

void checkSpacing(const std::vector<Vector3>& positions, double spacing, Findings& findings)
{
    const double gap = measureGaps(positions, 3 * spacing).mean / spacing;
    if (positions.size() < 2 || (gap >= leastMeanGap && gap <= mostMeanGap)) return;
    std::ostringstream text;
    text << "The liquid's particles are " << gap << " spacings apart on average, not about 1: they were filled in at "
            "another spacing\n    run fillLiquid again";
    findings.error(text.str());
}

std::vector<Body> bodiesOf(const Liquid& liquid, const std::vector<Vector3>& positions)
{
    const double spacing = liquid.properties().spacing;
    const auto velocities = toHost(liquid.velocity, liquid.units().of(dimensions::velocity), liquid.owned());
    std::vector<Body> bodies;
    for (const std::vector<int>& group : connectedPoints(positions, reach * spacing))
    {
        Body body{group.size(), {}, {}};
        Vector3 low = positions[group.front()], high = low;
        for (const int i : group)
        {
            body.velocity += velocities[i] / double(group.size());
            for (int c = 0; c < 3; ++c)
            {
                low[c] = std::min(low[c], positions[i][c]);
                high[c] = std::max(high[c], positions[i][c]);
            }
        }
        body.size = high - low + Vector3(spacing, spacing, spacing);
        bodies.push_back(body);
    }
    return bodies;
}

void report(const Body& body, std::size_t number, const LiquidProperties& p, double gravity, Findings& findings)
{
    const double volume = body.particles * p.particleVolume();
    const double diameter = std::cbrt(6 * volume / std::numbers::pi);
    const Vector3 spacings = body.size / p.spacing;
    const double U = length(body.velocity);
    std::cout << "Body " << number << ": " << body.particles << " particles, volume " << volume << " m3\n"
              << "    size " << str(body.size) << " m, " << str(spacings) << " spacings\n"
              << "    sphere of its volume: diameter D " << diameter << " m, " << diameter / (2 * p.spacing)
              << " spacings a radius\n"
              << "    mean velocity " << str(body.velocity) << " m/s\n";
    if (p.surfaceTension > 0)
    {
        const double capillary = p.density * diameter / p.surfaceTension;
        std::cout << "    Bond number rho g D^2/sigma " << capillary * gravity * diameter
                  << ", Weber number rho U^2 D/sigma " << capillary * U * U;
        if (p.viscosity > 0)
        {
            std::cout << ", Ohnesorge number nu sqrt(rho/(sigma D)) " << p.viscosity / diameter * std::sqrt(capillary);
        }
        std::cout << "\n";
    }
    if (p.viscosity > 0) std::cout << "    Reynolds number U D/nu " << U * diameter / p.viscosity << "\n";

    const std::string name = "body " + std::to_string(number);
    if (diameter < 2 * coarse * p.spacing)
    {
        findings.warn(name + " is coarse, less than 5 spacings a radius: a smaller spacing in system/solution resolves it");
    }
    if (std::min({spacings.x, spacings.y, spacings.z}) < thin)
    {
        findings.warn(name + " is thin, less than 3 spacings: a film is not resolved");
    }
}

}

void reportLiquid(const Liquid& liquid, double gravity, Findings& findings)
{
    const LiquidProperties& p = liquid.properties();
    const auto positions = toHost(liquid.position, liquid.units().length, liquid.owned());
    checkSpacing(positions, p.spacing, findings);
    const std::vector<Body> bodies = bodiesOf(liquid, positions);
    std::cout << "Liquid: " << liquid.owned() << " particles of spacing " << p.spacing << " m, volume "
              << liquid.owned() * p.particleVolume() << " m3, separate bodies " << bodies.size() << "\n";
    for (std::size_t i = 0; i < std::min(bodies.size(), mostReported); ++i) report(bodies[i], i + 1, p, gravity, findings);
    if (bodies.size() > mostReported) std::cout << "and " << bodies.size() - mostReported << " smaller ones\n";
}

}
