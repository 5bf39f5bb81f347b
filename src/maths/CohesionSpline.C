// SPDX-License-Identifier: GPL-3.0-or-later
#include "maths/CohesionSpline.H"

namespace shizuku
{

double cohesionCoefficient(double sigma, double density, double support)
{
    constexpr double pi = 3.14159265358979323846;
    return 8 * sigma / (pi * density * density * support * support * separationIntegral(CohesionSpline{1}));
}

}
