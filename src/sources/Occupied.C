// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/Occupied.H"

#include "device/Reduce.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// A bit for each place, in whole words, which lanes of a GPU pass on.
struct OccupiedBits
{
    static constexpr int words = 8, bits = 32, places = words*bits;

    std::uint32_t of[words] = {};

    HOST_DEVICE void add(const OccupiedBits& other)
    {
        for (int k = 0; k < words; ++k) of[k] |= other.of[k];
    }

    bool holds(std::size_t k) const { return (of[k/bits] >> k%bits & 1) != 0; }
};

struct IsNearPlaces
{
    Vector3 middle;                             // scaled, as all that follows
    double around, reach;                       // all places are nearer than `around` to the middle
    Periods periods;
    Span<const Vector3> places;
    Span<const Position> position;

    HOST_DEVICE bool isNear(const Place& p, const Vector3& to, double distance) const
    {
        const double dx = periods.shortest(quanta::lengthOf(p.x) - to.x, 0), dy = periods.shortest(quanta::lengthOf(p.y) - to.y, 1);
        const double dz = periods.shortest(quanta::lengthOf(p.z) - to.z, 2);
        return dx * dx + dy * dy + dz * dz < distance * distance;
    }

    HOST_DEVICE OccupiedBits operator()(int i) const
    {
        OccupiedBits near;
        const Place p = placeOf(position[i]);
        if (!isNear(p, middle, around + reach)) return near;
        for (int k = 0; k < places.size; ++k)
        {
            if (isNear(p, places[k], reach)) near.of[k/OccupiedBits::bits] |= std::uint32_t(1) << k%OccupiedBits::bits;
        }
        return near;
    }
};

}

std::vector<bool> areOccupied(const Liquid& liquid, const SourceSpace& space, const std::vector<Vector3>& places, double reach)
{
    constexpr double rounding = 1e-6;
    const double unit = liquid.units().length;
    std::vector<bool> occupied;
    for (std::size_t first = 0; first < places.size(); first += OccupiedBits::places)
    {
        std::vector<Vector3> scaled;
        for (std::size_t k = first; k < std::min(places.size(), first + OccupiedBits::places); ++k) scaled.push_back(places[k]/unit);
        const Vector3 middle = scaled[scaled.size()/2];
        double around = rounding;
        for (const Vector3& place : scaled) around = std::max(around, length(place - middle)*(1 + rounding));
        const Buffer<Vector3> there(scaled);
        Buffer<OccupiedBits> scratch;
        const IsNearPlaces near{middle, around, reach/unit, space.periods().scaled(unit), there.span(), liquid.position.span()};
        const OccupiedBits bits = liquid.parts().fold(reduce(liquid.owned(), near, scratch));
        for (std::size_t k = 0; k < scaled.size(); ++k) occupied.push_back(space.toPlane(places[first + k]) < reach || bits.holds(k));
    }
    return occupied;
}

}
