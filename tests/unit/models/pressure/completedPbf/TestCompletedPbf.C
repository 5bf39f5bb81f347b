// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/Motion.H"
#include "support/PairForceMeter.H"
#include "support/PressureReference.H"
#include "support/ReferenceKernels.H"
#include "support/SurfaceStates.H"
#include "support/VectorSum.H"

#include <algorithm>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// The largest pull that the tension allows, sigma/d.
scalar suctionOf(const Liquid& liquid)
{
    return liquid.units().toScaled(liquid.properties().surfaceTension, dimensions::surfaceTension) / liquid.spacing();
}

double averageOf(const std::vector<scalar>& density, double (*error)(double))
{
    double sum = 0;
    for (const scalar value : density) sum += error(value);
    return sum / double(density.size());
}

double compression(double density) { return std::max(density - 1, 0.0); }
double deviation(double density) { return std::abs(density - 1); }

// The cubic spline with support 2 over the lattice of spacing 1, over its half z >= 0, and over the half-space beyond 1/2.
struct Layer
{
    double lattice = 0, half = 0, beyond = 0;

    Layer()
    {
        const Reference<CubicSpline> W{2};
        for (const Vec3& r : latticeBlock(5, 5, 5, 1, {-2, -2, -2}))
        {
            lattice += W.W(norm(r));
            if (r.z >= 0) half += W.W(norm(r));
        }
        beyond = integrate(0.5, 2, 400, [&](double r) { return 2 * std::numbers::pi * r * (r - 0.5) * W.W(r); });
    }
};

}

// Walls at the sides and below, gas above. The layer at a wall is completed by the integral over the half-space, that at the
// surface divided by what is missing beyond half a spacing: the lattice's sums differ from integrals by 4 and 5 %, by which
// the density of these layers is off. The tables' interpolation: 1e-4.
TEST(CompletedPbf, TakesALatticeInATankToBeAtRest)
{
    LiquidCase drop({.walls = "tank { type box; min (0 0 0); max (8e-3 8e-3 1); }"});
    const auto points = latticeBlock(8, 8, 8, 1, {0.5f, 0.5f, 0.5f});
    drop.place(points);
    const auto converged = [&](const std::string& controls)
    {
        const auto pressure = makePressure(drop, "completedPbf", controls);
        drop.place(points);
        pressure->begin(0.1f);
        return pressure->converged(drop.liquid, drop.near, drop.walls);
    };
    EXPECT_TRUE(converged("minIterations 0; tolerance 0.03;"));
    EXPECT_FALSE(converged("minIterations 1; tolerance 0.03;"));
    const auto density = drop.inOrder(drop.liquid.density);
    EXPECT_LT(averageOf(density, deviation), 0.03);
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_NEAR(density[i], 1, 0.08) << i;      // edges by the union
    const Layer layer;
    const auto at = [&](int x, int y, int z) { return density[8 * (8 * z + y) + x]; };
    EXPECT_NEAR(at(4, 4, 4), 1, 2e-6);
    EXPECT_NEAR(at(4, 4, 0), layer.half / layer.lattice + layer.beyond, 1e-4);
    EXPECT_NEAR(at(0, 4, 4), layer.half / layer.lattice + layer.beyond, 1e-4);
    EXPECT_NEAR(at(4, 4, 7), layer.half / layer.lattice / (1 - layer.beyond), 1e-4);
}

// Half a ball on a plane, at 90 degrees: inside and at the wall as in the tank, at the rough surface of the lattice 0.04 on
// average. A flat sampled wall is the same plane, so densities differ by roundings.
TEST(CompletedPbf, TakesADropOnAWallToBeAtRest)
{
    std::vector<scalar> onAnalytic;
    for (const bool sampled : {false, true})
    {
        LiquidCase drop(caseOnFloor(sampled ? latticeBlock(33, 33, 1, 1, {-16, -16, -0.5f}) : std::vector<Vec3>()));
        const auto pressure = makePressure(drop, "completedPbf", "minIterations 0; tolerance 0.02;");
        auto points = latticeBall(8);
        points.erase(std::remove_if(points.begin(), points.end(), [](Vec3 x) { return x.z < 0; }), points.end());
        drop.place(points);
        pressure->begin(0.1f);
        EXPECT_TRUE(pressure->converged(drop.liquid, drop.near, drop.walls));
        const auto density = drop.inOrder(drop.liquid.density);
        EXPECT_LT(averageOf(density, deviation), 0.04);
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const bool inside = norm(points[i]) < 5.5f;
            ASSERT_NEAR(density[i], 1, inside ? 0.04 : 0.25) << i;
            if (sampled)
            {
                ASSERT_NEAR(density[i], onAnalytic[i], 1e-5) << i;
            }
        }
        onAnalytic = density;
    }
}

