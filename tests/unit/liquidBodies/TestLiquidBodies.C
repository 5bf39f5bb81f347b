// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquidBodies/CloseBoxes.H"
#include "liquidBodies/LiquidChecks.H"
#include "liquidBodies/PlaceBalls.H"
#include "liquidBodies/dropSizes/DropSizes.H"
#include "reference/Rain.H"
#include "support/ScratchFolder.H"
#include "support/Surfaces.H"

#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <numbers>
#include <random>

namespace shizuku::test
{

namespace
{

std::unique_ptr<LiquidBody> make(const std::string& text, const std::filesystem::path& casePath = {})
{
    const Dictionary dict = Dictionary::parse(text, "system/fillLiquidDict");
    return LiquidBodyTable::New("liquid body", dict.lookup<std::string>("type"), dict.where("type"), dict, casePath);
}

FilledBody fill(const std::string& name, const std::string& text, double spacing)
{
    FilledBody body{name, {"system/fillLiquidDict", 1}, make(text), {}, {}, {}};
    body.positions = fillLattice(*body.shape, spacing, body.where);
    return body;
}

// One particle a spacing^3: the nearest whole number of them.
void expectCount(const LiquidBody& body)
{
    EXPECT_NEAR(double(fillLattice(body, 1, {}).size()), body.volume(), 0.5);
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
    expectCount(*sphere);

    // An ellipsoid reaches to its semi-axes.
    const auto ellipsoid = make("type ellipsoid; centre (0 0 1e-3); semiAxes (8 6 7);");
    EXPECT_NEAR(ellipsoid->volume(), 4*pi/3*336, 1e-9);
    expectCount(*ellipsoid);
    EXPECT_TRUE(ellipsoid->contains({7.99, 0, 0}));
    EXPECT_FALSE(ellipsoid->contains({0, 6.01, 0}));
    EXPECT_TRUE(holds(messageOf([] { make("type ellipsoid; centre (0 0 0); semiAxes (1 0 1);"); }), {"semi-axes", "(a b c)"}));

    const auto cylinder = make("type cylinder; point (0 0 0); axis (1 1 1); radius 6; height 10;");
    EXPECT_NEAR(cylinder->volume(), pi*360, 1e-9);
    expectCount(*cylinder);
}

// A spacing that divides no edge: 10.4, 7.3 and 5.7 of them.
TEST(LiquidBodies, boxOfBrokenSpacingsHasItsVolumeInWholeRows)
{
    const auto box = make("type box; min (0 0 0); max (10.4 7.3 5.7);");
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

TEST(LiquidBodies, incompleteLayersAreSpreadEvenly)
{
    // A film of 0.4 spacings: in each quarter two fifths of the cells, to a few particles.
    const auto points = fillLattice(*make("type cylinder; point (0 0 0); axis (0 0 1); radius 20; height 0.4;"), 1, {});
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

TEST(LiquidBodies, latticesAreCentred)
{
    Vector3 mean;
    const auto points = fillLattice(*make("type sphere; centre (0 0 0); radius 5.2;"), 1, {});
    for (const Vector3& x : points) mean += x;
    // Symmetric but for the outermost shell, of at most 48 places at 5.2 spacings, which is filled evenly as far as the
    // 589 particles go: sqrt(48)/2*5.2/589 spacings were it by chance, twice that is allowed.
    EXPECT_EQ(points.size(), 589u);
    EXPECT_NEAR(length(mean/double(points.size())), 0, 0.06);
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
        EXPECT_EQ(points.size(), 4000u);
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
    EXPECT_TRUE(holds(messageOf([&] { fillLattice(*small, 1e-5, {}); }), {"2^31"}));
}

TEST(LiquidChecks, liquidOnAPlaneIsAcceptedAndBelowItRefused)
{
    const auto walls = readAnalyticSurfaces(Dictionary::parse("floor { type plane; point (0 0 0); normal (0 0 1); }"));
    const auto keepOut = [&](FilledBody body) { keepOutOfWalls(body, walls, 1); };
    EXPECT_NO_THROW(keepOut(fill("drop", "type box; min (0 0 0); max (4 4 4);", 1)));

    // Two of five layers are below: 2*16 particles, the first one in the corner.
    FilledBody sunk = fill("drop", "type box; min (0 0 -2); max (4 4 3);", 1);
    EXPECT_TRUE(holds
    (
        messageOf([&] { keepOutOfWalls(sunk, walls, 1); }),
        {"plane 'floor'", "32 of the 80", "'drop'", "(0.5 0.5 -1.5)", "fillLiquidDict", "overlaps carve"}
    ));
    // Or they are left out.
    sunk.carve = true;
    keepOutOfWalls(sunk, walls, 1);
    EXPECT_EQ(sunk.positions.size(), 48u);
    for (const Vector3& x : sunk.positions) EXPECT_GT(x.z, 0);
    ASSERT_EQ(sunk.leftOut.size(), 1u);
    EXPECT_TRUE(holds(sunk.leftOut[0], {"32 particles", "plane 'floor'"}));
    // But not all of them.
    FilledBody below = fill("drop", "type box; min (0 0 -2); max (4 4 0);", 1);
    below.carve = true;
    EXPECT_TRUE(holds(messageOf([&] { keepOutOfWalls(below, walls, 1); }), {"32 of the 32"}));
}

TEST(LiquidChecks, liquidOnSolidParticlesIsAcceptedAndBehindThemRefused)
{
    const SolidParticles solid = floorParticles(10);
    const auto keepOut = [&](FilledBody body) { keepOutOfSolid({&body, 1}, solid, 1); };
    EXPECT_NO_THROW(keepOut(fill("drop", "type box; min (0 0 0); max (4 4 4);", 1)));

    // Far behind the layer, further from any particle than the least distance.
    EXPECT_TRUE(holds
    (
        messageOf([&] { keepOut(fill("drop", "type box; min (0 0 -6); max (4 4 -4);", 1)); }),
        {"wall 'floor'", "32 of the 32"}
    ));
    // Too near in front of it: 0.3 + 0.5 spacings.
    EXPECT_TRUE(holds
    (
        messageOf([&] { keepOut(fill("drop", "type box; min (-0.5 -0.5 -0.2); max (3.5 3.5 2);", 1)); }),
        {"wall 'floor'", "16 of the 35"}
    ));
    // Below the floor's level, but beside it.
    EXPECT_NO_THROW(keepOut(fill("drop", "type box; min (14 0 -6); max (18 4 -4);", 1)));
}

TEST(LiquidChecks, overlappingBodiesAreRefused)
{
    std::vector<FilledBody> bodies;
    bodies.push_back(fill("left", "type box; min (0 0 0); max (4 4 4);", 1));
    bodies.push_back(fill("right", "type box; min (4 0 0); max (8 4 4);", 1));
    EXPECT_NO_THROW(keepApart(bodies, 1));

    // Half a cell off in all directions, so that no two particles are near: 0.87 spacings.
    bodies.push_back(fill("third", "type box; min (6.5 2.5 2.5); max (9.5 5.5 5.5);", 1));
    EXPECT_TRUE(holds(messageOf([&] { keepApart(bodies, 1); }), {"'right'", "'third'"}));

    // The one that asks for it gives way: its 2 x 2 x 2 corner in the other one, of 3 x 3 x 3.
    for (const std::size_t givesWay : {2, 1})
    {
        std::vector<FilledBody> both;
        for (std::size_t i = 0; i < 3; ++i)
        {
            both.push_back(fill(bodies[i].name, "type sphere; centre (0 0 0); radius 1;", 1));
            both[i].positions = bodies[i].positions;
            both[i].shape = std::move(bodies[i].shape);
        }
        both[givesWay].carve = true;
        keepApart(both, 1);
        EXPECT_EQ(both[2].positions.size(), givesWay == 2 ? 27u - 8u : 27u);
        EXPECT_EQ(both[1].positions.size(), givesWay == 1 ? 64u - 8u : 64u);
        for (std::size_t i = 0; i < 3; ++i) bodies[i].shape = std::move(both[i].shape);
    }
}

TEST(LiquidChecks, thoseThatGiveWayToSeveralBodiesLoseEachParticleOnce)
{
    // Two rods through a cube: one takes 2 x 2 x 6 of it, the other one as many, 2 x 2 x 2 of which are gone already.
    std::vector<FilledBody> bodies;
    bodies.push_back(fill("upright", "type box; min (2 2 -3); max (4 4 9);", 1));
    bodies.push_back(fill("cube", "type box; min (0 0 0); max (6 6 6);", 1));
    bodies.push_back(fill("lying", "type box; min (-3 2 2); max (9 4 4);", 1));
    for (FilledBody& body : bodies) body.carve = body.name != "upright";
    keepApart(bodies, 1);
    EXPECT_EQ(bodies[0].positions.size(), 48u);
    EXPECT_EQ(bodies[1].positions.size(), 216u - 24u);
    // The lying rod, the last one, gives way to both: 2 x 2 x 6 inside of the cube.
    EXPECT_EQ(bodies[2].positions.size(), 48u - 24u);
    ASSERT_EQ(bodies[2].leftOut.size(), 2u);
    EXPECT_TRUE(holds(bodies[2].leftOut[0], {"8 particles", "'upright'"}));
    EXPECT_TRUE(holds(bodies[2].leftOut[1], {"16 particles", "'cube'"}));
}

TEST(LiquidChecks, boxesThatMeetAreFound)
{
    const std::vector<Bounds> boxes{{{0, 0, 0}, {2, 2, 2}}, {{3, 0, 0}, {5, 2, 2}}, {{2, 0, 0}, {4, 1, 1}}, {{0, 0, 3}, {9, 9, 9}}};
    const std::vector<std::vector<std::size_t>> expected{{}, {}, {0, 1}, {}};
    EXPECT_EQ(earlierBoxesThatMeet(boxes), expected);
}

TEST(LiquidChecks, workGrowsWithTheDropsNotWithTheirPairs)
{
    // Time of the comparison of n^3 drops of 56 particles in a lattice whose gaps are less than a spacing: neighbours' boxes meet.
    const auto seconds = [](int n)
    {
        std::vector<FilledBody> bodies;
        for (int i = 0; i < n*n*n; ++i)
        {
            const Vector3 centre = 5.2*Vector3(i%n, i/n%n, i/(n*n));
            bodies.push_back(fill("drop", "type sphere; radius 2.4; centre " + str(centre) + ";", 1));
        }
        const auto start = std::chrono::steady_clock::now();
        keepApart(bodies, 1);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    // Eight times the drops: ten times the work, as more of them have neighbours on all sides, against 64 by pairs. Half
    // of that leaves room for a machine that does other things.
    EXPECT_LT(seconds(12), 32*seconds(6));
}

TEST(FilledBody, turnsAboutItsCentroid)
{
    FilledBody body = fill("drop", "type box; min (1 1 1); max (3 5 7);", 1);
    body.velocity = {0, 0, -1};
    body.angularVelocity = {0, 0, 2};
    const Vector3 centroid = body.centroid();
    Vector3 momentum;
    for (const Vector3& x : body.positions)
    {
        const Vector3 r = x - Vector3(2, 3, 4), velocity = body.velocityAt(x, centroid);
        EXPECT_NEAR(length(velocity - Vector3(-2*r.y, 2*r.x, -1)), 0, 1e-12);
        momentum += velocity;
    }
    EXPECT_NEAR(length(momentum/double(body.positions.size()) - body.velocity), 0, 1e-12);
    EXPECT_FALSE(body.movesAsOne());
}

namespace
{

// A case with the surface as constant/triSurface/body.stl.
void writeSurface(const ScratchFolder& folder, const PatchedSurface& surface)
{
    folder.write("constant/triSurface/body.stl", stlText(surface, "body"));
}

}

TEST(SurfaceBody, fillsTheInsideOfAClosedSurfaceToItsVolume)
{
    const ScratchFolder folder;
    writeSurface(folder, sphere(8, 3));
    const auto body = make("type surface; file \"body.stl\"; scale 0.5; translate (10 0 0);", folder.path());
    // Nearly the ball of radius 4 around (10 0 0): the 768 facets cut off less than 2 %.
    EXPECT_NEAR(body->volume(), 268.1, 5.4);
    const auto points = fillLattice(*body, 0.5, {});
    EXPECT_NEAR(points.size(), body->volume()/0.125, 0.5);
    // A cell of edge 0.5 that has the larger part inside has its middle at most about half an edge outside.
    for (const Vector3& x : points) EXPECT_LT(length(x - Vector3(10, 0, 0)), 4.25);
}

TEST(SurfaceBody, standsOnThePlaneUnderIt)
{
    const ScratchFolder folder;
    writeSurface(folder, cube(4));
    const auto points = fillLattice(*make("type surface; file \"body.stl\";", folder.path()), 1, {});
    ASSERT_EQ(points.size(), 64u);
    EXPECT_EQ(points.front(), Vector3(0.5, 0.5, 0.5));
}

TEST(SurfaceBody, inwardFacesAreTheSameAndAShellInsideIsABubble)
{
    const ScratchFolder folder;
    PatchedSurface box = cube(6);
    for (auto& face : box.mesh.faces) std::swap(face[0], face[1]);
    writeSurface(folder, box);
    EXPECT_EQ(fillLattice(*make("type surface; file \"body.stl\";", folder.path()), 1, {}).size(), 216u);

    PatchedSurface hollow = cube(6);
    const PatchedSurface bubble = cube(2);
    const int offset = int(hollow.mesh.vertices.size());
    for (const Vector3& v : bubble.mesh.vertices) hollow.mesh.vertices.push_back(v + Vector3(2, 2, 2));
    for (const auto& [i, j, k] : bubble.mesh.faces) hollow.mesh.faces.push_back({offset + j, offset + i, offset + k});
    hollow.patch.resize(hollow.mesh.faces.size(), 0);
    writeSurface(folder, hollow);
    const auto points = fillLattice(*make("type surface; file \"body.stl\";", folder.path()), 1, {});
    EXPECT_EQ(points.size(), 216u - 8u);
    for (const Vector3& x : points) EXPECT_GT(std::max({std::abs(x.x - 3), std::abs(x.y - 3), std::abs(x.z - 3)}), 1);
}

TEST(SurfaceBody, surfacesThatEncloseNothingAreRefused)
{
    const ScratchFolder folder;
    const auto message = [&](const std::string& text)
    {
        return messageOf([&] { make("type surface; file \"body.stl\";" + text, folder.path()); });
    };
    EXPECT_TRUE(holds(message(""), {"Cannot read", "body.stl"}));
    writeSurface(folder, rectangle(3, 3));
    EXPECT_TRUE(holds(message(""), {"body.stl", "encloses no body", "4 open edges", "closed surface"}));
    PatchedSurface torn = cube(3);
    torn.mesh.faces.pop_back();
    torn.patch.pop_back();
    writeSurface(folder, torn);
    EXPECT_TRUE(holds(message(""), {"3 open edges"}));
    PatchedSurface twisted = cube(3);
    std::swap(twisted.mesh.faces[0][0], twisted.mesh.faces[0][1]);
    writeSurface(folder, twisted);
    EXPECT_TRUE(holds(message(""), {"3 edges between triangles that are turned against each other"}));
    writeSurface(folder, cube(3));
    EXPECT_TRUE(holds(message("scale 0;"), {"scale"}));
    EXPECT_TRUE(holds(message("translate 3;"), {"translate"}));
}

TEST(PlacedBalls, areApartInsideTheBoxAndTheSameForASeed)
{
    const Bounds box{{1, 2, 3}, {11, 12, 8}};
    const std::vector<double> radii = {0.4, 0.2, 1, 0.3};
    std::vector<double> many;
    for (int i = 0; i < 100; ++i) many.insert(many.end(), radii.begin(), radii.begin() + (i < 10 ? 4 : 2));
    const PlacedBalls balls(box, many, 0.1, 1, "test");
    ASSERT_EQ(balls.placed(), many.size());
    double cubes = 0;
    for (std::size_t i = 0; i < balls.placed(); ++i)
    {
        const double radius = balls.radii()[i];
        const Vector3& x = balls.centres()[i];
        cubes += radius*radius*radius;
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(x[c] - radius >= box.low[c] - 1e-9 && x[c] + radius <= box.high[c] + 1e-9);
        for (std::size_t j = 0; j < i; ++j) EXPECT_GE(length(x - balls.centres()[j]), radius + balls.radii()[j] + 0.1 - 1e-9);
        EXPECT_TRUE(balls.contains(x + Vector3(0.99*radius, 0, 0)));
        EXPECT_FALSE(balls.contains(x + Vector3(1.01*radius, 0, 0)));
        EXPECT_EQ(balls.nearest(x + Vector3(0, 0, 1.04*radius), 0.1), int(i));
    }
    EXPECT_NEAR(balls.volume(), 4*std::numbers::pi/3*cubes, 1e-9);
    EXPECT_EQ(PlacedBalls(box, many, 0.1, 1, "test").centres(), balls.centres());
    EXPECT_NE(PlacedBalls(box, many, 0.1, 2, "test").centres(), balls.centres());
}

// What the standard says of its engine, and nothing that a machine rounds: whole multiples of 2^-40 of the longest edge.
TEST(PlacedBalls, placesAreTheSameOnEveryMachine)
{
    const PlacedBalls one({{0, 0, 0}, {1, 1, 1}}, {0.25}, 0, 1, "test");
    std::mt19937_64 random(1);
    for (int c = 0; c < 3; ++c)
    {
        const double share = double(random() >> 11)*0x1p-53;
        EXPECT_EQ(one.centres()[0][c], std::nearbyint((0.25 + 0.5*share)*0x1p40)*0x1p-40);
    }
}

TEST(PlacedBalls, thoseThatFindNoPlaceAreLeftOut)
{
    const PlacedBalls balls({{0, 0, 0}, {4, 4, 4}}, std::vector<double>(64, 0.9), 0.2, 1, "test");
    EXPECT_EQ(balls.wanted(), 64u);
    // Two a direction fit beside each other whatever is drawn, or nearly; 27 would stand on a lattice.
    EXPECT_GE(balls.placed(), 4u);
    EXPECT_LE(balls.placed(), 8u);
    EXPECT_EQ(balls.nextRadius(), 0.9);
}

namespace
{

std::unique_ptr<DropSizes> sizes(const std::string& text)
{
    const Dictionary dict = Dictionary::parse(text, "sizes");
    return DropSizesTable::New("drop size", dict.lookup<std::string>("type"), dict.where("type"), dict);
}

}

TEST(DropSizes, followTheirDistributions)
{
    EXPECT_EQ(sizes("type oneSize; diameter 2e-3;")->diameter(0.7), 2e-3);

    // Shares of 2, 1 and 1 of four.
    const auto table = sizes("type table; diameters (1 2 3); shares (2 1 1);");
    EXPECT_EQ(table->diameter(0.49), 1);
    EXPECT_EQ(table->diameter(0.51), 2);
    EXPECT_EQ(table->diameter(0.76), 3);
    EXPECT_EQ(table->diameter(0.999999), 3);

    // Of exp(-D/m) between a and b the share below D is (1 - exp(-(D - a)/m))/(1 - exp(-(b - a)/m)).
    const auto exponential = sizes("type exponential; meanDiameter 0.5; minDiameter 1; maxDiameter 3;");
    EXPECT_EQ(exponential->diameter(0), 1);
    EXPECT_LE(exponential->diameter(1 - 0x1p-53), 3);
    for (const double share : {0.1, 0.5, 0.9, 0.999})
    {
        const double D = exponential->diameter(share);
        EXPECT_NEAR((1 - std::exp(-(D - 1)/0.5))/(1 - std::exp(-2/0.5)), share, 1e-12);
    }

    // Marshall and Palmer's figures at 10 mm/h: a slope of 4.1*10^-0.21 = 2.528 a millimetre. Gunn and Kinzer 1949 measured 4.03, 6.49 and 9.09 m/s of drops
    // of 1, 2 and 5 mm, which the formula meets to 2 %.
    EXPECT_NEAR(meanRainDrop(10/3.6e6), 1e-3/2.528, 1e-7);
    EXPECT_NEAR(terminalSpeed(1e-3), 4.03, 0.08);
    EXPECT_NEAR(terminalSpeed(2e-3), 6.49, 0.13);
    EXPECT_NEAR(terminalSpeed(5e-3), 9.09, 0.18);

    EXPECT_TRUE(holds(messageOf([] { sizes("type exponential; minDiameter 1; maxDiameter 2; rainRate 1; meanDiameter 1;"); }), {"both", "one of them"}));
    EXPECT_TRUE(holds(messageOf([] { sizes("type exponential; minDiameter 2; maxDiameter 2; rainRate 1;"); }), {"largest", "above minDiameter"}));
    EXPECT_TRUE(holds(messageOf([] { sizes("type table; diameters (1 2); shares (1);"); }), {"2 diameters and 1 shares"}));
    EXPECT_TRUE(holds(messageOf([] { sizes("type table; diameters (1 -2); shares (1 1);"); }), {"diameters", "above 0"}));
}

namespace
{

const std::string boxOfDrops = "type drops; min (0 0 0); max (0.02 0.02 0.02); gap 1e-4; ";

}

TEST(DropsBody, holdsTheNumberOrTheVolumeThatIsAskedFor)
{
    // 200 balls of 1 mm, of 524 particles of 0.1 mm each.
    const auto number = make(boxOfDrops + "number 200; sizes { type oneSize; diameter 1e-3; }");
    EXPECT_NEAR(number->volume(), 200*std::numbers::pi/6*1e-9, 1e-15);
    const auto points = number->fill(1e-4, {});
    EXPECT_EQ(points.size(), 200u*524);
    EXPECT_EQ(points, make(boxOfDrops + "number 200; sizes { type oneSize; diameter 1e-3; }")->fill(1e-4, {}));
    EXPECT_NE(points, make(boxOfDrops + "number 200; seed 2; sizes { type oneSize; diameter 1e-3; }")->fill(1e-4, {}));

    // Water that would stand 0.2 mm high, to half a largest drop.
    const auto depth = make(boxOfDrops + "depth 2e-4; sizes { type exponential; meanDiameter 5e-4; minDiameter 5e-4; maxDiameter 2e-3; }");
    EXPECT_NEAR(depth->volume(), 2e-4*4e-4, 0.5*std::numbers::pi/6*8e-9);
}

TEST(DropsBody, eachDropFallsAtItsOwnSpeed)
{
    const ScratchFolder folder;
    folder.write("constant/models", "bodyForce gravity;");
    folder.write("constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 0 -9.81);");
    const auto drops = make(boxOfDrops + "number 50; speeds terminal; sizes { type table; diameters (1e-3 2e-3); shares (1 1); }", folder.path());
    ASSERT_TRUE(drops->hasVelocities());
    std::size_t small = 0, large = 0;
    for (const Vector3& x : drops->fill(1e-4, {}))
    {
        // Whole micrometres a second.
        const double speed = -drops->velocityAt(x).z;
        const bool isSmall = std::abs(speed - terminalSpeed(1e-3)) < 1e-6;
        EXPECT_TRUE(isSmall || std::abs(speed - terminalSpeed(2e-3)) < 1e-6) << speed;
        ++(isSmall ? small : large);
    }
    // 524 and 4,189 particles a drop.
    EXPECT_EQ(small%524, 0u);
    EXPECT_EQ(large%4189, 0u);
    EXPECT_EQ(small/524 + large/4189, 50u);
}

TEST(DropsBody, refusesWhatItCannotDo)
{
    const auto message = [&](const std::string& text) { return messageOf([&] { make(boxOfDrops + text); }); };
    const std::string one = " sizes { type oneSize; diameter 1e-3; }";
    EXPECT_TRUE(holds(message(one), {"neither number nor depth"}));
    EXPECT_TRUE(holds(message("number 1; depth 1;" + one), {"both number and depth"}));
    EXPECT_TRUE(holds(message("number 0;" + one), {"0 drops", "1 to"}));
    EXPECT_TRUE(holds(message("depth 1e-9;" + one), {"no whole drop"}));
    EXPECT_TRUE(holds(message("number 20000;" + one), {"of the 20000 drops fill", "a smaller gap"}));
    EXPECT_TRUE(holds(message("number 1; sizes { type oneSize; diameter 0.03; }"), {"larger than the box"}));
    EXPECT_TRUE(holds(message("number 1; speeds terminal;" + one), {"has no gravity", "bodyForce gravity"}));
    EXPECT_TRUE(holds(message("number 1; sizes { type many; }"), {"drop size", "'many'", "exponential", "oneSize", "table"}));
}

}
