// SPDX-License-Identifier: GPL-3.0-or-later
// The free surface of lattices whose surface is known.

#include "freeSurface/FreeSurface.H"

#include "core/angles/Degrees.H"
#include "device/Device.H"
#include "support/SurfaceStates.H"

using namespace shizuku;
using namespace shizuku::test;

TEST(FreeSurface, ThatNobodyAskedForCostsNothing)
{
    LiquidCase drop;
    drop.place(latticeBall(3));
    const DeviceCounters before = deviceCounters();
    FreeSurface surface;
    drop.reconstruct(surface);
    EXPECT_FALSE(surface.active());
    EXPECT_EQ(surface.support(), 0);
    EXPECT_EQ(surface.view().position.size, 0);
    EXPECT_EQ(deviceCounters().launches, before.launches);
    EXPECT_EQ(deviceCounters().bytes, before.bytes);
}

// In parts: of a drop that has grown those are left out for whom there was no room; searched for once more all are there, as if it had been
// looked at for the first time. Memory is for an eighth more than are near the surface.
TEST(FreeSurface, FindsRoomWhenItGrows)
{
    LiquidCase drop;
    drop.surface.require(drop.liquid, 4, 0);
    drop.place(latticeBall(4));
    EXPECT_FALSE(drop.surface.cutOff());
    const int before = drop.surface.view().position.size;
    LiquidCase large;
    large.surface.require(large.liquid, 4, 0);
    large.place(latticeBall(8));
    const int room = large.surface.view().position.size;
    EXPECT_GT(room, 2 * before);

    drop.surface.search(large.liquid, large.near, large.walls);
    EXPECT_EQ(drop.surface.view().position.size, before);
    EXPECT_TRUE(drop.surface.cutOff());
    drop.surface.search(large.liquid, large.near, large.walls);
    EXPECT_FALSE(drop.surface.cutOff());
    ASSERT_EQ(drop.surface.view().position.size, room);
    const auto count = large.surface.particles().before.download().back();
    const auto expected = download(large.surface.particles().indices, int(count)), found = download(drop.surface.particles().indices, int(count));
    EXPECT_EQ(room, int(count + count / 8));
    EXPECT_EQ(found, expected);
}

// A drop far above its floor has none; where it has come down the search leaves them out, and is made again.
TEST(FreeSurface, HasMemoryForContactLinesFromTheFirstOneOn)
{
    LiquidCase drop({.walls = floorPlane, .wettability = "floor { theta 60; }"});
    drop.useWalls();
    drop.surface.require(drop.liquid, 4, 0);
    drop.place(latticeBall(4, {0, 0, 30}));
    const int room = drop.surface.view().depth.size;
    EXPECT_GT(room, 0);
    EXPECT_EQ(drop.surface.view().contact.size, 1);

    drop.place(latticeBall(4, {0, 0, 4.5f}));
    EXPECT_FALSE(drop.surface.cutOff());
    EXPECT_EQ(drop.surface.view().contact.size, room);
    int atWall = 0;
    for (const SurfaceState& state : surfaceStates(drop)) atWall += state.contact.wall == 0;
    EXPECT_GT(atWall, 0);
    drop.surface.dropPositions();
    EXPECT_EQ(drop.surface.view().position.size, 0);
    EXPECT_EQ(drop.surface.view().depth.size, room);
}

// A lattice below z = 0, its first layer half a spacing below: |G| and depth of each layer against the integrals over the
// half-space. Sums over 270 points differ from integrals by 3 % of the steepest slope; the depth follows to 0.15 spacings. What
// is deeper than the density's support, 2 spacings, may be taken for liquid without a surface: the slope there is below 6 %. Diluted liquid has a smaller slope and the same
// depth.
TEST(FreeSurface, OfALatticeHalfSpaceIsPlanar)
{
    for (const scalar apart : {1.0f, 1.06f})
    {
        LiquidCase drop;
        drop.surface.require(drop.liquid, 4, 0);
        const scalar d = drop.liquid.spacing(), h = drop.surface.support();
        EXPECT_FLOAT_EQ(h, 4 * d);
        const auto points = latticeBlock(11, 11, 10, apart, {-5 * apart, -5 * apart, -9.5f * apart});
        drop.place(points);
        const auto surface = surfaceStates(drop);
        const auto table = tabulateHalfSpace(drop.surface.kernel());
        const HalfSpaceView plane{{table.data(), int(table.size())}, h};
        const scalar steepest = plane(0).gradient, dilution = 1 / (apart * apart * apart);
        EXPECT_FLOAT_EQ(drop.surface.steepest(), steepest);
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const Vec3 x = points[i], G = surface[i].gradient;
            if (x.x != 0 || x.y != 0 || x.z < -5) continue;
            const scalar s = -x.z * d;
            EXPECT_NEAR(-G.z, dilution * plane(s).gradient, (s < 2 * d ? 0.03f : 0.06f) * steepest) << x.z;
            EXPECT_NEAR(std::hypot(G.x, G.y), 0, 1e-5f * steepest) << x.z;         // roundings of 270 terms
            if (s < 2 * d)
            {
                EXPECT_NEAR(surface[i].depth, s, 0.15f * d) << x.z;
            }
            else
            {
                EXPECT_GT(surface[i].depth, std::min(s, h) - 0.15f * d) << x.z;
            }
            EXPECT_EQ(surface[i].contact.wall, -1);
        }
    }
}

