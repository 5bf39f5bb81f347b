// SPDX-License-Identifier: GPL-3.0-or-later
// The surface's pressure on lattices whose curvature is known.

#include "models/surfaceTension/laplacePressure/DisorderMemory.H"
#include "support/ReferenceKernels.H"
#include "support/SurfaceForces.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

std::unique_ptr<SurfaceTension> makeLaplacePressure(LiquidCase& drop, const std::string& coeffs = {})
{
    const Dictionary models = Dictionary::parse("surfaceTension laplacePressure; laplacePressureCoeffs { " + coeffs + " }", "constant/models");
    return SurfaceTension::New(models, drop.liquid, drop.walls, drop.surface);
}

// What a pressure of 1 in all particles pushes out of the ball around the origin: 2 sum_j grad W_ij of the cubic spline with support 2, along
// the radius, of all particles together.
double pushedOut(const std::vector<Vec3>& points)
{
    const Reference<CubicSpline> W{2};
    double sum = 0;
    for (const Vec3& x : points)
    {
        for (const Vec3& other : points)
        {
            const Vec3 r = x - other;
            const double distance = norm(r);
            if (distance == 0 || distance >= 2) continue;
            sum -= 2 * W.slope(distance) / distance * dot(r, x) / norm(x);
        }
    }
    return sum;
}

}

// It holds 2 sigma/R, the same pressure in all particles: what that pushes out of the ball's surface, 2 p sum grad W, it pushes in. Of an
// o of 1.2 the part of the sum that a plane does not have counts 1.2 times. The lattice's curvature is read within 3 % (TestRegressedCurvature), and the part of
// the sum over depths that each particle's share is a mean of within 2 % more.
TEST(LaplacePressure, BalancesTheSamePressureInAllParticlesOfABall)
{
    for (const scalar radius : {7.3f, 10.0f})
    {
        const auto points = latticeBall(radius);
        const double R = std::cbrt(3 * double(points.size()) / (4 * std::numbers::pi));
        double inward[2] = {};
        Vec3 total;
        for (const int k : {0, 1})
        {
            LiquidCase drop;
            const auto tension = makeLaplacePressure(drop);
            drop.surface.agreed().ordering = k == 0 ? 1 : 1.2f;
            const auto force = tensionOf(drop, *tension, points);
            for (std::size_t i = 0; i < points.size(); ++i)
            {
                const double r = norm(points[i]);
                inward[k] -= dot(force[i], points[i]) / r;
                if (k == 0) total += force[i];
            }
        }
        EXPECT_NEAR(inward[0] / (2 / R * pushedOut(points)), 1, 0.05) << radius;
        EXPECT_NEAR(norm(total), 0, 1e-6 * inward[0]) << radius;        // of a thousand terms, by symmetry
        EXPECT_GT(inward[1], inward[0]) << radius;                      // a ball's surface misses more than a plane
        EXPECT_LT(inward[1] / inward[0], 1.06) << radius;               // a fifth of what it misses more, which is less than 0.3
    }
}

// However little the pressure's sum makes of what particles miss more than a plane, R is 1.03, and however much, 1.3.
TEST(LaplacePressure, FollowsDisorderBetweenItsBounds)
{
    const auto points = latticeBall(7.3f);
    const auto forces = [&](scalar ordering)
    {
        LiquidCase drop;
        const auto tension = makeLaplacePressure(drop);
        drop.surface.agreed().ordering = ordering;
        return tensionOf(drop, *tension, points);
    };
    const auto least = forces(0), lower = forces(-1), most = forces(100);
    scalar smallest = 10, largest = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        ASSERT_EQ(norm(least[i] - lower[i]), 0);
        if (norm(least[i]) == 0) continue;
        smallest = std::min(smallest, norm(most[i]) / norm(least[i]));      // 1 where a particle misses less than a plane
        largest = std::max(largest, norm(most[i]) / norm(least[i]));
    }
    EXPECT_NEAR(smallest, 1, 1e-5);                 // single precision
    EXPECT_NEAR(largest, 1.3 / 1.03, 1e-5);
}

