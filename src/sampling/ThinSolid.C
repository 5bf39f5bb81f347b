// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/ThinSolid.H"

#include "sampling/SurfaceDistance.H"
#include "sampling/SurfaceGeometry.H"

namespace shizuku
{

std::optional<ThinPlace> findThinPlace(const PatchedSurface& surface, double spacing)
{
    constexpr double opposite = -0.867;         // cosine of 150 degrees: edges below 30 degrees are thin too, and throw liquid
    constexpr double enough = 1 - 1e-3;         // of the least thickness: two spacings that were rounded are two
    constexpr double resolution = 0.6;          // spacings between the places that are looked at
    const SurfaceGeometry geometry(surface);
    const SurfaceDistance distance(surface.mesh);
    std::optional<ThinPlace> thinnest;
    geometry.searchPieces(resolution*spacing, [&](const SurfacePoint& place, double radius)
    {
        if (radius > resolution*spacing) return true;
        const Vector3& normal = geometry.faceNormal(place.face);
        const auto behind = distance.behind(place.position, -normal, 1e-3*spacing);
        if (!behind || behind->distance >= enough*leastThickness*spacing) return false;
        if (dot(normal, geometry.faceNormal(behind->face)) > opposite) return false;
        if (!thinnest || behind->distance < thinnest->thickness) thinnest = ThinPlace{place.position, behind->distance};
        return false;
    });
    return thinnest;
}

}
