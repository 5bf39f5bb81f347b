// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/DropImpact.H"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace shizuku
{

namespace
{

struct Bin
{
    double from, to;                // of the Weber number
    Rebound rebound;

    double middle() const { return std::log(std::sqrt(from*to)); }
};

constexpr Bin bins[]
{
    {0.02, 0.05, {3.94, 0.84}}, {0.05, 0.1, {3.48, 0.82}}, {0.1, 0.2, {3.06, 0.83}}, {0.2, 0.5, {2.74, 0.81}},
    {0.5, 1, {2.545, 0.78}}, {1, 2, {2.41, 0.70}}, {2, 5, {2.38, 0.58}}, {5, 10.6, {2.265, 0.48}}
};

}

Rebound measuredRebound(double weber)
{
    const Bin& first = bins[0];
    const Bin& last = *std::prev(std::end(bins));
    const double place = std::clamp(std::log(weber), first.middle(), last.middle());
    const Bin* upper = std::find_if(std::next(bins), std::prev(std::end(bins)), [&](const Bin& bin) { return place <= bin.middle(); });
    const Bin& lower = *std::prev(upper);
    const double share = (place - lower.middle())/(upper->middle() - lower.middle());
    return
    {
        std::lerp(lower.rebound.contactTime, upper->rebound.contactTime, share),
        std::lerp(lower.rebound.restitution, upper->rebound.restitution, share)
    };
}

double largestSpread(double weber, double reynolds, double atRest)
{
    const double root = std::sqrt(weber*std::pow(reynolds, -0.4));
    return std::hypot(atRest, std::pow(reynolds, 0.2)*root/(1.24 + root));
}

}