// A ball that is cut out of a lattice of as many particles a volume, drawn out along x: what its order bears there is not what it bears across, and a
// pressure that takes the order's stress out again makes nothing of it.
TEST(LaplacePressure, FollowsNoStressThatThePressureTakesOut)
{
    constexpr scalar drawn = 1.1f, across = 0.953463f;       // 1/sqrt(1.1)
    std::vector<Vec3> points;
    for (const Vec3& x : latticeBall(13.0f))
    {
        const Vec3 place{drawn * x.x, across * x.y, across * x.z};
        if (norm(place) < 10.5f) points.push_back(place);
    }
    double share[2];                                         // of the force at the ends over that at the waist, for each particle's part of the surface
    for (const int removed : {0, 1})
    {
        LiquidCase drop;
        const auto tension = makeLaplacePressure(drop);
        drop.surface.agreed().ordering = 1.2f;
        drop.surface.agreed().orderRemoved = scalar(removed);
        const auto force = tensionOf(drop, *tension, points);
        double ends = 0, waist = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const double r = norm(points[i]), cosine = std::abs(points[i].x) / r, inward = -dot(force[i], points[i]) / r;
            if (cosine > 0.8) ends += inward / 0.2;
            else if (cosine < 0.5) waist += inward / 0.5;
        }
        share[removed] = ends / waist;
    }
    EXPECT_LT(share[0], 0.9);                                // 0.896: layers that lie farther apart along x miss less there
    EXPECT_GT(share[1], share[0] + 0.005);                   // 0.905; the outermost layer, of which nothing is taken out, keeps its part, and R its bounds
    EXPECT_LT(share[1], 1);
}

// Farther than two supports from the edges of a block, whose own force shows that the model acts. The normals differ by
// their roundings, 1e-7.
TEST(LaplacePressure, LeavesAPlaneAlone)
{
    LiquidCase drop({.walls = "far { type plane; point (0 0 -1); normal (0 0 1); }"});       // so that nothing is balanced
    const auto points = latticeBlock(29, 29, 8, 1, {-14, -14, -7.5f});
    const auto force = tensionOf(drop, *makeLaplacePressure(drop), points);
    scalar edge = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        edge = std::max(edge, norm(force[i]));
        if (std::max(std::abs(points[i].x), std::abs(points[i].y)) < 2.1f)
        {
            EXPECT_LT(norm(force[i]), 1e-6f) << points[i].z;
        }
    }
    EXPECT_GT(edge, 0.1f);
}

// A wedge on a wall of 0 degrees is drawn out over it, from 20 degrees on: its rim is a step of one spacing, whose convex edge alone would draw it
// back. Where the line is sought as far away as that of 0 degrees would be, that of 20 degrees is (-0.009 sigma).
TEST(LaplacePressure, DrawsAThinRimOutOverAWallThatItWets)
{
    for (const double wedge : {20.0, 30.0})
    {
        LiquidCase drop({.walls = floorPlane, .wettability = "floor { theta 0; }"});
        drop.useWalls();
        const auto points = latticeWedge(wedge, 12, 25, 6);
        const auto force = tensionOf(drop, *makeLaplacePressure(drop), points);
        double along = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            if (points[i].y == 0 && points[i].x > -5) along += force[i].x;
        }
        EXPECT_GT(along, 0.001) << wedge;
    }
}

// The rim of 20 degrees drawn apart along the wall, so that three fifths of the liquid stand on it: what would leave the liquid behind is not drawn
// out (0.0129 where the pull does not fade).
TEST(LaplacePressure, DrawsNothingOutOfAFilmThatIsStretched)
{
    LiquidCase drop({.walls = floorPlane, .wettability = "floor { theta 0; }"});
    drop.useWalls();
    constexpr scalar stretch = 1.3f;
    auto points = latticeWedge(20, 12, 25, 6);
    for (Vec3& x : points) x = {stretch * x.x, stretch * x.y, x.z};
    const auto force = tensionOf(drop, *makeLaplacePressure(drop), points);
    double along = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        if (points[i].y == 0 && points[i].x > -5 * stretch) along += force[i].x;
    }
    EXPECT_LT(along, 0.001);
}

// Per length of the contact line, in units of sigma, along the wall: of a wedge at the contact angle nothing, within 0.05 that the lattice leaves: it stands
// in layers, and the liquid beyond the wall does not (0.045 at 90 degrees). One that is steeper is
// drawn out over the wall, one that is flatter is drawn back, by Young's cos(theta) - cos(wedge), cut at the largest curvature and spread
// farther than what is summed over.
TEST(LaplacePressure, IsYoungsAtTheContactLine)
{
    for (const double wedge : {60.0, 90.0, 120.0})
    {
        for (const double theta : {wedge - 30, wedge, wedge + 30})
        {
            LiquidCase drop({.walls = floorPlane, .wettability = "floor { theta " + std::to_string(theta) + "; }"});
            drop.useWalls();
            const auto points = latticeWedge(wedge, 7, 25, 16);
            const auto force = tensionOf(drop, *makeLaplacePressure(drop), points);
            const double along = forceAlongWall(points, force, wedge);
            if (theta == wedge)
            {
                EXPECT_NEAR(along, 0, 0.05) << wedge;
                continue;
            }
            const double share = shareOfYoungs(along, theta, wedge);
            EXPECT_GT(share, 0.4) << wedge << " " << theta;
            EXPECT_LT(share, 1.2) << wedge << " " << theta;
        }
    }
}

