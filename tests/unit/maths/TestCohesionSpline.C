// SPDX-License-Identifier: GPL-3.0-or-later
#include "maths/CohesionSpline.H"

#include "support/ReferenceKernels.H"

#include <gtest/gtest.h>

#include <numbers>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr scalar h = 1.7f;
const CohesionSpline C{h};
const scalar unit = 1 / scalar(std::numbers::pi * h * h * h);     // C(h/2) is half of it

}

TEST(CohesionSpline, IsContinuousAtHalfTheSupportAndAtTheSupport)
{
    // (h/2)^6 32/(pi h^9) = 1/(2 pi h^3) on either side; its slope there is 0 above and below.
    EXPECT_NEAR(C(0.5f * h), 0.5f * unit, 1e-6f * unit);
    EXPECT_NEAR(C(0.50001f * h), 0.5f * unit, 1e-6f * unit);
    EXPECT_NEAR(C(0.49999f * h), 0.5f * unit, 1e-6f * unit);
    EXPECT_NEAR(C(0.9999f * h), 0, 1e-6f * unit);
    EXPECT_EQ(C(h), 0);
    EXPECT_EQ(C(2 * h), 0);
    EXPECT_EQ(C(0), 0);                              // a particle does not act on itself
}

// 2 (q (1 - q))^3 = 1/64 has the root q = (1 - sqrt(1 - 2^(-1/3)))/2 = 0.2729.
TEST(CohesionSpline, RepelsBelowItsRootAndAttractsAbove)
{
    const scalar root = scalar(0.5 * (1 - std::sqrt(1 - std::cbrt(0.5)))) * h;
    EXPECT_NEAR(root / h, 0.2729, 1e-4);
    for (scalar r = 0.01f * h; r < 0.999f * root; r += 0.01f * h) ASSERT_LT(C(r), 0) << r;
    for (scalar r = 1.001f * root; r < 0.999f * h; r += 0.01f * h) ASSERT_GT(C(r), 0) << r;
    EXPECT_NEAR(C(1e-6f * h), -0.5f * unit, 1e-4f * unit);      // -32/64 of the unit at contact, with slope 0
}

TEST(CohesionSpline, ScalesAsOneOverTheVolume)
{
    const CohesionSpline twice{2 * h};
    for (const scalar q : {0.1f, 0.3f, 0.5f, 0.8f}) EXPECT_NEAR(8 * twice(2 * q * h), C(q * h), 2e-7f * unit) << q;
}

// The work to pull two half-spaces apart, which makes two surfaces: force per area at a gap is the pull of one
// half-space on all layers of the other. Integrated over shells and gap, without the closed form of Kirkwood and Buff.
TEST(CohesionSpline, CoefficientGivesTheWorkOfCohesion)
{
    const double support = 2.56e-4, density = 998, sigma = 0.0728;
    const double gamma = cohesionCoefficient(sigma, density, support);
    const CohesionSpline spline{scalar(support)};
    // Pull of a half-space on a unit mass at distance z, over cap angles: int C(r) cos(angle) 2 pi r^2 sin(angle).
    const auto pull = [&](double z)
    {
        return gamma * density * integrate(z, support, 200, [&](double r)
        {
            const double cosine = z / r;
            return spline(scalar(r)) * integrate(cosine, 1, 2, [&](double c) { return 2 * std::numbers::pi * r * r * c; });
        });
    };
    // Layers at depth z - gap; the pull on the layer at z acts for all gaps from 0 to z.
    const double work = density * integrate(1e-9 * support, support, 200, [&](double z) { return z * pull(z); });
    // Simpson's rule over a profile with a kink in its second derivative, in single precision: 1e-5.
    EXPECT_NEAR(work / 2, sigma, 1e-5 * sigma);
    EXPECT_DOUBLE_EQ(cohesionCoefficient(2 * sigma, density, support), 2 * gamma);
}
