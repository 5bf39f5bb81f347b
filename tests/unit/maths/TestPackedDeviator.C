// SPDX-License-Identifier: GPL-3.0-or-later
// A deviator in four words.

#include "maths/PackedDeviator.H"
#include "support/PointSets.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// Numbers of any sign and of magnitudes from 1e-30 to 1e30.
scalar anyNumber(RandomNumbers& random) { return (random(0, 1) < 0.5f ? -1.0f : 1.0f) * std::pow(10.0f, random(-30, 30)); }

}

// Each number by itself, whatever the others are: four of them within 2^-17, the fifth within 2^-20; zz makes the trace zero.
TEST(PackedDeviator, KeepsEachNumber)
{
    RandomNumbers random(3);
    const scalar four = 1 / 131072.0f, fifth = 1 / 1048576.0f;
    for (int k = 0; k < 10000; ++k)
    {
        const scalar xx = anyNumber(random), yy = anyNumber(random), xy = anyNumber(random), yz = anyNumber(random), zx = anyNumber(random);
        const SymmTensor<Vec3> back = unpacked(packed({{xx, yy, -xx - yy}, {xy, yz, zx}}));
        EXPECT_NEAR(back.diagonal.x, xx, four * std::abs(xx));
        EXPECT_NEAR(back.diagonal.y, yy, four * std::abs(yy));
        EXPECT_EQ(back.diagonal.z, -back.diagonal.x - back.diagonal.y);
        EXPECT_NEAR(back.other.x, xy, four * std::abs(xy));
        EXPECT_NEAR(back.other.y, yz, four * std::abs(yz));
        EXPECT_NEAR(back.other.z, zx, fifth * std::abs(zx));
    }
}

// Where there is no stress, none comes back; and zeros beside a number come back as what no float with a normal exponent is smaller than.
TEST(PackedDeviator, KeepsZeros)
{
    const SymmTensor<Vec3> none = unpacked(packed({}));
    for (const Vec3 part : {none.diagonal, none.other}) EXPECT_EQ(squared(part), 0);
    const SymmTensor<Vec3> one = unpacked(packed({{}, {0, 0, -0.3f}}));
    for (const scalar zero : {one.diagonal.x, one.diagonal.y, one.diagonal.z, one.other.x, one.other.y}) EXPECT_LT(std::abs(zero), 1.2e-38f);
    EXPECT_NEAR(one.other.z, -0.3f, 0.3f / 1048576);
}
