// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/CapOnWall.H"

#include "core/angles/Degrees.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

constexpr int halvings = 60;            // of 180 degrees: below the digits of a double

struct Cap
{
    explicit Cap(double angle)
    :
        rise(2*std::pow(std::sin(radians(angle)/2), 2)), cosine(1 - rise), radius(std::cbrt(4/((2 + cosine)*rise*rise)))
    {}

    double rise, cosine;                // 1 - cos(angle), which keeps its digits at small angles; cos(angle)
    double radius;                      // over R
};

// Of the volume, below that depth.
double shareBelow(double angle, double depth)
{
    const Cap cap(angle);
    const double r = cap.radius, centre = -r*cap.cosine;
    if (depth >= r*cap.rise) return 1;
    return 0.75*(r*r*depth - (std::pow(depth - centre, 3) + std::pow(centre, 3))/3);
}

// Where `holds` turns from true at the angle `from` to false at `to`: the last one that is found false.
template<class Condition>
double turningAngle(double from, double to, Condition holds)
{
    for (int i = 0; i < halvings; ++i)
    {
        const double middle = 0.5*(from + to);
        (holds(middle) ? from : to) = middle;
    }
    return to;
}

}

double capEnergy(double angle, double theta)
{
    const Cap cap(angle);
    return cap.radius*cap.radius*cap.rise*(2 - std::cos(radians(theta))*(1 + cap.cosine));
}

double capRadius(double angle)
{
    return Cap(angle).radius;
}

double capFootRadius(double angle)
{
    return std::sin(radians(angle))*capRadius(angle);
}

double capCentroid(double angle)
{
    const Cap cap(angle);
    return cap.radius*(0.75*std::pow(1 + cap.cosine, 2)/(2 + cap.cosine) - cap.cosine);
}

double capAngleOf(double share, double depth)
{
    return turningAngle(0, 180, [&](double angle) { return shareBelow(angle, depth) > share; });
}

JumpOff jumpOff(const CapStart& start)
{
    constexpr double film = 0.01;       // degrees: at theta = 0 a cap has no energy left but weightless, and no radius
    const double weight = 4*start.bond/3, theta = std::max(start.theta, film);
    const auto energy = [&](double angle) { return capEnergy(angle, start.theta) + weight*capCentroid(angle); };
    JumpOff jump{energy(start.angle), 4 + weight, energy(theta), start.angle};
    if (!jump.excess()) return jump;
    jump.flattest = turningAngle(start.angle, theta, [&](double angle) { return energy(angle) > jump.free; });
    return jump;
}

}
