// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquidBodies/LiquidChecks.H"

#include "caseFiles/SolidSides.H"
#include "liquidBodies/CloseBoxes.H"
#include "meshes/PointGrid.H"

#include <algorithm>
#include <functional>
#include <optional>
#include <set>

namespace shizuku
{

namespace
{

constexpr double wallDistance = 0.4;                // spacings: the rows of a box may be that much narrower than one
constexpr double solidDistance = 0.9;               // spacings
constexpr double liquidDistance = 0.5*(1 - 1e-6);   // spacings; bodies that touch are there but for rounding

// Refuses the body, or notes what is left out of it: `count` of its particles, `first` before the others.
void giveWay
(
    FilledBody& body, std::size_t count, std::size_t present, const Vector3& first, const std::string& what,
    const std::string& expected
)
{
    const std::string number = std::to_string(count);
    if (!body.carve || count == present)
    {
        throw FatalInputError
        (
            body.where,
            what + ": " + number + " of the " + std::to_string(present) + " particles of the body '" + body.name
                + "', the first one at " + str(first) + " m",
            expected + (body.carve ? "" : "; or `overlaps carve;`, which leaves them out")
        );
    }
    body.leftOut.push_back(number + " particles: " + what);
}

// Refuses or leaves out the particles of the body for which bad(index) is true.
void keepOut
(
    FilledBody& body, const std::string& what, const std::string& expected, const std::function<bool(std::size_t)>& bad
)
{
    const std::size_t count = body.positions.size();
    std::size_t first = 0;
    while (first < count && !bad(first)) ++first;
    if (first == count) return;
    std::vector<Vector3> good(body.positions.begin(), body.positions.begin() + first);
    for (std::size_t i = first + 1; i < count; ++i) if (!bad(i)) good.push_back(body.positions[i]);
    giveWay(body, count - good.size(), count, body.positions[first], what, expected);
    body.positions = std::move(good);
}

// A body among others. Its particles are looked up by place, once another body is near; those that give way are marked,
// and go when all bodies have been compared.
class NearBody
{
public:
    NearBody(FilledBody& body, double spacing) : body_(body), spacing_(spacing) {}

    // The box around its shape and its particles, half a spacing wider: outside of it nothing is in its way.
    Bounds box() const
    {
        Bounds bounds = boundsOf(body_.positions);
        const Vector3 low = body_.shape->low(), high = body_.shape->high();
        const BodyFrame frame = body_.shape->frame();
        for (const double x : {low.x, high.x}) for (const double y : {low.y, high.y}) for (const double z : {low.z, high.z})
        {
            bounds.add(frame.origin + x*frame.x + y*frame.y + z*frame.z);
        }
        const Vector3 reach = 0.5*spacing_*Vector3(1, 1, 1);
        return {bounds.low - reach, bounds.high + reach};
    }

    bool carves() const { return body_.carve; }

    // Refuses or marks its particles within `region` that are in the way of the other body.
    void giveWayTo(NearBody& other, const Bounds& region)
    {
        std::vector<int> inTheWay;
        grid().forEachInBox(region.low, region.high, [&](int i)
        {
            if (!gone_[i] && other.occupies(body_.positions[i])) inTheWay.push_back(i);
        });
        if (inTheWay.empty()) return;
        giveWay
        (
            body_, inTheWay.size(), present_, body_.positions[*std::min_element(inTheWay.begin(), inTheWay.end())],
            "Liquid inside of other liquid, the body '" + other.body_.name + "'",
            "bodies that do not overlap, and whose particles are at least half a spacing apart"
        );
        for (const int i : inTheWay) gone_[i] = true;
        present_ -= inTheWay.size();
    }

