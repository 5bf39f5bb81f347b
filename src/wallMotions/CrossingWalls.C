// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallMotions/CrossingWalls.H"

#include "meshes/NearestPoint.H"
#include "wallMotions/WallMotions.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace shizuku
{

namespace
{

using Type = AnalyticSurface::Type;

// A wall where it is given: solid particles, or a surface that is no box.
struct Piece
{
    std::string wall;
    int motion = -1;                            // of WallMotions; -1: it stands still
    std::vector<Vector3> particles = {};
    std::shared_ptr<const NearestPoint> nearest = {};
    AnalyticSurface surface = {};

    bool isSampled() const { return nearest != nullptr; }
};

// Six planes, with their normals into the box.
std::vector<AnalyticSurface> facesOf(const AnalyticSurface& box)
{
    std::vector<AnalyticSurface> faces;
    for (int axis = 0; axis < 3; ++axis)
    {
        for (const int side : {1, -1})
        {
            AnalyticSurface face;
            face.name = box.name;
            face.type = Type::plane;
            face.point = side > 0 ? box.min : box.max;
            face.direction[axis] = side;
            faces.push_back(face);
        }
    }
    return faces;
}

std::vector<Piece> piecesOf(const std::filesystem::path& casePath, const WallMotions& motions)
{
    std::vector<Piece> pieces;
    const CaseWalls walls = readCaseWalls(casePath);
    for (const AnalyticSurface& surface : walls.analytic)
    {
        for (const AnalyticSurface& face : surface.type == Type::box ? facesOf(surface) : std::vector<AnalyticSurface>{surface})
        {
            pieces.push_back({.wall = surface.name, .motion = motions.indexOf(surface.name), .surface = face});
        }
    }
    if (walls.solid.positions.empty()) return pieces;
    const std::map<std::string, std::string> wallOf = readWallsOfPatches(casePath);
    std::map<std::string, std::vector<Vector3>> sampled;
    for (std::size_t k = 0; k < walls.solid.positions.size(); ++k)
    {
        const std::string& patch = walls.solid.patches[walls.solid.patch[k]];
        const auto wall = wallOf.find(patch);
        sampled[wall == wallOf.end() ? patch : wall->second].push_back(walls.solid.positions[k]);
    }
    for (auto& [name, particles] : sampled)
    {
        auto nearest = std::make_shared<const NearestPoint>(particles);
        pieces.push_back({.wall = name, .motion = motions.indexOf(name), .particles = std::move(particles), .nearest = std::move(nearest)});
    }
    return pieces;
}

// Two walls at a time. The first is looked at from the second one, which stands still then.
class Pair
{
public:
    Pair(const Piece& first, const Piece& second, const WallMotions& motions, double spacing)
    :
        first_(first), second_(second), motions_(motions), spacing_(spacing), points_(pointsOf(first)),
        stride_(1 + first.particles.size()/mostParticles)
    {}

    // A gap is known of the two in this order.
    static bool isKnown(const Piece& first, const Piece& second)
    {
        if (first.isSampled() && second.isSampled())
        {
            const std::size_t own = first.particles.size(), other = second.particles.size();
            return own < other || (own == other && &first < &second);       // the smaller one is looked for in the larger one
        }
        if (first.isSampled() || second.isSampled()) return first.isSampled();
        const AnalyticSurface& a = first.surface;
        const AnalyticSurface& b = second.surface;
        if (a.type == Type::plane) return b.type == Type::plane;
        if (a.liquidInside) return false;
        return a.type == Type::sphere || b.type != Type::sphere;
    }

    // How many distances a gap takes.
    double cost() const
    {
        constexpr double search = 10;           // in a tree, against that of a surface
        return std::max<double>(1, double(first_.particles.size()/stride_)*(second_.isSampled() ? search : 1));
    }

    // m; infinite where none is known, of walls that are not parallel.
    double gap(double time) const
    {
        const View view = viewAt(time);
        if (first_.isSampled())
        {
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < first_.particles.size(); k += stride_) least = std::min(least, distance(view(first_.particles[k])));
            return least - (second_.isSampled() ? 1 : 0.5)*spacing_;
        }
        const AnalyticSurface& a = first_.surface;
        const AnalyticSurface& b = second_.surface;
        constexpr double parallel = 1e-6;       // sine
        const double along = a.type == Type::sphere ? 0 : dot(view.turned(a.direction), b.direction);
        const bool isAligned = a.type == Type::sphere
            || (a.type == Type::plane ? along < parallel - 1 : b.type == Type::plane ? std::abs(along) < parallel : std::abs(along) > 1 - parallel);
        return isAligned ? distance(view(a.point)) - a.radius : std::numeric_limits<double>::infinity();
    }

    // The largest way [m] of a point of the first one between two times, as the second sees it.
    double way(double before, double time) const
    {
        const View was = viewAt(before), is = viewAt(time);
        double most = 0;
        for (const Vector3& x : points_) most = std::max(most, length(is(x) - was(x)));
        return most;
    }

private:
    // From the place that a point of the first wall is given to that which it has beside the second one's.
    struct View
    {
        Pose first, second;

        Vector3 operator()(const Vector3& x) const { return second.turnedBack(first(x) - second.shift); }
        Vector3 turned(const Vector3& n) const { return second.turnedBack(first.turned(n)); }
    };

    View viewAt(double time) const
    {
        const auto pose = [&](int motion) { return motion < 0 ? Pose() : motions_.walls()[motion].motion->at(time); };
        return {pose(first_.motion), pose(second_.motion)};
    }

    double distance(const Vector3& x) const
    {
        return second_.isSampled() ? length(x - second_.particles[(*second_.nearest)(x)]) : second_.surface.signedDistance(x);
    }

    // That go as far as any point does: corners around particles.
    static std::vector<Vector3> pointsOf(const Piece& piece)
    {
        if (!piece.isSampled()) return {piece.surface.point};
        Vector3 low = piece.particles.front(), high = low;
        for (const Vector3& x : piece.particles)
        {
            for (int k = 0; k < 3; ++k)
            {
                low[k] = std::min(low[k], x[k]);
                high[k] = std::max(high[k], x[k]);
            }
        }
        std::vector<Vector3> corners;
        for (int corner = 0; corner < 8; ++corner)
        {
            corners.push_back({corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z});
        }
        return corners;
    }

    static constexpr std::size_t mostParticles = 50'000;       // of larger walls every second, third, ... counts

    const Piece& first_;
    const Piece& second_;
    const WallMotions& motions_;
    double spacing_;
    std::vector<Vector3> points_;
    std::size_t stride_;
};

// Steps of a time, and the longest way in any of them.
struct Steps
{
    int count;
    double way;         // m
};

Steps stepsOf(const Pair& pair, double from, double to, double longest)
{
    constexpr int first = 256, most = 16384;
    constexpr double affordable = 3e7;          // distances: below a second
    const int budget = int(std::clamp(affordable/pair.cost(), 64.0, double(most)));
    for (int count = std::min(first, budget);; count = std::min(2*count, budget))
    {
        double way = 0;
        for (int k = 0; k < count; ++k) way = std::max(way, pair.way(from + (to - from)*k/count, from + (to - from)*(k + 1)/count));
        if (way <= longest || count == budget) return {count, way};
    }
}

// The time at which they have crossed; negative: never. Steps that are too short for the gap to close are left out.
double crossingOf(const Pair& pair, double from, double to, double spacing)
{
    if (pair.gap(0) < -1e-6*spacing) return -1;
    const Steps steps = stepsOf(pair, from, to, 0.25*spacing);
    if (steps.way == 0 && from == 0) return -1;
    for (int k = 0; k <= steps.count;)
    {
        const double time = from + (to - from)*k/steps.count, gap = pair.gap(time);
        if (gap < -0.5*spacing) return time;
        k += std::isfinite(gap) && steps.way > 0 ? std::max(1, int(std::min(gap/steps.way, double(steps.count)))) : 1;
    }
    return -1;
}

}

