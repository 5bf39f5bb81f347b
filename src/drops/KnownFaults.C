// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/KnownFaults.H"

#include "caseFiles/CaseGravity.H"
#include "core/paths/Existence.H"
#include "meshes/PointGrid.H"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr double reach = 1.3;               // spacings between the particles of two sides
constexpr double narrow = -0.35;            // cosine of 110 degrees: of a groove's sides, which opens by 70 degrees
constexpr double filled = 1;                // spacings from a place in liquid to the nearest of its particles: 0.87 in a lattice
constexpr std::size_t enough = 3;           // particles: fewer are chance in a layer that is bent

// apart: from the other particle.
bool isGroove(const Vector3& apart, const Vector3& normal, const Vector3& otherNormal)
{
    return dot(normal, otherNormal) < narrow && dot(apart, normal - otherNormal) < 0;
}

// Is there liquid between both sides?
class Surroundings
{
public:
    Surroundings(const SolidParticles& solid, const std::vector<Vector3>& liquid, double spacing)
    : solid_(solid), liquid_(spacing, liquid), spacing_(spacing)
    {}

    bool hold(const GroovePair& place) const
    {
        constexpr double far = 2;               // spacings, out of the corner of the surface
        const Vector3 between = solid_.normals[place.particle] + solid_.normals[place.other];
        if (squaredLength(between) == 0) return false;
        return liquid_.anyWithin(solid_.positions[place.particle] + far*spacing_*normalized(between), filled*spacing_);
    }

private:
    const SolidParticles& solid_;
    PointGrid liquid_;
    double spacing_;
};

std::string placesOf(std::size_t count, const Vector3& first)
{
    std::ostringstream text;
    text << count << " solid particles, the first at " << str(first) << " m";
    return text.str();
}

// 'a', 'b', 'c' and 4 more
std::string namesOf(const std::vector<std::string>& names)
{
    constexpr std::size_t most = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i) text += (i > 0 ? ", '" : "'") + names[i] + "'";
    return names.size() > most ? text + " and " + std::to_string(names.size() - most) + " more" : text;
}

// Liquid within a spacing of two neighbouring sides of the box.
bool isInEdge(const Vector3& x, const AnalyticSurface& box, int up, double spacing)
{
    int sides = 0;
    for (int c = 0; c < 3; ++c)
    {
        if (c != up) sides += std::min(x[c] - box.min[c], box.max[c] - x[c]) < spacing;
    }
    return sides == 2;
}

bool hasTension(const std::filesystem::path& casePath)
{
    const auto file = casePath/"constant/models";
    return isThere(file) && Dictionary::read(file).lookupOr<std::string>("surfaceTension", "none") != "none";
}

void lookAtGrooves
(
    const std::filesystem::path& casePath, const SolidParticles& solid, const std::vector<Vector3>& liquid, double spacing, std::vector<Suspect>& suspects
)
{
    const std::vector<GroovePair> places = findGrooves(solid, spacing);
    if (places.empty() || liquid.empty()) return;
    const Surroundings around(solid, liquid, spacing);
    std::vector<std::size_t> wet;
    std::set<int> patches;
    for (const GroovePair& place : places)
    {
        if (!around.hold(place)) continue;
        wet.push_back(place.particle);
        patches.insert(solid.patch[place.particle]);
    }
    if (wet.size() < enough) return;
    std::vector<std::string> names;
    for (const int patch : patches) names.push_back(solid.patches[patch]);
    suspects.push_back
    ({
        "The liquid is in narrow grooves of " + namesOf(names) + " (" + placesOf(wet.size(), solid.positions[wet.front()]) + "). Known fault: they can keep single particles moving\n"
        "    Expected: grooves rounded by two spacings or more (doc/guide/limits.md)",
        {(casePath/"constant/walls").string(), 0}
    });
}

void lookAtCorners
(
    const std::filesystem::path& casePath, const std::vector<AnalyticSurface>& walls, const std::vector<Vector3>& liquid, double spacing, std::vector<Suspect>& suspects
)
{
    const Vector3 gravity = caseGravity(casePath);
    int up = -1;
    for (int c = 0; c < 3; ++c)
    {
        if (std::abs(gravity[c]) > 0.9*length(gravity)) up = c;
    }
    if (up < 0) return;
    const auto file = casePath/"constant/walls";
    for (const AnalyticSurface& wall : walls)
    {
        if (wall.type != AnalyticSurface::Type::box) continue;
        const auto isIn = [&](const Vector3& x) { return isInEdge(x, wall, up, spacing); };
        if (std::none_of(liquid.begin(), liquid.end(), isIn)) continue;
        suspects.push_back
        ({
            "The liquid stands in the vertical edges of the box '" + wall.name + "'. Known fault: single particles hang there, up to two spacings above the surface\n"
            "    Expected: levels measured two spacings away from these edges (doc/guide/limits.md)",
            isThere(file) ? Dictionary::read(file).where(wall.name) : SourceLocation{file.string(), 0}
        });
    }
}

}

std::vector<GroovePair> findGrooves(const SolidParticles& solid, double spacing)
{
    std::vector<GroovePair> places;
    const PointGrid grid(reach*spacing, solid.positions);
    for (std::size_t i = 0; i < solid.positions.size(); ++i)
    {
        std::optional<GroovePair> found;
        grid.forEachWithin(solid.positions[i], reach*spacing, [&](int j, double)
        {
            if (!found && isGroove(solid.positions[i] - solid.positions[j], solid.normals[i], solid.normals[j])) found = GroovePair{i, std::size_t(j)};
        });
        if (found) places.push_back(*found);
    }
    return places;
}

std::string describeGrooves(const SolidParticles& solid, double spacing)
{
    const std::vector<GroovePair> places = findGrooves(solid, spacing);
    if (places.size() < enough) return "";
    return placesOf(places.size(), solid.positions[places.front().particle]);
}

std::vector<Suspect> knownFaults
(
    const std::filesystem::path& casePath, const SolidParticles& solid, const std::vector<AnalyticSurface>& walls, const std::vector<Vector3>& liquid, double spacing
)
{
    std::vector<Suspect> suspects;
    if (!hasTension(casePath)) return suspects;
    lookAtGrooves(casePath, solid, liquid, spacing, suspects);
    lookAtCorners(casePath, walls, liquid, spacing, suspects);
    return suspects;
}

}
