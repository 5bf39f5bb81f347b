// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/SeparateBodies.H"

#include "core/angles/Degrees.H"
#include "meshes/Bounds.H"
#include "meshes/ConnectedPoints.H"

#include <algorithm>
#include <numbers>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr double coarse = 5;                // spacings a radius
constexpr double thin = 3;                  // spacings
constexpr std::size_t mostWarnings = 10;

double radiusOf(const SeparateBody& body, double spacing) { return body.diameter()/(2*spacing); }

bool isCoarse(const SeparateBody& body, double spacing) { return radiusOf(body, spacing) < coarse; }

// others: how many smaller bodies there are.
std::string coarseWarning(const SeparateBody& body, double spacing, std::size_t others)
{
    std::ostringstream text;
    text << "is coarse, " << radiusOf(body, spacing) << " spacings a radius, less than " << coarse;
    if (others == 1) text << ", as is the smaller one";
    if (others > 1) text << ", as are the " << others << " smaller ones";
    text << ": contact angles of such drops are 4 degrees off at 300 particles, 28 at 50";
    return text.str();
}

// Empty where it is as thick as it should be.
std::string thinWarning(const SeparateBody& body, double spacing)
{
    const Vector3 size = body.size();
    const double thickness = std::min({size.x, size.y, size.z})/spacing;
    if (thickness >= thin) return {};
    std::ostringstream text;
    text << "is thin, " << thickness << " spacings, less than " << thin << ": a film is not resolved";
    return text.str();
}

}

double diameterOf(double volume) { return std::cbrt(6*volume/std::numbers::pi); }

std::vector<SeparateBody> separateBodies
(
    const std::vector<Vector3>& positions, const std::vector<Vector3>& velocities, double spacing
)
{
    const Vector3 half = 0.5*Vector3(spacing, spacing, spacing);
    std::vector<SeparateBody> bodies;
    for (std::vector<int>& group : connectedPoints(positions, bodyReach*spacing))
    {
        SeparateBody body;
        body.volume = double(group.size())*spacing*spacing*spacing;
        Bounds bounds;
        Vector3 centre, spin;
        for (const int i : group)
        {
            body.velocity += velocities[i]/double(group.size());
            centre += positions[i]/double(group.size());
            bounds.add(positions[i]);
        }
        double moment = 0;
        for (const int i : group)
        {
            const Vector3 arm = positions[i] - centre;
            spin += cross(arm, velocities[i] - body.velocity);
            moment += 2*squaredLength(arm)/3;
        }
        if (moment > 0) body.angularVelocity = spin/moment;
        body.low = bounds.low - half;
        body.high = bounds.high + half;
        body.particles = std::move(group);
        bodies.push_back(std::move(body));
    }
    return bodies;
}

std::vector<std::string> resolutionWarnings(const std::vector<SeparateBody>& bodies, double spacing)
{
    std::vector<std::string> warnings;
    for (std::size_t i = 0; i < bodies.size() && warnings.size() < mostWarnings; ++i)
    {
        const bool areCoarse = isCoarse(bodies[i], spacing);            // this one and all that follow, which are smaller
        const std::string warning = areCoarse ? coarseWarning(bodies[i], spacing, bodies.size() - i - 1) : thinWarning(bodies[i], spacing);
        if (warning.empty()) continue;
        warnings.push_back
        (
            "body " + std::to_string(i + 1) + " of " + std::to_string(bodies.size()) + ", "
          + std::to_string(bodies[i].particles.size()) + " particles, " + warning
          + "; a smaller spacing in system/solution resolves it"
        );
        if (areCoarse) break;
    }
    return warnings;
}

std::string puddleWarning(double capillaryLength, double theta, double spacing)
{
    const double height = 2*capillaryLength*std::sin(radians(theta)/2);
    if (!(height > 0) || height >= thin*spacing) return {};
    std::ostringstream text;
    text << "the weight of the liquid flattens it on the wall to " << height/spacing << " spacings or less, the height "
         << height << " m of a puddle at " << theta << " degrees, less than " << thin
         << ": such layers are noisy, or break up; a spacing below " << height/thin << " m in system/solution resolves it";
    return text.str();
}

std::string describe(const SeparateBody& body, double spacing)
{
    const double diameter = body.diameter();
    std::ostringstream text;
    text << body.particles.size() << " particles, volume " << body.volume << " m3\n"
         << "    size " << str(body.size()) << " m, " << str(body.size()/spacing) << " spacings\n"
         << "    sphere of its volume: diameter D " << diameter << " m, " << diameter/(2*spacing) << " spacings a radius\n"
         << "    mean velocity " << str(body.velocity) << " m/s\n";
    return text.str();
}

}
