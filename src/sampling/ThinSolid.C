// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/ThinSolid.H"

#include "meshes/ConnectedPoints.H"
#include "sampling/SurfaceDistance.H"
#include "sampling/SurfaceGeometry.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// Calls take(place, face, what lies behind it) for places all over the surface that have another side behind them.
template<class Take>
void forEachPlace(const PatchedSurface& surface, double spacing, const Take& take)
{
    constexpr double resolution = 0.6;          // spacings between the places that are looked at
    const SurfaceGeometry geometry(surface);
    const SurfaceDistance distance(surface.mesh);
    geometry.searchPieces(resolution*spacing, [&](const SurfacePoint& place, double radius)
    {
        if (radius > resolution*spacing) return true;
        const Vector3& normal = geometry.faceNormal(place.face);
        const auto behind = distance.behind(place.position, -normal, 1e-3*spacing);
        if (behind) take(place.position, normal, geometry.faceNormal(behind->face), behind->distance);
        return false;
    });
}

}

std::optional<ThinPlace> findThinPlace(const PatchedSurface& surface, double spacing)
{
    constexpr double opposite = -0.867;         // cosine of 150 degrees: edges below 30 degrees are thin too, and throw liquid
    constexpr double enough = 1 - 1e-3;         // of the least thickness: two spacings that were rounded are two
    std::optional<ThinPlace> thinnest;
    forEachPlace(surface, spacing, [&](const Vector3& position, const Vector3& normal, const Vector3& other, double thickness)
    {
        if (thickness >= enough*leastThickness*spacing || dot(normal, other) > opposite) return;
        if (!thinnest || thickness < thinnest->thickness) thinnest = ThinPlace{position, thickness};
    });
    return thinnest;
}

std::optional<Vector3> findSharpTip(const PatchedSurface& surface, double spacing)
{
    constexpr double opposite = -0.643;         // cosine of 130 degrees
    constexpr double thin = 1.5;                // spacings
    constexpr double across = 0.5;              // along an edge the sides look across it; round a tip they look everywhere
    constexpr std::size_t most = 1000;          // places: more are of a long edge
    std::vector<Vector3> places, normals, edges;
    forEachPlace(surface, spacing, [&](const Vector3& position, const Vector3& normal, const Vector3& other, double thickness)
    {
        if (thickness >= thin*spacing || dot(normal, other) > opposite || squaredLength(cross(normal, other)) < 1e-6) return;
        places.push_back(position);
        normals.push_back(normal);
        edges.push_back(normalized(cross(normal, other)));
    });
    for (const std::vector<int>& group : connectedPoints(places, spacing))
    {
        if (group.size() > most) continue;
        for (const int i : group)
        {
            const bool isTip = std::any_of(group.begin(), group.end(), [&](int j)
            {
                return length(places[i] - places[j]) < thin*spacing && std::abs(dot(normals[j], edges[i])) > across;
            });
            if (isTip) return places[i];
        }
    }
    return {};
}

}
