// SPDX-License-Identifier: GPL-3.0-or-later
// The curvature on lattices, free and on walls.

#include "models/surfaceTension/surfaceCurvature/RegressedCurvature.H"

#include "support/LiquidCase.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

struct SeenCurvature
{
    Vec3 x;                                 // in spacings
    double kappa, share;                    // 1/spacings; beta
};

struct MeanCurvature
{
    double sum = 0, shares = 0;

    void add(double kappa, double share)
    {
        sum += share * kappa;
        shares += share;
    }

    double value() const { return sum / shares; }
};

// Of the particles near the surface.
std::vector<SeenCurvature> curvaturesOf(LiquidCase& drop, const std::vector<Vec3>& points)
{
    const Dictionary coeffs = Dictionary::parse("", "constant/models");
    RegressedCurvature curvature(coeffs, drop.liquid, drop.surface, 1);
    drop.place(points);
    CurvatureField field = curvature.normals(drop.liquid, drop.near, drop.walls);
    curvature.curvatures(field, drop.liquid, drop.near, drop.walls);
    const int found = int(drop.surface.particles().before.download().back());
    const auto kappa = download(field.curvature, found);
    const auto normal = download(field.normal, found);
    const auto indices = download(drop.surface.particles().indices, found);
    const auto id = drop.liquid.id.download();
    std::vector<SeenCurvature> seen;
    for (int k = 0; k < found; ++k)
    {
        if (squared(normal[k]) == 0) continue;
        seen.push_back({points[id[indices[k]]], kappa[k] * drop.liquid.spacing(), normal[k].w});
    }
    return seen;
}

}

// A lattice's surface is a staircase: single steps are read as they lie, their mean is the ball's. The largest deviation of these three is 3.6 %.
TEST(RegressedCurvature, OfABallIsTwoOverItsRadius)
{
    for (const scalar radius : {7.3f, 10.0f, 14.0f})
    {
        LiquidCase drop;
        const auto points = latticeBall(radius);
        const double R = std::cbrt(3 * double(points.size()) / (4 * std::numbers::pi));
        double sum = 0, shares = 0;
        for (const auto& [x, kappa, share] : curvaturesOf(drop, points))
        {
            sum += share * kappa;
            shares += share;
        }
        EXPECT_NEAR(sum / shares / (2 / R), 1, 0.04) << radius;
    }
}

// A ball that a wall cuts at its contact angle has the curvature that it has without the wall, layer by layer, as a mean over many balls: their staircases are the
// same with and without. What is left comes of the wall's wedge, which does not stand in layers as the lattice does: in the two layers at the wall up to 4, 6
// and 0.4 % (60, 90, 120 degrees; 7, 10 and 4 % if normals counted there as elsewhere), in the next one 2.6.
TEST(RegressedCurvature, OfACapAtItsContactAngleIsThatOfTheBall)
{
    for (const double middle : {60.0, 90.0, 120.0})
    {
        std::map<scalar, MeanCurvature> free, cut;               // by height
        for (const scalar centre : {-8.0f, -5.0f, -4.0f, 0.0f, 4.0f, 5.0f, 6.0f, 7.0f})
        {
            for (scalar radius = 8; radius <= 14; radius += 0.5f)
            {
                const double theta = std::acos(double(-centre / radius)) * 180 / std::numbers::pi;
                if (!(std::abs(theta - middle) < 4)) continue;
                LiquidCase ball, cap({.walls = floorPlane, .wettability = "floor { theta " + std::to_string(theta) + "; }"});
                cap.useWalls();
                std::vector<Vec3> whole = latticeBall(radius, {0, 0, centre}), above;
                std::copy_if(whole.begin(), whole.end(), std::back_inserter(above), [](Vec3 x) { return x.z > 0; });
                for (const auto& [x, kappa, share] : curvaturesOf(ball, whole)) free[x.z].add(kappa * radius, share);
                for (const auto& [x, kappa, share] : curvaturesOf(cap, above)) cut[x.z].add(kappa * radius, share);
            }
        }
        for (const scalar z : {0.5f, 1.5f, 2.5f, 3.5f})
        {
            EXPECT_NEAR(cut[z].value() / free[z].value(), 1, z < 2 ? 0.08 : 0.03) << middle << " degrees, height " << z;
        }
    }
}
