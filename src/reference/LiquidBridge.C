// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/LiquidBridge.H"

#include "core/angles/Degrees.H"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace shizuku
{

namespace
{

// From the middle to a plate.
struct Meridian
{
    double foot, slope;         // at the plate
    double volume;              // of both halves
};

constexpr double steepest = 1e4;

Meridian meridian(double neck, double pressure, double half)
{
    constexpr int steps = 400;
    const double h = half/steps, end = std::numeric_limits<double>::infinity();
    const auto bend = [&](double r, double slope)
    {
        const double w = 1 + slope*slope;
        return w/r - pressure*w*std::sqrt(w);
    };
    double r = neck, slope = 0, volume = 0;
    for (int step = 0; step < steps; ++step)
    {
        // Runge and Kutta's fourth order, and Simpson's rule.
        const double a = bend(r, slope), slopeB = slope + h/2*a, rB = r + h/2*slope;
        const double b = bend(rB, slopeB), slopeC = slope + h/2*b, rC = r + h/2*slopeB;
        const double c = bend(rC, slopeC), slopeD = slope + h*c, rD = r + h*slopeC;
        const double d = bend(rD, slopeD);
        const double next = r + h/6*(slope + 2*slopeB + 2*slopeC + slopeD);
        volume += h/6*(r*r + 4*rC*rC + next*next);
        slope += h/6*(a + 2*b + 2*c + d);
        r = next;
        if (!(r > 0) || !(slope > -steepest)) return {0, -end, 0};
        if (slope > steepest) return {end, end, end};
    }
    return {r, slope, 2*std::numbers::pi*volume};
}

// The pressure at which the meridian meets the plates at the angle: the higher it is, the more the meridian bends in.
double pressureOf(double neck, double half, double slope)
{
    double low = 1/neck - 40/half, high = 1/neck + 40/half;
    for (int k = 0; k < 80; ++k)
    {
        const double middle = (low + high)/2;
        (meridian(neck, middle, half).slope > slope ? low : high) = middle;
    }
    return (low + high)/2;
}

}

LiquidBridge LiquidBridge::between(double height, double volume, double theta)
{
    const double half = height/2, slope = 1/std::tan(radians(theta));
    const auto volumeOf = [&](double neck) { return meridian(neck, pressureOf(neck, half, slope), half).volume; };
    const std::domain_error none("no bridge of that volume between these plates");
    double wide = 3*std::sqrt(volume/(std::numbers::pi*height)) + height, narrow = wide;
    do
    {
        wide = narrow;
        narrow *= 0.95;
        if (narrow < 1e-3*height) throw none;
    }
    while (volumeOf(narrow) > volume);
    for (int k = 0; k < 60; ++k)
    {
        const double middle = (wide + narrow)/2;
        (volumeOf(middle) > volume ? wide : narrow) = middle;
    }
    const double pressure = pressureOf(wide, half, slope);
    const Meridian found = meridian(wide, pressure, half);
    // Where meridians that blow up one way or the other are all that there is, the bisections end between them.
    if (!(std::abs(found.slope - slope) < 1e-6*(1 + std::abs(slope)) && std::abs(found.volume - volume) < 1e-6*volume)) throw none;
    return {wide, found.foot, pressure, 2*std::numbers::pi*(wide - pressure*wide*wide/2)};
}

}