// What a particle that rests, or moves at `speed` spacings a step, makes of 0.2 after so many steps of a hundredth of the memory, where it has had 0.1 before.
namespace
{

Remembered remembered(double degrees, scalar speed, int steps, int wall = 0)
{
    scalar before = 0.1f, now = 0;
    const Vec3 velocity{speed, 0, 0};
    ContactLine line;
    line.theta = scalar(degrees * std::numbers::pi / 180);
    line.wall = wall;
    Remembered disorder{};
    for (; steps > 0; --steps)
    {
        disorder = DisorderMemoryView{0.01f, 1, {&velocity, 1}, {}, {&before, 1}, {&now, 1}}(0, Position{}, line, 0.2f);
        before = now;
    }
    return disorder;
}

}

// A mean that forgets 1/e in its time, and at once what moves on by a spacing; nothing away from walls and where the surface faces them.
TEST(DisorderMemory, LagsBehindBesideWallsOnly)
{
    EXPECT_NEAR(remembered(120, 0, 100).more, 0.2 - 0.1 * std::pow(0.99, 100), 1e-5);       // single precision, a hundred times
    EXPECT_NEAR(remembered(120, 0.01f, 50).more, 0.2 - 0.1 * std::pow(0.98, 50), 1e-5);
    EXPECT_EQ(remembered(120, 1, 1).more, 0.2f);
    EXPECT_NEAR(remembered(147.5, 0, 1).more, 0.2 - 0.5 * 0.1 * 0.99, 1e-5);
    EXPECT_EQ(remembered(160.1, 0, 1).more, 0.2f);
    EXPECT_EQ(remembered(160.1, 2, 1).more, 0.2f);
    EXPECT_EQ(remembered(120, 0, 1, -1).more, 0.2f);
    EXPECT_EQ((DisorderMemoryView{}(0, Position{}, ContactLine{}, 0.2f).more), 0.2f);               // of a case without walls
}

// Long steps follow what is remembered wholly: so much of R is not of the moment.
TEST(DisorderMemory, SaysHowMuchIsNotOfTheMoment)
{
    EXPECT_FLOAT_EQ(remembered(120, 0, 1).share, 0.99f);
    EXPECT_FLOAT_EQ(remembered(120, 0.01f, 1).share, 0.98f);
    EXPECT_NEAR(remembered(147.5, 0, 1).share, 0.5 * 0.99, 1e-4);                                   // halfway from 135 to 160 degrees, of four digits
    EXPECT_EQ(remembered(120, 1, 1).share, 0);
    EXPECT_EQ(remembered(160.1, 0, 1).share, 0);
    EXPECT_EQ(remembered(120, 0, 1, -1).share, 0);
    EXPECT_EQ((DisorderMemoryView{}(0, Position{}, ContactLine{}, 0.2f).share), 0);
}

// The time that has passed, of which the lattice of the start is no more than its part, and at most 1000 capillary steps; in viscous liquid 10 d^2/nu.
TEST(DisorderMemory, IsNoLongerThanTheLiquidHasMoved)
{
    LiquidCase drop;
    drop.liquid.velocity.resize(1);
    DisorderMemory memory(drop.liquid);
    const auto forgotten = [&](scalar dt)
    {
        const scalar share = memory.view(drop.liquid, drop.walls, dt, 1).forgotten;
        memory.commit();
        return share;
    };
    EXPECT_EQ(forgotten(0.5f), 1);
    for (int step = 2; step <= 60; ++step) forgotten(0.5f);
    EXPECT_NEAR(forgotten(0.5f), 0.5 / 30, 1e-6);
    forgotten(5000);
    const LiquidProperties& properties = drop.liquid.properties();
    const double time = drop.liquid.units().of(dimensions::time), moved = drop.liquid.number("movedFor", 0) / time;
    drop.liquid.change(0, properties.surfaceTension);
    EXPECT_NEAR(forgotten(0.5f), 0.5 / 1000, 1e-8);
    drop.liquid.change(std::pow(properties.spacing, 2) / (20 * time), properties.surfaceTension);
    EXPECT_NEAR(forgotten(0.5f), 0.5 / 200, 1e-7);
    EXPECT_NEAR(moved, 5030.5, 5e-3);
}
