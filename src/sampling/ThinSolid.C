// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/ThinSolid.H"

#include "core/angles/Degrees.H"
#include "device/HostThreads.H"
#include "meshes/ConnectedPoints.H"
#include "meshes/PointGrid.H"

#include <algorithm>
#include <cmath>
#include <span>

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

// Places all over some pieces, in their order, as all threads find them.
std::vector<SurfacePoint> placesOn(std::span<const SurfacePiece> pieces, double resolution)
{
    std::vector<std::vector<SurfacePoint>> ofPiece(pieces.size());
    forEachInParallel
    (
        pieces.size(),
        [&](std::size_t i)
        {
            searchPiece(pieces[i], resolution, [&](const SurfacePoint& place, double radius)
            {
                if (radius > resolution) return true;
                ofPiece[i].push_back(place);
                return false;
            });
        },
        16
    );
    std::vector<SurfacePoint> places;
    for (const std::vector<SurfacePoint>& some : ofPiece) places.insert(places.end(), some.begin(), some.end());
    return places;
}

// Calls take(place) for places all over the surface that have another side behind them, nearer than `reach` [m].
template<class Take>
void forEachBackedPlace(const SurfaceGeometry& surface, const SurfaceDistance& distance, double spacing, double reach, const Take& take)
{
    constexpr double resolution = 0.6;          // spacings between the places that are looked at
    constexpr double same = 0.3;                // spacings: of many slivers beside each other one is enough
    constexpr double sameCosine = 0.996;        // of five degrees
    constexpr double size = 8;                  // spacings
    constexpr std::size_t together = 1 << 13;   // pieces of that size, whose places are in memory
    PointGrid seen(4*same*spacing);
    std::vector<const Vector3*> normals;
    const auto isNew = [&](const SurfacePoint& place)
    {
        const Vector3& normal = surface.faceNormal(place.face);
        bool known = false;
        seen.forEachWithin(place.position, same*spacing, [&](int i, double) { known |= dot(*normals[i], normal) > sameCosine; });
        if (known) return false;
        seen.insert(place.position);
        normals.push_back(&normal);
        return true;
    };
    const std::vector<SurfacePiece> pieces = surface.pieces(size*spacing);
    for (std::size_t begin = 0; begin < pieces.size(); begin += together)
    {
        std::vector<SurfacePoint> places = placesOn(std::span(pieces).subspan(begin, std::min(together, pieces.size() - begin)), resolution*spacing);
        std::erase_if(places, [&](const SurfacePoint& place) { return !isNew(place); });
        std::vector<std::optional<SurfaceDistance::Hit>> behind(places.size());
        forEachInParallel(places.size(), [&](std::size_t i)
        {
            behind[i] = distance.behind(places[i].position, -surface.faceNormal(places[i].face), 1e-3*spacing, reach);
        });
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            if (behind[i]) take(BackedPlace{places[i], surface.faceNormal(places[i].face), surface.faceNormal(behind[i]->face), behind[i]->distance});
        }
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
