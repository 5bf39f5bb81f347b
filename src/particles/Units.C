// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/Units.H"

#include <cmath>

namespace shizuku
{

namespace
{

double nearestPowerOfTwo(double x)
{
    return std::exp2(std::round(std::log2(x)));
}

}

Units Units::near(double spacing, double time, double mass)
{
    return {nearestPowerOfTwo(spacing), nearestPowerOfTwo(time), nearestPowerOfTwo(mass)};
}

double Units::of(const Dimensions& dimensions) const
{
    const auto& e = dimensions.exponents;
    return std::pow(mass, e[0]) * std::pow(length, e[1]) * std::pow(time, e[2]);
}

}
