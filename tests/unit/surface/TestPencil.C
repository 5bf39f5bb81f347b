// SPDX-License-Identifier: GPL-3.0-or-later
// What a pencil of normals holds, against bodies that are made of them.

#include "surface/Pencil.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace shizuku;

namespace
{

// By the half sum and the product of the curvatures, as a surface's are known.
Pencil pencilOf(scalar a, scalar b) { return Pencil::of(0.5f * (a + b), a * b, 100); }

}

// By area of a sphere of radius 2 and of a cylinder of radius 4: shells between r and R hold (R^3 - r^3)/(3 2^2) and (R^2 - r^2)/(2 4). Single precision.
TEST(Pencil, HoldsShells)
{
    const Pencil ball = pencilOf(0.5f, 0.5f), tube = pencilOf(0, 0.25f), plane = pencilOf(0, 0), cavity = pencilOf(-0.5f, -0.5f);
    for (const scalar t : {-1.5f, -0.5f, 0.25f, 1.0f})
    {
        EXPECT_NEAR(ball.volume(t), (std::pow(2 + t, 3) - 8) / 12, 1e-6) << t;
        EXPECT_NEAR(tube.volume(t), (std::pow(4 + t, 2) - 16) / 8, 1e-6) << t;
        EXPECT_EQ(plane.volume(t), t);
        EXPECT_NEAR(cavity.volume(t), (8 - std::pow(2 - t, 3)) / 12, 1e-6) << t;
    }
}

// They end at the centres of curvature, and at no other place.
TEST(Pencil, EndsAtCentresOfCurvature)
{
    const Pencil saddle = pencilOf(0.5f, -0.25f), plane = pencilOf(0, 0);
    EXPECT_FLOAT_EQ(saddle.lowest(-5), -2);
    EXPECT_EQ(saddle.lowest(-1), -1);
    EXPECT_FLOAT_EQ(saddle.highest(5), 4);
    EXPECT_EQ(saddle.highest(3), 3);
    EXPECT_EQ(plane.lowest(-5), -5);
    EXPECT_EQ(plane.highest(5), 5);
}

TEST(Pencil, CountsNoCurvatureAsMoreThanTheSharpest)
{
    const Pencil pencil = Pencil::of(0, -25, 3);
    EXPECT_EQ(pencil.most, 3);
    EXPECT_EQ(pencil.least, -3);
    EXPECT_EQ(pencil.mean(), 0);
}

// Newton's three steps from the volume itself: heights up to 0.4 radii on a cylinder, 0.3 on a ball within 1e-3 of the radius.
TEST(Pencil, IsFilledUpToTheHeightOfTheVolume)
{
    const Pencil ball = pencilOf(1, 1), tube = pencilOf(1, 0);
    for (const scalar t : {-0.3f, -0.1f, 0.0f, 0.1f, 0.3f}) EXPECT_NEAR(ball.height(ball.volume(t)), t, 1e-3) << t;
    for (const scalar t : {-0.4f, -0.1f, 0.0f, 0.1f, 0.4f}) EXPECT_NEAR(tube.height(tube.volume(t)), t, 1e-3) << t;
}

// Half way to another curvature; all the way.
TEST(Pencil, IsBroughtTowardsOneCurvature)
{
    const Pencil half = pencilOf(1, -1).towards(0.5f, 0.5f), all = pencilOf(1, -1).towards(0.5f, 1);
    EXPECT_FLOAT_EQ(half.most, 0.75f);
    EXPECT_FLOAT_EQ(half.least, -0.25f);
    EXPECT_FLOAT_EQ(all.most, 0.5f);
    EXPECT_FLOAT_EQ(all.least, 0.5f);
    // Sides that the height 1 stretches by 1.5 and 1.5: 0.5 times 1.5 in each direction.
    EXPECT_FLOAT_EQ(all.meanStretched(1), 0.75f);
}