// Close-packed layers, ABC, whose top one has 27 neighbours within the support: more than particles deep inside of some lattices have. Of particles
// that are farther than a support from the edges, the top one is near the surface, with a slope within a tenth of the planar one; those of the fifth layer, 3.7 spacings below, are not.
TEST(FreeSurface, IsFoundAboveClosePackedLayers)
{
    LiquidCase drop;
    drop.surface.require(drop.liquid, 4, 0);
    const scalar a = std::pow(2.0f, 1.0f / 6), rows = std::sqrt(0.75f) * a, layers = std::sqrt(2.0f / 3) * a;
    constexpr int n = 14, deep = 9;
    std::vector<Vec3> points;
    for (int k = 0; k < deep; ++k)
    for (int j = -n; j <= n; ++j)
    for (int i = -n; i <= n; ++i)
    {
        const scalar x = a * (scalar(i) + 0.5f * scalar((j + 2 * n) % 2)) + 0.5f * a * scalar(k % 3), y = rows * (scalar(j) + scalar(k % 3) / 3);
        points.push_back({x, y, -layers * scalar(k)});
    }
    drop.place(points);
    const auto surface = surfaceStates(drop);
    const auto table = tabulateHalfSpace(drop.surface.kernel());
    const HalfSpaceView plane{{table.data(), int(table.size())}, drop.surface.support()};
    int top = 0, fifth = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const Vec3 x = points[i];
        if (std::hypot(x.x, x.y) > 6) continue;
        if (x.z == 0)
        {
            ++top;
            EXPECT_NEAR(norm(surface[i].gradient), plane(0.5f * drop.liquid.spacing()).gradient, 0.1f * drop.surface.steepest());
        }
        if (std::abs(x.z + 4 * layers) < 0.1f)
        {
            ++fifth;
            EXPECT_EQ(norm(surface[i].gradient), 0);
        }
    }
    EXPECT_GT(top, 50);
    EXPECT_GT(fifth, 50);
}

// What stands alone has no surface direction and is at the least depth, half a spacing; what has no liquid near is not deeper.
TEST(FreeSurface, IsNotLessThanHalfASpacingAway)
{
    LiquidCase drop;
    drop.surface.require(drop.liquid, 4, 0);
    auto points = latticeBall(4);
    points.push_back({5.5f, 0, 0});
    drop.place(points);
    const scalar d = drop.liquid.spacing();
    const auto surface = surfaceStates(drop);
    for (const SurfaceState& state : surface) EXPECT_GE(state.depth, 0.5f * d * (1 - 1e-6f));
    EXPECT_FLOAT_EQ(surface.back().depth, 0.5f * d);
}

// Liquid whose interface meets the wall at the contact angle reads, near the wall, as without one. The lattice against the
// wedge's integrals: 4.5 degrees and 0.15 spacings where |G| is above a third of its largest; deeper the colour hardly changes
// with depth, and only the reconstructed wall's index, angle and direction are asked for.
TEST(FreeSurface, OfAWedgeAtItsContactAngleIsThatOfAHalfSpace)
{
    for (const double theta : {45.0, 60.0, 90.0, 110.0, 135.0})
    {
        LiquidCase drop({.walls = floorPlane, .wettability = "floor { theta " + std::to_string(theta) + "; }"});
        drop.useWalls();
        drop.surface.require(drop.liquid, 4, 0);
        const auto points = latticeWedge(theta, 10, 11, 10);
        drop.place(points);
        const scalar d = drop.liquid.spacing(), h = drop.surface.support();
        const auto table = tabulateHalfSpace(drop.surface.kernel());
        const HalfSpaceView plane{{table.data(), int(table.size())}, h};
        const auto surface = surfaceStates(drop);
        const Vec3 m{scalar(std::sin(radians(theta))), 0, scalar(std::cos(radians(theta)))};
        int compared = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const Vec3 x = points[i], G = surface[i].gradient;
            const scalar s = -dot(x, m);
            if (std::abs(x.y) > 0.1f || x.z > 5 || s > 1.5f) continue;
            ++compared;
            EXPECT_GT(-dot(G, m) / norm(G), std::cos(radians(4.5))) << theta << " " << x.z << " " << s;
            EXPECT_NEAR(norm(G), plane(s * d).gradient, 0.07f * plane(0).gradient) << theta << " " << x.z << " " << s;
            EXPECT_NEAR(surface[i].depth, std::max(s, scalar(0.5)) * d, 0.15f * d) << theta << " " << x.z << " " << s;
            const ContactLine line = surface[i].contact;
            EXPECT_EQ(line.wall, x.z < 4 ? 0 : -1);
            if (line.wall < 0) continue;
            EXPECT_NEAR(line.theta, radians(theta), 1e-6);
            EXPECT_NEAR(line.tangent.x, 1, 1e-5);               // by symmetry; roundings of 270 terms
            EXPECT_NEAR(line.tangent.z, 0, 1e-6);
            EXPECT_NEAR(line.depth, s * d, 0.2f * d) << theta << " " << x.z << " " << s;
        }
        EXPECT_GE(compared, 10);
    }
}

