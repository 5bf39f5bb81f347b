// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/ViscousDrop.H"

#include "core/messages/Error.H"
#include "reference/DropOscillation.H"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

namespace shizuku
{

namespace
{

using Complex = std::complex<double>;

// J_(order+1)(q)/J_order(q) by its continued fraction, from far enough inside on.
Complex besselRatio(double order, Complex q)
{
    const int depth = 40 + int(2*std::abs(q));
    Complex ratio = 0;
    for (int k = depth; k >= 1; --k) ratio = 1.0/(2*(order + k)/q - ratio);
    return ratio;
}

// What vanishes at a mode, over alpha^4 so that it is of order one. z: s over omega. oh: nu/(omega R^2).
Complex excess(int l, double oh, Complex z)
{
    const Complex q2 = z/oh, q = std::sqrt(q2), Q = besselRatio(l + 0.5, q);
    const Complex right = 2.0*q2*(l - 1.0)*(double(l) + (l + 1.0)*(q - 2.0*l*Q)/(q - 2.0*Q)) - q2*q2;
    return right*oh*oh - 1.0;
}

// By the secant's rule.
std::optional<Complex> rootNear(int l, double oh, Complex z)
{
    Complex before = z*Complex(1.001, 0.001), value = excess(l, oh, before);
    for (int k = 0; k < 100; ++k)
    {
        const Complex here = excess(l, oh, z);
        if (here == value) return std::abs(here) < 1e-9 ? std::optional(z) : std::nullopt;
        const Complex step = here*(z - before)/(here - value);
        before = z;
        value = here;
        z -= step;
        if (!std::isfinite(std::abs(z))) return std::nullopt;
        if (std::abs(step) < 1e-12*std::abs(z)) return z;
    }
    return std::nullopt;
}

// The least real root, between 0 and what the slowest creeping could be: the excess begins at -1.
std::optional<double> creepingRoot(int l, double oh)
{
    // Of creeping motion, which it comes to for large viscosities and is faster than.
    const double creeping = (2*l + 1.0)/(2*(l - 1.0)*(2*l*l + 4*l + 3))/oh;
    double low = 0;
    for (double high = 0.02*creeping; high < 4*creeping; high += 0.02*creeping)
    {
        if (excess(l, oh, high).real() < 0)
        {
            low = high;
            continue;
        }
        for (int k = 0; k < 100; ++k)
        {
            const double middle = 0.5*(low + high);
            (excess(l, oh, middle).real() < 0 ? low : high) = middle;
        }
        return low;
    }
    return std::nullopt;
}

}

DropMode viscousDropMode(int mode, double nu, double sigma, double rho, double radius)
{
    const double omega = dropFrequency(mode, sigma, rho, radius), wanted = nu/(omega*radius*radius);
    // From Lamb's limit on, in small steps: each root is near the one before.
    double oh = std::min(wanted, 1e-3);
    std::optional<Complex> root = rootNear(mode, oh, {(mode - 1.0)*(2*mode + 1)*oh, 1});
    while (root && root->imag() > 1e-6 && oh < wanted)
    {
        oh = std::min(1.02*oh, wanted);
        root = rootNear(mode, oh, *root);
    }
    if (root && root->imag() > 1e-6 && root->real() > 0) return {omega*root->real(), omega*root->imag()};
    if (const auto creeping = creepingRoot(mode, wanted)) return {omega**creeping, 0};
    throw FatalError("The mode of a viscous drop was not found");
}

}
