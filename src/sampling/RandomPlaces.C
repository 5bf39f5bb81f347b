// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/RandomPlaces.H"

#include "device/HostThreads.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

// 0 <= uniform < 1
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11)*0x1p-53; }

struct Draw
{
    int face;
    double first, second;
};

}

std::vector<SurfacePoint> RandomPlaces::next()
{
    constexpr long together = 1 << 17;
    std::vector<Draw> draws(std::min(together, count_ - drawn_));
    for (Draw& draw : draws)
    {
        const double place = (double(drawn_++) + uniform(random_))*part_;
        while (face_ + 1 < surface_.faces() && surface_.areaUpTo(face_) < place) ++face_;
        draw.face = face_;
        draw.first = uniform(random_);
        draw.second = uniform(random_);
    }
    std::vector<SurfacePoint> places(draws.size());
    forEachInParallel(draws.size(), [&](std::size_t i)
    {
        const auto corner = surface_.corners(draws[i].face);
        const double a = std::sqrt(draws[i].first), b = draws[i].second;
        places[i] = {draws[i].face, (1 - a)*corner[0] + a*(1 - b)*corner[1] + a*b*corner[2]};
    });
    return places;
}

}
