// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/foot/CleanFoot.H"

#include "core/angles/Degrees.H"
#include "device/HostThreads.H"
#include "drops/foot/FootVolume.H"
#include "drops/foot/LatticeLiquid.H"
#include "drops/foot/SmoothedLiquid.H"
#include "meshes/VertexNeighbours.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

using Role = FootPlace::Role;
using Wall = WallsNear::Wall;

constexpr double sinks = 0.25;                      // spacings: so far the free surface goes in, before the mesh leaves the walls
constexpr double follows = 0.375, stays = 0.875;    // supports: up to that height vertices follow the level, from there on they stay
constexpr double wider = 1.5;                       // support of the level's kernel, supports
constexpr int smoothingPasses = 20;                          // of Taubin's
constexpr double towardsMean = 0.5, backFromMean = -0.52;
constexpr int latticePasses = 30;                   // towards the mean alone, over a lattice, whose steps are three to six spacings long

// What of the way to the level a vertex goes.
double partOfWay(const FootPlace& place, double support)
{
    if (place.role == Role::line) return 1;
    const double p = std::clamp((stays - place.wall->height/support)/(stays - follows), 0.0, 1.0);
    return p*p*(3 - 2*p);
}

// A vertex on its way to the level of the wedge.
class LevelWalk
{
public:
    LevelWalk(const SmoothedLiquid& liquid, const WedgeLevel& level, double spacing) : liquid_(liquid), level_(level), spacing_(spacing) {}

    // Where the level is not found within `farthest` the start, on the wall if it is of the contact line.
    Vector3 end(const Vector3& start, const Vector3& normal, const Wall& wall, bool isLine) const
    {
        constexpr int steps = 12;
        const double farthest = (isLine ? 2.5 : 1.5)*spacing_;
        const double theta = wedgeOf(wall, normal);
        const Vector3 from = isLine ? start - wall.height*wall.normal : start;
        Vector3 x = from;
        for (int step = 0; step < steps; ++step)
        {
            const Vector3 way = wayToLevel(x, wall, heightOf(x, start, wall), theta, isLine);
            x += way;
            const double height = heightOf(x, start, wall);
            if (isLine || height < 0) x -= height*wall.normal;
            if (length(x - from) > farthest) return from;
            if (length(way) < 1e-3*spacing_) break;
        }
        return x;
    }

private:
    // Degrees. Away from the contact line that of the face as it is: a film's is parallel to the wall, whatever the contact angle is.
    double wedgeOf(const Wall& wall, const Vector3& normal) const
    {
        const double own = degrees(std::acos(std::clamp(dot(normal, wall.normal), -1.0, 1.0)));
        const double away = std::clamp((wall.height/spacing_ - 0.5)/0.75, 0.0, 1.0);
        return wall.theta + away*(own - wall.theta);
    }

    static double heightOf(const Vector3& x, const Vector3& start, const Wall& wall) { return wall.height + dot(x - start, wall.normal); }

    Vector3 wayToLevel(const Vector3& x, const Wall& wall, double height, double theta, bool alongWall) const
    {
        const double small = 0.02*spacing_, longest = 0.2*spacing_;
        const double above = std::max(0.0, height), level = level_(above, theta);
        Vector3 gradient;
        const double phi = liquid_.at(x, gradient);
        gradient -= (level_(above + small, theta) - level)/small*wall.normal;
        if (alongWall || height <= 0) gradient -= dot(gradient, wall.normal)*wall.normal;
        const double steepness = length(gradient);
        if (steepness*spacing_ < 0.01) return {};
        return std::clamp((level - phi)/steepness, -longest, longest)/steepness*gradient;
    }

    const SmoothedLiquid& liquid_;
    const WedgeLevel& level_;
    double spacing_;
};

void goToWalls(TriangleMesh& mesh, const std::vector<FootPlace>& places, const LevelWalk& walk, double support)
{
    forEachInParallel(places.size(), [&](std::size_t v)
    {
        const FootPlace& place = places[v];
        if (!place.wall) return;
        Vector3& x = mesh.vertices[v];
        if (place.role == Role::wall) x -= place.wall->height*place.wall->normal;
        else x += partOfWay(place, support)*(walk.end(x, mesh.normals[v], *place.wall, place.role == Role::line) - x);
    });
}

// Vertices go towards the mean of their neighbours: those on walls along them, those of the contact line by neighbours of the line alone.
class FootSmoothing
{
public:
    FootSmoothing(const TriangleMesh& mesh, const std::vector<FootPlace>& places)
    : places_(places), neighbours_(mesh, [&](int i, int j) { return places[i].role != Role::line || places[j].role == Role::line; })
    {}

    // By that part of the way, those that moves(v) tells.
    template<class Moves>
    void pass(TriangleMesh& mesh, double part, const Moves& moves) const
    {
        const std::vector<Vector3> ways = neighbours_.waysToMean(mesh.vertices);
        for (std::size_t v = 0; v < places_.size(); ++v)
        {
            if (!moves(v) || (places_[v].role == Role::line && neighbours_.count(v) < 2)) continue;
            Vector3 way = part*ways[v];
            if (places_[v].role != Role::free) way -= dot(way, places_[v].wall->normal)*places_[v].wall->normal;
            mesh.vertices[v] += way;
        }
    }

private:
    const std::vector<FootPlace>& places_;
    VertexNeighbours neighbours_;
};

