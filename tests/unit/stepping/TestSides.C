// SPDX-License-Identifier: GPL-3.0-or-later
// Space that repeats across cyclic sides, and mirrors at symmetry planes: neighbours, densities, steps, and what is refused.

#include "models/density/Density.H"
#include "motion/Motion.H"
#include "neighbours/ImagesOfLiquid.H"
#include "stepping/SubStep.H"
#include "support/LiquidCase.H"
#include "support/NeighbourLists.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <set>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr int periodInSpacings = 12;

// Sides around the origin of those axes: "xz".
std::string cyclicSides(const std::string& axes, double half = 0.5e-3 * periodInSpacings)
{
    const std::string at = std::to_string(half);
    std::string sides;
    for (const char axis : axes)
    {
        for (const char* end : {"Min", "Max"}) sides.append(1, axis).append(end).append(" cyclic; ");
    }
    return "min (-" + at + " -" + at + " -" + at + "); max (" + at + ' ' + at + ' ' + at + "); sides { " + sides + "}";
}

void expectRefused(const std::string& boundary, const std::string& reason)
{
    ScratchFolder folder;
    folder.write("constant/boundary", boundary);
    const std::string message = messageOf([&] { Sides::read(folder.path(), 1e-3); });
    EXPECT_NE(message.find(reason), std::string::npos) << boundary << '\n' << message;
}

using Key = std::array<std::int64_t, 6>;
using State = std::map<std::uint32_t, Key>;             // by particle: place and velocity

// A ball of liquid with the models of the default set.
class RepeatedDrop : public LiquidCase
{
public:
    explicit RepeatedDrop(const CaseText& text, const std::string& moreModels = {}) : LiquidCase(text)
    {
        const auto set = std::filesystem::path(std::getenv("SHIZUKU_DIR")) / "tests/validation/models/default";
        std::ifstream file(set / "models");
        folder.write("constant/models", std::string{std::istreambuf_iterator<char>(file), {}} + "bodyForce none;" + moreModels);
        std::ifstream solution(set / "solution");
        folder.write("system/solution", std::string{std::istreambuf_iterator<char>(solution), {}});
        models = std::make_unique<Models>(folder.path(), Dictionary::read(folder.path() / "system/solution"), liquid, walls);
        models->takeEffect(liquid, walls);
        liquid.ghosts().poisonUndeclared();
    }

    std::int64_t period() const
    {
        const SideMaps& maps = liquid.ghosts().images()->sides().maps();
        return maps.at[0][1] - maps.at[0][0];
    }

    // Those particles, moved on by so many quanta, after so many steps. Places are counted from what they were moved by, around the box.
    State run(const std::vector<Vec3>& points, const std::vector<Vec3>& velocities, Place by, int steps)
    {
        std::vector<Position> x;
        for (const Vec3& p : points)
        {
            const Vec3 scaled = liquid.spacing() * p;
            const Place at = placeAt(scaled.x, scaled.y, scaled.z);
            x.push_back(positionAt(Place{at.x + by.x, at.y + by.y, at.z + by.z}));
        }
        std::vector<std::uint32_t> id(x.size());
        for (std::size_t i = 0; i < id.size(); ++i) id[i] = std::uint32_t(i);
        liquid.resize(int(x.size()));
        liquid.position.upload(x);
        liquid.velocity.upload(velocities);
        liquid.id.upload(id);
        const scalar dt = liquid.units().toScaled(0.5 * liquid.properties().capillaryStep(), dimensions::time);
        SubStep step(liquid, near, walls, *models);
        settle(liquid, near, walls, *models, dt);
        for (int k = 0; k < steps; ++k) step(dt);
        return state(by);
    }

    State state(Place by) const
    {
        const auto x = liquid.position.download();
        const auto u = liquid.velocity.download();
        const auto id = liquid.id.download();
        State result;
        for (int i = 0; i < liquid.owned(); ++i)
        {
            const Place at = placeOf(x[i]);
            result[id[i]] = {around(at.x - by.x), around(at.y - by.y), around(at.z - by.z), 0, 0, 0};
            for (int c = 0; c < 3; ++c) result[id[i]][3 + c] = std::llround(double(c == 0 ? u[i].x : c == 1 ? u[i].y : u[i].z) * double(1 << 19));
        }
        return result;
    }

