// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquidBodies/CloseBoxes.H"
#include "liquidBodies/LiquidChecks.H"
#include "unit/liquidBodies/Bodies.H"

namespace shizuku::test
{

namespace
{

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

TEST(LiquidChecks, LiquidOnAPlaneIsAcceptedAndBelowItRefused)
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

TEST(LiquidChecks, LiquidBehindASymmetryPlaneIsRefusedOrLeftOut)
{
    BoxSides sides;
    sides.kind[0][0] = sides.kind[1][1] = BoxSides::Kind::symmetryPlane;
    sides.kind[2][0] = sides.kind[2][1] = BoxSides::Kind::cyclic;
    FilledBody drop = fill("drop", "type box; min (-2 -2 0); max (2 2 4);", 1);
    EXPECT_TRUE(holds
    (
        messageOf([&] { keepBeforePlanes(drop, sides, 1); }),
        {"Liquid behind the symmetry plane xMin", "32 of the 64", "(-1.5 -1.5 0.5)", "half a spacing", "overlaps carve"}
    ));
    drop.carve = true;
    keepBeforePlanes(drop, sides, 1);
    EXPECT_EQ(drop.positions.size(), 16u);
    for (const Vector3& x : drop.positions)
    {
        EXPECT_GT(x.x, 0);
        EXPECT_LT(x.y, 0);
    }
    ASSERT_EQ(drop.leftOut.size(), 2u);
    EXPECT_TRUE(holds(drop.leftOut[1], {"16 particles", "symmetry plane yMax"}));
    // Nearer to it than 0.4 spacings.
    FilledBody near = fill("near", "type box; min (-0.2 -4 0); max (3.8 -2 4);", 1);
    EXPECT_TRUE(holds(messageOf([&] { keepBeforePlanes(near, sides, 1); }), {"xMin", "8 of the 32"}));
}

TEST(LiquidChecks, LiquidOnSolidParticlesIsAcceptedAndBehindThemRefused)
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

TEST(LiquidChecks, OverlappingBodiesAreRefused)
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

TEST(LiquidChecks, ThoseThatGiveWayToSeveralBodiesLoseEachParticleOnce)
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

TEST(LiquidChecks, BoxesThatMeetAreFound)
{
    const std::vector<Bounds> boxes{{{0, 0, 0}, {2, 2, 2}}, {{3, 0, 0}, {5, 2, 2}}, {{2, 0, 0}, {4, 1, 1}}, {{0, 0, 3}, {9, 9, 9}}};
    const std::vector<std::vector<std::size_t>> expected{{}, {}, {0, 1}, {}};
    EXPECT_EQ(earlierBoxesThatMeet(boxes), expected);
}

// Of n^3 drops in a lattice, each of which meets those around it alone: the pairs that are compared are the neighbours, edges and corners included.
TEST(LiquidChecks, WorkGrowsWithTheDropsNotWithTheirPairs)
{
    const auto pairs = [](int n)
    {
        std::vector<Bounds> boxes;
        for (int i = 0; i < n*n*n; ++i)
        {
            const Vector3 centre = 5.2*Vector3(i%n, i/n%n, i/(n*n)), reach = 2.9*Vector3(1, 1, 1);
            boxes.push_back({centre - reach, centre + reach});
        }
        std::size_t count = 0;
        for (const auto& earlier : earlierBoxesThatMeet(boxes)) count += earlier.size();
        return count;
    };
    for (const std::size_t n : {6, 12})
    {
        const std::size_t around = 3*n - 2;         // neighbours along an axis, itself included, of all in a row
        EXPECT_EQ(pairs(int(n)), (around*around*around - n*n*n)/2);
    }
}

TEST(FilledBody, TurnsAboutItsCentroid)
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

}
