// SPDX-License-Identifier: GPL-3.0-or-later
// The surface's force on lattices whose curvature is known.

#include "models/forces/RigidMotion.H"
#include "models/surfaceTension/SurfaceTension.H"
#include "models/surfaceTension/continuumSurfaceForce/SurfaceLayer.H"

#include "core/angles/Degrees.H"
#include "support/LiquidCase.H"
#include "support/ReferenceKernels.H"
#include "support/SurfaceForces.H"
#include "support/SurfaceStates.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

std::unique_ptr<SurfaceTension> makeContinuumForce(LiquidCase& drop, const std::string& coeffs = "")
{
    const Dictionary models = Dictionary::parse
    (
        "surfaceTension continuumSurfaceForce; continuumSurfaceForceCoeffs { " + coeffs + " }", "constant/models"
    );
    return SurfaceTension::New(models, drop.liquid, drop.walls, drop.surface);
}

}

// Layers so thin that their sum is the integral, within 1e-4: its error goes with the square.
constexpr scalar thin = 0.02f;

// A sphere as large as the table's flattest has a plane's sum, whose integral is computed here by itself: b grows from 0 at a tenth of the
// plane's slope to 1 at all of it.
TEST(SurfaceLayer, AddsUpTheForceBelowAPlane)
{
    const Reference<WendlandC2> W{4};
    const auto ring = [&](double r) { return 2 * std::numbers::pi * r * W.W(r); };
    const auto slope = [&](double s) { return integrate(s, 4, 400, ring); };
    const double steepest = slope(0);
    const double expected = integrate(0, 4, 400, [&](double s)
    {
        return 2 * std::max((slope(s) / steepest - 0.1) / 0.9, 0.0) * slope(s);
    });
    const auto table = tabulateSurfaceLayer(WendlandC2(4), thin, 0.7f);
    EXPECT_NEAR(table[table.size() / 2], expected, 1e-3);
    const SurfaceLayerView view{{table.data(), int(table.size())}, {}, 0.7f};
    EXPECT_EQ(view.sum(-1), table.front());                     // beyond its ends
    EXPECT_EQ(view.sum(1), table.back());
    EXPECT_NEAR(view.sum(0), expected, 1e-3);
}

// A ball of radius h around a point of a ball's surface holds less liquid than gas, of a hollow one more: the inner side has the more of the
// force, the more it bulges.
TEST(SurfaceLayer, GrowsWithTheCurvature)
{
    const auto table = tabulateSurfaceLayer(WendlandC2(4), thin, 0.5f);
    for (std::size_t k = 1; k < table.size(); ++k) EXPECT_GT(table[k], table[k - 1]) << k;
    EXPECT_GT(table.back() / table[table.size() / 2], 1.05f);
}

// Layers that are drawn together or apart by 5 % have the same force, within 0.6 % with the smallest support: L of them over that of the spacing.
TEST(SurfaceLayer, IsTheSameHoweverFarTheLayersStandApart)
{
    for (const scalar support : {3.0f, 3.25f, 4.0f})
    {
        scalar least = 1e9f, most = 0;
        for (const scalar spacing : {0.95f, 0.97f, 0.99f, 1.0f, 1.01f, 1.03f, 1.05f})
        {
            const auto table = tabulateSurfaceLayer(WendlandC2(support), spacing, 0.7f);
            const scalar middle = table[table.size() / 2];
            least = std::min(least, middle);
            most = std::max(most, middle);
        }
        EXPECT_LT(most / least - 1, 0.006f) << support;
    }
}

