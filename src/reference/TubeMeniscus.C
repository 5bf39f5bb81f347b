#include "reference/TubeMeniscus.H"

#include "core/messages/Error.H"
#include "reference/BashforthAdams.H"

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace shizuku
{

namespace
{

namespace roots = boost::math::tools;

// The profile whose inclination is `angle` [degrees] where x is the radius: a sphere's cap is the flattest apex that does
// so without gravity, and gravity only flattens it.
DropProfile profileThrough(double radius, double capillaryLength, double angle, int points)
{
    const auto logExcess = [&](double logApexRadius)
    {
        return std::log(bashforthAdams(std::exp(logApexRadius), capillaryLength, angle, 2).contactRadius()/radius);
    };
    double low = std::log(radius/std::sin(angle*std::numbers::pi/180)), high = low;
    do
    {
        low = high;
        high += 0.5;
    }
    while (logExcess(high) < 0);
    if (logExcess(low) > 0) low -= 1e-6;        // rounding, where gravity does not count
    std::uintmax_t steps = 200;
    const auto [below, above] = roots::toms748_solve(logExcess, low, high, roots::eps_tolerance<double>(45), steps);
    return bashforthAdams(std::exp(0.5*(below + above)), capillaryLength, angle, points);
}

}

TubeMeniscus tubeMeniscus(double radius, double capillaryLength, double contactAngle, int points)
{
    if (!(radius > 0 && capillaryLength > 0 && contactAngle >= 0 && contactAngle <= 180 && points > 1))
    {
        throw FatalError("A meniscus needs a radius and a capillary length above 0 and a contact angle from 0 to 180 degrees");
    }
    constexpr double flat = 1e-9;               // degrees from 90
    if (std::abs(90 - contactAngle) < flat) return {{{0, 0}, {radius, 0}}, 0, 0};

    const double sign = contactAngle < 90 ? 1 : -1;
    const DropProfile profile = profileThrough(radius, capillaryLength, std::abs(90 - contactAngle), points);
    TubeMeniscus result;
    result.apexCurvature = sign/profile.apexRadius;
    for (const DropProfilePoint& point : profile.points) result.points.push_back({point.x, sign*point.z});
    // The liquid above the axis' height: the cylinder around the profile without what the profile encloses.
    const double around = std::numbers::pi*radius*radius*profile.height() - profile.volume();
    result.meanHeight = sign*around/(std::numbers::pi*radius*radius);
    return result;
}

double TubeMeniscus::height(double r) const
{
    const auto above = std::lower_bound
    (
        points.begin(), points.end(), r, [](const Point& point, double at) { return point.r < at; }
    );
    if (above == points.begin()) return above->z;
    if (above == points.end()) return points.back().z;
    const auto below = above - 1;
    return below->z + (above->z - below->z)*(r - below->r)/(above->r - below->r);
}

}
