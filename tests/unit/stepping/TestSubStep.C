// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/SubStep.H"

#include "motion/Motion.H"
#include "support/LiquidCase.H"
#include "support/MotionSums.H"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// A block that a step drives to half its size, onto a sampled floor: lists find no room. prepared: they are known to be long.
std::vector<Vec3> positionsAfterStep(bool prepared)
{
    constexpr scalar dt = 0.1f;
    const auto layer = latticeBlock(17, 17, 1, 0.5f, {-4, -4, -0.5f});
    LiquidCase drop({.walls = sampledFloor, .solidPositions = layer, .solidTheta = std::vector<double>(layer.size(), 60)});
    drop.folder.write
    (
        "constant/models",
        "pressure completedPbf; surfaceTension continuumSurfaceForce; wetting extendedSurface; viscosity XSPH; bodyForce none;"
    );
    Models models(drop.folder.path(), Dictionary(), drop.liquid, drop.walls);
    models.takeEffect(drop.liquid, drop.walls);
    const auto positions = latticeBlock(9, 9, 9, 1, {-4, -4, 0.5f});
    std::vector<Vec3> velocities;
    for (const Vec3 p : positions) velocities.push_back(-0.5f * drop.liquid.spacing() / dt * (p - Vec3{0, 0, 0.5f}));
    drop.place(positions, velocities);
    if (prepared)
    {
        predictPositions(drop.liquid, dt);
        drop.near.update(drop.liquid, models.freeSurface->support());
        drop.walls.update(drop.liquid);
    }
    SubStep(drop.liquid, drop.near, drop.walls, models)(dt);
    return drop.inOrder(drop.liquid.position);
}

}

// Lists that are cut off, found out in the midst of a step, change nothing of it.
TEST(SubStep, IsTheSameWhenListsFindNoRoom)
{
    const auto found = positionsAfterStep(false), expected = positionsAfterStep(true);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
        ASSERT_EQ(found[i].x, expected[i].x);
        ASSERT_EQ(found[i].y, expected[i].y);
        ASSERT_EQ(found[i].z, expected[i].z);
    }
}

namespace
{

// Places of a drop that falls and spreads on a plane, after ten steps so far off along x and y, less that way: in widths of the grid of cells,
// along y in as many as bring its copies, which are shifted along z and x, back to their places. With a pair another one lies where the first was made, and
// stands in front.
std::vector<std::array<std::int64_t, 3>> waysOf(const std::string& set, int x, int y, bool isPair = false)
{
    LiquidCase drop({.walls = floorPlane, .wettability = "floor { theta 60; }"});
    const auto folder = std::filesystem::path(std::getenv("SHIZUKU_DIR")) / "tests/validation/models" / set;
    drop.folder.write("constant/models", "#include \"" + (folder / "models").string() + "\"\nbodyForce gravity;\n");
    Models models(drop.folder.path(), Dictionary::read(folder / "solution"), drop.liquid, drop.walls);
    models.takeEffect(drop.liquid, drop.walls);
    auto points = latticeBall(4.2f, {0, 0, 4.4f});
    RandomNumbers random(3);
    disorder(points, 0.02f, random);
    const int first = isPair ? int(points.size()) : 0;
    if (isPair) points.insert(points.end(), points.begin(), points.end());
    drop.place(points, std::vector<Vec3>(points.size(), Vec3{0.02f, 0.01f, -0.05f}));

    const CellGridView grid = drop.near.grid().view();
    const std::int64_t cell = std::int64_t(grid.width) << CellGridView::coarseBits;
    const std::int64_t byX = x * (cell << grid.bitsX), byY = y * (cell << (grid.bitsX + grid.bitsY + grid.bitsZ));
    std::vector<Position> moved = drop.liquid.position.download();
    const auto id = drop.liquid.id.download();
    for (std::size_t i = 0; i < moved.size(); ++i)
    {
        const Place at = placeOf(moved[i]);
        if (int(id[i]) >= first) moved[i] = positionAt(Place{at.x + byX, at.y + byY, at.z});
    }
    drop.liquid.position.upload(moved);
    drop.liquid.predicted.upload(moved);
    const scalar dt = drop.liquid.units().toScaled(0.3 * drop.liquid.properties().capillaryStep(), dimensions::time);
    SubStep subStep(drop.liquid, drop.near, drop.walls, models);
    for (int step = 0; step < 10; ++step) subStep(dt);
    std::vector<std::array<std::int64_t, 3>> ways;
    for (const Position& p : drop.inOrder<Position>(drop.liquid.position))
    {
        const Place at = placeOf(p);
        const bool isShifted = int(ways.size()) >= first;
        ways.push_back({at.x - isShifted * byX, at.y - isShifted * byY, at.z});
    }
    return ways;
}

}

