// SPDX-License-Identifier: GPL-3.0-or-later
// A liquid that is cut into parts moves to the same bits as the whole, step by step: particles go from part to part, ghosts have what their owners computed, and
// sums of all parts do not depend on the cut.

#include "device/Sharing.H"
#include "parallel/PartsOfProcess.H"
#include "population/Population.H"
#include "stepping/SubStep.H"
#include "support/LiquidCase.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <mutex>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

using State = std::map<std::uint32_t, std::array<std::int64_t, 6>>;         // by particle: place and velocity

struct Scene
{
    std::string set, moreModels;
    bool sampled;
    int steps;
    std::string nu = "1e-6";            // m2/s
    std::string outlets = {};
    enum { ball, bar, block } shape = ball;     // bar: long enough for particles that no other part sees, and neighbours of whose neighbours none sees; block: for a coarse grid
    std::string moreSolution = {};
    std::string law = {};               // of contact lines
    std::string sources = {};
    Vec3 velocity{0.1f, 0.8f, -0.8f};   // m/s
    bool leavesParts = false;           // so fast that parts may be without liquid in the end
    std::string boundary = {};          // constant/boundary
};

std::filesystem::path setsOfModels() { return std::filesystem::path(std::getenv("SHIZUKU_DIR")) / "tests/validation/models"; }

CaseText textOf(const Scene& scene)
{
    CaseText text = caseOnWettedFloor(scene.sampled, 31, 91);        // so long that parts hold some of it
    text.liquidProperties = "rho 1000; nu " + scene.nu + "; sigma 0.072;";
    text.boundary = scene.boundary;
    return text;
}

// A drop that falls onto a floor and slides along it, so that particles go from part to part.
class CutDrop : public LiquidCase
{
public:
    explicit CutDrop(const Scene& scene) : LiquidCase(textOf(scene)), population(writePopulation(scene), liquid)
    {
        if (!scene.law.empty()) folder.write("constant/wettability", "floor { " + scene.law + " }");
        const auto set = setsOfModels() / scene.set;
        std::ifstream file(set / "models");
        folder.write("constant/models", std::string{std::istreambuf_iterator<char>(file), {}} + "bodyForce gravity;" + scene.moreModels);
        std::ifstream solution(set / "solution");
        folder.write("system/solution", std::string{std::istreambuf_iterator<char>(solution), {}} + scene.moreSolution);
        models = std::make_unique<Models>(folder.path(), Dictionary::read(folder.path() / "system/solution"), liquid, walls);
        models->takeEffect(liquid, walls);
        auto points = scene.shape == Scene::ball ? latticeBall(6.2f, {0, 0, 6.4f})
            : scene.shape == Scene::bar ? latticeBlock(5, 80, 5, 1, {-2, -40, 2}) : latticeBlock(14, 22, 18, 0.97f, {-7, -10, 0.5f});
        RandomNumbers random(3);
        disorder(points, 0.02f, random);
        place(points, std::vector<Vec3>(points.size(), scene.velocity));
    }

    scalar dt() const
    {
        return liquid.units().toScaled(std::min(0.5 * liquid.properties().capillaryStep(), models->pressure->stepLimit(liquid.properties())), dimensions::time);
    }

    RowLoads rows() const
    {
        const CellGridView grid = near.grid().view();
        RowLoads loads;
        for (const Position p : liquid.position.download())
        {
            const CellPlace cell = grid.cellPlace(p);
            loads.push_back({cell.y, cell.z, 1});
        }
        return sortedLoads(loads);
    }

    // The owned particles.
    State state() const
    {
        const auto x = liquid.position.download();
        const auto u = liquid.velocity.download();
        const auto id = liquid.id.download();
        State result;
        for (int i = 0; i < liquid.owned(); ++i)
        {
            const Place at = placeOf(x[i]);
            result[id[i]] = {at.x, at.y, at.z, wordOf(u[i].x), wordOf(u[i].y), wordOf(u[i].z)};
        }
        return result;
    }

    // The state before the first step and after each. The next step is begun before one is looked at, as the solver does.
    std::vector<State> run(int steps)
    {
        SubStep subStep(liquid, near, walls, *models);
        subStep.hold(population.held());
        population.begin(liquid);
        const double each = liquid.units().of(dimensions::time) * dt();
        settle(liquid, near, walls, *models, dt());
        std::vector<State> states{state()};
        for (int k = 0; k < steps; ++k)
        {
            population.beginStep(liquid, k * each, each);
            subStep(dt());
            if (population.endStep(liquid, k * each, (k + 1) * each, 0).any) near.recount();
            subStep.prepare(dt());
            states.push_back(state());
        }
        return states;
    }