void refuseCrossingWalls(const std::filesystem::path& casePath, double from, double to, double spacing)
{
    const WallMotions motions = WallMotions::read(casePath);
    if (motions.none() || !(to > from)) return;
    const std::vector<Piece> pieces = piecesOf(casePath, motions);
    const auto isFree = [&](const Piece& piece) { return piece.motion >= 0 && motions.walls()[piece.motion].motion->body(); };     // nobody knows its way
    for (const Piece& first : pieces)
    {
        for (const Piece& second : pieces)
        {
            if (&first == &second || first.motion == second.motion || isFree(first) || isFree(second) || !Pair::isKnown(first, second)) continue;
            const double time = crossingOf(Pair(first, second, motions, spacing), from, to, spacing);
            if (time < 0) continue;
            const Piece& moving = first.motion < 0 ? second : first;
            std::ostringstream text;
            text << "The motion of the wall '" << moving.wall << "' takes it through the wall '" << (&moving == &first ? second : first).wall << "': at " << time
                << " s they reach more than half a spacing into each other, and liquid between them has no place";
            const Dictionary walls = Dictionary::read(casePath/"constant/walls");
            throw FatalInputError
            (
                walls.subDict(moving.wall).where("motion"), text.str(),
                "a motion with 'stop' before that time, another path, an earlier endTime, or walls that reach into each other from the start"
            );
        }
    }
}

}
