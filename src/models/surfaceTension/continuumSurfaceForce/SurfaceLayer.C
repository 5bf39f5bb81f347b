// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/surfaceTension/continuumSurfaceForce/SurfaceLayer.H"

#include "maths/Simpson.H"
#include "models/surfaceTension/surfaceCurvature/SurfaceCurvature.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

constexpr double pi = 3.14159265358979323846;

// |G| at distance r from the centre of a sphere of radius R: the integral over its surface of W times the cosine towards r. At
// distance d from the point a ring of it has the area 2 pi (R/r) d dd and the cosine (r^2 + R^2 - d^2)/(2 r R).
double slopeAt(double r, double R, const WendlandC2& W)
{
    const double nearest = std::abs(r - R), farthest = std::min<double>(W.h, r + R);
    if (nearest >= farthest) return 0;
    const auto ring = [&](double d) { return pi / (r * r) * W.W(scalar(d)) * (r * r + R * R - d * d) * d; };
    return integrate(nearest, farthest, ring);
}

// |G| at a depth below a planar surface: the integral of W over the plane.
double slopeBelow(double depth, const WendlandC2& W)
{
    return depth < W.h ? integrate(depth, W.h, [&](double d) { return 2 * pi * d * W.W(scalar(d)); }) : 0;
}

double steepestSlope(const WendlandC2& W) { return slopeBelow(0, W); }

// What layers half a spacing, one and a half ... below a planar surface have of b |G|, over its integral.
double layersOverWhole(const WendlandC2& W, double spacing)
{
    const double steepest = steepestSlope(W);
    const auto force = [&](double depth)
    {
        const double slope = slopeBelow(depth, W);
        return surfaceWeight(scalar(slope / steepest)) * slope;
    };
    double layers = 0;
    for (double depth = 0.5 * spacing; depth < W.h; depth += spacing) layers += force(depth) * spacing;
    return layers / integrate(0, W.h, force);
}

}

std::vector<scalar> tabulateSurfaceLayer(const WendlandC2& W, scalar spacing, scalar largest)
{
    constexpr int half = 16, parts = 100;
    const double h = W.h, steepest = steepestSlope(W), layered = layersOverWhole(W, spacing);
    const auto layer = [&](double kappa)
    {
        const bool ball = kappa > 0;
        const double R = 2 / std::abs(kappa), towards = ball ? -1 : 1, depth = ball ? std::min(h, R) : h;
        double sum = 0;
        for (int k = 0; k < parts; ++k)
        {
            const double slope = slopeAt(R + towards * depth * (k + 0.5) / parts, R, W);
            sum += 2 * surfaceWeight(scalar(slope / steepest)) * slope * depth / parts;
        }
        return scalar(layered * sum);
    };
    std::vector<scalar> table(2 * half + 1);
    for (int k = 1; k <= half; ++k)
    {
        table[half + k] = layer(largest * k / half);
        table[half - k] = layer(-largest * k / half);
    }
    table[half] = 0.5f * (table[half - 1] + table[half + 1]);
    return table;
}

std::vector<scalar> tabulateDeeperPart(const WendlandC2& W)
{
    constexpr int entries = 65, layers = 4000;
    const double thickness = W.h / double(layers), steepest = steepestSlope(W);
    std::vector<scalar> table(entries);
    double slope = 0, force = 0;
    int entry = 0;
    for (int k = layers - 1; k >= 0; --k)           // from deep inside outwards, where both grow
    {
        const double depth = (k + 0.5) * thickness;
        slope += 2 * pi * depth * W.W(scalar(depth)) * thickness;
        while (entry < entries - 1 && entry <= slope / steepest * (entries - 1)) table[entry++] = scalar(force);
        force += surfaceWeight(scalar(slope / steepest)) * slope * thickness;
    }
    while (entry < entries) table[entry++] = scalar(force);
    for (scalar& part : table) part /= scalar(force);
    return table;
}

}
