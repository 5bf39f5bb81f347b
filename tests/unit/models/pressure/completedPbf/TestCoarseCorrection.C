#include "support/PressureReference.H"
#include "support/PointSets.H"

#include <gtest/gtest.h>

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
std::vector<Vec3> pressedColumn(float spacing)
{
    std::vector<Vec3> points;
    for (const Vec3& x : latticeBlock(across, across, deep, 1, {0.5f, 0.5f, 0.5f})) points.push_back({x.x, x.y, x.z * spacing});
    return points;
}

struct Outcome
{
    double compression = 0;         // mean of the densities' error, of what the last iteration saw
    double rise = 0;                // of the centroid, in spacings
};

Outcome stepOf(const std::vector<Vec3>& points, const std::string& controls, const CaseText& text = tank())
{
    LiquidCase drop(text);
    const auto pressure = makePressure(drop, "completedPbf", controls);
    drop.place(points);
    iterate(*pressure, drop, 0.1f);
    Outcome outcome;
    for (const float density : drop.liquid.density.download()) outcome.compression += (density - 1) / double(points.size());
    const std::vector<Vec3> after = drop.inOrder(drop.liquid.predicted);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        outcome.rise += (after[i].z / drop.liquid.spacing() - points[i].z) / double(points.size());
    }
    return outcome;
}

}

// Pressed together by 6 %, for which its centroid has to rise by 1.8 spacings: in eight iterations it does so, where the particles' iterations
// alone lift it by less than a quarter of that. What remains is disorder, what the grid bears, and the walls' layers, of which a lattice's read 4 % too
// much: a third of what remains without.
TEST(CoarseCorrection, ExpandsADeepColumnInOneStep)
{
    const auto points = pressedColumn(0.94f);
    const std::string eight = "minIterations 8; maxIterations 8; tolerance 0;";
    const Outcome without = stepOf(points, eight), with = stepOf(points, eight + " coarseGrid yes;");
    EXPECT_LT(without.rise, 0.25 * 0.5 * 0.06 * deep);
    EXPECT_NEAR(with.rise, 0.5 * 0.06 * deep, 0.3 * 0.5 * 0.06 * deep);
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
    const Outcome without = stepOf(points, eight, open);
    testing::internal::CaptureStderr();
    const Outcome with = stepOf(points, eight + " coarseGrid yes;", open);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("more than 2^26"), std::string::npos);
    EXPECT_EQ(with.rise, without.rise);
}
