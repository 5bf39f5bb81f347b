// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/Unfold.H"

#include "meshes/ConnectedPoints.H"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace shizuku
{

namespace
{

using Shift = std::array<int, 3>;               // periods along each axis

Vector3 pointOf(Place x) { return {quanta::lengthOf(x.x), quanta::lengthOf(x.y), quanta::lengthOf(x.z)}; }

// Pieces of liquid, and which of them touch each other across cyclic sides.
class Pieces
{
public:
    Pieces(const std::vector<Position>& places, double reach) : pieceOf_(places.size())
    {
        std::vector<Vector3> points;
        for (const Position& place : places) points.push_back(pointOf(placeOf(place)));
        const auto groups = connectedPoints(points, reach);
        joints_.resize(groups.size());
        for (std::size_t piece = 0; piece < groups.size(); ++piece)
        {
            for (const int i : groups[piece]) pieceOf_[i] = int(piece);
        }
    }

    // Those at the lower side of an axis, a period on, beside those at the upper one.
    void joinAlong(int axis, const std::vector<Position>& places, const Sides& sides, double reach)
    {
        std::vector<Vector3> points;
        std::vector<std::pair<int, bool>> of;           // piece; whether it is an image
        AtSides across;
        across.set(axis, AtSides::lower);               // whose image stands behind the upper side
        const std::int64_t most = quanta::wholeOf(reach);
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            const Place place = placeOf(places[i]);
            const auto side = sides.maps().within(most, place).along(axis);
            if (side == AtSides::neither) continue;
            const bool isImage = side == AtSides::lower;
            points.push_back(pointOf(isImage ? sides.maps().imageOf(place, across) : place));
            of.emplace_back(pieceOf_[i], isImage);
        }
        for (const std::vector<int>& group : connectedPoints(points, reach))
        {
            const auto first = [&](bool isImage) { return std::find_if(group.begin(), group.end(), [&](int k) { return of[k].second == isImage; }); };
            const auto image = first(true), real = first(false);
            if (image == group.end() || real == group.end()) continue;
            for (const int k : group) join(of[k].second ? of[k].first : of[*image].first, of[k].second ? of[*real].first : of[k].first, axis);
        }
    }

    // Of each particle.
    std::vector<Shift> shifts() const
    {
        std::vector<Shift> shift(joints_.size(), Shift{});
        std::vector<bool> seen(joints_.size(), false);
        for (std::size_t largest = 0; largest < joints_.size(); ++largest)      // of those that are left
        {
            if (seen[largest]) continue;
            std::vector<int> body{int(largest)};
            seen[largest] = true;
            bool goesRound = false;
            for (std::size_t k = 0; k < body.size(); ++k)
            {
                for (const Joint& joint : joints_[body[k]])
                {
                    Shift there = shift[body[k]];
                    there[joint.axis] += joint.periods;
                    if (seen[joint.piece]) goesRound = goesRound || shift[joint.piece] != there;
                    else
                    {
                        seen[joint.piece] = true;
                        shift[joint.piece] = there;
                        body.push_back(joint.piece);
                    }
                }
            }
            if (!goesRound) continue;
            for (const int piece : body) shift[piece] = Shift{};
        }
        std::vector<Shift> ofParticles;
        for (const int piece : pieceOf_) ofParticles.push_back(shift[piece]);
        return ofParticles;
    }

private:
    struct Joint
    {
        int piece, axis, periods;
    };

    void join(int lower, int upper, int axis)
    {
        joints_[upper].push_back({lower, axis, 1});
        joints_[lower].push_back({upper, axis, -1});
    }

    std::vector<int> pieceOf_;
    std::vector<std::vector<Joint>> joints_;
};

}

std::vector<Position> unfolded(std::vector<Position> places, const Sides& sides)
{
    for (int k = 0; k < 3; ++k)
    {
        const auto isPlane = [&](bool upper) { return sides.box().kind[k][upper] == Sides::Kind::symmetryPlane; };
        if (!isPlane(false) && !isPlane(true)) continue;
        AtSides across;
        across.set(k, isPlane(false) ? AtSides::lower : AtSides::upper);
        const std::size_t before = places.size();
        places.reserve(2 * before);
        for (std::size_t i = 0; i < before; ++i) places.push_back(sides.maps().imageOf(places[i], across));
    }
    return places;
}

std::vector<Position> joinedAcross(std::vector<Position> places, const Sides& sides, double reach)
{
    if (!sides.box().has(Sides::Kind::cyclic)) return places;
    Pieces pieces(places, reach);
    for (int axis = 0; axis < 3; ++axis)
    {
        if (sides.box().isCyclic(axis)) pieces.joinAlong(axis, places, sides, reach);
    }
    const std::vector<Shift> shifts = pieces.shifts();
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        Place place = placeOf(places[i]);
        for (int axis = 0; axis < 3; ++axis)
        {
            AtSides across;
            across.set(axis, shifts[i][axis] > 0 ? AtSides::lower : AtSides::upper);
            for (int k = std::abs(shifts[i][axis]); k > 0; --k) place = sides.maps().imageOf(place, across);
        }
        places[i] = positionAt(place);
    }
    return places;
}

}
