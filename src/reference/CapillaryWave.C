// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/CapillaryWave.H"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace shizuku
{

namespace
{

using Complex = std::complex<double>;

// exp(z^2) erfc(z), by a rational function of 32 terms (J. A. C. Weideman 1994, SIAM J. Numer. Anal. 31, 1497-1518): 12 digits.
Complex scaledErfc(Complex z)
{
    if (z.real() < 0) return 2.0*std::exp(z*z) - scaledErfc(-z);
    constexpr int terms = 32, points = 2*terms;
    constexpr double pi = std::numbers::pi;
    static const double L = std::sqrt(terms/std::numbers::sqrt2);
    static const auto coefficients = []
    {
        std::array<double, terms> a{};
        for (int k = 1 - points; k < points; ++k)
        {
            const double t = L*std::tan(0.5*pi*k/points), f = std::exp(-t*t)*(L*L + t*t);
            for (int n = 0; n < terms; ++n) a[n] += f*std::cos((n + 1)*pi*k/points)/(2*points);
        }
        return a;
    }();
    const Complex Z = (L - z)/(L + z);
    Complex sum = 0;
    for (int n = terms; n-- > 0;) sum = sum*Z + coefficients[n];
    return 2.0*sum/((L + z)*(L + z)) + 1.0/(std::sqrt(pi)*(L + z));
}

// All roots of z^4 + c3 z^3 + c2 z^2 + c1 z + c0, which differ (Durand and Kerner).
std::array<Complex, 4> quarticRoots(double c3, double c2, double c1, double c0)
{
    const double scale = std::pow(std::abs(c0), 0.25);
    std::array<Complex, 4> z;
    for (int i = 0; i < 4; ++i) z[i] = scale*std::pow(Complex(0.4, 0.9), i);
    for (int pass = 0; pass < 200; ++pass)
    {
        for (int i = 0; i < 4; ++i)
        {
            Complex others = 1;
            for (int j = 0; j < 4; ++j)
            {
                if (j != i) others *= z[i] - z[j];
            }
            z[i] -= ((((z[i] + c3)*z[i] + c2)*z[i] + c1)*z[i] + c0)/others;
        }
    }
    return z;
}

}

double CapillaryWave::frequency() const { return std::sqrt(sigma*k*k*k/(below + above)); }

double CapillaryWave::amplitude(double t) const
{
    const double beta = below*above/((below + above)*(below + above)), rate = nu*k*k, root = std::sqrt(rate), omega2 = std::pow(frequency(), 2);
    const double rest = (1 - 4*beta)*rate*rate;
    const auto z = quarticRoots(-4*beta*root, 2*(1 - 6*beta)*rate, 4*(1 - 3*beta)*rate*root, rest + omega2);
    Complex sum = 4*rest/(8*rest + omega2)*std::erfc(std::sqrt(rate*t));
    for (int i = 0; i < 4; ++i)
    {
        Complex others = 1;
        for (int j = 0; j < 4; ++j)
        {
            if (j != i) others *= z[j] - z[i];
        }
        sum += z[i]/others*omega2/(z[i]*z[i] - rate)*std::exp(-rate*t)*scaledErfc(z[i]*std::sqrt(t));
    }
    return sum.real();
}

double threadGrowth(double x, double sigma, double rho, double radius)
{
    return std::sqrt(sigma/(rho*std::pow(radius, 3))*x*(1 - x*x)*std::cyl_bessel_i(1, x)/std::cyl_bessel_i(0, x));
}

}
