// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/ProfileFit.H"

#include "maths/LinearSolve.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

constexpr std::size_t unknowns = 3;
using Unknowns = SmallVector<unknowns>;     // height of the apex in units of the drop's size, ln b, ln l

// The profile, searched by the polar angle about a point of its axis: it is convex. Its chords are 1e-5 of the size off, so
// the equation needs no more than a thousandth of that.
class SearchedProfile
{
public:
    explicit SearchedProfile(const ProfileFit& fit)
    : top_(fit.apexHeight), profile_(fit.profile(401, 1e-8))
    {
        middle_ = 0.5*profile_.height();
        for (const DropProfilePoint& p : profile_.points) polar_.push_back(std::atan2(p.x, middle_ - p.z));
    }

    // Outside of the profile positive. By the chord across the point: exact to the second order of the distance.
    double distance(const MeridianPoint& point) const { return distance(point, top_); }

    // From the profile with its apex at that height [m].
    double distance(const MeridianPoint& point, double top) const
    {
        const double z = top - point.height;
        const auto after = std::upper_bound(polar_.begin() + 1, polar_.end() - 1, std::atan2(point.r, middle_ - z));
        const DropProfilePoint& a = profile_.points[after - polar_.begin() - 1];
        const DropProfilePoint& b = profile_.points[after - polar_.begin()];
        const double dx = b.x - a.x, dz = b.z - a.z;
        return ((point.r - a.x)*dz - (z - a.z)*dx)/std::sqrt(dx*dx + dz*dz);
    }

    // From the profile that many times as large, its apex where it is.
    double distanceScaled(const MeridianPoint& point, double scale) const
    {
        return scale*distance({point.r/scale, top_ + (point.height - top_)/scale, 0});
    }

private:
    double top_;
    DropProfile profile_;
    double middle_ = 0;                     // depth of the centre of search below the apex, m
    std::vector<double> polar_;
};

class ProfileSearch
{
public:
    // isKnown: l stays as it is.
    ProfileSearch(const std::vector<MeridianPoint>& points, double size, bool hangs, bool isKnown)
    : points_(points), size_(size), hangs_(hangs), isKnown_(isKnown) {}

    ProfileFit fitOf(const Unknowns& u) const { return {std::exp(u[1]), std::exp(u[2]), size_*u[0], 0, hangs_}; }
    int profiles() const { return profiles_; }

    double meanSquare(const Unknowns& u) const
    {
        const SearchedProfile profile = profileAt(u);
        double sum = 0, total = 0;
        for (const MeridianPoint& p : points_)
        {
            sum += p.weight*std::pow(profile.distance(p), 2);
            total += p.weight;
        }
        return sum/total;
    }

    // Central differences. Only a profile of another b alone has to be integrated: b and l times a number make it larger.
    NormalEquations<unknowns> equationsAt(const Unknowns& u) const
    {
        constexpr double step = 1e-3;       // their error is its square
        Unknowns rounder = u, sharper = u;
        rounder[1] += step;
        sharper[1] -= step;
        const SearchedProfile here = profileAt(u), more = profileAt(rounder), less = profileAt(sharper);
        const double top = size_*u[0], grown = std::exp(step), shrunk = std::exp(-step);
        NormalEquations<unknowns> equations;
        for (const MeridianPoint& p : points_)
        {
            const auto slope = [](double up, double down) { return (up - down)/(2*step); };
            const double byTop = slope(here.distance(p, top + step*size_), here.distance(p, top - step*size_));
            const double byRadius = slope(more.distance(p), less.distance(p));
            const double byScale = isKnown_ ? byRadius : slope(here.distanceScaled(p, grown), here.distanceScaled(p, shrunk));
            equations.add({byTop/size_, byRadius/size_, (byScale - byRadius)/size_}, -here.distance(p)/size_, p.weight);
        }
        if (isKnown_) equations.matrix[2][2] = 1;       // its row has nothing else: no change
        return equations;
    }

private:
    SearchedProfile profileAt(const Unknowns& u) const
    {
        ++profiles_;
        return SearchedProfile(fitOf(u));
    }

    const std::vector<MeridianPoint>& points_;
    double size_;                           // of the drop, m
    bool hangs_, isKnown_;
    mutable int profiles_ = 0;
};