// A block of 0.94 spacings, 20 % too dense: it comes to rest at the tolerance, with all of its particles near rest density
// and the size that nine spacings have. It becomes rounder on the way, so its root mean square radius falls by 1 %.
TEST(CompletedPbf, ExpandsACompressedBlockToRestDensity)
{
    LiquidCase drop;
    const auto points = latticeBlock(9, 9, 9, 0.94f, {-4 * 0.94f, -4 * 0.94f, -4 * 0.94f});
    const auto before = makePressure(drop, "completedPbf", "");
    drop.place(points);
    before->begin(0.1f);
    EXPECT_FALSE(before->converged(drop.liquid, drop.near, drop.walls));
    EXPECT_GT(averageOf(drop.liquid.density.download(), compression), 0.15);

    const auto pressure = makePressure(drop, "completedPbf", "maxIterations 60; tolerance 1e-3; relaxation 0.5;");
    pressure->forget();                     // what the other one has left in the liquid
    const int iterations = iterate(*pressure, drop, 0.1f);
    EXPECT_GT(iterations, 2);
    EXPECT_LT(iterations, 60);
    const auto density = drop.liquid.density.download();
    EXPECT_LT(averageOf(density, compression), 1e-3);
    EXPECT_LT(averageOf(density, deviation), 0.015);
    double moment = 0, lattice = 0;
    for (const Vec3& x : vectors(drop.liquid.predicted)) moment += squared((1 / drop.liquid.spacing()) * x);
    for (const Vec3& x : points) lattice += squared((1 / 0.94f) * x);
    EXPECT_NEAR(std::sqrt(moment / lattice), 1, 0.01);
}

// One iteration against the formula over all pairs in double, with the depths of the reconstruction.
TEST(CompletedPbf, RaisesThePressureByItsFormula)
{
    for (const auto& [tension, dt] : {std::pair{true, 0.125f}, {true, 2.0f}, {false, 0.125f}})
    {
        LiquidCase drop;
        const auto model = tension ? makeTension(drop, "continuumSurfaceForce") : nullptr;
        const auto pressure = makePressure(drop, "completedPbf", "maxIterations 1; minIterations 1; relaxation 0.4; epsilon 0.01;");
        RandomNumbers random(3);
        auto points = latticeBlock(7, 7, 7, 1);
        disorder(points, 0.15f, random);
        drop.place(points);
        const auto surface = surfaceStates(drop);
        const Buffer<scalar>* field = pressure->keepPressure();
        ASSERT_NE(field, nullptr);
        pressure->begin(dt);
        ASSERT_FALSE(pressure->converged(drop.liquid, drop.near, drop.walls));
        pressure->correct(drop.liquid, drop.near, drop.walls);
        const auto p = drop.inOrder(*field);
        const auto density = drop.inOrder(drop.liquid.density);

        // Lengths in spacings, in which V = 1; squares of gradients in 1/d^2.
        const Reference<CubicSpline> W{2};
        const scalar d = drop.liquid.spacing();
        double latticeSum = 0, bulk = 0;
        for (const Vec3& r : latticeBlock(5, 5, 5, 1, {-2, -2, -2}))
        {
            latticeSum += W.W(norm(r));
            bulk += W.slope(norm(r)) * W.slope(norm(r));
        }
        const double lowest = tension ? -suctionOf(drop.liquid) : 0;
        int raised = 0, lowered = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            double sum = 0, squares = 0, gradient[3] = {0, 0, 0};
            for (std::size_t j = 0; j < points.size(); ++j)
            {
                const Vec3 r = points[i] - points[j];
                const double length = norm(r), slope = W.slope(length);
                sum += W.W(length) / latticeSum;
                if (i == j) continue;
                squares += slope * slope;
                gradient[0] += slope * r.x / length;
                gradient[1] += slope * r.y / length;
                gradient[2] += slope * r.z / length;
            }
            for (const double g : gradient) squares += g * g;
            // What is missing beyond the surface.
            const double s = surface[i].depth / d;
            const auto cap = [&](double r) { return 2 * std::numbers::pi * r * (r - s) * W.W(r); };
            const double rho = sum / (1 - (s < 2 ? integrate(s, 2, 400, cap) : 0));
            ASSERT_NEAR(density[i], rho, 1e-4) << i;        // the table's interpolation
            const double stiffness = 0.4 / (squares + 0.01 * bulk) * d * d * drop.liquid.restDensity() / (dt * dt);
            ASSERT_NEAR(p[i], std::max(stiffness * (rho - 1), lowest), 1e-4 * stiffness) << i;
            raised += p[i] > 0;
            lowered += p[i] < 0;
        }
        EXPECT_GT(raised, 50);
        EXPECT_EQ(lowered > 50, tension);
        // A short step finds the bound, a long one stays above it.
        const scalar least = *std::min_element(p.begin(), p.end());
        EXPECT_EQ(least == scalar(lowest), !(tension && dt == 2)) << least;
    }
}

