// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/BashforthAdams.H"

#include "core/angles/Degrees.H"
#include "core/messages/Error.H"

#include <boost/math/tools/roots.hpp>
#include <boost/numeric/odeint.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

namespace shizuku
{

namespace
{

namespace odeint = boost::numeric::odeint;
namespace roots = boost::math::tools;

using State = std::array<double, 4>;        // x, z, phi, V

void refuse(const std::string& what, double value)
{
    throw FatalError("A drop's profile needs " + what + ", not " + std::to_string(value));
}

// smallest: of the numbers that count. On a wide puddle all but x begin as small as the apex's curvature.
auto denseStepper(double smallest, double tolerance)
{
    return odeint::make_dense_output(tolerance*smallest, tolerance, odeint::runge_kutta_dopri5<State>());
}

// The equation in a unit of length in which neither curvature nor gravity is large.
class YoungLaplace
{
public:
    // gravity: 1 where it presses the drop onto its wall, -1 where it pulls at one that hangs.
    YoungLaplace(double apexRadius, double capillaryLength, int gravity, double tolerance)
    :
        unit_(1/(1/apexRadius + 1/capillaryLength)),
        apexCurvature_(unit_/apexRadius),
        gravity_(gravity*unit_*unit_/(capillaryLength*capillaryLength)), tolerance_(tolerance)
    {}

    double unit() const { return unit_; }   // m

    void operator()(const State& state, State& slope, double) const
    {
        const auto& [x, z, phi, volume] = state;
        const double around = x == 0 ? apexCurvature_ : std::sin(phi)/x;
        slope = {std::cos(phi), std::sin(phi), 2*apexCurvature_ + gravity_*z - around, std::numbers::pi*x*x*std::sin(phi)};
    }

    // The arc length at which phi reaches the angle [radians], or grows no more, as it may in a drop that hangs.
    double lengthTo(double angle) const
    {
        const auto excess = [&](const State& state)
        {
            State slope;
            (*this)(state, slope, 0);
            return std::max(state[2] - angle, -slope[2]);
        };
        auto stepper = denseStepper(apexCurvature_, tolerance_);
        stepper.initialize(State{}, 0, 1e-3);
        while (excess(stepper.current_state()) < 0) stepper.do_step(*this);
        if (excess(stepper.current_state()) == 0) return stepper.current_time();
        std::uintmax_t steps = 100;
        const auto [low, high] = roots::toms748_solve
        (
            [&](double s)
            {
                State state;
                stepper.calc_state(s, state);
                return excess(state);
            },
            stepper.previous_time(), stepper.current_time(), roots::eps_tolerance<double>(50), steps
        );
        return 0.5*(low + high);
    }

    std::vector<DropProfilePoint> points(double end, int count) const
    {
        std::vector<double> lengths;
        for (int i = 0; i < count; ++i) lengths.push_back(end*i/(count - 1));
        std::vector<DropProfilePoint> result;
        State state{};
        odeint::integrate_times
        (
            denseStepper(apexCurvature_, tolerance_), *this, state, lengths.begin(), lengths.end(), 1e-3*end,
            [&](const State& at, double s)
            {
                result.push_back({unit_*s, unit_*at[0], unit_*at[1], at[2], unit_*unit_*unit_*at[3]});
            }
        );
        return result;
    }

private:
    double unit_, apexCurvature_, gravity_, tolerance_;
};

DropProfile profileOf(double apexRadius, double capillaryLength, double contactAngle, int points, int gravity, double tolerance)
{
    if (!(apexRadius > 0 && std::isfinite(apexRadius))) refuse("a positive radius of its apex", apexRadius);
    if (!(capillaryLength > 0)) refuse("a positive capillary length", capillaryLength);
    if (!(contactAngle > 0 && contactAngle <= 180)) refuse("a contact angle above 0 and up to 180 degrees", contactAngle);
    const YoungLaplace equation(apexRadius, capillaryLength, gravity, tolerance);
    return {apexRadius, capillaryLength, equation.points(equation.lengthTo(radians(contactAngle)), points)};
}

}

DropProfile bashforthAdams(double apexRadius, double capillaryLength, double contactAngle, int points, double tolerance)
{
    return profileOf(apexRadius, capillaryLength, contactAngle, points, 1, tolerance);
}

DropProfile hangingDrop(double apexRadius, double capillaryLength, double contactAngle, int points, double tolerance)
{
    return profileOf(apexRadius, capillaryLength, contactAngle, points, -1, tolerance);
}

DropProfile bashforthAdamsWhere
(
    const std::function<double(const DropProfile&)>& excess, double fromRadius, double capillaryLength, double contactAngle,
    int points
)
{
    const auto excessAt = [&](double logRadius)
    {
        return excess(bashforthAdams(std::exp(logRadius), capillaryLength, contactAngle, 2));
    };
    double low = std::log(fromRadius), high = low;
    do
    {
        low = high;
        high += 0.5;
    }
    while (excessAt(high) < 0);
    if (excessAt(low) > 0) low -= 1e-6;     // rounding, where gravity does not count
    std::uintmax_t steps = 200;
    const auto [below, above] = roots::toms748_solve(excessAt, low, high, roots::eps_tolerance<double>(45), steps);
    return bashforthAdams(std::exp(0.5*(below + above)), capillaryLength, contactAngle, points);
}

DropProfile bashforthAdamsOfVolume(double volume, double capillaryLength, double contactAngle, int points)
{
    if (!(volume > 0 && std::isfinite(volume))) refuse("a positive volume", volume);
    // Gravity only flattens the apex: its radius is at least that of the cap without gravity.
    const double cap = std::cbrt(volume/bashforthAdams(1, HUGE_VAL, contactAngle, 2).volume());
    const auto excess = [&](const DropProfile& drop) { return std::log(drop.volume()/volume); };
    return bashforthAdamsWhere(excess, cap, capillaryLength, contactAngle, points);
}

}
