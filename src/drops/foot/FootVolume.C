// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/foot/FootVolume.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

using Role = FootPlace::Role;

// A third of the faces around each vertex, as vectors. freeAlone: at the contact line without those on the wall.
std::vector<Vector3> areaVectors(const TriangleMesh& mesh, const std::vector<FootPlace>& places, bool freeAlone)
{
    std::vector<Vector3> areas(places.size());
    for (const auto& face : mesh.faces)
    {
        const auto& [i, j, k] = face;
        const Vector3 third = cross(mesh.vertices[j] - mesh.vertices[i], mesh.vertices[k] - mesh.vertices[i])/6;
        const bool isFree = std::any_of(face.begin(), face.end(), [&](int v) { return places[v].role == Role::free; });
        for (const int v : face)
        {
            if (isFree || !freeAlone || places[v].role != Role::line) areas[v] += third;
        }
    }
    return areas;
}

// Where each vertex goes when the free surface moves by one: along its normal, at the contact line along the wall.
std::vector<Vector3> waysOut(const TriangleMesh& mesh, const std::vector<FootPlace>& places)
{
    constexpr double flattest = 0.1;        // square of the sine of the contact angle that counts
    std::vector<Vector3> ways = footNormals(mesh, places);
    for (std::size_t v = 0; v < ways.size(); ++v)
    {
        if (places[v].role == Role::wall) ways[v] = {};
        if (places[v].role != Role::line) continue;
        ways[v] -= dot(ways[v], places[v].wall->normal)*places[v].wall->normal;
        ways[v] *= 1/std::max(squaredLength(ways[v]), flattest);
    }
    return ways;
}

// Where each vertex goes when the mesh goes back from the walls.
std::vector<Vector3> waysBack(const std::vector<FootPlace>& places)
{
    std::vector<Vector3> ways(places.size());
    for (std::size_t v = 0; v < ways.size(); ++v)
    {
        if (places[v].role != Role::free) ways[v] = places[v].room*places[v].wall->normal;
    }
    return ways;
}

class Filling
{
public:
    Filling(TriangleMesh& mesh, const std::vector<FootPlace>& places, double volume)
    : mesh_(mesh), places_(places), volume_(volume), start_(mesh.vertices), moved_(mesh.vertices.size())
    {}

    bool isDone() const { return std::abs(volume_ - mesh_.volume()) <= 1e-5*std::abs(volume_); }

    // Newton's steps to the multiple of these ways that does it, or to the nearest one between the two.
    double move(const std::vector<Vector3>& ways, double least, double most)
    {
        constexpr int turns = 8;
        double way = 0;
        for (int turn = 0; turn < turns && !isDone(); ++turn)
        {
            const std::vector<Vector3> areas = areaVectors(mesh_, places_, false);
            double grows = 0;
            for (std::size_t v = 0; v < ways.size(); ++v) grows += dot(ways[v], areas[v]);
            const double next = std::clamp(way + (volume_ - mesh_.volume())/grows, least, most);
            if (!(next != way)) break;
            way = next;
            for (std::size_t v = 0; v < ways.size(); ++v) mesh_.vertices[v] = outOfWall(v, start_[v] + moved_[v] + way*ways[v]);
        }
        for (std::size_t v = 0; v < ways.size(); ++v) moved_[v] += way*ways[v];
        return way;
    }

    void undo() { mesh_.vertices = start_; }

private:
    Vector3 outOfWall(std::size_t v, const Vector3& x) const
    {
        if (!places_[v].wall) return x;
        const auto& [height, normal, theta] = *places_[v].wall;
        return x - std::min(0.0, height + dot(x - start_[v], normal))*normal;
    }

    TriangleMesh& mesh_;
    const std::vector<FootPlace>& places_;
    double volume_;
    std::vector<Vector3> start_, moved_;
};

}

std::vector<Vector3> footNormals(const TriangleMesh& mesh, const std::vector<FootPlace>& places)
{
    std::vector<Vector3> normals = areaVectors(mesh, places, true);
    for (std::size_t v = 0; v < normals.size(); ++v)
    {
        const double area = length(normals[v]);
        normals[v] = area > 0 ? normals[v]/area : mesh.normals[v];
    }
    return normals;
}

FootOffsets bringToVolume(TriangleMesh& mesh, const std::vector<FootPlace>& places, double volume, double sinks, double most)
{
    constexpr double mostRooms = 2;
    const bool isWet = std::any_of(places.begin(), places.end(), [](const FootPlace& place) { return place.room > 0; });
    Filling filling(mesh, places, volume);
    FootOffsets offsets;
    offsets.free = filling.move(waysOut(mesh, places), isWet ? -sinks : -most, most);
    if (isWet && !filling.isDone()) offsets.back = filling.move(waysBack(places), 0, mostRooms);
    if (filling.isDone()) return offsets;
    filling.undo();
    return {std::nan(""), 0};
}

}
