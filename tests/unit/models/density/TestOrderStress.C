// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/ForEach.H"
#include "models/density/OrderStress.H"
#include "support/PressureReference.H"
#include "support/ReferenceKernels.H"
#include "support/SurfaceStates.H"

#include <algorithm>
#include <array>
#include <map>

using namespace shizuku;
using namespace shizuku::test;

// Deep in a compressed, disordered block, in the second step at the same positions: the displacement has the pairs' part of the
// pressure's increase, and that of the stress p D, whose pressure is the first step's.
TEST(OrderStress, IsTakenOutOfThePressure)
{
    constexpr scalar dt = 0.5f;
    LiquidCase drop;
    const auto pressure = makePressure(drop, "completedPbf", "maxIterations 1; minIterations 1; ordering 1;");
    RandomNumbers random(7);
    auto points = latticeBlock(13, 13, 13, 0.97f);
    disorder(points, 0.1f, random);
    drop.place(points);
    const auto start = drop.liquid.predicted.download();
    std::vector<scalar> p;
    for (int step = 0; step < 2; ++step)
    {
        drop.liquid.predicted.upload(start);
        pressure->begin(dt);
        ASSERT_FALSE(pressure->converged(drop.liquid, drop.near, drop.walls));
        pressure->correct(drop.liquid, drop.near, drop.walls);
        p = drop.inOrder(*pressure->keepPressure());
    }
    const auto moved = drop.inOrder(drop.liquid.predicted);

    const Reference<CubicSpline> W{2};              // in spacings, in which V = 1
    const double d = drop.liquid.spacing(), strength = dt * dt / (drop.liquid.restDensity() * d * d);
    const Vec3 middle{5.82f, 5.82f, 5.82f};
    const auto gradient = [&](std::size_t i, std::size_t j)
    {
        const Vec3 r = points[i] - points[j];
        return W.slope(norm(r)) / norm(r) * Vector3(r.x, r.y, r.z);
    };
    using Tensor = std::array<std::array<double, 3>, 3>;
    std::map<std::size_t, Tensor> stress;           // r p D of those in the middle and of their neighbours
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        if (norm(points[i] - middle) > 3.5) continue;
        Tensor D{};
        for (std::size_t j = 0; j < points.size(); ++j)
        {
            if (j == i || norm(points[i] - points[j]) >= 2) continue;
            const Vec3 r = points[i] - points[j];
            const double arm[3] = {r.x, r.y, r.z};
            const Vector3 slope = gradient(i, j);
            for (int a = 0; a < 3; ++a)
            {
                for (int b = 0; b < 3; ++b) D[a][b] -= arm[a] * slope[b];
            }
        }
        const double third = (D[0][0] + D[1][1] + D[2][2]) / 3;
        for (int a = 0; a < 3; ++a) D[a][a] -= third;
        for (auto& row : D) for (double& value : row) value *= std::max(p[i], scalar(0));
        stress[i] = D;
    }
    int compared = 0;
    double largest = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        if (norm(points[i] - middle) > 1.2) continue;
        ++compared;
        Vector3 pairs(0, 0, 0), taken(0, 0, 0);
        for (std::size_t j = 0; j < points.size(); ++j)
        {
            if (j == i || norm(points[i] - points[j]) >= 2) continue;
            const Vector3 slope = gradient(i, j);
            pairs += (p[i] + p[j]) * slope;
            for (int a = 0; a < 3; ++a)
            {
                for (int b = 0; b < 3; ++b) taken[a] += (stress[i][a][b] + stress[j][a][b]) * slope[b];
            }
        }
        // Thirty terms of up to 0.05 spacings, each rounded to 1e-7, and positions of up to twelve units to 1e-6.
        expectMoved(moved[i], d, points[i], -strength * (pairs - taken), 1e-5, i);
        largest = std::max(largest, std::abs(strength * taken.x));
    }
    EXPECT_GT(compared, 5);
    EXPECT_GT(largest, 1e-4);                       // ten times the tolerance
}