// To the bit: pairs are differences of quanta, and cells have the same order.
TEST(SubStep, IsTheSameFarAway)
{
    for (const std::string set : {"default", "Fujisawa2014", "XSPH"})
    {
        const auto here = waysOf(set, 0, 0);
        for (const auto& [x, y] : {std::pair{1, 0}, {0, -3}, {40, 500}}) EXPECT_EQ(waysOf(set, x, y), here) << set << ' ' << x << ' ' << y;
    }
}

// Two drops in a domain of 10 m and more at 50 um, 200,000 spacings: each does what one alone does. What is taken back of the motion of all is a mean of both, and is
// rounded: places differ by less than a thousandth of a spacing.
TEST(SubStep, IsTheSameOfTwoDropsFarApart)
{
    const auto alone = waysOf("default", 0, 0);
    const auto both = waysOf("default", 1600, 0, true);
    const std::int64_t thousandth = std::llround(1e-3 * LiquidCase().liquid.spacing() / quanta::lengthOf(std::int64_t(1)));
    ASSERT_EQ(both.size(), 2 * alone.size());
    for (std::size_t i = 0; i < both.size(); ++i)
    {
        for (int c = 0; c < 3; ++c) ASSERT_LE(std::abs(both[i][c] - alone[i % alone.size()][c]), thousandth) << i;
    }
}

namespace
{

// Velocities of a drop after four steps in which liquid farther off is held in a stream at rest: squeezed by that share, so that what pushes it is not the same.
std::vector<Vec3> velocitiesBeside(scalar squeezed)
{
    LiquidCase drop;
    drop.folder.write("constant/models", "pressure completedPbf; surfaceTension laplacePressure; wetting extendedSurface; viscosity newtonian; bodyForce none;");
    drop.folder.write("system/solution", "pressure { minIterations 4; maxIterations 4; }");        // of which all liquid has as many
    Models models(drop.folder.path(), Dictionary::read(drop.folder.path() / "system/solution"), drop.liquid, drop.walls);
    models.takeEffect(drop.liquid, drop.walls);
    auto points = latticeBall(3);
    const std::size_t inDrop = points.size();
    RandomNumbers random(3);
    disorder(points, 0.05f, random);
    for (const Vec3 p : latticeBlock(5, 5, 4, 1, {18, -2, -2})) points.push_back({p.x, p.y, (1 - squeezed * (p.z + 2)) * p.z});
    drop.place(points);
    HeldLiquid held;
    const double d = drop.liquid.spacing();
    held.set({{Vector3(20, 0, -10)*d, Vector3(0, 0, 1), 20*d, 0, 5*d, 0}}, true);
    SubStep subStep(drop.liquid, drop.near, drop.walls, models);
    subStep.hold(held);
    for (int step = 0; step < 4; ++step) subStep(0.1f);
    auto velocities = drop.inOrder(drop.liquid.velocity);
    velocities.resize(inDrop);
    return velocities;
}

}

// To the bit: what pushes held liquid is the business of what holds it. It was taken for a motion that internal forces give the liquid as a whole, and a drop that hung from a nozzle had a
// fifth of its weight taken off.
TEST(SubStep, LeavesLiquidAloneWhereOtherIsHeld)
{
    const auto beside = velocitiesBeside(0), other = velocitiesBeside(0.05f);
    ASSERT_EQ(beside.size(), other.size());
    double fastest = 0;
    for (std::size_t i = 0; i < beside.size(); ++i)
    {
        ASSERT_EQ(beside[i].x, other[i].x);
        ASSERT_EQ(beside[i].y, other[i].y);
        ASSERT_EQ(beside[i].z, other[i].z);
        fastest = std::max(fastest, double(norm(beside[i])));
    }
    EXPECT_GT(fastest, 0);
}

