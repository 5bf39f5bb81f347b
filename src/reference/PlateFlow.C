// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/PlateFlow.H"

#include <cmath>
#include <numbers>

namespace shizuku
{

double plateFlow(double height, double time)
{
    constexpr double shortest = 0.01;       // of it the plate at rest knows 1e-12
    if (time < shortest) return time > 0 ? stokesFirstProblem(height/std::sqrt(time)) : height > 0 ? 0 : 1;
    constexpr double pi = std::numbers::pi, negligible = 40;
    double sum = 1 - height;
    for (int n = 1; n*n*pi*pi*time < negligible; ++n) sum -= 2/(n*pi)*std::sin(n*pi*height)*std::exp(-n*n*pi*pi*time);
    return sum;
}

double stokesFirstProblem(double depth) { return std::erfc(0.5*depth); }

}