// One correction against the formula over all pairs in double, with the floor's gradient as the integral over its half-space:
// columns that no other wall reaches, in a tank of jittered liquid. The table's gradient is interpolated to 3e-3
// of its largest, 0.7/d, and multiplied by up to 0.3. Ordering o times as strong: p_j + (2 o - 1) p_i in the sum, 2 o p_i with
// the floor, and -2 (o - 1) p_i with what a planar surface at the particle's depth has.
void expectDisplacements(scalar ordering)
{
    constexpr scalar dt = 0.5f;
    LiquidCase drop({.walls = "tank { type box; min (0 0 0); max (8e-3 8e-3 1); }"});
    const auto pressure = makePressure
    (
        drop, "completedPbf",
        "maxIterations 1; minIterations 1; relaxation 1; ordering " + std::to_string(ordering) + ";"
    );
    RandomNumbers random(6);
    auto points = latticeBlock(8, 8, 8, 1, {0.5f, 0.5f, 0.85f});        // so far from the floor that nothing is stopped there
    disorder(points, 0.15f, random);
    drop.place(points);
    pressure->begin(dt);
    ASSERT_FALSE(pressure->converged(drop.liquid, drop.near, drop.walls));
    pressure->correct(drop.liquid, drop.near, drop.walls);
    const auto p = drop.inOrder(*pressure->keepPressure());
    EXPECT_EQ(pressure->iterations(), 1);
    const auto moved = drop.inOrder(drop.liquid.predicted);
    const auto states = surfaceStates(drop);

    const Reference<CubicSpline> W{2};              // in spacings, in which V = 1
    const double d = drop.liquid.spacing(), strength = dt * dt / (drop.liquid.restDensity() * d * d);
    const auto halfSpace = [&](double s)            // the gradient of what fills it, away from x by s
    {
        const auto cap = [&](double r) { return std::numbers::pi * (r * r - s * s) * W.slope(r); };
        return s < 2 ? integrate(s, 2, 400, cap) : 0;
    };
    int compared = 0;
    double nearFloor = 0, nearSurface = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const Vec3 x = points[i];
        if (std::abs(x.x - 4) > 1.8f || std::abs(x.y - 4) > 1.8f) continue;
        ++compared;
        const double extra = 2 * (ordering - 1) * p[i];
        const double floor = (2 * p[i] + extra) * halfSpace(x.z), surface = extra * halfSpace(states[i].depth / d);
        Vector3 sum(0, 0, floor);
        if (surface != 0)
        {
            const Vec3 inward = states[i].gradient, m = 1 / norm(inward) * inward;
            sum += surface * Vector3(m.x, m.y, m.z);
        }
        for (std::size_t j = 0; j < points.size(); ++j)
        {
            const Vec3 r = x - points[j];
            if (j != i) sum += (p[i] + p[j] + extra) * W.slope(norm(r)) / norm(r) * Vector3(r.x, r.y, r.z);
        }
        nearFloor = std::max(nearFloor, std::abs(strength * floor));
        nearSurface = std::max(nearSurface, std::abs(strength * surface));
        expectMoved(moved[i], d, x, -strength * sum, 6e-4, i);
    }
    EXPECT_EQ(compared, 128);
    EXPECT_GT(nearFloor, 0.02);
    EXPECT_GE(nearSurface, 0.01 * (ordering - 1));
}

