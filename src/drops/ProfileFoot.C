// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/ProfileFoot.H"

#include "core/angles/Degrees.H"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shizuku
{

std::optional<ProfileFoot> footOf(const ProfileFit& fit, const Vector3& axis, const Vector3& up, const WallShape& wall)
{
    constexpr int sides = 8, pieces = 1000;     // an even number: on a wall not quite level opposite sides make up for each other
    const DropProfile profile = fit.profile(pieces + 1);
    const Vector3 x = perpendicular(up), y = cross(up, x);
    ProfileFoot foot;
    for (int side = 0; side < sides; ++side)
    {
        const double azimuth = 2*std::numbers::pi*side/sides;
        const Vector3 outward = std::cos(azimuth)*x + std::sin(azimuth)*y;
        const auto above = [&](const DropProfilePoint& p)
        {
            return wall.at(axis + (fit.apexHeight - p.z)*up + p.x*outward).distance;
        };
        const auto at = std::partition_point
        (
            profile.points.begin(), profile.points.end(), [&](const DropProfilePoint& p) { return above(p) > 0; }
        );
        if (at == profile.points.begin() || at == profile.points.end()) return std::nullopt;

        const DropProfilePoint &last = at[-1], &next = at[0];
        const double share = above(last)/(above(last) - above(next));
        const double radius = std::lerp(last.x, next.x, share), phi = std::lerp(last.phi, next.phi, share);
        const double height = fit.apexHeight - std::lerp(last.z, next.z, share);
        const Vector3 normal = std::cos(phi)*up + std::sin(phi)*outward;
        const double cosine = dot(normal, wall.at(axis + height*up + radius*outward).normal);
        foot.radius += radius/sides;
        foot.angle += degrees(std::acos(std::clamp(cosine, -1.0, 1.0)))/sides;
    }
    return foot;
}

}
