// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/PressureReference.H"
#include "support/PointSets.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr int across = 8, deep = 60;

CaseText tank()
{
    return {.walls = "tank { type box; min (0 0 0); max (8e-3 8e-3 0.2); }", .wettability = "tank { theta 90; }"};
}

// A column of water in a tank that is just as wide, so many spacings deep, pressed together along its height.
std::vector<Vec3> pressedColumn(scalar spacing)
{
    std::vector<Vec3> points;
    for (const Vec3& x : latticeBlock(across, across, deep, 1, {0.5f, 0.5f, 0.5f})) points.push_back({x.x, x.y, x.z * spacing});
    return points;
}

struct Outcome
{
    double compression = 0;         // mean of the densities' error, of what the last iteration saw
    double rise = 0;                // of the centroid, in spacings
    double most = 0;                // of any particle
};

// Of some steps, each from where the one before ended.
Outcome stepOf(const std::vector<Vec3>& points, const std::string& controls, int steps = 3, const CaseText& text = tank())
{
    LiquidCase drop(text);
    const auto pressure = makePressure(drop, "completedPbf", controls);
    std::vector<Vec3> after = points;
    for (int step = 0; step < steps; ++step)
    {
        drop.place(after);
        iterate(*pressure, drop, 0.1f);
        after = drop.inOrder(drop.liquid.predicted);
        for (Vec3& x : after) x = 1 / drop.liquid.spacing() * x;
    }
    Outcome outcome;
    for (const scalar density : drop.liquid.density.download()) outcome.compression += (density - 1) / double(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        outcome.rise += (after[i].z - points[i].z) / double(points.size());
        outcome.most = std::max(outcome.most, double(after[i].z - points[i].z));
    }
    return outcome;
}

}

// Pressed together by 0.5 to 2 %, which lattices read as 2.5 % more for their layers at walls: in three steps of eight iterations the grid leaves less than a per cent, of
// which it bears 0.3, and without it nearly all of it is left. The outermost layers of these lattices lie in another cell than those deep inside, or in the one beyond.
TEST(CoarseCorrection, ExpandsADeepColumn)
{
    const std::string eight = "minIterations 8; maxIterations 8; tolerance 0;";
    for (const scalar pressed : {0.005f, 0.01f, 0.015f, 0.02f})
    {
        const auto points = pressedColumn(1 - pressed);
        const Outcome without = stepOf(points, eight), with = stepOf(points, eight + " coarseGrid yes;");
        EXPECT_GT(without.compression, 0.025 + 0.9 * pressed) << pressed;
        EXPECT_LT(std::abs(with.compression), 0.01) << pressed;
    }
}

// Pressed together by 6 %, for which its centroid has to rise by 1.8 spacings, and its top by 3.6: the four corrections of a step lift nothing by more than a fifth of one
// each beyond what the particles' iterations do, in one step and in four, and the top by all of that but 2 %, the shares of cells. (Of liquid that the grid has lifted these
// are others than alone: up to a tenth of all, by the order of sums.) So the centroid has risen so far in four steps, where the
// particles' iterations alone lift it by a fiftieth of that; in an even expansion it has half the top's way, and more of it, by less than a fifth, where the top is held back. What remains
// is disorder, what the grid bears, the rest of the way, and the walls' layers, of which a lattice's read 4 % too much: a third of what remains without.
TEST(CoarseCorrection, LiftsNothingFarAtOnce)
{
    const auto points = pressedColumn(0.94f);
    const std::string eight = "minIterations 8; maxIterations 8; tolerance 0;";
    const Outcome before = stepOf(points, eight, 1), once = stepOf(points, eight + " coarseGrid yes;", 1);
    const double perStep = 4 * 0.2;
    EXPECT_LT(once.most, 1.1 * (before.most + perStep));
    EXPECT_GT(once.most, 0.98 * (before.most + perStep));

    const Outcome without = stepOf(points, eight, 4), with = stepOf(points, eight + " coarseGrid yes;", 4);
    EXPECT_LT(with.most, 1.1 * (without.most + 4 * perStep));
    EXPECT_GT(with.most, 0.98 * (without.most + 4 * perStep));
    EXPECT_LT(without.rise, 0.05 * 0.5 * 0.06 * deep);
    EXPECT_GT(with.rise, 0.5 * 0.06 * deep);
    EXPECT_LT(with.rise, 1.2 * 0.5 * with.most);
    EXPECT_GT(without.compression, 0.06);
    EXPECT_LT(std::abs(with.compression), 0.4 * without.compression);
}

// No particle is deep inside of a small drop: there is nothing to be done, to the last bit.
TEST(CoarseCorrection, LeavesSmallDropsAlone)
{
    const auto points = latticeBlock(4, 4, 4, 0.95f, {2, 2, 2});
    const auto moved = [&](const std::string& controls)
    {
        LiquidCase drop(tank());
        const auto pressure = makePressure(drop, "completedPbf", controls);
        drop.place(points);
        iterate(*pressure, drop, 0.1f);
        return drop.inOrder(drop.liquid.predicted);
    };
    const auto with = moved("coarseGrid yes;"), without = moved("");
    for (std::size_t i = 0; i < with.size(); ++i) ASSERT_EQ(norm(with[i] - without[i]), 0) << i;
}

// Two columns 1,000 spacings apart along each axis: a box around both has 500^3 = 1.3e8 cells. The grid is left out, which is said.
TEST(CoarseCorrection, SaysThatLiquidLiesTooFarApart)
{
    auto points = pressedColumn(0.94f);
    const std::size_t one = points.size();
    for (std::size_t i = 0; i < one; ++i) points.push_back(points[i] + Vec3{1000, 1000, 1000});
    CaseText open;
    const std::string eight = "minIterations 8; maxIterations 8; tolerance 0;";
    const Outcome without = stepOf(points, eight, 1, open);
    testing::internal::CaptureStderr();
    const Outcome with = stepOf(points, eight + " coarseGrid yes;", 1, open);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("more than 2^26"), std::string::npos);
    EXPECT_EQ(with.rise, without.rise);
}

TEST(CoarseCorrection, IsRefusedBetweenSides)
{
    LiquidCase between({.boundary = "min (0 0 0); max (0.02 0 0); sides { xMin cyclic; xMax cyclic; }"});
    EXPECT_TRUE(holds(messageOf([&] { makePressure(between, "completedPbf", "coarseGrid yes;"); }), {"coarseGrid", "does not go on across the sides of constant/boundary"}));
}