// What lies deeper than s below a plane, as a part of all: the integral of b |G| from there on. Nothing where b is none. At the surface all
// of it, where |G| is flat in s: between two entries, a root of their distance.
TEST(SurfaceLayer, KnowsWhichPartOfTheForceLiesDeeper)
{
    const Reference<WendlandC2> W{4};
    const auto ring = [&](double r) { return 2 * std::numbers::pi * r * W.W(r); };
    const auto slope = [&](double s) { return integrate(s, 4, 400, ring); };
    const double steepest = slope(0);
    const auto force = [&](double s) { return std::max((slope(s) / steepest - 0.1) / 0.9, 0.0) * slope(s); };
    const auto table = tabulateDeeperPart(WendlandC2(4));
    const SurfaceLayerView view{{}, {table.data(), int(table.size())}, 1};
    const double all = integrate(0, 4, 400, force);
    for (const double s : {0.5, 1.0, 1.5, 2.0, 3.0})
    {
        EXPECT_NEAR(view.deeper(scalar(slope(s) / steepest)), integrate(s, 4, 400, force) / all, 2e-3) << s;
    }
    EXPECT_EQ(view.deeper(0), 0);
    EXPECT_EQ(view.deeper(1), 1);
    EXPECT_LT(view.deeper(0.1f), 1e-5f);
}

// The pressure that the force holds in a ball is Laplace's, 2 sigma/R with R from the particles' volume: the sum over shells of what
// presses on them, over their areas. It has no resultant. A lattice's surface is rough: 3 %.
TEST(ContinuumSurfaceForce, HoldsLaplacesPressureInABall)
{
    for (const scalar radius : {6.0f, 7.3f, 8.0f, 10.0f, 13.0f})
    {
        LiquidCase drop;
        const auto tension = makeContinuumForce(drop);
        const auto points = latticeBall(radius);
        const auto force = tensionOf(drop, *tension, points);
        const double R = std::cbrt(3 * double(points.size()) / (4 * std::numbers::pi));
        double pressure = 0, inward = 0;
        Vec3 total;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const double r = norm(points[i]);
            if (r == 0) continue;
            total += force[i];
            const double in = -dot(force[i], points[i]) / r;
            inward += in;
            pressure += in / (4 * std::numbers::pi * r * r);
        }
        EXPECT_NEAR(pressure / (2 / R), 1, 0.03) << radius;
        EXPECT_NEAR(norm(total), 0, 1e-6 * inward) << radius;           // of a thousand terms, by symmetry
    }
}

// A free body is not set moving as a whole, however its particles lie: 512 ways, each rounded to whole 2^-31 of a unit, over a step of 0.01, make 3e-7 along each axis, root mean square,
// where the largest velocity is 7e-3. Four times that.
TEST(ContinuumSurfaceForce, DoesNotMoveFreeLiquidAsAWhole)
{
    LiquidCase drop;
    const auto tension = makeContinuumForce(drop);
    RandomNumbers random(3);
    auto points = latticeBlock(8, 8, 8, 1);
    disorder(points, 0.2f, random);
    drop.place(points);
    Buffer<Vec3> acceleration(drop.liquid.all());
    acceleration.setZero();
    tension->apply(drop.liquid, drop.near, drop.walls, acceleration);
    const scalar dt = 0.01f;
    auto velocities = acceleration.download();
    for (Vec3& u : velocities) u = dt * u;
    drop.liquid.velocity.upload(velocities);
    const auto sumAndLargest = [&]
    {
        Vector3 sum(0, 0, 0);
        double largest = 0;
        for (const Vec3 u : drop.liquid.velocity.download())
        {
            sum += Vector3(u.x, u.y, u.z);
            largest = std::max(largest, double(norm(u)));
        }
        return std::pair{std::sqrt(squaredLength(sum)), largest};
    };
    EXPECT_GT(sumAndLargest().first, 0.1 * sumAndLargest().second);     // there is something to take back
    ASSERT_TRUE(tension->isInternal());
    RigidMotion().remove(drop.liquid, {}, {std::as_const(acceleration).span(), dt * dt}, drop.walls, drop.surface.support(), dt);
    EXPECT_LT(sumAndLargest().first, 3e-4 * sumAndLargest().second);
}

