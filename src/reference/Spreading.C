// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/Spreading.H"

#include "reference/CapOnWall.H"

#include <cmath>
#include <numbers>

namespace shizuku
{

namespace
{

constexpr double rate = 0.471/4.49, power = 0.699;          // of the fit

}

const std::vector<WettedShare>& lavi2004()
{
    static const std::vector<WettedShare> measured
    {
        {4.17, 0.260}, {8.30, 0.349}, {14.83, 0.480}, {20.49, 0.570}, {30.06, 0.669}, {46.9, 0.780}, {82.3, 0.889}, {159, 0.957}, {303, 0.986}
    };
    return measured;
}

double fittedWettedShare(double time)
{
    return 1 - std::exp(-rate*std::pow(time, power));
}

double viscousSpreadingTime()
{
    const double final = capFootRadius(41);
    const double time = std::pow(-std::log(1 - 1/(final*final))/rate, 1/power);
    return time*std::cbrt(4*std::numbers::pi/3);                          // from V^(1/3) to R
}

double inertialSpreadingTime()
{
    return 1/(1.14*1.14);
}

double huppertRadius(double gravity, double volume, double nu, double time)
{
    return 0.894*std::pow(gravity*std::pow(volume, 3)/(3*nu)*time, 0.125);
}

}
