// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquidBodies/PlaceBalls.H"

#include "core/messages/Progress.H"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

namespace shizuku
{

namespace
{

constexpr int mostTrials = 5000;        // of a ball

// The largest first: small ones find room between them.
std::vector<double> largestFirst(std::vector<double> radii)
{
    std::sort(radii.begin(), radii.end(), std::greater<double>());
    return radii;
}

// Between low and high. The standard says what the engine gives, and not what its distributions make of it.
double drawn(std::mt19937_64& random, double low, double high, double quantum)
{
    const double share = double(random() >> 11)*0x1p-53;
    return std::round((low + share*(high - low))/quantum)*quantum;
}

}

PlacedBalls::PlacedBalls(const Bounds& box, std::vector<double> radii, double gap, std::uint64_t seed, const std::string& what)
:
    radii_(largestFirst(std::move(radii))), wanted_(radii_.size()), largest_(radii_.front()), grid_(2*largest_ + gap)
{
    const Vector3 size = box.high - box.low;
    const double quantum = std::max({size.x, size.y, size.z})*0x1p-40;
    std::mt19937_64 random(seed);
    Progress progress(what);
    for (const double radius : radii_)
    {
        bool isPlaced = false;
        for (int trial = 0; trial < mostTrials && !isPlaced; ++trial)
        {
            Vector3 centre;
            for (int c = 0; c < 3; ++c) centre[c] = drawn(random, box.low[c] + radius, box.high[c] - radius, quantum);
            if (!isFree(centre, radius, gap)) continue;
            grid_.insert(centre);
            centres_.push_back(centre);
            isPlaced = true;
        }
        if (!isPlaced)
        {
            next_ = radius;
            break;
        }
        progress.update(double(centres_.size())/double(wanted_));
    }
    radii_.resize(centres_.size());
}

double PlacedBalls::volume() const
{
    double cubes = 0;
    for (const double radius : radii_) cubes += radius*radius*radius;
    return 4*std::numbers::pi/3*cubes;
}

bool PlacedBalls::isFree(const Vector3& centre, double radius, double gap) const
{
    bool free = true;
    grid_.forEachWithin(centre, radius + largest_ + gap, [&](int i, double d2)
    {
        const double least = radius + radii_[i] + gap;
        free = free && d2 >= least*least;
    });
    return free;
}

bool PlacedBalls::contains(const Vector3& x) const
{
    bool found = false;
    grid_.forEachWithin(x, largest_, [&](int i, double d2) { found = found || d2 <= radii_[i]*radii_[i]; });
    return found;
}

int PlacedBalls::nearest(const Vector3& x, double reach) const
{
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    grid_.forEachWithin(x, largest_ + reach, [&](int i, double d2)
    {
        const double height = std::sqrt(d2) - radii_[i];
        if (height >= least || height > reach) return;
        least = height;
        best = i;
    });
    return best;
}

}
