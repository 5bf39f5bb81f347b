// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of half-spaces against integration over cylindrical shells, which knows nothing of spherical caps.

#include "walls/HalfSpace.H"

#include "maths/CohesionSpline.H"
#include "support/ReferenceKernels.H"

#include <gtest/gtest.h>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr scalar support = 1.9f;

// int over the half-space z > s of f(r, z), z the distance towards the solid. Midpoint rule.
template<class Integrand>
double overHalfSpace(double s, const Integrand& f)
{
    constexpr int n = 300;
    double sum = 0;
    const double dz = (support - s) / n, dRho = support / n;
    for (int i = 0; i < n; ++i)
    {
        const double z = s + (i + 0.5) * dz;
        for (int j = 0; j < n; ++j)
        {
            const double rho = (j + 0.5) * dRho;
            const double r = std::hypot(rho, z);
            if (r < support) sum += 2 * std::numbers::pi * rho * f(r, z) * dz * dRho;
        }
    }
    return sum;
}

template<class Type>
class HalfSpace : public testing::Test
{
public:
    HalfSpaceValues operator()(scalar s) const
    {
        return HalfSpaceView{{table.data(), int(table.size())}, support}(s);
    }

    const std::vector<HalfSpaceValues> table = tabulateHalfSpace(Type(support));
    const Reference<Type> reference{support};
};

using Kernels = testing::Types<CubicSpline, Poly6Spiky, WendlandC2>;
TYPED_TEST_SUITE(HalfSpace, Kernels);

}

TYPED_TEST(HalfSpace, FillsHalfOfTheSupportAtThePlane)
{
    const auto& at = *this;
    // Simpson's rule and a sum in double, stored as scalar.
    EXPECT_NEAR(at(0).density, 0.5, 1e-6);
    EXPECT_NEAR(at(-support).density, 1, 1e-6);
    EXPECT_EQ(at(support).density, 0);
    for (scalar s = 0; s < support; s += 0.11f)
    {
        EXPECT_NEAR(at(s).density + at(-s).density, 1, 1e-6) << s;
        EXPECT_GE(at(s).gradient, 0) << s;
    }
    // Beyond the table its ends go on.
    EXPECT_EQ(at(2 * support).density, 0);
    EXPECT_NEAR(at(-2 * support).density, 1, 1e-6);
}

// Linear interpolation in steps of h/128 is off by at most f'' (h/128)^2/8, and f'' is below 40 f/h^2; the referee's
// midpoint rule by as much again. Both together stay below 3e-4 of the largest value.
TYPED_TEST(HalfSpace, HoldsTheIntegralsOfItsKernel)
{
    const auto& at = *this;
    const auto& reference = this->reference;
    const CohesionSpline C{support};
    const HalfSpaceValues largest{1, at(0).gradient, at(0.5f * support).cohesion, at(-support).drag};
    for (const scalar s : {-1.5f, -0.77f, -0.2f, 0.0f, 0.013f, 0.4f, 0.95f, 1.3f, 1.7f})
    {
        const auto value = at(s);
        const auto density = [&](double r, double) { return reference.W(r); };
        const auto gradient = [&](double r, double z) { return -reference.slope(r) * z / r; };
        const auto cohesion = [&](double r, double z) { return C(scalar(r)) * z / r; };
        const auto drag = [&](double r, double) { return -2 * reference.slope(r) / r; };
        EXPECT_NEAR(value.density, overHalfSpace(s, density), 3e-4 * largest.density) << s;
        EXPECT_NEAR(value.gradient, overHalfSpace(s, gradient), 3e-4 * largest.gradient) << s;
        EXPECT_NEAR(value.cohesion, overHalfSpace(s, cohesion), 3e-4 * largest.cohesion) << s;
        EXPECT_NEAR(value.drag, overHalfSpace(s, drag), 3e-4 * largest.drag) << s;
    }
}

// Of the kernel that gradients are taken of: int grad W over the half-space is the area integral of W over its plane.
TYPED_TEST(HalfSpace, GradientIsTheKernelsIntegralOverThePlane)
{
    for (const scalar s : {-1.2f, -0.3f, 0.0f, 0.5f, 1.0f, 1.6f})
    {
        const auto onPlane = [&](double rho)
        {
            return 2 * std::numbers::pi * rho * this->reference.smooth(std::hypot(rho, s));
        };
        const double expected = integrate(0, support, 2000, onPlane);
        EXPECT_NEAR((*this)(s).gradient, expected, 2e-4 * (*this)(0).gradient) << s;
    }
}

// Where values and gradients share a kernel, -d density/ds over two steps of the table: (h/64)^2 f'''/24 apart, and
// f''' < 100/h^3.
TEST(HalfSpaceOfCubicSpline, GradientIsTheSlopeOfTheDensity)
{
    const auto table = tabulateHalfSpace(CubicSpline(support));
    const double step = support / 128;
    for (std::size_t i = 1; i + 1 < table.size(); ++i)
    {
        const double slope = (double(table[i + 1].density) - table[i - 1].density) / (2 * step);
        ASSERT_NEAR(table[i].gradient, -slope, 1e-3 / support) << i;
    }
}