    int heldSolid() const { return walls.view(liquid).particles.position.size; }

    std::filesystem::path writePopulation(const Scene& scene) const
    {
        folder.write("constant/outlets", scene.outlets);
        folder.write("constant/sources", scene.sources);
        return folder.path();
    }

    std::unique_ptr<Models> models;
    Population population;
};

struct Cut
{
    std::vector<State> states;
    int mostMoved = 0;                  // particles that came to a part, or left it, in a step
    int withLiquid = 0;                 // parts, in the end
    int mostSolid = 0;                  // particles that a part holds
};

Cut runCut(const Scene& scene, const RowCut& cut)
{
    Cut result;
    result.states.resize(scene.steps + 1);
    std::mutex mutex;
    runParts(cut.parts(), [&](const Communicator& parts)
    {
        CutDrop drop(scene);
        if (parts.part() > 0) drop.liquid.resize(0);            // the first search brings them what is theirs
        drop.liquid.ghosts().join(parts);
        drop.liquid.ghosts().poisonUndeclared();
        drop.near.cut(cut, 100);            // in several rounds
        if (!sharesAsWhole()) drop.walls.cut(cut.rowsOf(parts.part()), drop.near.grid().view());    // as the solver
        drop.models->refuseGhostBlind(drop.liquid, "The liquid cannot be cut into parts");
        const std::vector<State> own = drop.run(scene.steps);
        const std::lock_guard lock(mutex);
        for (std::size_t k = 0; k < own.size(); ++k)
        {
            int moved = 0;
            for (const auto& [id, bits] : own[k])
            {
                EXPECT_TRUE(result.states[k].emplace(id, bits).second) << "particle " << id << " is owned twice";
                if (k > 0) moved += !own[k - 1].contains(id);
            }
            result.mostMoved = std::max(result.mostMoved, moved);
        }
        result.withLiquid += !own.back().empty();
        result.mostSolid = std::max(result.mostSolid, drop.heldSolid());
    });
    return result;
}

int differing(const State& a, const State& b)
{
    int count = 0;
    for (const auto& [id, bits] : b) count += a.at(id) != bits;
    return count;
}

// A model of a user's, which reads neighbours as one process sees them.
class OfOneProcess : public Pressure
{
public:
    void begin(scalar) override {}
    bool converged(Liquid&, const Neighbourhood&, const Walls&) override { return true; }
    void correct(Liquid&, const Neighbourhood&, const Walls&) override {}
    int iterations() const override { return 0; }
};

// In quanta along an axis.
std::int64_t farthest(const State& a, const State& b)
{
    std::int64_t most = 0;
    for (const auto& [id, bits] : b)
    {
        for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a.at(id)[c] - bits[c]));
    }
    return most;
}

// What a GPU needs for it (device/Sharing.H); a CPU does it always.
struct SharedAsOf
{
    explicit SharedAsOf(int whole) { shareAsOf(whole); }
    ~SharedAsOf() { shareAsOf(0); }
};

struct Method
{
    std::string name;
    std::function<RowCut(const RowLoads&)> cut;
};

Method bisected(int parts)
{
    return {"bisected " + std::to_string(parts), [=](const RowLoads& loads) { return cutBisected(loads, parts); }};
}

Method slabs(int parts, bool acrossZ)
{
    return {"slabs " + std::to_string(parts), [=](const RowLoads& loads) { return cutPencils(loads, parts, 1, acrossZ); }};
}

