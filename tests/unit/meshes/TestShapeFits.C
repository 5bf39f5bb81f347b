// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/PlaneFit.H"
#include "meshes/SphereFit.H"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

using namespace shizuku;

namespace
{

// Points of the sphere's cap around +z down to the polar angle `opening`, by a golden-angle spiral.
std::vector<Vector3> capPoints(const Vector3& centre, double radius, double opening, int count)
{
    std::vector<Vector3> points;
    for (int i = 0; i < count; ++i)
    {
        const double z = 1 - (1 - std::cos(opening))*(i + 0.5)/count, phi = i*2*std::numbers::pi/std::numbers::phi;
        const double r = std::sqrt(1 - z*z);
        points.push_back(centre + radius*Vector3(r*std::cos(phi), r*std::sin(phi), z));
    }
    return points;
}

}

TEST(SphereFit, ExactPointsGiveTheExactSphere)
{
    const Vector3 centre(1e-3, -2e-3, 5e-4);
    for (const double opening : {0.2, 1.0, 3.0})
    {
        const auto fit = fitSphere(capPoints(centre, 1e-3, opening, 500));
        ASSERT_TRUE(fit);
        // Rounding of 1e-16, amplified by the flatness of the cap: (1/opening)^4 of the normal equations, 600 at 0.2.
        EXPECT_NEAR(fit->radius, 1e-3, 1e-3*1e-10) << opening;
        EXPECT_NEAR(length(fit->centre - centre), 0, 1e-3*1e-10) << opening;
        EXPECT_LT(fit->rms, 1e-3*1e-12) << opening;
    }
}

TEST(SphereFit, GeometricStepsRemoveTheBiasOfNoise)
{
    // 20,000 points of a hemisphere with 3 % noise: the geometric fit's radius scatters by about
    // 0.03/sqrt(20000)*2 = 4e-4; an algebraic fit alone is off by the noise squared, 1e-3.
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 0.03);
    auto points = capPoints({0, 0, 0}, 1, std::numbers::pi/2, 20000);
    for (Vector3& p : points) p *= 1 + noise(random);
    const auto fit = fitSphere(points);
    ASSERT_TRUE(fit);
    // The geometric optimum itself keeps a curvature bias of sigma^2/R (9e-4): both together.
    EXPECT_NEAR(fit->radius, 1, 1.5e-3);
    EXPECT_NEAR(fit->rms, 0.03, 0.03*0.02);     // chi's scatter: 1/sqrt(2 n) = 0.5 %, four times
}

TEST(SphereFit, RefusesPointsThatDetermineNoSphere)
{
    EXPECT_FALSE(fitSphere({}));
    EXPECT_FALSE(fitSphere({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_FALSE(fitSphere({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {2, 1, 1}}));
    EXPECT_FALSE(fitSphere({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}));
}

TEST(PlaneFit, FindsATiltedPlaneOfALattice)
{
    const Vector3 normal = normalized({1, 2, 3}), point(3e-3, -1e-3, 2e-3);
    const Vector3 u = normalized(cross(normal, {0, 0, 1})), v = cross(normal, u);
    std::vector<Vector3> points;
    for (int i = -10; i <= 10; ++i)
    {
        for (int j = -5; j <= 5; ++j) points.push_back(point + 1e-4*i*u + 1e-4*j*v);
    }
    const auto fit = fitPlane(points);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(std::abs(dot(fit->plane.normal, normal)), 1, 1e-14);
    EXPECT_NEAR(fit->plane.distance(point), 0, 1e-17);      // rounding of millimetres
    EXPECT_LT(fit->rms, 1e-3*1e-7);                         // the root of the variance's rounding
}

TEST(PlaneFit, RootMeanSquareIsThatOfTheHeights)
{
    std::vector<Vector3> points;                // heights +0.1 and -0.1 in a chequerboard: no tilt
    for (int i = 0; i < 10; ++i)
    {
        for (int j = 0; j < 10; ++j) points.push_back({double(i), double(j), (i + j) % 2 ? 0.1 : -0.1});
    }
    const auto fit = fitPlane(points);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->rms, 0.1, 1e-4);           // the chequerboard's ends tilt the plane by 1e-3 of the height
}

TEST(PlaneFit, RefusesPointsOnALine)
{
    EXPECT_FALSE(fitPlane({{0, 0, 0}, {1, 1, 1}}));
    EXPECT_FALSE(fitPlane({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}));
}