    void removeMarked()
    {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < gone_.size(); ++i) if (!gone_[i]) body_.positions[kept++] = body_.positions[i];
        if (!gone_.empty()) body_.positions.resize(kept);
    }

private:
    bool occupies(const Vector3& x)
    {
        if (body_.shape->contains(x)) return true;
        bool near = false;
        grid().forEachWithin(x, liquidDistance*spacing_, [&](int i, double) { near = near || !gone_[i]; });
        return near;
    }

    const PointGrid& grid()
    {
        if (!grid_)
        {
            grid_.emplace(spacing_, body_.positions);
            present_ = body_.positions.size();
            gone_.resize(present_);
        }
        return *grid_;
    }

    FilledBody& body_;
    double spacing_;
    std::optional<PointGrid> grid_;
    std::vector<bool> gone_;
    std::size_t present_ = 0;
};

Bounds common(const Bounds& a, const Bounds& b)
{
    Bounds result;
    for (int c = 0; c < 3; ++c)
    {
        result.low[c] = std::max(a.low[c], b.low[c]);
        result.high[c] = std::min(a.high[c], b.high[c]);
    }
    return result;
}

}

void keepOutOfWalls(FilledBody& body, const std::vector<AnalyticSurface>& walls, double spacing)
{
    for (const AnalyticSurface& wall : walls)
    {
        keepOut
        (
            body, "Liquid inside a solid, the " + typeName(wall.type) + " '" + wall.name + "'",
            "particles on the liquid's side, about half a spacing from the wall",
            [&](std::size_t i) { return wall.signedDistance(body.positions[i]) < wallDistance*spacing; }
        );
    }
}

void keepBeforePlanes(FilledBody& body, const BoxSides& sides, double spacing)
{
    for (int k = 0; k < 3; ++k)
    {
        for (const bool upper : {false, true})
        {
            if (sides.kind[k][upper] != BoxSides::Kind::symmetryPlane) continue;
            const double at = sides.at[k][upper], sign = upper ? -1 : 1;
            keepOut
            (
                body, "Liquid behind the symmetry plane " + BoxSides::name(k, upper),
                "particles before the plane, about half a spacing from it, as those of a body have that has its origin on it",
                [&](std::size_t i) { return sign*(body.positions[i][k] - at) < wallDistance*spacing; }
            );
        }
    }
}

void keepOutOfSolid(std::span<FilledBody> bodies, const SolidParticles& solid, double spacing)
{
    if (solid.positions.empty()) return;
    SolidSides sides(solid, spacing);
    for (FilledBody& body : bodies)
    {
        std::vector<int> patches;       // one a particle
        for (const Vector3& x : body.positions) patches.push_back(sides.patchInTheWay(x, solidDistance*spacing).value_or(-1));
        std::set<int> met(patches.begin(), patches.end());
        met.erase(-1);
        for (const int patch : met)
        {
            keepOut
            (
                body, "Liquid inside a solid, the wall '" + solid.patches[patch] + "'",
                "particles in front of the faces of the wall's surface, at least 0.9 spacings from its particles; where all liquid is behind them, `flip yes;` in constant/walls turns the faces, and sampleSurface is run again",
                [&](std::size_t i) { return patches[i] == patch; }
            );
            std::erase(patches, patch);
        }
    }
}

void keepApart(std::vector<FilledBody>& bodies, double spacing)
{
    std::vector<NearBody> all;
    std::vector<Bounds> boxes;
    for (FilledBody& body : bodies)
    {
        all.emplace_back(body, spacing);
        boxes.push_back(all.back().box());
    }
    const std::vector<std::vector<std::size_t>> earlierOnes = earlierBoxesThatMeet(boxes);
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        NearBody& later = all[i];
        for (const std::size_t j : earlierOnes[i])
        {
            NearBody& earlier = all[j];
            const Bounds region = common(boxes[i], boxes[j]);
            if (later.carves() || !earlier.carves()) later.giveWayTo(earlier, region);
            if (!later.carves()) earlier.giveWayTo(later, region);
        }
    }
    for (NearBody& body : all) body.removeMarked();
}

}
