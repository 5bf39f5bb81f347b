// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/LiquidRays.H"
#include "optics/Studio.H"
#include "support/CapMesh.H"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// Of radius 1 around the origin; edges of 0.034, half as long with each level more.
TriangleMesh ball(int levels = 5)
{
    TriangleMesh mesh = icosphereMesh(levels);
    mesh.normals = mesh.vertices;
    return mesh;
}

LiquidLook clear(double index) { return {"clear", index, {1, 1, 1}, {}, false}; }

// White from everywhere, no wall.
const LiquidSurroundings white{[](const Vector3&, const Vector3&) { return Colour(1, 1, 1); }, [](const Vector3&, const Vector3&) { return std::optional<Vector3>(); }};

}

TEST(TriangleTree, FindsWhatAllTrianglesFind)
{
    const TriangleMesh mesh = ball();
    const TriangleTree tree(mesh);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-1, 1);
    int hits = 0;
    for (int k = 0; k < 200; ++k)
    {
        const Vector3 from = 3*Vector3(any(random), any(random), any(random)), towards = normalized(Vector3(any(random), any(random), any(random)) - 0.3*from);
        const auto found = tree.first(from, towards, 0, std::numeric_limits<double>::max());
        // The ball by its equation; its mesh is off by the sagitta of its edges, 0.034^2/8 = 1.5e-4, more along slanting rays.
        const double middle = -dot(from, towards), off = squaredLength(from) - middle*middle;
        if (off > 0.95 && off < 1.05) continue;
        const bool inside = squaredLength(from) < 1;
        const bool meets = off < 1 && (inside || middle > 0);
        EXPECT_EQ(found.has_value(), meets);
        if (!found || !meets) continue;
        ++hits;
        EXPECT_NEAR(found->distance, middle + (inside ? 1 : -1)*std::sqrt(1 - off), 0.01);
        EXPECT_GE(found->second, 0);
        EXPECT_LE(found->second + found->third, 1);
    }
    EXPECT_GT(hits, 20);
    EXPECT_FALSE(TriangleTree({}).first({}, {0, 0, 1}, 0, 1));
}

// Nothing is absorbed: what is mirrored and what is refracted add up, but for rays below 1.5 % that are not followed.
TEST(LiquidRays, KeepTheLight)
{
    const TriangleMesh mesh = ball();
    const LiquidRays rays(mesh, clear(1.333), 2);
    for (const double off : {0.0, 0.3, 0.6, 0.9})
    {
        const Colour seen = rays.seen({off, 0, 3}, {0, 0, -1}, white);
        EXPECT_NEAR(seen.x, 1, 0.03) << off;
        EXPECT_LE(seen.x, 1 + 1e-9) << off;
    }
    EXPECT_EQ(rays.seen({2, 0, 3}, {0, 0, -1}, white), Colour(1, 1, 1));
}

// A ball of index n turns a ray by 2 (a - b), sin a = n sin b, a being the angle at which it comes.
TEST(LiquidRays, RefractBySnellsLaw)
{
    const TriangleMesh mesh = ball(6);
    const double index = 1.333;
    const LiquidRays rays(mesh, clear(index), 2);
    for (const double off : {0.0, 0.2, 0.5, 0.7})
    {
        const auto light = rays.through({off, 0.001, 3}, {0, 0, -1}, white);
        ASSERT_TRUE(light);
        const double in = std::asin(std::hypot(off, 0.001)), turned = 2*(in - std::asin(std::sin(in)/index));
        EXPECT_NEAR(std::acos(-light->direction.z), turned, 2e-3) << off;           // normals between those of vertices 0.017 apart
        const double straight = (index - 1)/(index + 1), left = 1 - straight*straight;
        if (off == 0)
        {
            EXPECT_NEAR(light->left.x, left*left, 1e-5);                            // Fresnel at right angles, in and out
        }
    }
}

TEST(LiquidRays, AbsorbByTheWayThroughTheLiquid)
{
    const TriangleMesh mesh = ball();
    LiquidLook look = clear(1.0001);
    look.passes = {0.5, 0.25, 1};
    const LiquidRays rays(mesh, look, 1);               // half of red a unit of length
    const Colour middle = rays.seen({0, 0.001, 3}, {0, 0, -1}, white), side = rays.seen({0.8, 0, 3}, {0, 0, -1}, white);
    EXPECT_NEAR(middle.x, 0.25, 1e-3);                  // two units
    EXPECT_NEAR(middle.y, 0.0625, 1e-3);
    EXPECT_NEAR(middle.z, 1, 1e-3);
    EXPECT_NEAR(side.x, std::pow(0.5, 1.2), 2e-3);      // a chord of 2 x 0.6
}

// A ball open at its side x < 0: what comes in there is neither bent, darkened nor mirrored by the half behind it; what comes from outside is bent.
TEST(LiquidRays, GoStraightInWhereTheLiquidIsOpen)
{
    TriangleMesh half = ball();
    std::erase_if(half.faces, [&](const std::array<int, 3>& face) { return half.vertices[face[0]].x < 0; });
    const LiquidRays rays(half, {"dark", 1.33, {0.5, 0.5, 0.5}, {}, false}, 1);
    const Vector3 along(1, 0, 0), slanting = normalized(Vector3(1, 0.2, 0));
    EXPECT_EQ(rays.seen({-5, 0.3, 0.1}, along, white), Colour(1, 1, 1));
    const auto light = rays.through({-5, 0.3, 0.1}, slanting, white);
    ASSERT_TRUE(light.has_value());
    EXPECT_EQ(light->left, Colour(1, 1, 1));
    EXPECT_EQ(light->direction, slanting);
    const auto bent = rays.through({5, 0.3, 0.1}, -along, white);
    ASSERT_TRUE(bent.has_value());
    EXPECT_GT(length(bent->direction + along), 0.05);           // by Snell's law, 18.4 degrees become 13.7
}

TEST(LiquidRays, EndAtTouchedWallsAndMirrorAtMetals)
{
    const TriangleMesh mesh = ball();
    LiquidSurroundings around = white;
    around.wall = [](const Vector3& place, const Vector3&) { return place.z < -0.9 ? std::optional(place) : std::nullopt; };
    around.seen = [](const Vector3&, const Vector3& direction) { return direction.z < -0.999 ? Colour(1, 0, 0) : Colour(0, 0, 0); };
    const LiquidRays rays(mesh, clear(1.333), 2);
    const double mirrored = std::pow(0.333/2.333, 2);
    EXPECT_NEAR(rays.seen({0, 0.001, 3}, {0, 0, -1}, around).x, 1 - mirrored, 1e-3);        // no second face: the wall as it is
    const LiquidRays metal(mesh, liquidLook("mercury"), 2);
    EXPECT_NEAR(metal.seen({0, 0.001, 3}, {0, 0, -1}, white).x, 0.78, 1e-3);
    EXPECT_FALSE(metal.through({0, 0, 3}, {0, 0, -1}, white));
}

TEST(Studio, IsBrightAtTheHorizonAndDarkAbove)
{
    const Studio studio({0, 0, 1}, {1, 0, 0}, {0, -1, 0});
    EXPECT_GT(studio.light({0, 1, 0}).y, 0.85);         // behind the liquid: no panel
    EXPECT_LT(studio.light({0, 0, 1}).y, 0.4);
    EXPECT_GT(studio.light(normalized({-0.5, -0.45, 0.8})).y, 2);       // the panel that lights it
}
