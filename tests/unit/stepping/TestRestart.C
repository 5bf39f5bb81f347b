// SPDX-License-Identifier: GPL-3.0-or-later
// A run goes on from what it has written, and from what it holds when models change, to the same bits: for every set of models of the ladder.

#include "models/density/Density.H"
#include "particles/ParticleFiles.H"
#include "population/Population.H"
#include "stepping/SubStep.H"
#include "support/LiquidCase.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

const std::filesystem::path sets = std::filesystem::path(std::getenv("SHIZUKU_DIR")) / "tests/validation/models";

std::vector<std::string> names()
{
    std::vector<std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(sets)) result.push_back(entry.path().filename());
    std::sort(result.begin(), result.end());
    return result;
}

std::string modelsOf(const std::string& set)
{
    std::ifstream file(sets / set / "models");
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// What a set is, and what differs from it.
struct Chosen
{
    std::string set, moreModels = {}, morePressure = {};
    bool sampled = true;
    std::string outlets = {};
    scalar speed = 0.02f;               // scaled, along x
    std::string law = {};               // of contact lines
    std::string sources = {};
};

// A drop of the set that falls onto a floor.
class Drop : public LiquidCase
{
public:
    explicit Drop(const Chosen& chosen) : LiquidCase(caseOnWettedFloor(chosen.sampled, 25, 25)), population(writePopulation(chosen), liquid), speed(chosen.speed) { choose(chosen); }

    // Models of another set from now on, as after a change of the dictionaries.
    void choose(const Chosen& chosen)
    {
        if (models) models->pressure->complete();
        subStep.reset();
        if (!chosen.law.empty()) folder.write("constant/wettability", "floor { " + chosen.law + " }");
        folder.write("constant/models", modelsOf(chosen.set) + "bodyForce gravity;" + chosen.moreModels);
        Dictionary solution = Dictionary::read(sets / chosen.set / "solution");
        if (!chosen.morePressure.empty()) solution = Dictionary::parse("pressure { maxIterations 10; " + chosen.morePressure + " }");
        models = std::make_unique<Models>(folder.path(), solution, liquid, walls);
        models->takeEffect(liquid, walls);
        subStep.emplace(liquid, near, walls, *models);
        subStep->hold(population.held());
    }

    void begin()
    {
        auto points = latticeBall(4.2f, {0, 0, 4.4f});
        RandomNumbers random(3);
        disorder(points, 0.02f, random);
        place(points, std::vector<Vec3>(points.size(), Vec3{speed, 0, -0.05f}));
    }

    // The next step is begun before one is looked at, as the solver does.
    void steps(int n)
    {
        population.begin(liquid);
        const double each = liquid.units().of(dimensions::time) * dt();
        for (int k = 0; k < n; ++k, ++made)
        {
            population.beginStep(liquid, made * each, each);
            (*subStep)(dt());
            population.endStep(liquid, made * each, (made + 1) * each, 0);
            subStep->prepare(dt());
        }
    }

    void write(const std::filesystem::path& time)
    {
        models->pressure->complete();
        computeDensity(liquid, liquid.position, near, walls);
        ParticleCopy copy;
        copy.take(liquid, liquid.units());
        copy.write(time, {.binary = binary, .precision = digits});
    }

    // By the particles' numbers.
    std::map<std::uint32_t, std::array<std::int64_t, 6>> bits() const
    {
        const auto x = liquid.position.download();
        const auto u = liquid.velocity.download();
        const auto id = liquid.id.download();
        std::map<std::uint32_t, std::array<std::int64_t, 6>> result;
        for (std::size_t i = 0; i < x.size(); ++i)
        {
            const Place at = placeOf(x[i]);
            result[id[i]] = {at.x, at.y, at.z, wordOf(u[i].x), wordOf(u[i].y), wordOf(u[i].z)};
        }
        return result;
    }

    scalar dt() const
    {
        const double limit = std::min(0.3 * liquid.properties().capillaryStep(), models->pressure->stepLimit(liquid.properties()));
        return liquid.units().toScaled(limit, dimensions::time);
    }

    std::filesystem::path writePopulation(const Chosen& chosen) const
    {
        folder.write("constant/outlets", chosen.outlets);
        folder.write("constant/sources", chosen.sources);
        return folder.path();
    }

    std::unique_ptr<Models> models;
    std::optional<SubStep> subStep;
    Population population;
    scalar speed;
    int made = 0;                       // steps
    bool binary = true;
    static constexpr int digits = sizeof(scalar) == 4 ? 9 : 17;     // that keep every bit
};

void expectRestart(const Chosen& chosen, bool binary = true)
{
    SCOPED_TRACE(chosen.set + " " + chosen.moreModels + chosen.morePressure + (chosen.sampled ? ", sampled" : ", analytic"));
    Drop whole(chosen), first(chosen), then(chosen);
    whole.begin();
    whole.steps(9);
    first.binary = binary;
    first.begin();
    first.steps(5);
    first.write(first.folder.path() / "1");
    then.liquid.read(first.folder.path() / "1");
    then.made = first.made;
    EXPECT_NE(first.bits(), whole.bits());
    then.steps(4);
    EXPECT_EQ(then.bits(), whole.bits());
    EXPECT_EQ(then.liquid.numbers(), whole.liquid.numbers());
}

}

TEST(Restart, HasTheSameBitsForEverySet)
{
    for (const std::string& name : names()) expectRestart({name});
}