// Of each vertex, whether it is next to a face that has turned over: on a wall away from it, elsewhere against the normals that the mesh had. Empty: none has.
std::vector<bool> turnedOver(const TriangleMesh& mesh, const std::vector<FootPlace>& places)
{
    std::vector<bool> turned;
    for (const auto& face : mesh.faces)
    {
        const auto& [i, j, k] = face;
        const Vector3 area = cross(mesh.vertices[j] - mesh.vertices[i], mesh.vertices[k] - mesh.vertices[i]);
        const bool onWall = std::none_of(face.begin(), face.end(), [&](int v) { return places[v].role == Role::free; });
        const Vector3 outward = onWall ? -places[i].wall->normal : mesh.normals[i] + mesh.normals[j] + mesh.normals[k];
        if (dot(area, outward) > 0) continue;
        if (turned.empty()) turned.resize(mesh.vertices.size());
        for (const int v : face) turned[v] = true;
    }
    const std::vector<bool> own = turned;
    for (const auto& face : mesh.faces)
    {
        if (own.empty() || std::none_of(face.begin(), face.end(), [&](int v) { return own[v]; })) continue;
        for (const int v : face) turned[v] = true;
    }
    return turned;
}

// Takes short waves out.
void smoothFoot(TriangleMesh& mesh, const FootSmoothing& smoothing)
{
    for (int pass = 0; pass < smoothingPasses; ++pass)
    {
        for (const double part : {towardsMean, backFromMean}) smoothing.pass(mesh, part, [](std::size_t) { return true; });
    }
}

// Takes the steps of a lattice out, where particles stand on one.
void smoothLattice(TriangleMesh& mesh, const FootSmoothing& smoothing, const std::vector<Vector3>& particles, double spacing)
{
    const LatticeLiquid lattice(particles, spacing);
    if (!lattice.any()) return;
    std::vector<char> stands(mesh.vertices.size());
    forEachInParallel(stands.size(), [&](std::size_t v) { stands[v] = lattice.at(mesh.vertices[v]); });
    for (int pass = 0; pass < latticePasses; ++pass)
    {
        smoothing.pass(mesh, towardsMean, [&](std::size_t v) { return stands[v] != 0; });
    }
}

// Smooths what has been folded over, of those that may move, until nothing is, or as often as it helps.
template<class May>
void unfold(TriangleMesh& mesh, const std::vector<FootPlace>& places, const FootSmoothing& smoothing, const May& may)
{
    constexpr int passes = 200;
    for (int pass = 0; pass < passes; ++pass)
    {
        const std::vector<bool> turned = turnedOver(mesh, places);
        if (turned.empty()) break;
        smoothing.pass(mesh, towardsMean, [&](std::size_t v) { return turned[v] && may(v); });
    }
}

// Where the vertices are that have a wall within `reach` [m]. Those that are not free are put on it, or that part of their room away; those that have got into it too.
void endOnWalls(TriangleMesh& mesh, std::vector<FootPlace>& places, const WallsNear& walls, double reach, double back)
{
    forEachInParallel(places.size(), [&](std::size_t v)
    {
        FootPlace& place = places[v];
        if (!place.wall) return;
        if (const auto wall = walls.at(mesh.vertices[v], reach)) place.wall = wall;
        else return;
        if (place.role == Role::free && place.wall->height >= 0) return;
        const double height = back*place.room;
        mesh.vertices[v] += (height - place.wall->height)*place.wall->normal;
        place.wall->height = height;
    });
}

}

CleanFoot::CleanFoot(const WallsNear& walls, double spacing, double support)
: walls_(walls), spacing_(spacing), support_(support), level_(wider*support)
{}

double CleanFoot::clean(TriangleMesh& mesh, const std::vector<Vector3>& particles, double volume) const
{
    const double reach = stays*support_, most = 0.5*spacing_;
    if (mesh.faces.empty()) return volume > 0 ? std::nan("") : 0;
    const double own = mesh.volume();
    std::vector<FootPlace> places = footPlaces(mesh, walls_, reach, spacing_);
    if (walls_.any())
    {
        const SmoothedLiquid liquid(particles, spacing_, wider*support_);
        goToWalls(mesh, places, LevelWalk(liquid, level_, spacing_), support_);
    }
    const FootSmoothing smoothing(mesh, places);
    smoothFoot(mesh, smoothing);
    smoothLattice(mesh, smoothing, particles, spacing_);
    unfold(mesh, places, smoothing, [](std::size_t) { return true; });
    endOnWalls(mesh, places, walls_, reach, 0);
    FootOffsets offsets = bringToVolume(mesh, places, volume, sinks*spacing_, most);
    const bool isFar = std::isnan(offsets.free);
    if (isFar) offsets = bringToVolume(mesh, places, own, sinks*spacing_, most);
    unfold(mesh, places, smoothing, [&](std::size_t v) { return places[v].role == Role::wall; });      // encloses the same
    endOnWalls(mesh, places, walls_, reach, offsets.back);
    mesh.normals = footNormals(mesh, places);
    return isFar ? std::nan("") : offsets.free;
}

}
