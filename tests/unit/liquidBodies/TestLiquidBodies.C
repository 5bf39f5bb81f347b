// SPDX-License-Identifier: GPL-3.0-or-later
#include "unit/liquidBodies/Bodies.H"

#include <map>
#include <numbers>

namespace shizuku::test
{

namespace
{

// One particle a spacing^3: the nearest whole number of them.
void expectCount(const LiquidBody& body)
{
    EXPECT_NEAR(double(fillLattice(body, 1, {}).size()), body.volume(), 0.5);
}

}

TEST(LiquidBodies, BoxStartsHalfASpacingFromItsCorner)
{
    const auto box = makeBody("type box; min (1 2 3); max (5 5 5);");
    EXPECT_DOUBLE_EQ(box->volume(), 4*3*2);
    const auto points = fillLattice(*box, 0.5, {});
    ASSERT_EQ(points.size(), 8u*6*4);
    EXPECT_EQ(points.front(), Vector3(1.25, 2.25, 3.25));
    EXPECT_EQ(points.back(), Vector3(4.75, 4.75, 4.75));
}

TEST(LiquidBodies, CountsFollowTheVolumes)
{
    const double pi = std::numbers::pi;
    const auto sphere = makeBody("type sphere; centre (1e-3 0 0); radius 8;");
    EXPECT_NEAR(sphere->volume(), 4*pi/3*512, 1e-9);
    expectCount(*sphere);

    // An ellipsoid reaches to its semi-axes.
    const auto ellipsoid = makeBody("type ellipsoid; centre (0 0 1e-3); semiAxes (8 6 7);");
    EXPECT_NEAR(ellipsoid->volume(), 4*pi/3*336, 1e-9);
    expectCount(*ellipsoid);
    EXPECT_TRUE(ellipsoid->contains({7.99, 0, 0}));
    EXPECT_FALSE(ellipsoid->contains({0, 6.01, 0}));
    EXPECT_TRUE(holds(messageOf([] { makeBody("type ellipsoid; centre (0 0 0); semiAxes (1 0 1);"); }), {"semi-axes", "(a b c)"}));

    const auto cylinder = makeBody("type cylinder; point (0 0 0); axis (1 1 1); radius 6; height 10;");
    EXPECT_NEAR(cylinder->volume(), pi*360, 1e-9);
    expectCount(*cylinder);
}

// A spacing that divides no edge: 10.4, 7.3 and 5.7 of them.
TEST(LiquidBodies, BoxOfBrokenSpacingsHasItsVolumeInWholeRows)
{
    const auto box = makeBody("type box; min (0 0 0); max (10.4 7.3 5.7);");
    expectCount(*box);
    const auto points = fillLattice(*box, 1, {});
    std::map<double, int> layers;
    for (const Vector3& x : points)
    {
        EXPECT_GT(std::min({x.x, x.y, 10.4 - x.x, 7.3 - x.y}), 0.5);
        ++layers[std::round(1e6*x.z)];
    }
    // 10 x 7 rows; all layers are complete but for the top one.
    ASSERT_EQ(layers.size(), 7u);
    for (auto layer = layers.begin(); layer != std::prev(layers.end()); ++layer) EXPECT_EQ(layer->second, 70);
    EXPECT_EQ(layers.rbegin()->second, 433 - 6*70);
}

TEST(LiquidBodies, IncompleteLayersAreSpreadEvenly)
{
    // A film of 0.4 spacings: in each quarter two fifths of the cells, to a few particles.
    const auto points = fillLattice(*makeBody("type cylinder; point (0 0 0); axis (0 0 1); radius 20; height 0.4;"), 1, {});
    EXPECT_NEAR(points.size(), 503, 1);     // 0.4 pi 400 = 502.65
    int left = 0, front = 0;
    for (const Vector3& x : points)
    {
        left += x.x < 0;
        front += x.y < 0;
    }
    EXPECT_NEAR(left, 251, 15);
    EXPECT_NEAR(front, 251, 15);
}

TEST(LiquidBodies, LatticesAreCentred)
{
    Vector3 mean;
    const auto points = fillLattice(*makeBody("type sphere; centre (0 0 0); radius 5.2;"), 1, {});
    for (const Vector3& x : points) mean += x;
    // Symmetric but for the outermost shell, of at most 48 places at 5.2 spacings, which is filled evenly as far as the
    // 589 particles go: sqrt(48)/2*5.2/589 spacings were it by chance, twice that is allowed.
    EXPECT_EQ(points.size(), 589u);
    EXPECT_NEAR(length(mean/double(points.size())), 0, 0.06);
}

// Layers of particles lie at right angles to the axis, and their number stays.
TEST(LiquidBodies, TheLatticeOfABallCanBeTurned)
{
    const auto level = makeBody("type sphere; centre (0 0 0); radius 6;"), turned = makeBody("type sphere; centre (0 0 0); radius 6; latticeAxis (1 1 1);");
    const auto before = fillLattice(*level, 1, {}), points = fillLattice(*turned, 1, {});
    EXPECT_EQ(points.size(), before.size());
    const Vector3 axis = normalized(Vector3(1, 1, 1));
    for (const Vector3& x : points)
    {
        EXPECT_LE(length(x), 6 + 1);
        const double layer = dot(x, axis) - dot(points.front(), axis);
        EXPECT_NEAR(layer, std::round(layer), 1e-9);                   // whole spacings along the axis
    }
    EXPECT_TRUE(holds(messageOf([] { makeBody("type sphere; centre (0 0 0); radius 1; latticeAxis (0 0 0);"); }), {"latticeAxis"}));
}

TEST(LiquidBodies, CapHasItsVolumeItsAngleAndStandsOnThePlane)
{
    for (const double angle : {30.0, 60.0, 90.0, 120.0, 180.0})
    {
        std::ostringstream text;
        text << "type cap; centre (1 1 1); normal (0 0 1); contactAngle " << angle << "; volume 4000;";
        const auto cap = makeBody(text.str());
        EXPECT_DOUBLE_EQ(cap->volume(), 4000);

        // A cap of height H and base radius a has the volume pi H (3 a^2 + H^2)/6 and, by the half-angle formula,
        // tan(angle/2) = H/a. Where the base and the top are is found by asking contains(); bisection to 1e-9.
        const auto extent = [&](const Vector3& from, const Vector3& direction)
        {
            double in = 0, out = 100;
            while (out - in > 1e-9) (cap->contains(from + 0.5*(in + out)*direction) ? in : out) = 0.5*(in + out);
            return in;
        };
        const double H = extent({1, 1, 1}, {0, 0, 1}), a = angle < 180 ? extent({1, 1, 1 + 1e-12}, {1, 0, 0}) : 0;
        EXPECT_NEAR(std::numbers::pi*H*(3*a*a + H*H)/6, 4000, 1e-4);
        EXPECT_NEAR(2*std::atan2(H, a)*180/std::numbers::pi, angle, 1e-5);

        const auto points = fillLattice(*cap, 1, {});
        double lowest = 1e9;
        for (const Vector3& x : points) lowest = std::min(lowest, x.z);
        // A spherical drop touches in one point: its first layer may be too small for a particle.
        if (angle < 180)
        {
            EXPECT_DOUBLE_EQ(lowest, 1.5);
        }
        EXPECT_EQ(points.size(), 4000u);
    }
}

TEST(LiquidBodies, TiltedCapHasTheLatticeOfItsWall)
{
    const Vector3 normal = normalized({1, 2, 3});
    const auto points = fillLattice
    (
        *makeBody("type cap; centre (0 0 0); normal (1 2 3); contactAngle 90; volume 500;"), 1, {}
    );
    for (const Vector3& x : points)
    {
        const double layer = dot(x, normal) - 0.5;
        EXPECT_NEAR(layer, std::round(layer), 1e-12);
        EXPECT_GT(layer, -1e-12);
    }
}

TEST(LiquidBodies, BadBodiesAreRefused)
{
    EXPECT_TRUE(holds(messageOf([] { makeBody("type blob;"); }), {"blob", "sphere", "cylinder", "cap", "box"}));
    EXPECT_TRUE(holds(messageOf([] { makeBody("type sphere; centre (0 0 0); radius -1;"); }), {"radius", "-1"}));
    EXPECT_TRUE(holds(messageOf([] { makeBody("type box; min (0 0 0); max (1 -1 1);"); }), {"min", "max"}));
    EXPECT_TRUE(holds
    (
        messageOf([] { makeBody("type cap; centre (0 0 0); normal (0 0 1); contactAngle 200; volume 1;"); }),
        {"contact angle", "200"}
    ));
    const auto small = makeBody("type sphere; centre (0 0 0); radius 0.1;");
    EXPECT_TRUE(holds(messageOf([&] { fillLattice(*small, 1, {}); }), {"smaller than the particle spacing"}));
    EXPECT_TRUE(holds(messageOf([&] { fillLattice(*small, 1e-5, {}); }), {"up to 2e+09"}));
}

}