// Farther than two supports from the edges of a block, whose own force shows that the model acts. The normals differ by
// their roundings, 1e-7.
TEST(ContinuumSurfaceForce, LeavesAPlaneAlone)
{
    LiquidCase drop({.walls = "far { type plane; point (0 0 -1); normal (0 0 1); }"});       // so that nothing is balanced
    const auto tension = makeContinuumForce(drop);
    const auto points = latticeBlock(29, 29, 8, 1, {-14, -14, -7.5f});
    const auto force = tensionOf(drop, *tension, points);
    scalar edge = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        edge = std::max(edge, norm(force[i]));
        const bool inside = std::max(std::abs(points[i].x), std::abs(points[i].y)) < 2.1f;
        if (inside)
        {
            EXPECT_LT(norm(force[i]), 1e-6f) << points[i].z;
        }
    }
    EXPECT_GT(edge, 0.1f);
}

// Below a wave z = A cos(q x), whose curvature is A q^2 cos(q x), the force is the gradient of -sigma kappa psi: in each layer it pushes
// along the surface, from where it bulges to where it is hollow, by sigma psi A q^3 sin(q x), with psi of the layer's |G|. A is small
// beside the wave's length; over the supports of colour, normals and curvature waves of 30 d are smoothed by a tenth to a sixth.
TEST(ContinuumSurfaceForce, PushesAlongTheSurfaceWhereTheCurvatureChanges)
{
    LiquidCase drop({.walls = "far { type plane; point (0 0 -20); normal (0 0 1); }"});
    const auto tension = makeContinuumForce(drop);
    const scalar length = 30, q = 2 * std::numbers::pi_v<scalar> / length, A = 1;
    auto points = latticeBlock(61, 21, 8, 1, {-30, -10, -7.5f});
    for (Vec3& p : points) p.z += A * std::cos(q * p.x);
    const auto force = tensionOf(drop, *tension, points);
    const auto states = surfaceStates(drop);
    const auto table = tabulateDeeperPart(drop.surface.kernel());
    const SurfaceLayerView view{{}, {table.data(), int(table.size())}, 1};
    for (const scalar depth : {0.5f, 1.5f})
    {
        double along = 0, expected = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const Vec3 x = points[i];
            if (x.y != 0 || std::abs(x.x) > 15 || std::abs(x.z - A * std::cos(q * x.x) + depth) > 0.1f) continue;
            const scalar slope = -A * q * std::sin(q * x.x);
            const Vec3 f = force[i];
            const double tangential = (f.x + slope * f.z) / std::sqrt(1 + slope * slope);
            const double psi = view.deeper(norm(states[i].gradient) / drop.surface.steepest());
            along += tangential * std::sin(q * x.x);
            expected += psi * A * q * q * q * std::sin(q * x.x) * std::sin(q * x.x);
        }
        EXPECT_GT(expected, 0) << depth;
        EXPECT_NEAR(along / expected, 0.88, 0.1) << depth;
    }
}

// Per length of the contact line, in units of sigma, along the wall. At the contact angle nothing: a lattice in front of the
// wall and integrals behind it leave 0.02, and 0.016 of a particle. A wedge that is steeper than the contact angle is drawn out over the wall, one that
// is flatter is drawn back, by Young's cos(theta) - cos(wedge); the force is cut at the largest curvature and spread over
// four supports, not all of which are summed over, so that of it 0.4 to 1.1 is seen.
TEST(ContinuumSurfaceForce, IsYoungsAtTheContactLine)
{
    for (const double wedge : {60.0, 90.0, 120.0})
    {
        for (const double theta : {wedge - 30, wedge, wedge + 30})
        {
            LiquidCase drop({.walls = floorPlane, .wettability = "floor { theta " + std::to_string(theta) + "; }"});
            drop.useWalls();
            const auto tension = makeContinuumForce(drop);
            const auto points = latticeWedge(wedge, 7, 25, 16);
            const auto force = tensionOf(drop, *tension, points);
            const double along = forceAlongWall(points, force, wedge);
            if (theta == wedge)
            {
                EXPECT_NEAR(along, 0, 0.02) << wedge;
                for (std::size_t i = 0; i < points.size(); ++i)
                {
                    const Vec3 x = points[i];
                    const double depth = -x.x * std::sin(radians(wedge)) - x.z * std::cos(radians(wedge));
                    if (x.y != 0 || x.z > 8 || depth > 3) continue;
                    EXPECT_LT(norm(force[i]), 0.016f) << wedge << " " << x.x << " " << x.z;
                }
                continue;
            }
            const double share = shareOfYoungs(along, theta, wedge);
            EXPECT_GT(share, 0.4) << wedge << " " << theta;
            EXPECT_LT(share, 1.2) << wedge << " " << theta;
        }
    }
}