void expectSameBits(const Scene& scene, const std::vector<Method>& methods)
{
    const SharedAsOf all(CutDrop(scene).liquid.owned());
    CutDrop whole(scene);
    const RowLoads rows = whole.rows();
    const std::vector<State> states = whole.run(scene.steps);
    for (const Method& method : methods)
    {
        SCOPED_TRACE(scene.set + ", " + method.name);
        const RowCut rowCut = method.cut(rows);
        const Cut cut = runCut(scene, rowCut);
        EXPECT_GT(cut.mostMoved, 0);
        if (scene.sampled && !sharesAsWhole() && !rowCut.isAcross(true))        // a part below may see all of the floor
        {
            EXPECT_LT(cut.mostSolid, whole.heldSolid());
        }
        if (!scene.leavesParts) EXPECT_GE(cut.withLiquid, rowCut.parts() - 1);      // the last row may have lost its particles: a part without any is none that fails
        for (std::size_t k = 0; k < states.size(); ++k)
        {
            ASSERT_EQ(cut.states[k].size(), states[k].size()) << "step " << k;
            ASSERT_EQ(differing(cut.states[k], states[k]), 0) << "step " << k;
        }
    }
}

}

TEST(TestParts, DefaultHasTheBitsOfTheWhole)
{
    expectSameBits({"default", "", true, 12}, {bisected(2), bisected(3), bisected(5), slabs(3, false)});
    expectSameBits({"default", "", false, 12}, {slabs(2, true), bisected(4)});
}

// Pieces that see each other at corners alone, parts of a few rows, and parts that have none.
TEST(TestParts, AnyCutHasTheBitsOfTheWhole)
{
    expectSameBits
    (
        {"default", "", false, 6},
        {
            bisected(8), slabs(4, false),
            {"pencils, first across y", [](const RowLoads& loads) { return cutPencils(loads, 2, 3, false); }},
            {"pencils, first across z", [](const RowLoads& loads) { return cutPencils(loads, 2, 2, true); }},
            {"straight", [](const RowLoads& loads) { return cutStraight(loads, 2, 2); }},
            {"weighted", [](const RowLoads& loads) { return cutBisected(loads, 3, {1, 2, 4}); }},
        }
    );
}

// Particles that nobody else sees are computed while values of the others travel.
TEST(TestParts, LongBarHasTheBitsOfTheWhole)
{
    expectSameBits({"default", "velocityCorrection keepsTurns;", false, 6, "1e-6", {}, Scene::bar}, {bisected(2)});
}

// Of water the step takes the stress as it is; of a thick liquid it is solved for, with sums over all parts.
TEST(TestParts, ThickLiquidHasTheBitsOfTheWhole)
{
    expectSameBits({"default", "", false, 12, "1e-3"}, {slabs(2, true), bisected(4)});
}

TEST(TestParts, HeldContactLinesHaveTheBitsOfTheWhole)
{
    Scene held{"default", "", true, 8};
    held.law = "law hysteresis; thetaAdv 80; thetaRec 75;";
    expectSameBits(held, {bisected(3)});
    held.sampled = false;
    held.law = "law coxVoinov; thetaAdv 65; thetaRec 60;";
    expectSameBits(held, {bisected(4)});
}

TEST(TestParts, WhatKeepsTurnsHasTheBitsOfTheWhole)
{
    expectSameBits({"default", "velocityCorrection keepsTurns;", true, 12}, {slabs(2, false), bisected(4)});
}

// All sets of models that the validations know.
class TestPartsOfSet : public testing::TestWithParam<const char*>
{};

const std::vector<const char*> setsToCut
{
    "Akinci2013", "Becker2007", "Clavet2005", "DFSPH", "Fujisawa2014", "Kondo2007", "Mueller2003", "PCISPH", "Tartakovsky2005", "WCSPH", "XSPH",
    "continuumSurfaceForce", "default", "idealGas"
};

TEST_P(TestPartsOfSet, HasTheBitsOfTheWhole)
{
    expectSameBits({GetParam(), "", true, 8}, {bisected(2), slabs(3, false), bisected(5)});
}

INSTANTIATE_TEST_SUITE_P(Models, TestPartsOfSet, testing::ValuesIn(setsToCut), [](const auto& info) { return std::string(info.param); });

// A drop that leaves its parts, through others within a few steps. Sets that take analytic walls.
class TestFastPartsOfSet : public testing::TestWithParam<const char*>
{};

TEST_P(TestFastPartsOfSet, HasTheBitsOfTheWhole)
{
    Scene scene{GetParam(), "", false, 6};
    scene.velocity = {0.2f, 10, -0.2f};
    scene.leavesParts = true;
    expectSameBits(scene, {bisected(2), slabs(3, false), bisected(5)});
}

