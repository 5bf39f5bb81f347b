// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/HalfSpace.H"

#include "maths/CohesionSpline.H"
#include "maths/Simpson.H"

#include <cmath>

namespace shizuku
{

namespace
{

constexpr double pi = 3.14159265358979323846;

// At distance r from the particle the half-space at distance s >= 0 holds a cap of the sphere: area 2 pi r (r - s), and
// the mean of cos over it, times its area, is pi (r^2 - s^2).
HalfSpaceValues outside(const KernelChoice& kernel, double s)
{
    const double h = supportOf(kernel);
    const CohesionSpline C{scalar(h)};
    return std::visit
    (
        [&](const auto& W) -> HalfSpaceValues
        {
            return
            {
                scalar(integrate(s, h, [&](double r) { return 2 * pi * r * (r - s) * W.W(scalar(r)); })),
                scalar(integrate(s, h, [&](double r) { return -pi * (r * r - s * s) * W.g(scalar(r)) * r; })),
                scalar(integrate(s, h, [&](double r) { return pi * (r * r - s * s) * C(scalar(r)); })),
                scalar(integrate(s, h, [&](double r) { return -4 * pi * r * (r - s) * W.g(scalar(r)); }))
            };
        },
        kernel
    );
}

}

std::vector<HalfSpaceValues> tabulateHalfSpace(const KernelChoice& kernel)
{
    constexpr int half = 128;
    const double h = supportOf(kernel);
    const HalfSpaceValues middle = outside(kernel, 0);
    std::vector<HalfSpaceValues> table(2 * half + 1);
    for (int i = 0; i <= half; ++i)
    {
        const HalfSpaceValues value = outside(kernel, h * i / half);
        table[half + i] = value;
        // Beyond the plane the other half-space is what is missing from the whole.
        table[half - i] =
        {
            2 * middle.density - value.density, value.gradient, value.cohesion, 2 * middle.drag - value.drag
        };
    }
    return table;
}

}