// Around a bubble in disordered liquid the surface bears the suction 1.5 sigma kappa, kappa = -2/R, nearly everywhere alike: with
// the mean over the neighbours kappa scatters by a tenth; that of single particles does by 14 %. Of a wide support, which reads little of
// the disorder.
TEST(ContinuumSurfaceForce, BearsSuctionAlikeAtAHollowSurface)
{
    LiquidCase drop;
    const auto tension = makeContinuumForce(drop, "support 4;");
    const scalar R = 7;
    RandomNumbers random(5);
    auto points = latticeBlock(26, 26, 26, 1, {-12.5f, -12.5f, -12.5f});
    std::erase_if(points, [&](Vec3 p) { return norm(p) < R; });
    disorder(points, 0.25f, random);
    points.push_back({0, 0, 2.5f - R});                 // has nobody in the density's support to take a mean of
    for (const Vec3 f : tensionOf(drop, *tension, points)) ASSERT_TRUE(std::isfinite(norm(f)));
    points.pop_back();
    tensionOf(drop, *tension, points);
    const auto states = surfaceStates(drop);
    const scalar sigma = drop.liquid.units().toScaled(drop.liquid.properties().surfaceTension, dimensions::surfaceTension);
    double n = 0, sum = 0, squares = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        if (norm(points[i]) > R + 1) continue;
        const double kappa = states[i].lowestPressure * drop.liquid.spacing() / (1.5 * sigma);
        ++n;
        sum += kappa;
        squares += kappa * kappa;
    }
    const double mean = sum / n;
    EXPECT_NEAR(mean, -2 / R, 0.03 * 2 / R);                            // the lattice's roughness, as of the ball
    EXPECT_LT(std::sqrt(squares / n - mean * mean), 0.12 * 2 / R);
}

TEST(ContinuumSurfaceForce, RefusesASupportOutOfRange)
{
    LiquidCase drop;
    EXPECT_EQ(messageOf([&] { makeContinuumForce(drop, "support 3;"); }), "no error");
    EXPECT_EQ(messageOf([&] { makeContinuumForce(drop, "support 8;"); }), "no error");
    for (const std::string support : {"2.9", "8.1", "-4", "0"})
    {
        EXPECT_TRUE(holds(messageOf([&] { makeContinuumForce(drop, "support " + support + ";"); }),
                          {"constant/models", "support", "1.5 times the kernel's to 8 spacings"}));
    }
}

// Where nothing is asked for, a wider kernel brings its own least.
TEST(ContinuumSurfaceForce, HasASupportForEveryKernel)
{
    for (const double support : {2.0, 2.5, 4.0})
    {
        LiquidCase drop({.kernel = "type cubicSpline; support " + std::to_string(support) + ";"});
        EXPECT_EQ(messageOf([&] { makeContinuumForce(drop); }), "no error");
        EXPECT_FLOAT_EQ(drop.surface.support() / drop.liquid.spacing(), std::max(scalar(3.25), scalar(1.5 * support)));
    }
}
