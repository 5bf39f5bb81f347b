// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/ThinSolid.H"

#include "core/angles/Degrees.H"
#include "device/HostThreads.H"
#include "meshes/ConnectedPoints.H"
#include "meshes/PointGrid.H"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shizuku
{

namespace
{

// A place of the surface, and the side that is nearest behind it.
struct BackedPlace
{
    SurfacePoint place;
    Vector3 normal, normalBehind;
    double thickness;                           // m
};

// Calls take(place) for places all over the surface that have another side behind them, nearer than `reach` [m].
template<class Take>
void forEachBackedPlace(const SurfaceGeometry& surface, const SurfaceDistance& distance, double spacing, double reach, const Take& take)
{
    constexpr double resolution = 0.6;          // spacings between the places that are looked at
    constexpr double same = 0.3;                // spacings: of many slivers beside each other one is enough
    constexpr double sameCosine = 0.996;        // of five degrees
    constexpr double size = 8;                  // spacings
    constexpr std::size_t share = 16, together = 128*share;     // pieces of that size: of a thread at a time, of a batch

    const std::vector<SurfacePiece> pieces = surface.pieces(size*spacing);
    const auto placesOf = [&](std::size_t begin)
    {
        std::vector<SurfacePoint> places;
        for (std::size_t i = begin; i < std::min(begin + share, pieces.size()); ++i)
        {
            searchPiece(pieces[i], resolution*spacing, [&](const SurfacePoint& place, double radius)
            {
                if (radius > resolution*spacing) return true;
                places.push_back(place);
                return false;
            });
        }
        return places;
    };

    PointGrid seen(4*same*spacing);
    std::vector<const Vector3*> normals;
    const auto isSeen = [&](const SurfacePoint& place)
    {
        const Vector3& normal = surface.faceNormal(place.face);
        bool known = false;
        seen.forEachWithin(place.position, same*spacing, [&](int i, double) { known |= dot(*normals[i], normal) > sameCosine; });
        if (known) return true;
        seen.insert(place.position);
        normals.push_back(&normal);
        return false;
    };

    const auto backed = [&](const std::vector<SurfacePoint>& places)
    {
        std::vector<BackedPlace> found;
        for (const SurfacePoint& place : places)
        {
            const Vector3& normal = surface.faceNormal(place.face);
            const auto behind = distance.behind(place.position, -normal, 1e-3*spacing, reach);
            if (behind) found.push_back({place, normal, surface.faceNormal(behind->face), behind->distance});
        }
        return found;
    };

    // Batches in their order. While one thread leaves out what is seen already in one, the others find the places of the next, and look behind those of the one before.
    using Batch = std::vector<std::vector<SurfacePoint>>;
    constexpr std::size_t groups = together/share;
    const std::size_t batches = (pieces.size() + together - 1)/together;
    Batch next(groups), current, last;
    for (std::size_t batch = 0; batch < batches + 2; ++batch)
    {
        std::vector<std::vector<BackedPlace>> found(last.size());
        forEachPart(1 + groups, [&](std::size_t part)
        {
            if (part == 0)
            {
                for (std::vector<SurfacePoint>& places : current) std::erase_if(places, isSeen);
                return;
            }
            const std::size_t group = part - 1;
            if (batch < batches) next[group] = placesOf(batch*together + group*share);
            if (group < last.size()) found[group] = backed(last[group]);
        });
        for (const std::vector<BackedPlace>& some : found)
        {
            for (const BackedPlace& place : some) take(place);
        }
        last = std::move(current);
        current = batch < batches ? std::exchange(next, Batch(groups)) : Batch();
    }
}

// Of places that belong to one edge or tip: whether it is a tip. Along an edge the sides look across it; round a tip they look everywhere.
bool isTip(const std::vector<BackedPlace>& places, const std::vector<int>& group, double near)
{
    constexpr double across = 0.5;
    return std::any_of(group.begin(), group.end(), [&](int i)
    {
        const Vector3 edge = normalized(cross(places[i].normal, places[i].normalBehind));
        return std::any_of(group.begin(), group.end(), [&](int j)
        {
            return length(places[i].place.position - places[j].place.position) < near && std::abs(dot(places[j].normal, edge)) > across;
        });
    });
}

// Nothing where the sides look everywhere, as along the rim of a lens.
std::optional<Tip> tipOf(const SurfaceGeometry& surface, const std::vector<BackedPlace>& places, const std::vector<int>& group, double near)
{
    constexpr double alike = 0.7;               // length of the mean direction
    Vector3 sum;
    for (const int i : group) sum += normalized(places[i].normal + places[i].normalBehind);
    if (length(sum) < alike*double(group.size())) return {};
    Tip tip{places[group.front()].place.position, normalized(sum)};
    for (const int i : group)
    {
        for (const Vector3& corner : surface.corners(places[i].place.face))
        {
            if (length(corner - places[i].place.position) < near && dot(corner - tip.position, tip.axis) > 0) tip.position = corner;
        }
    }
    return tip;
}

}

NarrowPlaces findNarrowPlaces(const PatchedSurface& surface, double spacing)
{
    constexpr double opposite = -0.867;         // cosine of 150 degrees: edges below 30 degrees are thin too, and throw liquid
    constexpr double enough = 1 - 1e-3;         // of the least thickness: two spacings that were rounded are two
    NarrowPlaces found;
    forEachBackedPlace(SurfaceGeometry(surface), SurfaceDistance(surface.mesh), spacing, enough*leastThickness*spacing, [&](const BackedPlace& at)
    {
        const double cosine = dot(at.normal, at.normalBehind);
        if (cosine <= opposite)
        {
            if (!found.thin || at.thickness < found.thin->thickness) found.thin = ThinPlace{at.place.position, at.thickness};
            return;
        }
        const double angle = degrees(std::acos(-cosine));
        if (angle < (found.sharp ? found.sharp->angle : sharpest)) found.sharp = SharpPlace{at.place.position, angle};
    });
    return found;
}

std::vector<Tip> findTips(const SurfaceGeometry& surface, const SurfaceDistance& distance, double spacing)
{
    constexpr double opposite = -0.342;         // cosine of 110 degrees
    constexpr double thin = 1.5, near = 4;      // spacings; near: the tip of a cone of 30 degrees, where it is thin
    constexpr std::size_t most = 1000;          // places: more are of a long edge
    std::vector<BackedPlace> places;
    std::vector<Vector3> positions;
    forEachBackedPlace(surface, distance, spacing, thin*spacing, [&](const BackedPlace& at)
    {
        if (dot(at.normal, at.normalBehind) > opposite) return;
        if (squaredLength(cross(at.normal, at.normalBehind)) < 1e-6) return;
        places.push_back(at);
        positions.push_back(at.place.position);
    });
    std::vector<Tip> tips;
    for (const std::vector<int>& group : connectedPoints(positions, spacing))
    {
        if (group.size() > most || !isTip(places, group, thin*spacing)) continue;
        if (const auto tip = tipOf(surface, places, group, near*spacing)) tips.push_back(*tip);
    }
    return tips;
}

}
