#include "geometry/liquidBodies/LiquidChecks.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <numbers>

namespace shizuku::test
{

namespace
{

std::unique_ptr<LiquidBody> make(const std::string& text)
{
    const Dictionary dict = Dictionary::parse(text, "system/fillLiquidDict");
    return LiquidBodyTable::New("liquid body", dict.lookup<std::string>("type"), dict.where("type"), dict);
}

FilledBody fill(const std::string& name, const std::string& text, double spacing)
{
    FilledBody body{name, {"system/fillLiquidDict", 1}, make(text), {}, {}};
    body.positions = fillLattice(*body.shape, spacing, body.where);
    return body;
}

// The lattice has one particle a spacing^3. How far its count is off the volume is known for convex bodies: the points
// near the surface are in or out by chance, about sqrt(surface) of them; a tenth of the surface is far beyond that.
void expectCount(const LiquidBody& body, double surface)
{
    EXPECT_NEAR(double(fillLattice(body, 1, {}).size()), body.volume(), 0.1*surface);
}

// Particles on a square lattice at z = -0.5: a floor whose surface is z = 0.
SolidParticles floorParticles(int n)
{
    SolidParticles solid;
    solid.patches = {"floor"};
    for (int i = -n; i <= n; ++i)
    {
        for (int j = -n; j <= n; ++j)
        {
            solid.positions.emplace_back(i, j, -0.5);
            solid.normals.emplace_back(0, 0, 1);
            solid.patch.push_back(0);
        }
    }
    return solid;
}

}

TEST(LiquidBodies, boxStartsHalfASpacingFromItsCorner)
{
    const auto box = make("type box; min (1 2 3); max (5 5 5);");
    EXPECT_DOUBLE_EQ(box->volume(), 4*3*2);
    const auto points = fillLattice(*box, 0.5, {});
    ASSERT_EQ(points.size(), 8u*6*4);
    EXPECT_EQ(points.front(), Vector3(1.25, 2.25, 3.25));
    EXPECT_EQ(points.back(), Vector3(4.75, 4.75, 4.75));
}

TEST(LiquidBodies, countsFollowTheVolumes)
{
    const double pi = std::numbers::pi;
    const auto sphere = make("type sphere; centre (1e-3 0 0); radius 8;");
    EXPECT_NEAR(sphere->volume(), 4*pi/3*512, 1e-9);
    expectCount(*sphere, 4*pi*64);

    const auto cylinder = make("type cylinder; point (0 0 0); axis (1 1 1); radius 6; height 10;");
    EXPECT_NEAR(cylinder->volume(), pi*360, 1e-9);
    expectCount(*cylinder, 2*pi*36 + 2*pi*60);
}

TEST(LiquidBodies, latticesAreSymmetric)
{
    Vector3 mean;
    const auto points = fillLattice(*make("type sphere; centre (0 0 0); radius 5.2;"), 1, {});
    for (const Vector3& x : points) mean += x;
    EXPECT_NEAR(length(mean/double(points.size())), 0, 1e-12);
}

TEST(LiquidBodies, capHasItsVolumeItsAngleAndStandsOnThePlane)
{
    for (const double angle : {30.0, 60.0, 90.0, 120.0, 180.0})
    {
        std::ostringstream text;
        text << "type cap; centre (1 1 1); normal (0 0 1); contactAngle " << angle << "; volume 4000;";
        const auto cap = make(text.str());
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
        EXPECT_NEAR(double(points.size()), 4000, 0.1*4*std::numbers::pi*H*H);
    }
}

TEST(LiquidBodies, tiltedCapHasTheLatticeOfItsWall)
{
    const Vector3 normal = normalized({1, 2, 3});
    const auto points = fillLattice
    (
        *make("type cap; centre (0 0 0); normal (1 2 3); contactAngle 90; volume 500;"), 1, {}
    );
    for (const Vector3& x : points)
    {
        const double layer = dot(x, normal) - 0.5;
        EXPECT_NEAR(layer, std::round(layer), 1e-12);
        EXPECT_GT(layer, -1e-12);
    }
}

TEST(LiquidBodies, badBodiesAreRefused)
{
    EXPECT_TRUE(holds(messageOf([] { make("type blob;"); }), {"blob", "sphere", "cylinder", "cap", "box"}));
    EXPECT_TRUE(holds(messageOf([] { make("type sphere; centre (0 0 0); radius -1;"); }), {"radius", "-1"}));
    EXPECT_TRUE(holds(messageOf([] { make("type box; min (0 0 0); max (1 -1 1);"); }), {"min", "max"}));
    EXPECT_TRUE(holds
    (
        messageOf([] { make("type cap; centre (0 0 0); normal (0 0 1); contactAngle 200; volume 1;"); }),
        {"contact angle", "200"}
    ));
    const auto small = make("type sphere; centre (0 0 0); radius 0.1;");
    EXPECT_TRUE(holds(messageOf([&] { fillLattice(*small, 1, {}); }), {"smaller than the particle spacing"}));
    EXPECT_TRUE(holds(messageOf([&] { fillLattice(*small, 1e-5, {}); }), {"1e8"}));
}

TEST(LiquidChecks, liquidOnAPlaneIsAcceptedAndBelowItRefused)
{
    const auto walls = readAnalyticSurfaces(Dictionary::parse("floor { type plane; point (0 0 0); normal (0 0 1); }"));
    EXPECT_NO_THROW(refuseInsideWalls(fill("drop", "type box; min (0 0 0); max (4 4 4);", 1), walls, 1));

    // Two of five layers are below: 2*16 particles, the first one in the corner.
    const FilledBody sunk = fill("drop", "type box; min (0 0 -2); max (4 4 3);", 1);
    EXPECT_TRUE(holds
    (
        messageOf([&] { refuseInsideWalls(sunk, walls, 1); }),
        {"plane 'floor'", "32 of the 80", "'drop'", "(0.5 0.5 -1.5)", "fillLiquidDict"}
    ));
}

TEST(LiquidChecks, liquidOnSolidParticlesIsAcceptedAndBehindThemRefused)
{
    const SolidParticles solid = floorParticles(10);
    EXPECT_NO_THROW(refuseInsideSolid(fill("drop", "type box; min (0 0 0); max (4 4 4);", 1), solid, 1));

    // Far behind the layer, further from any particle than the least distance.
    EXPECT_TRUE(holds
    (
        messageOf([&] { refuseInsideSolid(fill("drop", "type box; min (0 0 -6); max (4 4 -4);", 1), solid, 1); }),
        {"wall 'floor'", "32 of the 32"}
    ));
    // Too near in front of it: 0.3 + 0.5 spacings.
    EXPECT_TRUE(holds
    (
        messageOf([&] { refuseInsideSolid(fill("drop", "type box; min (-0.5 -0.5 -0.2); max (3.5 3.5 2);", 1), solid, 1); }),
        {"wall 'floor'", "16 of the 32"}
    ));
    // Below the floor's level, but beside it.
    EXPECT_NO_THROW(refuseInsideSolid(fill("drop", "type box; min (14 0 -6); max (18 4 -4);", 1), solid, 1));
}

TEST(LiquidChecks, overlappingBodiesAreRefused)
{
    std::vector<FilledBody> bodies;
    bodies.push_back(fill("left", "type box; min (0 0 0); max (4 4 4);", 1));
    bodies.push_back(fill("right", "type box; min (4 0 0); max (8 4 4);", 1));
    EXPECT_NO_THROW(refuseOverlaps(bodies, 1));

    // Half a cell off in all directions, so that no two particles are near: 0.87 spacings.
    bodies.push_back(fill("third", "type box; min (6.5 2.5 2.5); max (9.5 5.5 5.5);", 1));
    EXPECT_TRUE(holds(messageOf([&] { refuseOverlaps(bodies, 1); }), {"'right'", "'third'"}));
}

}