TEST(Restart, HasTheSameBitsForTheDefaultAtAnalyticWallsAndWithAllThatItMayHave)
{
    expectRestart({.set = "default", .sampled = false});
    expectRestart({.set = "default", .morePressure = "coarseGrid yes;"});
    expectRestart({.set = "default", .moreModels = "particleShifting closePairs;"});
    expectRestart({.set = "default"}, false);                              // ascii
}

TEST(Restart, HasTheSameBitsWhereWallsHoldContactLines)
{
    for (const bool sampled : {true, false})
    {
        const Chosen held{.set = "default", .sampled = sampled, .law = "law hysteresis; thetaAdv 80; thetaRec 75;"};
        expectRestart(held);
        Drop drop(held);
        drop.begin();
        drop.steps(9);
        const auto angles = drop.models->heldLine->angle().download();
        EXPECT_GT(std::count_if(angles.begin(), angles.end(), [](scalar angle) { return angle > 0; }), 10);
    }
    expectRestart({.set = "default", .sampled = false, .law = "law coxVoinov; thetaAdv 65; thetaRec 60;"});
}

// A plane across the way of the drop, askew to its rows: particles leave before and after the restart, and none comes back.
TEST(Restart, HasTheSameBitsWhereLiquidIsTakenOut)
{
    for (const std::string set : {"default", "XSPH", "Fujisawa2014"})
    {
        const Chosen chosen{.set = set, .outlets = "out { type plane; point (3e-3 0 4.4e-3); normal (1 0.31 0.17); }", .speed = 0.5f};
        Drop first(chosen), whole(chosen);
        for (Drop* drop : {&first, &whole}) drop->begin();
        const int all = first.liquid.owned();
        first.steps(5);
        whole.steps(9);
        const double before = first.liquid.numbers().at(Outlets::numberOf("out")), later = whole.liquid.numbers().at(Outlets::numberOf("out"));
        EXPECT_GT(before, 0);
        EXPECT_GT(later, before);
        EXPECT_EQ(all - whole.liquid.owned(), later);
        expectRestart(chosen);
    }
}

// A nozzle with a flow that rises, a needle, drops of rain and a pool, beside the drop and into it: each lets liquid in before and after the restart.
TEST(Restart, HasTheSameBitsWhereLiquidComesIn)
{
    for (const std::string set : {"default", "XSPH", "Fujisawa2014"})
    {
        const Chosen chosen
        {
            .set = set, .outlets = "out { type plane; point (3e-3 0 4.4e-3); normal (1 0.31 0.17); }", .speed = 0.5f, .sources =
            "tap { type nozzle; mouth (-12e-3 0 12e-3); direction (0.2 0 -1); radius 1.6e-3; velocity { times (0 1e-3 1); values (0.2 0.8 0.8); } }\n"
            "needle { type needle; mouth (0 0 0); direction (0 0 1); radius 1.5e-3; flowRate 2e-6; }\n"
            "shower { type rain; rate 0.02; corner (-70e-3 -70e-3 20e-3); along (60e-3 0 0); across (0 60e-3 0); direction (0 0 -1); speed 0.5;\n"
            "    sizes { type table; diameters (2.6e-3 3.4e-3); shares (2 1); } seed 4; }\n"
            "pool { type reservoir; min (-30e-3 8e-3 0); max (-20e-3 16e-3 8e-3); direction (0 0 1); level 4e-3; relaxationTime 2e-3; }\n"
        };
        Drop first(chosen), whole(chosen);
        for (Drop* drop : {&first, &whole}) drop->begin();
        first.steps(5);
        whole.steps(9);
        for (const std::string source : {"tap", "needle", "shower", "pool"})
        {
            const double before = first.liquid.numbers().at(Sources::numberOf(source)), later = whole.liquid.numbers().at(Sources::numberOf(source));
            EXPECT_GT(before, 0) << source;
            EXPECT_GT(later, before) << source;
        }
        expectRestart(chosen);
    }
}

// Models that were made and not taken, as after an edit that is refused, leave nothing behind.
TEST(Restart, OfModelsThatAreNotTakenNothingStays)
{
    Drop untouched({"default"}), tried({"default"});
    for (Drop* drop : {&untouched, &tried}) drop->begin();
    for (Drop* drop : {&untouched, &tried}) drop->steps(4);
    const std::size_t fields = tried.liquid.fields().entries().size();
    for (const std::string& name : names())
    {
        const FieldRegistry::Infos before = tried.liquid.fields().infos();
        tried.folder.write("constant/models", modelsOf(name) + "bodyForce gravity;");
        { const Models other(tried.folder.path(), Dictionary::read(sets / name / "solution"), tried.liquid, tried.walls); }
        tried.liquid.fields().restore(before);
    }
    EXPECT_EQ(tried.liquid.fields().entries().size(), fields);
    for (Drop* drop : {&untouched, &tried}) drop->steps(4);
    EXPECT_EQ(tried.bits(), untouched.bits());
}

// A change to other models and back gives what a run that is started with these gives from that state on.
TEST(Restart, AfterAChangeToOtherModelsAndBackIsARunFromThatState)
{
    for (const std::string& other : names())
    {
        SCOPED_TRACE(other);
        Drop changed({"default"}), started({"default"});
        changed.begin();
        changed.steps(4);
        changed.choose({other});
        changed.steps(3);
        changed.write(changed.folder.path() / "1");
        started.liquid.read(changed.folder.path() / "1");
        changed.choose({"default"});
        changed.steps(4);
        started.steps(4);
        EXPECT_EQ(changed.bits(), started.bits());
    }
}