TEST(CompletedPbf, DisplacesByItsFormula)
{
    for (const scalar ordering : {1.0f, 1.5f, 2.0f}) expectDisplacements(ordering);
}

// Deep in liquid that is too thin every particle pulls; then the part of the disorder has the other sign, p_j - 5 p_i where
// p_j + 3 p_i stands under pressure: against two neighbours of equal p it moves from where they are dense.
TEST(CompletedPbf, KeepsOrderUnderSuction)
{
    constexpr scalar dt = 0.5f;
    LiquidCase drop;
    const auto tension = makeTension(drop, "continuumSurfaceForce");
    const auto pressure = makePressure(drop, "completedPbf", "maxIterations 1; minIterations 1; relaxation 1; ordering 1.4;");
    RandomNumbers random(7);
    auto points = latticeBlock(11, 11, 11, 1.06f);
    disorder(points, 0.1f, random);
    drop.place(points);
    pressure->begin(dt);
    ASSERT_FALSE(pressure->converged(drop.liquid, drop.near, drop.walls));
    pressure->correct(drop.liquid, drop.near, drop.walls);
    const auto p = drop.inOrder(*pressure->keepPressure());
    const auto moved = drop.inOrder(drop.liquid.predicted);

    const Reference<CubicSpline> W{2};              // in spacings, in which V = 1
    const double d = drop.liquid.spacing(), strength = dt * dt / (drop.liquid.restDensity() * d * d);
    int compared = 0;
    double farthest = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const Vec3 x = points[i];
        if (norm(x - Vec3{5.3f, 5.3f, 5.3f}) > 2) continue;
        ASSERT_LT(p[i], 0);
        ++compared;
        Vector3 sum(0, 0, 0);
        for (std::size_t j = 0; j < points.size(); ++j)
        {
            const Vec3 r = x - points[j];
            if (j != i) sum += (p[j] - 3.8 * p[i]) * W.slope(norm(r)) / norm(r) * Vector3(r.x, r.y, r.z);
        }
        // Some thirty terms of up to 0.05 spacings, each rounded to 1e-7, and positions of up to twelve units to 1e-6.
        expectMoved(moved[i], d, x, -strength * sum, 1e-5, i);
        farthest = std::max(farthest, std::abs(strength * sum.x));
    }
    EXPECT_GT(compared, 20);
    EXPECT_GT(farthest, 1e-3);
}

// Pairs leave the centroid where it is, and what ordering moved as a whole is taken back at the end of the step, in positions and
// velocities. Positions of up to eight units are rounded to 5e-7: 512 of them leave about 1e-5.
TEST(CompletedPbf, LeavesTheCentroidOfFreeLiquid)
{
    LiquidCase drop;
    const auto pressure = makePressure(drop, "completedPbf", "maxIterations 1; minIterations 1; relaxation 1;");
    RandomNumbers random(8);
    auto points = latticeBlock(8, 8, 8, 0.97f);
    disorder(points, 0.15f, random);
    drop.place(points);
    const auto before = vectors(drop.liquid.position);
    iterate(*pressure, drop, 0.5f);
    updateVelocities(drop.liquid, 0.5f);
    const VectorSum ordered = sumOfSteps(before, vectors(drop.liquid.position));
    EXPECT_GT(ordered.sizes, 5);
    EXPECT_GT(std::abs(ordered.components[0]), 0.01);
    RigidMotion().remove(drop.liquid, pressure->displacement(), {}, drop.walls, drop.surface.support(), 0.5f);
    const VectorSum steps = sumOfSteps(before, vectors(drop.liquid.position));
    const VectorSum speeds = sumOfSteps(std::vector<Vec3>(points.size()), drop.liquid.velocity.download());
    for (const double component : steps.components) EXPECT_NEAR(component, 0, 1e-4);
    for (const double component : speeds.components) EXPECT_NEAR(0.5 * component, 0, 1e-4);
}

