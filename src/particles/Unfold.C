// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/Unfold.H"

namespace shizuku
{

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

}
