// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/SphereInBath.H"

#include "core/angles/Degrees.H"
#include "core/messages/Error.H"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr double pi = std::numbers::pi;

// Where f goes from below 0 to above it.
template<class F>
double rootOf(const F& f, double low, double high)
{
    constexpr int halvings = 45;
    for (int k = 0; k < halvings; ++k)
    {
        const double middle = 0.5*(low + high);
        (f(middle) < 0 ? low : high) = middle;
    }
    return 0.5*(low + high);
}

// The least angle [degrees] at which f does so; nothing where it does not.
template<class F>
std::optional<double> firstRootOf(const F& f)
{
    constexpr double first = 6, step = 12;
    if (!(f(first) < 0)) return {};
    for (double phi = first + step; phi < 180; phi += step) if (f(phi) >= 0) return rootOf(f, phi - step, phi);
    return {};
}

// A point of the surface.
struct Point
{
    double r, z, psi;
};

}

SphereInBath::SphereInBath(double bathRadius, double radius, double capillaryLength, double theta)
:
    bathRadius_(bathRadius), radius_(radius), capillaryLength_(capillaryLength), theta_(radians(theta))
{
    if (!(radius > 0 && bathRadius > radius && capillaryLength > 0 && theta >= 0 && theta <= 180))
    {
        throw FatalError("A sphere in a bath needs a radius below that of the bath, a capillary length above 0, and a contact angle from 0 to 180 degrees");
    }
}

// That with which the surface comes to the wall; or half a turn where it does not.
double SphereInBath::slopeAtWall(double r, double z, double psi) const
{
    const double step = 2e-2*std::min(capillaryLength_, bathRadius_ - radius_), l2 = capillaryLength_*capillaryLength_;
    const auto along = [&](const Point& at, const Point& change, double ds) { return Point{at.r + ds*change.r, at.z + ds*change.z, at.psi + ds*change.psi}; };
    const auto change = [l2](const Point& at) { return Point{std::cos(at.psi), std::sin(at.psi), at.z/l2 - std::sin(at.psi)/at.r}; };
    Point now{r, z, psi};
    while (now.r < bathRadius_ && std::abs(now.psi) < pi)
    {
        // Runge and Kutta's fourth order.
        const Point a = change(now), b = change(along(now, a, 0.5*step)), c = change(along(now, b, 0.5*step)), d = change(along(now, c, step));
        now = along(along(along(along(now, a, step/6), b, step/3), c, step/3), d, step/6);
    }
    return now.psi;
}

SphereInBath::Line SphereInBath::at(double phi) const
{
    const double angle = radians(phi), c = std::cos(angle), r = radius_*std::sin(angle), psi = angle + theta_ - pi;
    const double most = 4*capillaryLength_ + radius_;
    const double z = rootOf([&](double height) { return slopeAtWall(r, height, psi); }, -most, most);
    const double below = pi*std::pow(radius_, 3)*(2 + c)*(1 - c)*(1 - c)/3;
    return {radius_*(1 - c) - z, below - z*pi*r*r + 2*pi*r*capillaryLength_*capillaryLength_*std::sin(psi), z};
}

double SphereInBath::lift(double depth) const
{
    const auto phi = firstRootOf([&](double angle) { return at(angle).depth - depth; });
    if (phi) return at(*phi).lift;
    std::ostringstream found;
    found << "The surface of the bath does not meet a sphere whose lowest point is " << depth << " m below the level";
    throw FatalError(found.str());
}

double SphereInBath::depthUnder(double load) const
{
    const auto phi = firstRootOf([&](double angle) { return at(angle).lift - load; });
    if (phi) return at(*phi).depth;
    std::ostringstream found;
    found << "A sphere as heavy as " << load << " m3 of the liquid sinks in the bath";
    throw FatalError(found.str());
}

}
