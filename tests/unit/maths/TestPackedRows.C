// SPDX-License-Identifier: GPL-3.0-or-later
// A matrix and a share in five words.

#include "maths/PackedRows.H"
#include "support/PointSets.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

struct Back
{
    Rows<Vec3> rows;
    scalar share;
};

Back thereAndBack(const Rows<Vec3>& rows, scalar share)
{
    const PackedRows words = packed(rows, share);
    const auto back = unpacked(words.words, words.last);
    return {back.quantum * back.counts, back.share};
}

void expectNear(Vec3 a, Vec3 b, scalar within)
{
    EXPECT_NEAR(a.x, b.x, within);
    EXPECT_NEAR(a.y, b.y, within);
    EXPECT_NEAR(a.z, b.z, within);
}

}

// Numbers of any sign, the largest of magnitudes from 1e-20 to 1e20 and the others to a thousandth of it.
TEST(PackedRows, KeepsNumbersToAShareOfTheLargest)
{
    RandomNumbers random(3);
    for (int k = 0; k < 10000; ++k)
    {
        const scalar size = std::pow(10.0f, random(-20, 20));
        const auto number = [&] { return size * random(-1, 1) * std::pow(10.0f, random(-3, 0)); };
        const auto row = [&] { return Vec3{number(), number(), number()}; };
        const Rows<Vec3> rows{row(), row(), row()};
        scalar largest = 0;
        for (const Vec3& a : {rows.x, rows.y, rows.z}) largest = std::max(largest, packedRows::largestOf(a));
        const scalar share = random(0, 1);
        const Back back = thereAndBack(rows, share);
        // A quantum is at most 2^-14 of the largest: half of one off, or a whole one where the last would be beyond.
        const scalar within = largest / 16384;
        expectNear(back.rows.x, rows.x, within);
        expectNear(back.rows.y, rows.y, within);
        expectNear(back.rows.z, rows.z, within);
        EXPECT_NEAR(back.share, share, 0.501f / 255);
        EXPECT_NEAR(packedShare(share), back.share, 1e-7f);
    }
}

TEST(PackedRows, KeepsNothingAndAllOfAShare)
{
    const Back none = thereAndBack({}, 0), all = thereAndBack({{0, 0, 1}, {}, {}}, 1);
    for (const Vec3 row : {none.rows.x, none.rows.y, none.rows.z, all.rows.y, all.rows.z}) EXPECT_EQ(squared(row), 0);
    EXPECT_EQ(none.share, 0);
    EXPECT_NEAR(all.share, 1, 1e-7f);
    EXPECT_EQ(all.rows.x.z, 1);
    EXPECT_EQ(all.rows.x.x, 0);
}

TEST(PackedRows, AreMirroredExactly)
{
    RandomNumbers random(7);
    for (int k = 0; k < 1000; ++k)
    {
        const Rows<Vec3> rows{random({-1, -1, -1}, {1, 1, 1}), random({-1, -1, -1}, {1, 1, 1}), random({-1, -1, -1}, {1, 1, 1})};
        const PackedRows words = packed(rows, 0.5f);
        const auto plain = unpacked(words.words, words.last);
        for (int sides = 0; sides < 8; ++sides)
        {
            const Vec3 s{sides & 1 ? -1.0f : 1.0f, sides & 2 ? -1.0f : 1.0f, sides & 4 ? -1.0f : 1.0f};
            const auto seen = unpacked(mirrored(words.words, s.x, s.y, s.z), words.last);
            const auto expectRow = [&](Vec3 found, Vec3 own, scalar sign)
            {
                EXPECT_EQ(found.x, sign * s.x * own.x);
                EXPECT_EQ(found.y, sign * s.y * own.y);
                EXPECT_EQ(found.z, sign * s.z * own.z);
            };
            expectRow(seen.counts.x, plain.counts.x, s.x);
            expectRow(seen.counts.y, plain.counts.y, s.y);
            expectRow(seen.counts.z, plain.counts.z, s.z);
            EXPECT_EQ(seen.share, plain.share);
        }
    }
}
