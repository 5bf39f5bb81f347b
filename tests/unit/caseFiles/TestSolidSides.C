// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/SolidSides.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shizuku::test
{

namespace
{

// The layer of a wedge along y whose edge lies at the origin and looks upwards, at a spacing of 1: a row below the edge, of both sides in turn,
// and rows down the flanks.
struct Wedge
{
    explicit Wedge(double degrees) : half(0.5*degrees*std::numbers::pi/180)
    {
        for (int row = 0; row < 12; ++row)
        {
            for (int place = -6; place <= 6; ++place)
            {
                for (const int side : {-1, 1})
                {
                    if (row == 0 && side != (place % 2 == 0 ? -1 : 1)) continue;
                    solid.positions.push_back(double(row)*down(side) - Vector3(0, 0, 0.5/std::sin(half)) + Vector3(0, place + 0.5*(row % 2), 0));
                    solid.normals.push_back(normal(side));
                }
            }
        }
        solid.patch.assign(solid.positions.size(), 0);
        solid.patches = {"wedge"};
    }

    Vector3 down(int side) const { return {side*std::sin(half), 0, -std::cos(half)}; }
    Vector3 normal(int side) const { return {side*std::cos(half), 0, std::sin(half)}; }

    double half;
    SolidParticles solid;
};

}

TEST(SolidSides, PlacesBesideASharpEdgeAreInFrontAndThoseBelowItBehind)
{
    for (const double degrees : {45.0, 60.0, 90.0, 120.0})
    {
        const Wedge wedge(degrees);
        const SolidSides sides(wedge.solid, 1);
        for (const int side : {-1, 1})
        {
            for (double along = 0; along < 6; along += 0.1)
            {
                for (const double y : {-0.3, 0.0, 0.5, 1.0})
                {
                    SCOPED_TRACE(testing::Message() << degrees << " degrees, " << side*along << " down, y " << y);
                    // Half a spacing off the flank, where the first liquid is.
                    EXPECT_FALSE(sides(along*wedge.down(side) + 0.5*wedge.normal(side) + Vector3(0, y, 0)).behind);
                }
            }
        }
        // Deeper than the layer by half a spacing and more, down to where the other ends of the flanks are as near.
        for (double below = 0.7; below < 6; below += 0.3)
        {
            EXPECT_TRUE(sides(Vector3(0, 0.2, -0.5/std::sin(wedge.half) - below)).behind) << degrees << " degrees, " << below;
        }
    }
}

TEST(SolidSides, BelowALayerIsBehindAndBesideItsBorderIsNot)
{
    SolidParticles solid;
    for (int x = 0; x <= 10; ++x) for (int y = 0; y <= 10; ++y) solid.positions.emplace_back(x, y, -0.5);
    solid.normals.assign(solid.positions.size(), {0, 0, 1});
    const SolidSides sides(solid, 1);
    EXPECT_TRUE(sides({5.2, 5.3, -3}).behind);
    EXPECT_FALSE(sides({5.2, 5.3, 3}).behind);
    EXPECT_FALSE(sides({12, 5, -1}).behind);
    EXPECT_DOUBLE_EQ(sides({5, 5, 1}).distance, 1.5);
    EXPECT_EQ(sides({0, 3, 1}).nearest, 3u);
}

// By cells the same is found as by asking for each: above and below a floor, beside its border, near it and far away.
TEST(SolidSides, ManyPlacesAreAskedForByCells)
{
    SolidParticles solid;
    for (int x = 0; x <= 40; ++x) for (int y = 0; y <= 40; ++y) solid.positions.emplace_back(x, y, -0.5);
    solid.normals.assign(solid.positions.size(), {0, 0, 1});
    for (const Vector3& p : solid.positions) solid.patch.push_back(p.x < 20 ? 0 : 1);
    solid.patches = {"left", "right"};
    SolidSides sides(solid, 1);
    int behind = 0;
    for (double x = -20.3; x < 60; x += 1.7)
    {
        for (double y = 1.1; y < 39; y += 3.7)
        {
            for (double z = -90.2; z < 90; z += 1.1)
            {
                // A place farther than a cell from the border, where the middle of a cell and its places may lie on different sides of it.
                if (z < -4 && std::min(std::abs(x), std::abs(x - 40)) < 5) continue;
                const SolidSides::Place place = sides({x, y, z});
                const bool inTheWay = place.behind || place.distance < 0.9;
                const auto patch = sides.patchInTheWay({x, y, z}, 0.9);
                ASSERT_EQ(patch.has_value(), inTheWay) << x << ' ' << y << ' ' << z;
                if (patch && (x < 16 || x > 24))
                {
                    EXPECT_EQ(*patch, solid.patch[place.nearest]);
                }
                behind += inTheWay;
            }
        }
    }
    EXPECT_GT(behind, 1000);
}

}
