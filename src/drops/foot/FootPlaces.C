// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/foot/FootPlaces.H"

#include "core/angles/Degrees.H"
#include "device/HostThreads.H"
#include "meshes/VertexNeighbours.H"

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

// The vertices within so many edges of the first ones, of those that may be.
template<class May>
std::vector<bool> grown(std::vector<bool> those, const VertexNeighbours& neighbours, int edges, const May& may)
{
    for (int edge = 0; edge < edges; ++edge)
    {
        const std::vector<bool> former = those;
        for (std::size_t v = 0; v < those.size(); ++v)
        {
            if (former[v] || !may(v)) continue;
            neighbours.forEach(v, [&](int j) { if (former[j]) those[v] = true; });
        }
    }
    return those;
}

// What the steps of a lattice leave open in the wetted area, of less than two spacings across and no higher above the wall than `highest` [m], belongs to it: the area grows by
// a spacing and shrinks by an edge more, so that its outline stays where it is wide.
void closeWettedArea(std::vector<FootPlace>& places, const VertexNeighbours& neighbours, int edges, double highest)
{
    std::vector<bool> wetted(places.size()), open(places.size());
    for (std::size_t v = 0; v < places.size(); ++v) wetted[v] = places[v].role == Role::wall;
    wetted = grown(std::move(wetted), neighbours, edges, [&](std::size_t v) { return places[v].wall && places[v].wall->height < highest; });
    for (std::size_t v = 0; v < places.size(); ++v) open[v] = !wetted[v];
    open = grown(std::move(open), neighbours, edges + 1, [](std::size_t) { return true; });
    for (std::size_t v = 0; v < places.size(); ++v)
    {
        if (!open[v]) places[v].role = Role::wall;
    }
}

// Means over a spacing and a half around each vertex that is not free.
void findRoom(std::vector<FootPlace>& places, const VertexNeighbours& neighbours, int edges)
{
    const int passes = 4*edges*edges;
    const auto counts = [&](std::size_t v) { return places[v].role != Role::free; };
    std::vector<double> room(places.size()), former;
    for (std::size_t v = 0; v < room.size(); ++v)
    {
        if (counts(v)) room[v] = std::max(0.0, places[v].wall->height);
    }
    for (int pass = 0; pass < passes; ++pass)
    {
        former = room;
        forEachInParallel(room.size(), [&](std::size_t v)
        {
            if (!counts(v)) return;
            int n = 1;
            neighbours.forEach(v, [&](int j)
            {
                if (!counts(j)) return;
                room[v] += former[j];
                ++n;
            });
            room[v] /= n;
        });
    }
    for (std::size_t v = 0; v < room.size(); ++v) places[v].room = room[v];
}

}

std::vector<FootPlace> footPlaces(const TriangleMesh& mesh, const WallsNear& walls, double reach, double spacing)
{
    constexpr double wetted = 0.75, highest = 1.25;     // spacings: half of one is what the mesh may be off at a layer of particles, one at the steps of a lattice
    std::vector<FootPlace> places(mesh.vertices.size());
    if (!walls.any()) return places;
    forEachInParallel(places.size(), [&](std::size_t v)
    {
        FootPlace& place = places[v];
        place.wall = walls.at(mesh.vertices[v], reach);
        if (place.wall && place.wall->height < wetted*spacing && looksAt(*place.wall, mesh.normals[v])) place.role = Role::wall;
    });
    const double edge = std::sqrt(2*mesh.area()/double(mesh.faces.size()));
    const int edges = std::max(1, int(std::lround(spacing/edge)));
    const VertexNeighbours neighbours(mesh);
    closeWettedArea(places, neighbours, edges, highest*spacing);
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
    findRoom(places, neighbours, edges);
    return places;
}

}
