// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/SolidSides.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

constexpr std::array<double, 3> edges{64, 16, 4};       // of cells, in spacings

}

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

std::optional<int> SolidSides::patchInTheWay(const Vector3& x, double least)
{
    for (std::size_t k = 0; k < edges.size(); ++k)
    {
        if (const Cell& cell = cellOf(x, edges[k]*spacing_, cells_[k]); cell.free) return cell.patch;
    }
    const Place place = (*this)(x);
    if (place.behind || place.distance < least) return int(solid_.patch[place.nearest]);
    return {};
}

// edge: m.
const SolidSides::Cell& SolidSides::cellOf(const Vector3& x, double edge, Cells& cells) const
{
    constexpr double reach = 1.5;           // spacings; a way between two places farther than that from all particles does not cross their layer
    constexpr std::uint64_t bits = 21, mask = (1 << bits) - 1;
    Vector3 middle;
    std::uint64_t key = 0;
    for (int c = 0; c < 3; ++c)
    {
        const double cell = std::floor(x[c]/edge);
        middle[c] = (cell + 0.5)*edge;
        key = key << bits | (std::uint64_t(std::int64_t(cell)) & mask);
    }
    const auto [at, isNew] = cells.try_emplace(key);
    if (isNew)
    {
        const Place place = (*this)(middle);
        // Behind a layer's border a cell may have two sides: there the narrowest are asked alone.
        const bool inFront = dot(middle - solid_.positions[place.nearest], solid_.normals[place.nearest]) >= 0;
        at->second.free = place.distance > 0.5*std::sqrt(3)*edge + reach*spacing_ && (inFront || edge <= edges.back()*spacing_);
        if (place.behind) at->second.patch = int(solid_.patch[place.nearest]);
    }
    return at->second;
}

}