// Everywhere too thin, and a step so short that the constraint would pull without end: each particle has the suction sigma/d,
// that is, none without tension, and then nothing moves. A new step begins at zero.
TEST(CompletedPbf, PullsNoMoreThanTheTensionAllows)
{
    for (const bool tension : {true, false})
    {
        LiquidCase drop;
        const auto model = tension ? makeTension(drop, "continuumSurfaceForce") : nullptr;
        const auto pressure = makePressure(drop, "completedPbf", "maxIterations 5; tolerance 0;");
        const auto points = latticeBlock(8, 8, 8, 1.08f);
        drop.place(points);
        const auto before = drop.inOrder(drop.liquid.predicted);
        EXPECT_EQ(iterate(*pressure, drop, 0.02f), 5);
        for (const scalar p : pressure->keepPressure()->download())
        {
            ASSERT_FLOAT_EQ(p, tension ? -suctionOf(drop.liquid) : 0);
        }
        const auto after = drop.inOrder(drop.liquid.predicted);
        scalar farthest = 0;
        for (std::size_t i = 0; i < after.size(); ++i) farthest = std::max(farthest, norm(after[i] - before[i]));
        EXPECT_EQ(farthest > 0, tension);
    }
}

// What the step before left does not count in the pressure of the next one.
TEST(CompletedPbf, BeginsEachStepWithoutPressure)
{
    LiquidCase drop;
    const auto pressure = makePressure(drop, "completedPbf", "maxIterations 1; minIterations 1;");
    drop.place(latticeBlock(8, 8, 8, 0.98f));
    std::vector<scalar> first;
    for (int step = 0; step < 2; ++step)
    {
        pressure->begin(0.02f);
        ASSERT_FALSE(pressure->converged(drop.liquid, drop.near, drop.walls));
        const auto moved = vectors(drop.liquid.predicted);
        pressure->correct(drop.liquid, drop.near, drop.walls);
        const auto p = pressure->keepPressure()->download();
        EXPECT_GT(*std::max_element(p.begin(), p.end()), 0);
        if (step == 0) first = p;
        EXPECT_EQ(p, first);
        drop.liquid.predicted.upload(placed(moved));
    }
}

// The increase that was looked at before a step was found to need no further iteration is no pressure: the same iterations by
// their number alone leave the same.
TEST(CompletedPbf, HasThePressureOfWhatItDisplacedBy)
{
    const auto pressureAfter = [](const std::string& controls, int& made)
    {
        LiquidCase drop;
        const auto pressure = makePressure(drop, "completedPbf", controls);
        drop.place(latticeBlock(8, 8, 8, 0.95f));
        made = iterate(*pressure, drop, 0.1f);
        return pressure->keepPressure()->download();
    };
    int untilTolerance = 0, byNumber = 0;
    const auto p = pressureAfter("minIterations 1; maxIterations 60; tolerance 0.01;", untilTolerance);
    ASSERT_LT(untilTolerance, 60);
    const auto same = pressureAfter("maxIterations " + std::to_string(untilTolerance) + "; tolerance 0;", byNumber);
    EXPECT_EQ(untilTolerance, byNumber);
    EXPECT_EQ(p, same);
}

TEST(CompletedPbf, RefusesControlsOutOfRange)
{
    LiquidCase drop;
    const std::pair<std::string, std::string> wrong[]
    {
        {"maxIterations", "0"}, {"minIterations", "11"}, {"tolerance", "-1"}, {"relaxation", "2"}, {"epsilon", "-1"},
        {"ordering", "0.9"}, {"ordering", "5"}
    };
    for (const auto& entry : wrong)
    {
        const auto make = [&] { makePressure(drop, "completedPbf", entry.first + " " + entry.second + ";"); };
        EXPECT_TRUE(holds(messageOf(make), {"system/solution", "'" + entry.first + "'"}));
    }
}