INSTANTIATE_TEST_SUITE_P
(
    Models, TestFastPartsOfSet,
    testing::Values("Becker2007", "DFSPH", "Fujisawa2014", "Kondo2007", "Mueller2003", "PCISPH", "Tartakovsky2005", "WCSPH"),
    [](const auto& info) { return std::string(info.param); }
);

TEST(TestParts, AFastDropLeavesItsParts)
{
    Scene scene{"default", "", false, 12};
    scene.velocity = {0.2f, 10, -0.2f};
    EXPECT_EQ(runCut(scene, slabs(3, false).cut(CutDrop(scene).rows())).withLiquid, 1);
}

TEST(TestParts, AllSetsAreCut)
{
    std::vector<std::string> folders;
    for (const auto& set : std::filesystem::directory_iterator(setsOfModels())) folders.push_back(set.path().filename());
    std::sort(folders.begin(), folders.end());
    EXPECT_EQ(folders, std::vector<std::string>(setsToCut.begin(), setsToCut.end()));
}

// A nozzle above one end of the liquid, a needle below it that draws, rain and a pool that fills beside it, and a box from whose top it goes: a particle has the number and the place that the whole gives it.
TEST(TestParts, LiquidThatComesInHasTheBitsOfTheWhole)
{
    const std::string sources =
        "tap { type nozzle; mouth (0 12e-3 8e-3); direction (0 -0.3 -1); radius 2e-3; flowRate 8e-6; }\n"
        "needle { type needle; mouth (0 -3e-3 0); direction (0 0 1); radius 1.5e-3; flowRate -3e-6; }\n"
        "shower { type rain; rate 3; corner (-8e-3 -25e-3 16e-3); along (16e-3 0 0); across (0 12e-3 0); direction (0 0 -1); speed 1; sizes { type oneSize; diameter 3e-3; } }\n"
        "filled { type reservoir; min (-6e-3 20e-3 0); max (6e-3 30e-3 8e-3); direction (0 0 1); level 3e-3; relaxationTime 5e-3; }\n"
        "emptied { type reservoir; min (-3e-3 1e-3 0); max (3e-3 5e-3 12e-3); direction (0 0 1); level 6e-3; relaxationTime 5e-3; }\n";
    expectSameBits({.set = "default", .sampled = false, .steps = 12, .sources = sources}, {slabs(1, false), bisected(2), bisected(3), bisected(5)});
    expectSameBits({.set = "Akinci2013", .sampled = true, .steps = 12, .sources = sources}, {bisected(3)});
}

// Variants of models that no set has.
// The drop touches itself across y and is beside its image, or its mirror image, across x: cuts go along sides and across them.
TEST(TestParts, LiquidThatGoesOnAcrossSidesHasTheBitsOfTheWhole)
{
    Scene sides{"default", "", true, 5};
    for (const std::string x : {"xMin cyclic; xMax cyclic;", "xMin symmetryPlane;"})
    {
        sides.boundary = "min (-7e-3 -6.6e-3 0); max (7e-3 6.6e-3 0); sides { yMin cyclic; yMax cyclic; " + x + " }";
        expectSameBits(sides, {slabs(3, false), bisected(4)});
        sides.sampled = false;
    }
}

TEST(TestParts, WallNormalsHaveTheBitsOfTheWhole)
{
    expectSameBits({"Fujisawa2014", "contactAngleCoeffs { solidNormal wall; }", true, 12}, {bisected(3)});
}

TEST(TestParts, SPHNormalsOfAnalyticWallsHaveTheBitsOfTheWhole)
{
    expectSameBits({"Fujisawa2014", "", false, 12}, {bisected(3)});
    expectSameBits({"Fujisawa2014", "pressure completedPbf;", true, 12}, {bisected(3)});        // whose lists of solid particles are wider
}

TEST(TestParts, ForcesInEveryIterationHaveTheBitsOfTheWhole)
{
    expectSameBits({"Fujisawa2014", "forceCoupling everyIteration;", true, 6}, {bisected(3)});
    expectSameBits({"Fujisawa2014", "forceCoupling everyIteration; pressure completedPbf;", true, 6}, {bisected(3)});
    expectSameBits({"Becker2007", "forceCoupling everyIteration; pressure DFSPH;", true, 6}, {bisected(3)});
}

TEST(TestParts, CurvatureAtStartHasTheBitsOfTheWhole)
{
    expectSameBits({"continuumSurfaceForce", "continuumSurfaceForceCoeffs { curvatureAt start; }", true, 12}, {bisected(3)});
}

