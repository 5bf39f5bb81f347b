// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/TubeMeniscus.H"

#include "core/angles/Degrees.H"
#include "core/messages/Error.H"
#include "reference/BashforthAdams.H"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shizuku
{

namespace
{

// The profile whose inclination is `angle` [degrees] where x is the radius: a sphere's cap is the flattest apex that does
// so without gravity, and gravity only flattens it.
DropProfile profileThrough(double radius, double capillaryLength, double angle, int points)
{
    const double cap = radius/std::sin(radians(angle));
    const auto excess = [&](const DropProfile& profile) { return std::log(profile.contactRadius()/radius); };
    return bashforthAdamsWhere(excess, cap, capillaryLength, angle, points);
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
