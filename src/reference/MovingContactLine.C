// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/MovingContactLine.H"

#include "core/angles/Degrees.H"

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace shizuku
{

double movingAngle(double theta, double capillaryNumber, double logarithm)
{
    const double cube = std::pow(radians(theta), 3) + 9*capillaryNumber*logarithm;
    return std::min(180.0, degrees(std::cbrt(std::max(0.0, cube))));
}

double slidingForce(double theta, double capillaryNumber, double logarithm)
{
    constexpr int points = 360;
    double sum = 0;
    for (int i = 0; i < points; ++i)
    {
        const double c = std::cos(2*std::numbers::pi*i/points);
        sum -= std::cos(radians(movingAngle(theta, capillaryNumber*c, logarithm)))*c;
    }
    return 2*std::numbers::pi/points*sum;
}

double slidingSpeed(double theta, double force, double logarithm)
{
    // Speed and logarithm come in by their product alone.
    return slidingLogarithm(theta, 1, force)/logarithm;
}

double slidingLogarithm(double theta, double capillaryNumber, double force)
{
    const double most = std::pow(radians(theta), 3)/(9*capillaryNumber);
    const auto excess = [&](double logarithm) { return slidingForce(theta, capillaryNumber, logarithm) - force; };
    if (!(force > 0 && excess(most) >= 0)) return std::nan("");
    std::uintmax_t steps = 100;
    const auto [low, high] = boost::math::tools::toms748_solve(excess, 0.0, most, boost::math::tools::eps_tolerance<double>(40), steps);
    return 0.5*(low + high);
}

}