namespace
{

// What a pressure of 1/r has taken out.
struct StoreDeviator
{
    CubicSpline W;
    scalar volume;
    Span<const Position> x;
    NeighbourView near;
    WallContribution walls;
    FreeSurfaceView surface;
    HalfSpaceView plane;
    KeptOrderStress stress;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        OrderStress::Moments moments;
        constraintSums(W, volume, i, x, near, team, moments);
        const bool atWall = walls.walls.isNear(i, x[i], W.h, team);
        const auto slopes = moments.over(team);
        stress.store(i, x[i], slopes, 1, surface(i), plane, walls, atWall, team);
    }
};

// q D of each particle, q going from 0 to 1 between `layer` (spacings) below the surface and the kernel's support.
std::vector<SymmTensor<Vec3>> deviators(const LiquidCase& drop, scalar layer)
{
    const Liquid& liquid = drop.liquid;
    const CubicSpline W = std::get<CubicSpline>(liquid.kernel());
    const ExtendedLiquid extended(liquid.kernel(), drop.walls.contactAngles(drop.surface.support()));
    Buffer<HalfSpaceValues> plane;
    plane.upload(tabulateHalfSpace(liquid.kernel()));
    Buffer<Vec3> ofParticle(liquid.owned());
    forEachTeam(liquid.owned(), StoreDeviator
    {
        W, liquid.particleVolume(), liquid.predicted.span(), drop.near.view(), {extended.view(), W.h, drop.walls.view(drop.liquid)},
        drop.surface.view(), {plane.span(), W.h}, {{1, layer * liquid.spacing()}, 1, ofParticle.span()}
    });
    std::vector<SymmTensor<Vec3>> result;
    for (const Vec3 words : drop.inOrder(ofParticle)) result.push_back(unpacked(words));
    return result;
}

// The part of a cubic lattice that is missing beyond a plane, half a spacing behind its last layer, at the distance s from a
// particle: along the normal, of the deviator of its sum over -r grad W; and of what a half-space has. In spacings.
struct MissingPart
{
    double lattice, completion;

    MissingPart(double s, double h)
    {
        const Reference<CubicSpline> W{h};
        double along = 0, across = 0;
        const int n = int(h) + 1;
        for (const Vec3 p : latticeBlock(2 * n + 1, 2 * n + 1, n, 1, {scalar(-n), scalar(-n), scalar(s + 0.5)}))
        {
            const double r = norm(p);
            if (r >= h) continue;
            along -= W.slope(r) / r * p.z * p.z;
            across -= W.slope(r) / r * p.x * p.x;
        }
        const double gradient = integrate(s, h, 1000, [&](double r) { return 2 * std::numbers::pi * r * W.W(r); });
        lattice = 2.0 / 3 * (along - across);
        completion = 2.0 / 3 * s * gradient;
    }
};

constexpr scalar halfWidth = 9;

// A cubic lattice on the side of the plane through the origin to which the normal n = (0.6 0 0.8) points, and its mirror image on
// the other side; lengths in spacings.
Vec3 turned(Vec3 p) { return p.x * Vec3{0.8f, 0, -0.6f} + p.y * Vec3{0, 1, 0} + p.z * Vec3{0.6f, 0, 0.8f}; }

std::vector<Vec3> halfSpace(scalar side)
{
    std::vector<Vec3> points = latticeBlock(19, 19, 18, 1, {-halfWidth, -halfWidth, side > 0 ? 0.5f : -17.5f});
    for (Vec3& p : points) p = turned(p);
    return points;
}

