// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/foot/FootPlaces.H"

#include "core/angles/Degrees.H"
#include "device/HostThreads.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

using Role = FootPlace::Role;

// Nearer to the direction into the wall than to that of a free face at the contact angle.
bool looksAt(const WallsNear::Wall& wall, const Vector3& normal)
{
    const double theta = std::clamp(wall.theta, 20.0, 150.0);
    return std::acos(std::clamp(-dot(normal, wall.normal), -1.0, 1.0)) < 0.5*radians(180 - theta);
}

}

std::vector<FootPlace> footPlaces(const TriangleMesh& mesh, const WallsNear& walls, double reach, double wetted)
{
    std::vector<FootPlace> places(mesh.vertices.size());
    if (!walls.any()) return places;
    forEachInParallel(places.size(), [&](std::size_t v)
    {
        FootPlace& place = places[v];
        place.wall = walls.at(mesh.vertices[v], reach);
        if (place.wall && place.wall->height < wetted && looksAt(*place.wall, mesh.normals[v])) place.role = Role::wall;
    });
    const auto isWall = [&](int v) { return places[v].role == Role::wall; };
    for (const auto& face : mesh.faces)
    {
        if (std::none_of(face.begin(), face.end(), isWall)) continue;
        for (const int v : face)
        {
            if (!isWall(v) && places[v].wall) places[v].role = Role::line;
        }
    }
    // A vertex that no face joins to the free surface is within the wetted area.
    std::vector<bool> atFree(places.size());
    for (const auto& face : mesh.faces)
    {
        if (std::none_of(face.begin(), face.end(), [&](int v) { return places[v].role == Role::free; })) continue;
        for (const int v : face) atFree[v] = true;
    }
    for (std::size_t v = 0; v < places.size(); ++v)
    {
        if (places[v].role == Role::line && !atFree[v]) places[v].role = Role::wall;
    }
    return places;
}

}