// On a ball whose surface turns by 2.9 degrees a spacing, a planar interface that meets it at the contact angle: the tangent
// plane below a particle has the angle to the interface there, up to ten degrees off theta. The contact line is found from
// the depth, which is good to 0.2 spacings, 0.6 degrees; 1.5 are allowed.
TEST(FreeSurface, MeetsACurvedWallAtTheAngleOfItsContactLine)
{
    for (const double theta : {60.0, 90.0})
    {
        LiquidCase drop({.walls = "ball { type sphere; centre (0 0 -20e-3); radius 20e-3; liquid outside; }",
                         .wettability = "ball { theta " + std::to_string(theta) + "; }"});
        drop.useWalls();
        drop.surface.require(drop.liquid, 4, 0);
        const Vec3 m{scalar(std::sin(radians(theta))), 0, scalar(std::cos(radians(theta)))}, centre{0, 0, -20};
        std::vector<Vec3> points;
        for (const Vec3 p : latticeBlock(26, 17, 18, 1, {-17.5f, -8, -7.5f}))
        {
            if (norm(p - centre) > 20.4f && dot(p, m) < -0.3f) points.push_back(p);
        }
        drop.place(points);
        const auto surface = surfaceStates(drop);
        int compared = 0;
        double most = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const Vec3 x = points[i], foot = x - centre;
            if (std::abs(x.y) > 0.1f || norm(foot) > 22.5f || dot(x, m) < -1.5f || x.x < -4) continue;
            ++compared;
            const double exact = degrees(std::acos(dot(m, foot) / norm(foot)));
            most = std::max(most, std::abs(exact - theta));
            EXPECT_NEAR(degrees(surface[i].contact.theta), exact, 1.5) << theta << " " << x.x << " " << x.z;
        }
        EXPECT_GE(compared, 3) << theta;
        EXPECT_GT(most, 4) << theta;            // what a wall taken as plane would miss by
    }
}

// Where two walls meet below deep liquid there is no surface: both are full. The union's product is off by 1.5e-3 of the
// density, some hundredths of the steepest slope.
TEST(FreeSurface, IsNotInACornerFullOfLiquid)
{
    LiquidCase drop({.walls = floorPlane + "side { type plane; point (0 0 0); normal (1 0 0); }"});
    drop.surface.require(drop.liquid, 4, 0);
    const auto points = latticeBlock(10, 11, 10, 1, {0.5f, -5, 0.5f});
    drop.place(points);
    const scalar d = drop.liquid.spacing();
    const auto surface = surfaceStates(drop);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const Vec3 x = points[i];
        if (x.y != 0 || x.x > 5 || x.z > 5) continue;
        EXPECT_LT(norm(surface[i].gradient), 0.05f * drop.surface.steepest()) << x.x << " " << x.z;
        EXPECT_GT(surface[i].depth, 2.4f * d) << x.x << " " << x.z;
        if (x.x > 2 && x.z > 2) continue;           // deeper than the density's support
        EXPECT_EQ(surface[i].contact.wall, x.z <= x.x ? 0 : 1) << x.x << " " << x.z;
    }
}

// What the search spares is what has no effect: a particle that is taken for deep lies deeper than the density's support, in
// liquid in disorder too: by 0.35 spacings, as the points of the surface. Of a ball of 10 spacings about a fifth is deep,
// (10 - 4)^3/10^3.
TEST(FreeSurface, IsFartherThanTheDensitysSupportFromWhatIsDeep)
{
    LiquidCase drop;
    drop.surface.require(drop.liquid, 4, 0);
    auto points = latticeBall(10);
    RandomNumbers random(3);
    disorder(points, 0.35f, random);
    drop.place(points);
    const auto surface = surfaceStates(drop);
    int deep = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        if (surface[i].depth < drop.surface.support()) continue;
        ++deep;
        EXPECT_LT(norm(points[i]), 8.35f);
    }
    EXPECT_GT(deep, 0.15 * double(points.size()));
}