// D of the particle s below the middle of the plane, along its normal; the other components must be those of a tensor that is
// symmetrical about it.
double alongNormal(const std::vector<SymmTensor<Vec3>>& D, const std::vector<Vec3>& points, Vec3 place)
{
    const auto nearest = std::min_element(points.begin(), points.end(), [&](Vec3 a, Vec3 b)
    {
        return norm(a - place) < norm(b - place);
    });
    const SymmTensor<Vec3> own = D[nearest - points.begin()];
    const Vec3 n{0.6f, 0, 0.8f}, t{0.8f, 0, -0.6f}, onN = own * n, onT = own * t;
    // Sums of up to 270 terms of up to 0.1.
    EXPECT_NEAR(dot(onN, t), 0, 1e-4f);
    EXPECT_NEAR(onN.y, 0, 1e-4f);
    EXPECT_NEAR(dot(onT, t), -0.5f * dot(onN, n), 1e-4f);
    return dot(onN, n);
}

}

// In a lattice the whole sum is isotropic. Next to a plane D is what the half-space, which completes it, differs from the lattice
// that is missing: a third at half a spacing where the kernel reaches 2 of them, within 0.01 where it reaches 4, of 0.04 to 0.24 that
// are missing. FreeSurface.H tells the depth within 0.15 spacings of its lattice (TestFreeSurface.C); the wall's distance is exact.
TEST(OrderStress, VanishesNextToPlanesOfALattice)
{
    for (const int support : {2, 4})
    {
        const std::string kernel = "type cubicSpline; support " + std::to_string(support) + ";";
        LiquidCase open({.kernel = kernel});
        LiquidCase bounded
        ({
            .kernel = kernel, .walls = "floor { type plane; point (0 0 0); normal (0.6 0 0.8); }",
            .wettability = "floor { theta 90; }"
        });
        bounded.useWalls();
        for (LiquidCase* each : {&open, &bounded}) each->surface.require(each->liquid, scalar(2 * support), 0);
        const auto below = halfSpace(-1), above = halfSpace(1);
        open.place(below);
        bounded.place(above);
        const auto atSurface = deviators(open, -1e3f), atWall = deviators(bounded, -1e3f);       // q is 1 everywhere
        for (double s = 0.5; s < support - 1; ++s)
        {
            const MissingPart missing(s, support), deeper(s + 0.15, support), higher(s - 0.15, support);
            const double left = missing.completion - missing.lattice;
            const double depth = std::max
            (
                std::abs(deeper.completion - missing.completion), std::abs(higher.completion - missing.completion)
            );
            const double surface = alongNormal(atSurface, below, turned({0, 0, -scalar(s)}));
            const double wall = alongNormal(atWall, above, turned({0, 0, scalar(s)}));
            EXPECT_NEAR(surface, left, depth + 1e-4) << support << " " << s;
            EXPECT_NEAR(wall, left, 1e-4) << support << " " << s;
            // Without completion -missing.lattice were there.
            EXPECT_GT(missing.lattice, 0.04);
            EXPECT_LT(std::abs(left), support == 2 ? missing.lattice / 3 : 0.01);
            EXPECT_LT(std::abs(surface), missing.lattice / 2) << support << " " << s;
        }
        // Deep inside nothing is missing.
        EXPECT_NEAR(alongNormal(atSurface, below, turned({0, 0, -8.5f})), 0, 1e-4);
        EXPECT_NEAR(alongNormal(atWall, above, turned({0, 0, 8.5f})), 0, 1e-4);
    }
}

// q: nothing of the outermost layer, all of it where the surface is beyond the kernel's support, in between in proportion.
TEST(OrderStress, StaysInTheOutermostLayers)
{
    LiquidCase open({.kernel = "type cubicSpline; support 4;"});
    open.surface.require(open.liquid, 8, 0);
    const auto points = halfSpace(-1);
    open.place(points);
    const auto all = deviators(open, -1e3f), taken = deviators(open, 0.5f);
    for (const scalar s : {0.5f, 1.5f, 2.5f})
    {
        const Vec3 place = turned({0, 0, -s});
        // FreeSurface.H tells the depth within 0.15 spacings of its lattice.
        EXPECT_NEAR(alongNormal(taken, points, place) / alongNormal(all, points, place), (s - 0.5) / 3.5, 0.15 / 3.5) << s;
    }
}