    std::unique_ptr<Models> models;

private:
    std::int64_t around(std::int64_t x) const
    {
        if (!liquid.ghosts().images()) return x;
        const std::int64_t p = period(), rest = ((x + p / 2) % p + p) % p;
        return rest - p / 2;
    }
};

std::int64_t farthest(const State& a, const State& b, int first, int end)
{
    std::int64_t most = 0;
    EXPECT_EQ(a.size(), b.size());
    for (const auto& [id, of] : a)
    {
        for (int c = first; c < end; ++c) most = std::max(most, std::abs(of[c] - b.at(id)[c]));
    }
    return most;
}

std::vector<Vec3> disorderedBall(scalar radius)
{
    auto points = latticeBall(radius);
    RandomNumbers random(5);
    disorder(points, 0.03f, random);
    return points;
}

}

TEST(Sides, NeighboursAreThoseOfSpaceThatRepeats)
{
    for (const std::string axes : {"x", "y", "z", "xy", "yz", "zx", "xyz"})
    {
        LiquidCase box({.boundary = cyclicSides(axes)});
        constexpr scalar half = 0.5f * periodInSpacings;
        const auto points = randomPoints(1500, {-half, -half, -half}, {half, half, half});
        box.place(points);
        const std::vector<std::uint32_t> all = box.liquid.id.download();
        std::vector<std::uint32_t> ids(all);
        for (std::uint32_t& id : ids) id &= (1u << 29) - 1;             // of the particle that an image is one of
        const auto found = listsOf(box.near.view(), {ids.begin(), ids.begin() + box.liquid.owned()}, ids);

        const auto x = box.inOrder<Position>(box.liquid.position);
        const SideMaps& maps = box.liquid.ghosts().images()->sides().maps();
        const auto apart = [&](std::int64_t a, std::int64_t b, int axis)
        {
            std::int64_t d = a - b;
            const std::int64_t period = maps.at[axis][1] - maps.at[axis][0];
            if (!maps.isOpen[axis][0]) d -= period * std::llround(double(d) / double(period));
            return quanta::lengthOf(d);
        };
        std::size_t across = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            std::multiset<int> expected;
            const Place a = placeOf(x[i]);
            for (std::size_t j = 0; j < points.size(); ++j)
            {
                const Place b = placeOf(x[j]);
                const double dx = apart(a.x, b.x, 0), dy = apart(a.y, b.y, 1), dz = apart(a.z, b.z, 2);
                // In single precision, as the search does: pairs at the rim of the support.
                const scalar r2 = scalar(dx) * scalar(dx) + scalar(dy) * scalar(dy) + scalar(dz) * scalar(dz);
                if (i != j && r2 < box.liquid.support() * box.liquid.support()) expected.insert(int(j));
            }
            ASSERT_EQ(std::multiset<int>(found[i].begin(), found[i].end()), expected) << axes << ", particle " << i;
            for (const int j : found[i]) across += norm(points[i] - points[std::size_t(j)]) > half;
        }
        EXPECT_GT(across, 500u) << axes;                // pairs that only sides make neighbours
    }
}

TEST(Sides, ABoxThatIsFullHasTheDensityOfTheLatticeEverywhere)
{
    LiquidCase box({.boundary = cyclicSides("xyz")});
    const scalar low = 0.5f - 0.5f * periodInSpacings;
    box.place(latticeBlock(periodInSpacings, periodInSpacings, periodInSpacings, 1, {low, low, low}));
    computeDensity(box.liquid, box.near, box.walls);
    for (const scalar density : box.inOrder(box.liquid.density)) EXPECT_NEAR(density, 1, 2e-5);         // places are whole quanta, two millionths of a spacing
}

// Balls of a radius of 2 between sides at 6 and -6; across the upper one, put back between the sides, it is near to both.
TEST(Sides, ABodyMayLieAcrossWhereLiquidIsNearBoth)
{
    const auto mayLie = [](const std::string& axes, scalar x)
    {
        LiquidCase box({.boundary = cyclicSides(axes)});
        auto points = latticeBall(2, {x, 0, 0});
        for (Vec3& p : points) p.x -= p.x >= 6 ? 12 : 0;
        box.place(points);
        return mayLieAcross(box.liquid, box.liquid.ghosts().images()->sides(), 1.5 * box.liquid.spacing());
    };
    EXPECT_FALSE(mayLie("x", 0));
    EXPECT_FALSE(mayLie("x", 3.9f));            // to 5.9
    EXPECT_TRUE(mayLie("xz", 4.9f));
    EXPECT_FALSE(mayLie("yz", 3.9f));
}

