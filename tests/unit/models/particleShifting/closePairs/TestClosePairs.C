// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/particleShifting/ParticleShifting.H"

#include "support/LiquidCase.H"
#include "support/SurfaceStates.H"

#include <algorithm>
#include <cmath>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

std::unique_ptr<ParticleShifting> make(LiquidCase& drop, const std::string& coeffs = "")
{
    const Dictionary models = Dictionary::parse("particleShifting closePairs; closePairsCoeffs { " + coeffs + " }", "constant/models");
    return ParticleShifting::New(models, drop.liquid, drop.walls, drop.surface);
}

// Where the model leaves these points, in spacings.
std::vector<Vec3> shifted(LiquidCase& drop, ParticleShifting& model, const std::vector<Vec3>& points)
{
    drop.place(points);
    model.apply(drop.liquid, drop.near, drop.walls);
    std::vector<Vec3> x = drop.inOrder(drop.liquid.position);
    for (Vec3& p : x) p = 1 / drop.liquid.spacing() * p;
    return x;
}

scalar nearest(const std::vector<Vec3>& points, std::size_t i)
{
    scalar least = 1e30f;
    for (std::size_t j = 0; j < points.size(); ++j)
    {
        if (j != i) least = std::min(least, norm(points[i] - points[j]));
    }
    return least;
}

}

// By the sum over all pairs, in a ball of 9 spacings: of those inside, none of the outermost layer.
TEST(ClosePairs, AreMovedApartByWhatTheyLack)
{
    LiquidCase drop;
    const auto model = make(drop, "distance 0.9;");
    auto points = latticeBall(9);
    RandomNumbers random(3);
    disorder(points, 0.25f, random);
    const auto x = shifted(drop, *model, points);
    int moved = 0, limited = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        Vec3 expected;
        for (std::size_t j = 0; j < points.size(); ++j)
        {
            const Vec3 r = points[i] - points[j];
            const scalar apart = norm(r);
            if (i != j && apart < 0.9f) expected += 0.5f * (0.9f - apart) / apart * r;
        }
        const scalar far = norm(expected);
        if (far > 0.1f) expected = 0.1f / far * expected;
        const scalar r = norm(points[i]);
        // Positions of up to 9 spacings in single precision, scaled and back: 1e-6 of these each.
        if (r < 6) { ASSERT_LT(norm(x[i] - points[i] - expected), 1e-5f) << i; }
        if (r > 8.5f) { ASSERT_LT(norm(x[i] - points[i]), 2e-6f) << "at the surface, " << i; }
        moved += r < 6 && far > 0.02f;
        limited += r < 6 && far > 0.1f;
    }
    EXPECT_GT(moved, 200);
    EXPECT_GT(limited, 20);
}

// The lattice, and liquid whose pairs are farther apart than the distance, stay to the last bit.
TEST(ClosePairs, LeaveALatticeAlone)
{
    LiquidCase drop;
    const auto model = make(drop);
    drop.place(latticeBall(7));
    const auto before = drop.inOrder(drop.liquid.position);
    model->apply(drop.liquid, drop.near, drop.walls);
    const auto after = drop.inOrder(drop.liquid.position);
    for (std::size_t i = 0; i < before.size(); ++i) ASSERT_EQ(norm(after[i] - before[i]), 0) << i;
}

// A lattice that was pressed to 0.55 spacings along one axis and stretched to 1.35 along the others, volume as before, and is a little
// disturbed: columns of pairs. Of as many steps as a 60th second's are in half a second no pair remains closer than 0.8.
TEST(ClosePairs, DissolveTheColumnsOfASqueezedLattice)
{
    LiquidCase drop;
    const auto model = make(drop);
    std::vector<Vec3> points;
    for (const Vec3& p : latticeBlock(15, 15, 36, 1, {-7, -7, -17.5f})) points.push_back({1.35f * p.x, 1.35f * p.y, 0.55f * p.z});
    RandomNumbers random(5);
    disorder(points, 0.05f, random);
    const auto inner = [](const Vec3& p) { return std::fabs(p.x) < 4 && std::fabs(p.y) < 4 && std::fabs(p.z) < 4; };
    const auto closest = [&]
    {
        std::vector<scalar> distances;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            if (inner(points[i])) distances.push_back(nearest(points, i));
        }
        std::nth_element(distances.begin(), distances.begin() + distances.size() / 20, distances.end());
        return distances[distances.size() / 20];
    };
    EXPECT_LT(closest(), 0.52f);
    for (int step = 0; step < 30; ++step) points = shifted(drop, *model, points);
    EXPECT_GT(closest(), 0.75f);
}

// A lattice squeezed towards a floor, its lowest layer half a spacing above it, as close as liquid is let: of the others each is pushed from
// both sides, that layer towards the floor, by a tenth of a spacing if it were not there.
TEST(ClosePairs, PassNoWalls)
{
    LiquidCase drop(caseOnFloor({}));
    const auto model = make(drop);
    std::vector<Vec3> points;
    for (const Vec3& p : latticeBlock(13, 13, 13, 1, {-6, -6, 0})) points.push_back({1.2f * p.x, 1.2f * p.y, 0.5f + 0.7f * p.z});
    const auto x = shifted(drop, *model, points);
    const auto states = surfaceStates(drop);
    int pushed = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const Vec3 p = points[i];
        if (std::fabs(p.x) > 3 || std::fabs(p.y) > 3 || p.z > 3) continue;
        ASSERT_GT(states[i].depth, drop.liquid.spacing()) << "is among those that are moved";
        ASSERT_LT(norm(x[i] - p), 2 * quanta::each);
        pushed += p.z < 1;
    }
    EXPECT_EQ(pushed, 25);
}

TEST(ClosePairs, RefuseADistanceOutOfRange)
{
    LiquidCase drop;
    for (const std::string distance : {"0", "1.1", "-1"})
    {
        EXPECT_TRUE(holds(messageOf([&] { make(drop, "distance " + distance + ";"); }), {"constant/models", "above 0, up to 1 spacing"}));
    }
}