// A sphere's height at the apex against that half way out, where the drop is a sphere or flatter.
double apexRadiusOf(const std::vector<MeridianPoint>& points, double apex, double widest)
{
    double rise = 0, square = 0;
    for (const MeridianPoint& p : points)
    {
        if (p.r > 0.5*widest || apex - p.height > 0.5*widest) continue;
        rise += p.weight*(apex - p.height)*p.r*p.r;
        square += p.weight*std::pow(p.r, 4);
    }
    return rise > 0 ? 0.5*square/rise : widest;
}

// The least squares that Levenberg-Marquardt steps from u come to. smallestGain: the share of them that a step has to gain.
struct Minimum
{
    Unknowns u;
    double squares;
};

Minimum descend(const ProfileSearch& search, Unknowns u, double shortest, double longest, double smallestGain)
{
    constexpr int maxSteps = 100;
    constexpr double longestStep = 0.5, mostDamping = 1e6;
    double squares = search.meanSquare(u), damping = 1e-3;
    for (int step = 0; step < maxSteps && damping < mostDamping; ++step)
    {
        const NormalEquations<unknowns> equations = search.equationsAt(u);
        const double before = squares;
        for (bool better = false; !better && damping < mostDamping;)
        {
            NormalEquations<unknowns> damped = equations;
            for (std::size_t k = 0; k < unknowns; ++k) damped.matrix[k][k] *= 1 + damping;
            Unknowns next = u;
            if (const auto change = damped.solve())
            {
                for (std::size_t k = 0; k < unknowns; ++k) next[k] += std::clamp((*change)[k], -longestStep, longestStep);
                const bool inRange = next[2] > shortest && next[2] < longest;
                const double nextSquares = inRange ? search.meanSquare(next) : HUGE_VAL;
                better = nextSquares < squares;
                if (better)
                {
                    u = next;
                    squares = nextSquares;
                }
            }
            damping *= better ? 0.1 : 10;
        }
        if (before - squares < smallestGain*before) break;
    }
    return {u, squares};
}

// Every so many of the points, some hundreds of them.
std::vector<MeridianPoint> thinned(const std::vector<MeridianPoint>& points)
{
    constexpr std::size_t enough = 500;
    const std::size_t stride = std::max<std::size_t>(1, points.size()/enough);
    std::vector<MeridianPoint> chosen;
    for (std::size_t i = 0; i < points.size(); i += stride) chosen.push_back(points[i]);
    return chosen;
}

}

DropProfile ProfileFit::profile(int points, double tolerance) const
{
    return hangs ? hangingDrop(apexRadius, capillaryLength, 180, points, tolerance)
        : bashforthAdams(apexRadius, capillaryLength, 180, points, tolerance);
}

std::optional<ProfileFit> fitProfile(const std::vector<MeridianPoint>& points, bool hangs, std::optional<double> capillaryLength)
{
    constexpr std::size_t fewest = 10;
    if (points.size() < fewest) return std::nullopt;

    double apex = points.front().height, widest = 0;
    for (const MeridianPoint& p : points)
    {
        apex = std::max(apex, p.height);
        widest = std::max(widest, p.r);
    }
    if (!(widest > 0)) return std::nullopt;

    // A puddle has another minimum where l is as long as the puddle is wide, which is not the least. Few of the points and few steps tell which is.
    const bool isKnown = capillaryLength.has_value();
    const std::vector<MeridianPoint> few = thinned(points);
    const ProfileSearch search(points, widest, hangs, isKnown), coarse(few, widest, hangs, isKnown);
    const double shortest = isKnown ? -HUGE_VAL : std::log(widest/30), longest = isKnown ? HUGE_VAL : std::log(10*widest);      // of l
    std::vector<double> starts = hangs ? std::vector{3.0, 1.5, 0.75} : std::vector{1.0, 0.3, 0.1};          // one that hangs is no puddle
    if (isKnown) starts = {*capillaryLength/widest};
    Unknowns start{apex/widest, std::log(apexRadiusOf(points, apex, widest)), 0};
    Minimum least{{}, HUGE_VAL};
    for (const double l : starts)
    {
        start[2] = std::log(l*widest);
        const Minimum found = descend(coarse, start, shortest, longest, 0.01);
        if (found.squares < least.squares) least = found;
    }
    if (std::isfinite(least.squares)) least = descend(search, least.u, shortest, longest, 1e-8);
    // Next to the ends of the range the least squares are beyond it.
    constexpr double margin = 0.1;
    if (!(least.u[2] > shortest + margin && least.u[2] < longest - margin)) return std::nullopt;
    ProfileFit fit = search.fitOf(least.u);
    fit.rms = std::sqrt(least.squares);
    fit.profiles = coarse.profiles() + search.profiles();
    return fit;
}

}