namespace
{

// A drop that falls and spreads, after three steps.
std::vector<Vec3> spreadDrop(const std::function<void(SubStep&, scalar)>& makeStep)
{
    LiquidCase drop({.walls = floorPlane, .wettability = "floor { theta 60; }"});
    drop.folder.write
    (
        "constant/models",
        "pressure completedPbf; surfaceTension continuumSurfaceForce; wetting extendedSurface; viscosity XSPH; bodyForce gravity;"
    );
    Models models(drop.folder.path(), Dictionary(), drop.liquid, drop.walls);
    models.takeEffect(drop.liquid, drop.walls);
    const auto positions = latticeBlock(9, 9, 5, 1, {-4, -4, 0.5f});
    std::vector<Vec3> velocities;
    for (const Vec3 p : positions) velocities.push_back(0.02f * Vec3{p.x, p.y, -p.z});
    drop.place(positions, velocities);
    SubStep subStep(drop.liquid, drop.near, drop.walls, models);
    for (int step = 0; step < 3; ++step) makeStep(subStep, 0.1f);
    return drop.inOrder(drop.liquid.position);
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, double(norm(a[i] - b[i])));
    return most;
}

}

// A step that was begun ahead is the same step, bit by bit.
TEST(SubStep, MayBePreparedAhead)
{
    const auto expected = spreadDrop([](SubStep& subStep, scalar dt) { subStep(dt); });
    const auto ahead = spreadDrop([](SubStep& subStep, scalar dt)
    {
        subStep.prepare(dt);
        subStep(dt);
    });
    EXPECT_EQ(farthest(ahead, expected), 0);
}

// One of another length, and one from before models changed, leave nothing behind but an order of the particles, on which no sum depends.
TEST(SubStep, IsPreparedAnewWhereWhatWasPreparedDoesNotHold)
{
    const auto expected = spreadDrop([](SubStep& subStep, scalar dt) { subStep(dt); });
    const auto otherLength = spreadDrop([](SubStep& subStep, scalar dt)
    {
        subStep.prepare(2 * dt);
        subStep(dt);
    });
    const auto changed = spreadDrop([](SubStep& subStep, scalar dt)
    {
        subStep.prepare(dt);
        subStep.dropPrepared();
        subStep(dt);
    });
    const double moved = farthest(expected, spreadDrop([](SubStep&, scalar) {}));
    EXPECT_GT(moved, 1e-2);
    EXPECT_EQ(farthest(otherLength, expected), 0);
    EXPECT_EQ(farthest(changed, expected), 0);
}

namespace
{

// A sheet of one layer on a plane, as fillLiquid leaves the rim of a flat drop, under a pressure model alone.
struct Sheet
{
    LiquidCase drop{{.walls = floorPlane, .wettability = "floor { theta 15; }"}};
    Models models;

    explicit Sheet(const std::string& pressure)
    :
        models(described(drop, pressure), Dictionary(), drop.liquid, drop.walls)
    {
        drop.useWalls();
        const auto points = latticeBlock(21, 21, 1, 1, {-10, -10, 0.5f});
        drop.place(points, std::vector<Vec3>(points.size(), Vec3{0.5f, 0, 0}));
    }

    static std::filesystem::path described(LiquidCase& drop, const std::string& pressure)
    {
        drop.folder.write
        (
            "constant/models",
            "pressure " + pressure + "; surfaceTension none; wetting none; viscosity none; bodyForce none;"
        );
        return drop.folder.path();
    }

    // The farthest way of a particle, in spacings.
    double farthest(const std::vector<Vec3>& before) const
    {
        double most = 0;
        const auto after = drop.inOrder(drop.liquid.position);
        for (std::size_t i = 0; i < before.size(); ++i) most = std::max(most, double(norm(after[i] - before[i])));
        return most / drop.liquid.spacing();
    }