TEST(Sides, LiquidThatIsShiftedByHalfAPeriodMovesAlike)
{
    const auto points = disorderedBall(4.2f);
    const std::vector<Vec3> velocities(points.size(), Vec3{0.1f, -0.2f, 0.3f});
    for (const std::string axes : {"x", "yz", "xyz"})
    {
        for (const std::string more : {"", "velocityCorrection keepsTurns;", "particleShifting closePairs;"})
        {
            RepeatedDrop middle({.boundary = cyclicSides(axes)}, more), shifted({.boundary = cyclicSides(axes)}, more);
            const std::int64_t half = middle.period() / 2;
            const auto along = [&](char axis) { return axes.find(axis) != std::string::npos ? half : 0; };
            const Place by{along('x'), along('y'), along('z')};
            constexpr int steps = 20;
            const State a = middle.run(points, velocities, {}, steps), b = shifted.run(points, velocities, by, steps);
            // Neighbours across a side come later in lists: roundings of sums differ, and 20 steps let them grow. A spacing has 537,000 quanta; 64 and 39 were measured.
            EXPECT_LE(farthest(a, b, 0, 3), 250) << axes << ' ' << more;
            EXPECT_LE(farthest(a, b, 3, 6), 150) << axes << ' ' << more;
            EXPECT_GT(shifted.liquid.all() - shifted.liquid.owned(), middle.liquid.all() - middle.liquid.owned());      // images
        }
    }
}

TEST(Sides, WhatLeavesComesInAtTheOtherSideWithTheSameBits)
{
    RepeatedDrop drop({.boundary = cyclicSides("xy")});
    const auto points = latticeBall(1.2f, {5, 5, 0});           // 6 spacings from the middle are the sides
    const scalar speed = 0.4f;
    drop.liquid.resize(0);
    const std::int64_t period = drop.period();
    const State start = drop.run(points, std::vector<Vec3>(points.size(), Vec3{speed, speed, 0}), {}, 0);
    for (const auto& [id, at] : start)
    {
        for (int c = 0; c < 2; ++c) EXPECT_LE(std::abs(at[c]), period / 2);
    }
    // A translation by a period has the same state to the bit, whatever side it starts at.
    RepeatedDrop before({.boundary = cyclicSides("xy")}), behind({.boundary = cyclicSides("xy")});
    const std::vector<Vec3> velocities(points.size(), Vec3{speed, speed, 0});
    const State a = before.run(points, velocities, {}, 5), b = behind.run(points, velocities, {-period, -period, 0}, 5);
    EXPECT_EQ(a, b);
}

TEST(Sides, MomentumIsKeptAcrossSides)
{
    RepeatedDrop drop({.boundary = cyclicSides("xyz")});
    const auto points = disorderedBall(3.2f);
    const std::vector<Vec3> velocities(points.size(), Vec3{0.5f, 0.3f, -0.4f});
    const std::int64_t half = drop.period() / 2;
    const State end = drop.run(points, velocities, {half, half, half}, 40);
    std::array<double, 3> mean{};
    for (const auto& [id, of] : end)
    {
        for (int c = 0; c < 3; ++c) mean[c] += double(of[3 + c]) / double(1 << 19) / double(end.size());
    }
    // Sums of pairs are taken to be internal, and what is left of them is removed: what remains are roundings.
    EXPECT_NEAR(mean[0], 0.5, 2e-4);
    EXPECT_NEAR(mean[1], 0.3, 2e-4);
    EXPECT_NEAR(mean[2], -0.4, 2e-4);
}

