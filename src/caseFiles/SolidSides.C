// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/SolidSides.H"

#include <algorithm>

namespace shizuku
{

SolidSides::SolidSides(const SolidParticles& solid, double spacing) : solid_(solid), spacing_(spacing), nearest_(solid.positions) {}

SolidSides::Place SolidSides::operator()(const Vector3& x) const
{
    constexpr std::size_t around = 16;
    constexpr double farther = 0.75;                // spacings, than the nearest one
    constexpr double aside = 1, alsoAside = 1.3;    // spacings from a normal: of the nearest one, of others
    const auto height = [&](std::size_t k) { return dot(x - solid_.positions[k], solid_.normals[k]); };
    const auto isBeside = [&](std::size_t k, double most)
    {
        return squaredLength(x - solid_.positions[k]) - height(k)*height(k) >= most*most*spacing_*spacing_;
    };

    const std::size_t first = nearest_(x);
    const double distance = length(x - solid_.positions[first]);
    if (height(first) >= 0 || isBeside(first, aside)) return {first, distance, false};
    const std::vector<std::size_t> near = nearest_(x, std::min(around, solid_.positions.size()));
    const bool inFront = std::any_of(near.begin(), near.end(), [&](std::size_t k)
    {
        const bool counts = length(x - solid_.positions[k]) <= distance + farther*spacing_ && !isBeside(k, alsoAside);
        return counts && height(k) > 0.25*spacing_;
    });
    return {first, distance, !inFront};
}

}