    std::vector<Vec3> positions() const { return drop.inOrder(drop.liquid.position); }

    void settleFor(scalar dt) { settle(drop.liquid, drop.near, drop.walls, models, dt); }
    void step(scalar dt) { SubStep(drop.liquid, drop.near, drop.walls, models)(dt); }
};

}

// The model wants the sheet a tenth of a spacing and more elsewhere. Settled, that is no velocity, and the first step moves it by
// what the settling's iterations left.
TEST(SubStep, StartsSettledLiquidWithItsOwnVelocity)
{
    constexpr scalar dt = 1e-3f;
    Sheet filled("completedPbf"), settled("completedPbf");
    const auto placed = filled.positions();
    filled.step(dt);
    const double jump = filled.farthest(placed);
    EXPECT_GT(jump, 0.1);

    settled.settleFor(dt);
    EXPECT_GT(settled.farthest(placed), 0.1);
    for (const Vec3& u : settled.drop.liquid.velocity.download())
    {
        EXPECT_EQ(u.x, 0.5f);
        EXPECT_EQ(u.y, 0);
        EXPECT_EQ(u.z, 0);
    }
    for (const scalar p : settled.models.pressure->keepPressure()->download()) EXPECT_EQ(p, 0);
    const auto start = settled.positions();
    settled.step(dt);
    EXPECT_LT(settled.farthest(start), 0.01 * jump);        // 0.0036, after eleven rounds
}

TEST(SubStep, LeavesLiquidOfOtherModelsWhereItIs)
{
    Sheet sheet("pbf");
    const auto placed = sheet.positions();
    sheet.settleFor(1e-3f);
    EXPECT_EQ(sheet.farthest(placed), 0);
}

// A free drop that turns by 0.05 in a step. Where forces are those at the predicted positions each step takes 0.05^2 of its angular momentum, 7 % in thirty; of the first
// step there is none before. How the drop finds its shape is noise of a tenth of that.
TEST(SubStep, KeepsWhatTurnsWhereItIsAskedTo)
{
    constexpr int steps = 30;
    constexpr double perStep = 0.05;
    const auto kept = [&](const std::string& correction, const std::string& walls)
    {
        LiquidCase drop({.walls = walls, .wettability = walls.empty() ? "" : "floor { theta 60; }"});
        if (!walls.empty()) drop.useWalls();
        const auto folder = std::filesystem::path(std::getenv("SHIZUKU_DIR")) / "tests/validation/models/default";
        drop.folder.write
        (
            "constant/models", "#include \"" + (folder / "models").string() + "\"\nbodyForce none; velocityCorrection " + correction + ";\n"
        );
        Models models(drop.folder.path(), Dictionary::read(folder / "solution"), drop.liquid, drop.walls);
        models.takeEffect(drop.liquid, drop.walls);
        const auto points = latticeBall(4.2f);
        const scalar dt = drop.liquid.units().toScaled(0.7 * drop.liquid.properties().capillaryStep(), dimensions::time);
        std::vector<Vec3> velocities;
        for (const Vec3& p : points) velocities.push_back(scalar(perStep) / dt * drop.liquid.spacing() * cross(Vec3{0, 0, 1}, p));
        drop.place(points, velocities);
        const auto momentum = [&] { return motionOf(drop.inOrder(drop.liquid.position), drop.inOrder(drop.liquid.velocity)).angular[2]; };
        const double before = momentum();
        SubStep subStep(drop.liquid, drop.near, drop.walls, models);
        for (int step = 0; step < steps; ++step) subStep(dt);
        return momentum() / before;
    };
    const double lost = 1 - std::exp(-steps * perStep * perStep);
    const std::string farBelow = "floor { type plane; point (0 0 -1); normal (0 0 1); }";      // m
    EXPECT_NEAR(kept("none", farBelow), 1 - lost, 0.3 * lost);
    EXPECT_NEAR(kept("keepsTurns", farBelow), 1, 0.2 * lost);
    EXPECT_NEAR(kept("none", ""), 1, 0.01 * lost);      // 3e-4: viscosity moves particles, too
}
