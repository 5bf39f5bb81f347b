// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/CapillaryRise.H"

#include "core/angles/Degrees.H"
#include "core/messages/Error.H"
#include "reference/MovingContactLine.H"

#include <boost/numeric/odeint.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace shizuku
{

namespace
{

using LevelAndSpeed = std::array<double, 2>;        // over R, and over R a second

double angleOf(const CapillaryRise& rise, double speed)
{
    if (!rise.slipLength) return rise.theta;
    return movingAngle(rise.theta, rise.rho*rise.nu*speed/rise.sigma, std::log(rise.radius/ *rise.slipLength));
}

}

double CapillaryRise::finalHeight() const
{
    return (isBetweenPlates ? 1 : 2)*sigma*std::cos(radians(theta))/(rho*gravity*radius*(1 + areaRatio));
}

std::vector<double> CapillaryRise::heights(double start, const std::vector<double>& times) const
{
    namespace odeint = boost::numeric::odeint;
    constexpr double tolerance = 1e-9;
    if (!(immersion + start + entry*radius > 0)) throw FatalError("A column that rises needs a length at the start");
    const auto slope = [&](const LevelAndSpeed& state, LevelAndSpeed& change, double)
    {
        const auto& [level, speed] = state;
        const double column = immersion/radius + level;
        const double tension = (isBetweenPlates ? 1 : 2)*sigma*std::cos(radians(angleOf(*this, radius*speed)))/(rho*std::pow(radius, 3));
        const double friction = (isBetweenPlates ? 3 : 8)*nu/(radius*radius)*(column + entryFriction)*speed;
        const double entering = speed*std::max(speed, 0.0);
        change = {speed, (tension - (1 + areaRatio)*gravity/radius*level - friction - entering)/(column + entry)};
    };
    LevelAndSpeed state{start/radius, 0};
    std::vector<double> result;
    const auto dense = odeint::make_dense_output(tolerance, tolerance, odeint::runge_kutta_dopri5<LevelAndSpeed>());
    odeint::integrate_times
    (
        dense, slope, state, times.begin(), times.end(), 1e-6*std::max(times.back(), 1e-30),
        [&](const LevelAndSpeed& at, double) { result.push_back(radius*at[0]); }
    );
    return result;
}

}