TEST(Sides, AreRefusedWhereTheyCannotBe)
{
    expectRefused("min (0 0 0); max (1 1 1); sides { xMin cyclic; }", "The side xMin is cyclic, and xMax is not");
    expectRefused("min (0 0 0); max (1 1 1); sides { xMin cyclical; xMax cyclic; }", "cyclical");
    expectRefused("min (0 0 0); max (0 1 1); sides { xMin cyclic; xMax cyclic; }", "The sides xMin and xMax are at 0 and 0 m");
    expectRefused("min (0 0 0); max (1 1 1); sides { yMin cyclic; yMax cyclic; left cyclic; }", "left");
    expectRefused("min (0 0 0); max (100 1 1); sides { xMin cyclic; xMax cyclic; }", "The cyclic sides xMin and xMax are 100 m apart");
    expectRefused("max (1 1 1); sides { }", "min");

    LiquidCase narrow({.boundary = cyclicSides("y", 1.5e-3)});
    EXPECT_NE(messageOf([&] { narrow.place({{0, 0, 0}}); }).find("The sides yMin and yMax are 0.003 m apart, and particles see each other across 0.002"), std::string::npos);

    LiquidCase box({.boundary = cyclicSides("z")});
    const Sides& sides = box.liquid.ghosts().images()->sides();
    sides.refuseOutside({{0, 5, 0.0179}});
    EXPECT_NE(messageOf([&] { sides.refuseOutside({{0, 0, 0}, {0, 0, 0.0181}}); }).find("(0 0 0.0181) m is beyond the side zMax"), std::string::npos);

    LiquidCase half({.boundary = "min (0 0 0); max (1 1 1); sides { xMin symmetryPlane; }"});
    const Sides& plane = half.liquid.ghosts().images()->sides();
    plane.refuseOutside({{0.001, -5, 0}, {9, 0, 0}});
    EXPECT_NE(messageOf([&] { plane.refuseOutside({{-0.001, 0, 0}}); }).find("(-0.001 0 0) m is beyond the side xMin, at x = 0 m"), std::string::npos);
}

TEST(Sides, OpenOnesAreNone)
{
    ScratchFolder folder;
    EXPECT_FALSE(Sides::read(folder.path(), 1e-3));
    folder.write("constant/boundary", "min (0 0 0); max (0 0 0); sides { xMin open; }");
    EXPECT_FALSE(Sides::read(folder.path(), 1e-3));
}

TEST(Sides, WallsGoOnBeyondThem)
{
    const std::string mirror = "min (0 -1 -1); max (1 1 1); sides { xMin symmetryPlane; }", cyclic = cyclicSides("x");
    const auto with = [](const std::string& boundary, const std::string& walls, const std::vector<Vec3>& solid = {})
    {
        return messageOf([&] { LiquidCase({.walls = walls, .boundary = boundary, .solidPositions = solid}); });
    };
    const auto expectRefusedWith = [&](const std::string& boundary, const std::string& walls, const std::string& found, const std::vector<Vec3>& solid = {})
    {
        const std::string message = with(boundary, walls, solid);
        EXPECT_NE(message.find(found), std::string::npos) << walls << '\n' << message;
    };
    const std::string slope = "slope { type plane; point (0 0 0); normal (1 0 10); }", along = "pipe { type cylinder; point (0 0 0); axis (1 0 0); radius 1e-3; liquid inside; }";
    const auto post = [](const std::string& x) { return "post { type cylinder; point (" + x + " 0 0); axis (0 0 1); radius 1e-3; liquid outside; }"; };
    const auto ball = [](const std::string& x) { return "ball { type sphere; centre (" + x + " 0 0); radius 1e-3; liquid outside; }"; };
    for (const std::string& boundary : {mirror, cyclic})
    {
        EXPECT_EQ(with(boundary, floorPlane), "no error");
        expectRefusedWith(boundary, slope, "The plane 'slope' does not go on beyond the");
        EXPECT_EQ(with(boundary, along), "no error");
        EXPECT_EQ(with(boundary, "tank { type box; min (-1 -1 0); max (1 1 1); }"), "no error");
    }
    EXPECT_EQ(with(cyclic, post("0")), "no error");
    expectRefusedWith(cyclic, post("5e-3"), "The cylinder 'post' does not go on beyond the cyclic side xMax");
    EXPECT_EQ(with(cyclic, ball("0")), "no error");
    expectRefusedWith(cyclic, ball("-5e-3"), "The sphere 'ball' does not go on beyond the cyclic side xMin");
    expectRefusedWith(cyclic, "tank { type box; min (-6e-3 -1 0); max (6e-3 1 1); }", "The box 'tank'");

    for (const std::string at : {"0", "4e-3"})
    {
        EXPECT_EQ(with(mirror, post(at)), "no error");
        EXPECT_EQ(with(mirror, ball(at)), "no error");
    }
    expectRefusedWith(mirror, post("1e-3"), "The cylinder 'post' does not go on beyond the symmetry plane xMin");
    expectRefusedWith(mirror, ball("2e-3"), "The sphere 'ball' does not go on beyond the symmetry plane xMin");
    EXPECT_EQ(with(mirror, "side { type plane; point (4e-3 0 0); normal (-1 0 0); }"), "no error");
    expectRefusedWith(mirror, "side { type plane; point (1e-3 0 0); normal (-1 0 0); }", "The plane 'side'");

    // Cyclic: 12 spacings from side to side, and two more at either of them.
    EXPECT_EQ(with(cyclic, sampledFloor, latticeBlock(17, 5, 1, 1, {-8, -2, -0.5f})), "no error");
    expectRefusedWith(cyclic, sampledFloor, "The wall 'floor' does not go on beyond the cyclic side xMin", latticeBlock(13, 5, 1, 1, {-8, -2, -0.5f}));
    EXPECT_EQ(with(mirror, sampledFloor, latticeBlock(17, 5, 1, 1, {-2, -2, -0.5f})), "no error");
    expectRefusedWith(mirror, sampledFloor, "The wall 'floor' does not go on beyond the symmetry plane xMin", latticeBlock(17, 5, 1, 1, {0, -2, -0.5f}));
}