TEST(TestParts, LaminarViscosityAndShiftedParticlesHaveTheBitsOfTheWhole)
{
    expectSameBits({"default", "viscosity laminar; particleShifting closePairs;", true, 6}, {bisected(3)});
}

TEST(TestParts, CoarseGridHasTheBitsOfTheWhole)
{
    Scene scene{"default", "particleShifting closePairs;", false, 4, "1e-6", {}, Scene::block};
    const State without = CutDrop(scene).run(1).back();
    scene.moreSolution = "pressure { coarseGrid yes; }";
    EXPECT_GT(differing(CutDrop(scene).run(1).back(), without), 0);         // it is deep enough for the grid to act
    expectSameBits(scene, {slabs(2, true), slabs(3, false), bisected(5)});
}

// A plane that the drop moves through: each part takes out its own, and all know how many.
TEST(TestParts, OutletsTakeOutTheSame)
{
    const Scene scene{"default", "", true, 12, "1e-6", "out { type plane; point (0 5.9e-3 0); normal (0 1 0); }"};
    CutDrop drop(scene);
    const std::size_t before = drop.state().size(), behind = drop.run(scene.steps).back().size();
    EXPECT_LT(behind, before);
    EXPECT_EQ(double(before - behind), drop.liquid.numbers().at(Outlets::numberOf("out")));
    expectSameBits(scene, {slabs(3, false)});
}

// All that there is, before the last step: parts and the whole go on without any.
TEST(TestParts, AllIsTakenOut)
{
    const Scene scene{"default", "", true, 3, "1e-6", "out { type plane; point (0 -1 0); normal (0 1 0); }"};
    for (const int parts : {2, 3})
    {
        const Cut cut = runCut(scene, bisected(parts).cut(CutDrop(scene).rows()));
        EXPECT_GT(cut.states[0].size(), 0u);
        EXPECT_EQ(cut.states[1].size(), 0u);
        EXPECT_EQ(cut.withLiquid, 0);
    }
}

// Rows far from the liquid, then its own: what was let go of is there again, with the same bits.
TEST(TestParts, SolidParticlesAreThoseOfTheRows)
{
    const Scene scene{"default", "", true, 2};
    const SharedAsOf all(CutDrop(scene).liquid.owned());
    CutDrop whole(scene), part(scene);
    RowRectangle own{1000, -1000};
    for (const RowLoad& load : part.rows())
    {
        own.lowY = std::min(own.lowY, load.y);
        own.highY = std::max(own.highY, load.y + 1);
    }
    part.walls.cut({own.highY + 11, own.highY + 12}, part.near.grid().view());
    part.walls.search(part.liquid);
    EXPECT_LT(part.heldSolid(), whole.heldSolid() / 2);
    part.walls.cut(own, part.near.grid().view());
    // Where lanes share the solid particles of a cell, those of other cells with the same name too, their sums have another order: some quanta.
    constexpr std::int64_t rounding = 64;
    EXPECT_LE(farthest(part.run(scene.steps).back(), whole.run(scene.steps).back()), sharesAsWhole() ? rounding : 0);
    EXPECT_LT(part.heldSolid(), whole.heldSolid());
    EXPECT_EQ(part.walls.particles(), whole.walls.particles());
}

TEST(TestParts, ModelsThatDoNotSayThatTheySeeGhostsAreRefused)
{
    CutDrop drop({"default", "", false, 1});
    drop.models->refuseGhostBlind(drop.liquid, "The liquid cannot be cut into parts");
    drop.models->pressure = std::make_unique<OfOneProcess>();
    try
    {
        drop.models->refuseGhostBlind(drop.liquid, "The liquid cannot be cut into parts");
        FAIL();
    }
    catch (const FatalInputError& error)
    {
        EXPECT_NE(std::string(error.what()).find("cannot be cut into parts with pressure completedPbf"), std::string::npos) << error.what();
    }
}

TEST(TestParts, OneThatFailsEndsAll)
{
    const auto run = [](const Communicator& parts)
    {
        if (parts.part() == 1) throw std::runtime_error("this one");
        parts.any(true);
    };
    try
    {
        runParts(3, run);
        FAIL();
    }
    catch (const std::runtime_error& error)
    {
        EXPECT_STREQ(error.what(), "this one");
    }
}