// A drop that is symmetric to three planes, and an eighth of it between them.
TEST(Sides, AnEighthOfADropMovesAsTheWholeDrop)
{
    const auto stretch = [](const std::vector<Vec3>& points)
    {
        std::vector<Vec3> velocities;
        for (const Vec3& p : points) velocities.push_back({0.02f * p.x, -0.03f * p.y, 0.01f * p.z});
        return velocities;
    };
    const auto points = latticeBall(4.7f);
    std::vector<Vec3> eighth;
    std::vector<std::uint32_t> number;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        if (points[i].x < 0 || points[i].y < 0 || points[i].z < 0) continue;
        eighth.push_back(points[i]);
        number.push_back(std::uint32_t(i));
    }
    const CaseText planes{.boundary = "min (0 0 0); max (1 1 1); sides { xMin symmetryPlane; yMin symmetryPlane; zMin symmetryPlane; }"};
    for (const std::string more : {"", "velocityCorrection keepsTurns;", "particleShifting closePairs;"})
    {
        RepeatedDrop whole({}, more), part(planes, more);
        constexpr int steps = 20;
        const State a = whole.run(points, stretch(points), {}, steps), b = part.run(eighth, stretch(eighth), {}, steps);
        ASSERT_EQ(b.size(), points.size() / 8);
        State expected;
        for (std::size_t k = 0; k < number.size(); ++k) expected[std::uint32_t(k)] = a.at(number[k]);
        // Sums come in another order, and deviators that are mirrored are packed anew, within 2^-17: 48 and 29 quanta were measured on a CPU, 174 on a GPU, of 537,000 that a spacing has.
        EXPECT_LE(farthest(expected, b, 0, 3), 500) << more;
        EXPECT_LE(farthest(expected, b, 3, 6), 500) << more;
    }
}

TEST(Sides, WhatCrossesASymmetryPlaneComesBackMirrored)
{
    RepeatedDrop drop({.boundary = "min (0 0 0); max (1 1 1); sides { yMin symmetryPlane; }"});
    drop.place({{3, 0.5f, 2}}, {{0.25f, -2, 0.5f}});
    // A scaled unit of time, by which it goes two units down: to 1.488 below the plane.
    predictPositions(drop.liquid, 1);
    drop.near.update(drop.liquid);
    const Position p = drop.liquid.predicted.download()[0], x = drop.liquid.position.download()[0];
    const Vec3 u = drop.liquid.velocity.download()[0];
    const double spacing = drop.liquid.spacing(), quantum = quanta::lengthOf(1);
    EXPECT_NEAR(quanta::lengthOf(placeOf(p).y), 2 - 0.5 * spacing, quantum);
    EXPECT_NEAR(quanta::lengthOf(placeOf(x).y), -0.5 * spacing, quantum);
    EXPECT_NEAR(quanta::lengthOf(placeOf(p).x), 3 * spacing + 0.25, quantum);
    EXPECT_EQ(u.x, 0.25f);
    EXPECT_EQ(u.y, 2);
    EXPECT_EQ(u.z, 0.5f);
}
