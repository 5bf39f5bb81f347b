// SPDX-License-Identifier: GPL-3.0-or-later
#include "population/Population.H"

#include "device/Device.H"
#include "support/LiquidCase.H"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// Without liquid at first, or with 5 x 5 x 5 particles above the origin; spacings of 1 mm. Nothing moves but streams.
class SourceScene : public LiquidCase
{
public:
    explicit SourceScene(const std::string& sources, const std::string& outlets = "", bool filled = false, const CaseText& text = {}) : LiquidCase(text)
    {
        folder.write("constant/outlets", outlets);
        folder.write("constant/sources", sources);
        if (filled) place(latticeBlock(5, 5, 5, 1, {-2, -2, 1}));
        population.emplace(folder.path(), liquid);
        population->begin(liquid);
    }

    void step(double deltaT)
    {
        const scalar dt = liquid.units().toScaled(deltaT, dimensions::time);
        population->beginStep(liquid, time, deltaT);
        population->held().begin(liquid);
        population->held().end(liquid, dt);
        changed = population->endStep(liquid, time, time + deltaT, 0).any;
        time += deltaT;
    }

    double number(const std::string& source) const { return liquid.numbers().at(Sources::numberOf(source)); }
    std::set<std::uint32_t> ids() const
    {
        const auto all = liquid.id.download();
        return {all.begin(), all.begin() + liquid.owned()};
    }
    double volume() const { return liquid.owned()*liquid.properties().particleVolume(); }

    std::optional<Population> population;
    double time = 0;
    bool changed = false;
};

const std::string tap = "tap { type nozzle; mouth (0 0 0.02); direction (0 0 -1); radius 2.2e-3; flowRate 1e-6; }";

}

// The layers of the stretch at first: four, two supports. Then as many as the flow moves on by spacings: the volume is that of the flow within a layer.
TEST(Population, ANozzleLetsInWhatItsFlowAsksFor)
{
    SourceScene scene(tap);
    EXPECT_EQ(scene.liquid.owned(), 0);
    EXPECT_TRUE(scene.population->mayComeIn());
    for (int k = 0; k < 200; ++k) scene.step(1e-3);
    constexpr double layer = 16e-9;             // m3: of 16 columns, as near to the disc's area of 15.2 mm2 as a lattice has
    constexpr double flow = 200e-9, atFirst = 3*layer;
    EXPECT_NEAR(scene.volume(), flow + atFirst, layer);
    EXPECT_EQ(scene.liquid.owned() % 16, 0);
    EXPECT_EQ(scene.number("tap"), scene.liquid.owned());
    EXPECT_EQ(scene.ids().size(), std::size_t(scene.liquid.owned()));
    EXPECT_EQ(*scene.ids().rbegin(), std::uint32_t(scene.liquid.owned() - 1));
}

// In the stretch layers are a spacing apart, and all particles move along the axis: roundings are of quanta, 2e-6 spacings each, over 50 steps.
TEST(Population, WhatIsInANozzleIsALatticeThatMovesRigidly)
{
    SourceScene scene("tap { type nozzle; mouth (0 0 0.02); direction (0 0 -1); radius 2.2e-3; velocity 0.1; }");
    for (int k = 0; k < 50; ++k) scene.step(1e-3);
    const auto x = scene.liquid.positions();
    const auto u = scene.liquid.velocity.download();
    double least = 1;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        EXPECT_NEAR(u[i].z*scene.liquid.units().of(dimensions::velocity), -0.1, 1e-7);
        for (std::size_t j = 0; j < i; ++j)
        {
            if (x[i].z > 0.02 && x[j].z > 0.02) least = std::min(least, length(x[i] - x[j]));
        }
    }
    EXPECT_NEAR(least, 1e-3, 1e-6);
}

// The layer of the block at 5 mm stands 0.4 spacings behind the places where layers are born.
TEST(Population, ANozzleBearsNothingOnLiquidBehindIt)
{
    SourceScene scene("tap { type nozzle; mouth (0.5e-3 0.5e-3 0.6e-3); direction (0 0 -1); radius 2.2e-3; flowRate 1e-6; }", "", true);
    for (int k = 0; k < 50; ++k) scene.step(1e-3);
    const auto x = scene.liquid.positions();
    double least = 1;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j) if (x[i].z > 3.9e-3 && x[j].z > 3.9e-3) least = std::min(least, length(x[i] - x[j]));
    }
    EXPECT_GE(least, 0.5e-3);
}

// Also where sums of products are rounded once: the square of a place on the axis less that of its depth is then as often below zero as above.
TEST(Population, AStreamWithoutAHoleHasItsAxis)
{
    const Stream stream{{0, 0, 4.123}, {0, 0, -1}, 5, 0, 2, 1};
    for (int k = 0; k < 1000; ++k)
    {
        const scalar z = scalar(4.1) - scalar(k)*scalar(4.7e-3);
        EXPECT_TRUE(stream.contains(Place{} + Vec3{0, 0, z})) << "z = " << z;
    }
    EXPECT_FALSE(stream.contains(Place{} + Vec3{0, 0, scalar(4.2)}));
    EXPECT_FALSE(stream.contains(Place{} + Vec3{scalar(2.1), 0, 0}));
}

TEST(Population, ATableChangesTheFlowAndARingIsHollow)
{
    SourceScene scene("tap { type nozzle; mouth (0 0 0.02); direction (0 0 -1); radius 4e-3; innerRadius 2e-3; velocity { times (0 0.1 0.2); values (0 0.1 0); } }");
    for (int k = 0; k < 300; ++k) scene.step(1e-3);
    // A triangle of 0.2 s and 0.1 m/s: 10 mm, ten layers, behind three at first and one in between.
    const double layers = 14;
    EXPECT_EQ(std::fmod(scene.liquid.owned(), layers), 0);
    for (const Vector3& x : scene.liquid.positions()) EXPECT_GE(std::hypot(x.x, x.y), 2e-3 - 1e-8);
}

// The volume is exact to the particle at all times, both ways.
TEST(Population, ANeedleFeedsAndDrawsToTheParticle)
{
    SourceScene scene("needle { type needle; mouth (0 0 0); direction (0 0 1); radius 2.2e-3; flowRate { times (0 0.01 0.02 1); values (1e-6 1e-6 -1e-6 -1e-6); } }", "", true);
    double asked = 0;
    for (int k = 0; k < 45; ++k)
    {
        const double middle = (k + 0.5)*1e-3;
        asked += 1e-3*(middle < 0.01 ? 1e-6 : middle < 0.02 ? 1e-6 - 2e-4*(middle - 0.01) : -1e-6);
        scene.step(1e-3);
        EXPECT_EQ(scene.number("needle"), std::floor(asked/1e-9 + 1e-6)) << "step " << k;
        EXPECT_EQ(scene.liquid.owned(), 125 + scene.number("needle"));
    }
    EXPECT_LT(scene.number("needle"), 0);
    EXPECT_EQ(scene.ids().size(), std::size_t(scene.liquid.owned()));
}

// 0.05 m/s over 4 cm2 for 20 ms: 400 mm3, within a drop of 14. No two of the drops overlap.
TEST(Population, RainIsAsMuchAsItsRate)
{
    const std::string shower = "shower { type rain; rate 0.05; corner (0 0 0.1); along (0.02 0 0); across (0 0.02 0); direction (0 0 -1); speed 2; sizes { type oneSize; diameter 3e-3; } seed 7; }";
    const std::string out = "floor { type plane; point (0 0 0); normal (0 0 -1); }";
    SourceScene scene(shower, out), again(shower, out);
    const Vec3 fall{0, 0, -scalar(2/scene.liquid.units().of(dimensions::velocity))};
    for (int k = 0; k < 20; ++k)
    {
        for (SourceScene* each : {&scene, &again})
        {
            each->step(1e-3);
            std::vector<Position> x = each->liquid.position.download();
            for (Position& p : x) p += each->liquid.units().toScaled(1e-3, dimensions::time)*fall;
            each->liquid.position.upload(x);
        }
    }
    EXPECT_LE(scene.volume(), 400e-9);
    EXPECT_NEAR(scene.volume(), 400e-9, 14e-9);
    const auto x = scene.liquid.positions(), y = again.liquid.positions();
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(x[i], y[i]);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j) EXPECT_GT(length(x[i] - x[j]), 0.99e-3);
    }
}

// Outlets take out what sources let in: what is there stays the same, so does the memory, and no number comes twice.
TEST(Population, FilledAndEnteredLessLeftIsThere)
{
    SourceScene scene(tap, "out { type plane; point (0 0 0.018); normal (0 0 -1); }", true);
    EXPECT_EQ(scene.liquid.owned(), 125);
    std::set<std::uint32_t> known = scene.ids();
    std::size_t memory = 0;
    for (int k = 0; k < 400; ++k)
    {
        const std::set<std::uint32_t> before = scene.ids();
        scene.step(1e-3);
        for (const std::uint32_t id : scene.ids())
        {
            if (!before.contains(id)) EXPECT_TRUE(known.insert(id).second) << "number " << id << " comes again";
        }
        // Particles go on by the nozzle's velocity, which nothing else here does.
        std::vector<Position> x = scene.liquid.position.download();
        const auto u = scene.liquid.velocity.download();
        const auto at = scene.liquid.positions();
        for (std::size_t i = 0; i < at.size(); ++i)
        {
            if (at[i].z < 0.02) x[i] += scene.liquid.units().toScaled(1e-3, dimensions::time)*u[i];
        }
        scene.liquid.position.upload(x);
        if (k == 200) memory = deviceCounters().bytes;
    }
    EXPECT_EQ(deviceCounters().bytes, memory);
    const auto& numbers = scene.liquid.numbers();
    EXPECT_EQ(numbers.at(Population::filledNumber), 125);
    EXPECT_GT(numbers.at(Outlets::numberOf("out")), 200);
    EXPECT_EQ(numbers.at(Population::filledNumber) + scene.number("tap") - numbers.at(Outlets::numberOf("out")), scene.liquid.owned());
    EXPECT_TRUE(holds(scene.population->report(numbers, 1e-9, scene.liquid.owned()), {"entered: tap", "balance: 125 filled + ", "taken out: out"}));
}

// Room grows by a quarter: of 10,000 particles that come in layers of 16, in fewer than 40 steps (1.25^40 = 7,500).
TEST(Population, MemoryGrowsGeometrically)
{
    SourceScene scene("tap { type nozzle; mouth (0 0 0.02); direction (0 0 -1); radius 2.2e-3; velocity 1; }");
    int growths = 0, room = 0;
    for (int k = 0; k < 650; ++k)
    {
        scene.step(1e-3);
        growths += scene.liquid.fields().room() != room;
        room = scene.liquid.fields().room();
        EXPECT_GE(room, scene.liquid.owned());
    }
    EXPECT_GT(scene.liquid.owned(), 10000);
    EXPECT_LT(growths, 40);
}

TEST(Population, NoneCostsNothing)
{
    SourceScene scene("", "", true);
    const long launches = deviceCounters().launches;
    scene.step(1e-3);
    EXPECT_FALSE(scene.changed);
    EXPECT_EQ(deviceCounters().launches, launches);
    EXPECT_FALSE(scene.population->mayComeIn());
    EXPECT_EQ(scene.population->report(scene.liquid.numbers(), 1, 125), "");
}

TEST(Population, RefusesWhatItDoesNotKnow)
{
    const auto message = [](const std::string& sources, const std::string& outlets = "") { return messageOf([&] { SourceScene scene(sources, outlets); }); };
    const std::string opening = "mouth (0 0 0.02); direction (0 0 -1); radius 2e-3; ";
    EXPECT_TRUE(holds(message("a { type hose; }"), {"source", "'hose'", "nozzle", "needle", "rain", "constant/sources", "line 1"}));
    EXPECT_TRUE(holds(message("a { type nozzle; " + opening + "}"), {"neither flowRate nor velocity"}));
    EXPECT_TRUE(holds(message("a { type nozzle; " + opening + "velocity 1; flowRate 1; }"), {"both flowRate and velocity"}));
    EXPECT_TRUE(holds(message("a { type nozzle; " + opening + "velocity -1; }"), {"velocity", "-1", "at least 0"}));
    EXPECT_TRUE(holds(message("a { type nozzle; " + opening + "velocity { times (0 2 1); values (0 1 1); } }"), {"not sorted", "1 s follows 2 s"}));
    EXPECT_TRUE(holds(message("a { type nozzle; " + opening + "velocity { times (0 2); values (0 1 1); } }"), {"2 times and 3 values"}));
    EXPECT_TRUE(holds(message("a { type nozzle; mouth (0 0 0); direction (0 0 0); radius 1; velocity 1; }"), {"direction"}));
    EXPECT_TRUE(holds(message("a { type nozzle; mouth (0 0 0); direction (0 0 1); radius 2e-4; velocity 1; }"), {"narrow", "a larger radius"}));
    EXPECT_TRUE(holds(message("a { type nozzle; " + opening + "innerRadius 3e-3; velocity 1; }"), {"innerRadius"}));
    EXPECT_TRUE(holds(message("a { type nozzle; " + opening + "velocity 1; speed 2; }"), {"'speed'"}));
    const std::string area = "corner (0 0 0.1); along (0.01 0 0); direction (0 0 -1); sizes { type oneSize; diameter 3e-3; } ";
    EXPECT_TRUE(holds(message("a { type rain; rate -1; across (0 0.01 0); " + area + "}"), {"rate", "at least 0"}));
    EXPECT_TRUE(holds(message("a { type rain; rate 1; across (0.02 0 0); " + area + "}"), {"area", "one direction"}));
    EXPECT_TRUE(holds(message("a { type rain; rate 1; corner (0 0 0.1); along (1 0 0); across (0 1 0); direction (0 0 -1); sizes { type oneSize; diameter 1e-3; } }"), {"smallest drop"}));
    EXPECT_TRUE(holds(message("a { type rain; rate 1; across (0 0.01 0); " + area + "}", "sky { type outside; min (-1 -1 -1); max (1 1 0.05); }"), {"'a'", "outlet 'sky'"}));
}

TEST(Population, RefusesSourcesInWallsAndStepsThatAreTooLong)
{
    CaseText text;
    text.walls = floorPlane;
    SourceScene inside("a { type nozzle; mouth (0 0 1e-3); direction (0 0 1); radius 2e-3; velocity 1; }", "", false, text);
    Liquid empty(inside.liquid.properties(), Dictionary());
    EXPECT_TRUE(holds(messageOf([&] { inside.population->refuseInWalls(inside.walls, empty); }), {"'a'", "inside of the solid 'floor'"}));
    SourceScene above("a { type needle; mouth (0 0 0); direction (0 0 1); radius 2e-3; flowRate 1e-6; }", "", false, text);
    EXPECT_NO_THROW(above.population->refuseInWalls(above.walls, empty));
    EXPECT_TRUE(holds(messageOf([&] { above.step(1); }), {"'a'", "deltaT of at most"}));
}

namespace
{

// Axes of cyclic sides 12 mm apart around the origin.
CaseText repeated(const std::string& sides)
{
    CaseText text;
    text.boundary = "min (-6e-3 -6e-3 0); max (6e-3 6e-3 0); sides { " + sides + " }";
    return text;
}

constexpr double periodOfScene = 12e-3;             // m
const std::string cyclicX = "xMin cyclic; xMax cyclic;", cyclicXY = cyclicX + "yMin cyclic; yMax cyclic;";

double shortest(double d) { return d - periodOfScene*std::round(d/periodOfScene); }

}

// The mouth is on a side. Liquid stands where that of open space does, a period on where it would be beyond the side. Places are whole quanta: 2e-9 m.
TEST(Population, AStreamGoesOnAcrossACyclicSide)
{
    for (const char* y : {"0", "0.006"})
    {
        const std::string at = "tap { type nozzle; mouth (0.006 " + std::string(y) + " 0.02); direction (0 0 -1); radius 2.2e-3; flowRate 1e-6; }";
        SourceScene open(at), across(at, "", false, repeated(cyclicXY));
        for (int k = 0; k < 60; ++k)
        {
            open.step(1e-3);
            across.step(1e-3);
        }
        const auto a = open.liquid.positions(), b = across.liquid.positions();
        ASSERT_EQ(a.size(), b.size());
        int moved = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
        {
            EXPECT_NEAR(b[i].x, shortest(a[i].x), 4e-9);
            EXPECT_NEAR(b[i].y, shortest(a[i].y), 4e-9);
            EXPECT_NEAR(b[i].z, a[i].z, 4e-9);
            moved += std::abs(a[i].x - b[i].x) > 1e-3;
        }
        EXPECT_EQ(moved, int(a.size()/2));          // half of the mouth
    }
}

// What is drawn is the nearest to the mouth, on both sides of the seam.
TEST(Population, ANeedleDrawsAcrossACyclicSide)
{
    SourceScene scene("needle { type needle; mouth (0.006 0 0); direction (0 0 1); radius 2.2e-3; flowRate -1e-6; }", "", false, repeated(cyclicX));
    scene.place(latticeBlock(12, 5, 5, 1, {-5.5f, -2, 0.5f}));
    for (int k = 0; k < 12; ++k) scene.step(1e-3);
    EXPECT_EQ(scene.number("needle"), -12);
    const std::set<std::uint32_t> left = scene.ids();
    int lower = 0, upper = 0;                       // drawn beside either side
    const auto before = latticeBlock(12, 5, 5, 1, {-5.5f, -2, 0.5f});
    for (std::size_t i = 0; i < before.size(); ++i)
    {
        if (left.contains(std::uint32_t(i))) continue;
        EXPECT_EQ(before[i].z, 0.5f);
        EXPECT_LE(std::hypot(6 - std::abs(before[i].x), before[i].y), 2.5f);
        lower += before[i].x < 0;
        upper += before[i].x > 0;
    }
    EXPECT_EQ(lower + upper, 12);
    EXPECT_GT(lower, 0);
    EXPECT_GT(upper, 0);
}

// Across sides no two drops overlap, and some lie across one.
TEST(Population, RainFallsOnAPaneThatRepeats)
{
    const std::string shower = "shower { type rain; rate 0.05; corner (-6e-3 -6e-3 0.1); along (0.012 0 0); across (0 0.012 0); direction (0 0 -1); speed 2; sizes { type oneSize; diameter 3e-3; } seed 7; }";
    SourceScene scene(shower, "", false, repeated(cyclicXY));
    const Vec3 fall{0, 0, -scalar(2/scene.liquid.units().of(dimensions::velocity))};
    for (int k = 0; k < 20; ++k)
    {
        scene.step(1e-3);
        std::vector<Position> x = scene.liquid.position.download();
        for (Position& p : x) p += scene.liquid.units().toScaled(1e-3, dimensions::time)*fall;
        scene.liquid.position.upload(x);
    }
    EXPECT_NEAR(scene.volume(), 144e-9, 15e-9);     // 0.05 m/s over 144 mm2 for 20 ms, within a drop
    const auto x = scene.liquid.positions();
    int across = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        EXPECT_LE(std::max(std::abs(x[i].x), std::abs(x[i].y)), 6e-3 + 4e-9);
        for (std::size_t j = 0; j < i; ++j)
        {
            const Vector3 d(shortest(x[i].x - x[j].x), shortest(x[i].y - x[j].y), x[i].z - x[j].z);
            EXPECT_GT(length(d), 0.99e-3);
            across += length(d) < 1.01e-3 && length(x[i] - x[j]) > 6e-3;
        }
    }
    EXPECT_GT(across, 10);
}

// A drop is three spacings across, and what is within its radius and two spacings of the plane is left free.
TEST(Population, RainKeepsAwayFromSymmetryPlanes)
{
    const std::string shower = "shower { type rain; rate 0.2; corner (-6e-3 -6e-3 0.1); along (0.012 0 0); across (0 0.012 0); direction (0 0 -1); speed 2; sizes { type oneSize; diameter 3e-3; } }";
    SourceScene scene(shower, "", false, repeated("xMin symmetryPlane;"));
    for (int k = 0; k < 20; ++k) scene.step(1e-3);
    ASSERT_GT(scene.liquid.owned(), 30);
    for (const Vector3& x : scene.liquid.positions()) EXPECT_GE(x.x, -6e-3 + 1.9e-3);
}

TEST(Population, RefusesSourcesBeyondSides)
{
    const auto message = [](const std::string& sources, const std::string& sides) { return messageOf([&] { SourceScene scene(sources, "", false, repeated(sides)); }); };
    const auto tapAt = [](const std::string& x) { return "a { type nozzle; mouth (" + x + " 0 0.02); direction (0 0 -1); radius 2.2e-3; velocity 1; }"; };
    EXPECT_TRUE(holds(message(tapAt("0"), cyclicX + "yMin symmetryPlane;"), {"no error"}));
    EXPECT_TRUE(holds(message(tapAt("-0.0045"), "xMin symmetryPlane;"), {"'a'", "near to a symmetry plane", "half a spacing away", "constant/sources"}));
    EXPECT_TRUE(holds(message(tapAt("-0.008"), "xMin symmetryPlane;"), {"'a'", "behind a symmetry plane"}));
    EXPECT_TRUE(holds(message(tapAt("0.015"), cyclicX), {"no error"}));
    EXPECT_TRUE(holds(message(tapAt("0.02"), cyclicX), {"'a'", "a period or more beyond the cyclic sides along x"}));

    // From side to side, of a period that is no whole number of quanta.
    for (const char* spacing : {"3e-4", "4e-4", "7e-4"})
    {
        CaseText text = repeated(cyclicXY);
        text.spacing = std::stod(spacing);
        const std::string shower = "a { type rain; rate 1; corner (-6e-3 -6e-3 0.1); along (0.012 0 0); across (0 0.012 0); direction (0 0 -1); speed 1; sizes { type oneSize; diameter 3e-3; } }";
        EXPECT_EQ(messageOf([&] { SourceScene scene(shower, "", false, text); }), "no error") << spacing;
    }
}

namespace
{

// Without walls around it: what is in the box stays where it is.
std::string pool(const std::string& level, const std::string& more = "")
{
    return "pool { type reservoir; min (-5e-3 -5e-3 0); max (5e-3 5e-3 9e-3); direction (0 0 1); relaxationTime 5e-3; level " + level + "; } " + more;
}

double highest(const SourceScene& scene)
{
    double z = -1;
    for (const Vector3& x : scene.liquid.positions()) z = std::max(z, x.z);
    return z;
}

}

// 100 particles a layer: a level of 5 mm is 500 of them, of 3 mm 300, within the one by which it may be off and the one that is not whole. They lie as on a lattice, so that the
// surface is half a spacing above the highest.
TEST(Population, AReservoirFillsItsBoxAndEmptiesItToItsLevel)
{
    SourceScene scene(pool("{ times (0 0.1 0.101); values (5e-3 5e-3 3e-3); }"));
    EXPECT_TRUE(scene.population->mayComeIn());
    for (int k = 0; k < 100; ++k) scene.step(1e-3);
    EXPECT_NEAR(scene.liquid.owned(), 500, 2);
    EXPECT_EQ(scene.number("pool"), scene.liquid.owned());
    EXPECT_NEAR(highest(scene), 4.5e-3, 1.1e-3);
    const auto x = scene.liquid.positions();
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j) EXPECT_GT(length(x[i] - x[j]), 0.999e-3);
    }
    for (int k = 0; k < 100; ++k) scene.step(1e-3);
    EXPECT_NEAR(scene.liquid.owned(), 300, 2);
    EXPECT_NEAR(highest(scene), 2.5e-3, 1.1e-3);
    EXPECT_EQ(scene.ids().size(), std::size_t(scene.liquid.owned()));
    for (int k = 0; k < 20; ++k)
    {
        scene.step(1e-3);
        EXPECT_FALSE(scene.changed);            // at rest none comes and none goes
    }
}

// dV/dt = (h A - V)/tau: a time tau behind a start from nothing exp(-1) of the volume is missing, once what a step may let in (a quarter of a layer) is more than the rate asks for.
// A flow Q out of the box holds the volume Q tau below the level's: of two particles a step, ten particles, within the two above.
TEST(Population, AReservoirFollowsItsEquation)
{
    SourceScene scene(pool("{ times (0 0.1 0.1001); values (5e-3 5e-3 5.4e-3); }"));
    for (int k = 0; k < 100; ++k) scene.step(1e-3);
    const int before = scene.liquid.owned();
    for (int k = 0; k < 5; ++k) scene.step(1e-3);
    // Five explicit steps of a fifth of tau each: 0.8^5.
    EXPECT_NEAR(scene.liquid.owned(), 540 - 40*std::pow(0.8, 5), 2) << "from " << before;
    for (int k = 0; k < 95; ++k) scene.step(1e-3);
    EXPECT_NEAR(scene.liquid.owned(), 540, 2);
    double mean = 0;
    for (int k = 0; k < 100; ++k)
    {
        std::vector<Position> x = scene.liquid.position.download();
        for (int j = 2*k; j < 2*k + 2; ++j) x[std::size_t(j)] += Vec3{0, 0, -100};
        scene.liquid.position.upload(x);
        scene.step(1e-3);
        if (k >= 50) mean += (scene.liquid.owned() - 2*(k + 1))/50.0;
    }
    EXPECT_EQ(scene.number("pool"), scene.liquid.owned());
    EXPECT_NEAR(mean, 530, 2);
}

// The same box between sides, of which one goes through it, and upside down: as many, and at the same heights.
TEST(Population, AReservoirGoesOnAcrossACyclicSideAndMayHang)
{
    const std::string turned = "pool { type reservoir; min (1e-3 -6e-3 -9e-3); max (11e-3 6e-3 0); direction (0 0 -1); relaxationTime 5e-3; level 4e-3; }";
    SourceScene scene(turned, "", false, repeated(cyclicXY));
    for (int k = 0; k < 100; ++k) scene.step(1e-3);
    EXPECT_NEAR(scene.liquid.owned(), 480, 2);
    int across = 0;
    for (const Vector3& x : scene.liquid.positions())
    {
        EXPECT_LE(std::max(std::abs(x.x), std::abs(x.y)), 6e-3 + 4e-9);
        EXPECT_GT(x.z, -5.6e-3);
        EXPECT_LT(x.z, 0);
        across += x.x < -1e-3;
    }
    EXPECT_NEAR(across, scene.liquid.owned()/2, 2); // five of ten rows of columns are beyond the side
}

TEST(Population, RefusesReservoirsThatCannotBe)
{
    const auto message = [](const std::string& box, const std::string& rest) { return messageOf([&] { SourceScene scene("a { type reservoir; " + box + rest + " }"); }); };
    const std::string box = "min (0 0 0); max (5e-3 5e-3 9e-3); ", up = "direction (0 0 1); ", rest = "relaxationTime 1e-3; level 5e-3;";
    EXPECT_EQ(message(box, up + rest), "no error");
    EXPECT_TRUE(holds(message(box, up + "relaxationTime 1e-3;"), {"level", "constant/sources"}));
    EXPECT_TRUE(holds(message(box, up + "relaxationTime 0; level 5e-3;"), {"relaxationTime", "not above 0", "line 1"}));
    EXPECT_TRUE(holds(message(box, up + "relaxationTime 1e-3; level -1e-3;"), {"level", "-0.001", "at least 0"}));
    EXPECT_TRUE(holds(message(box, up + "relaxationTime 1e-3; level 8.5e-3;"), {"0.0085 m", "no room", "at most 0.008 m"}));
    EXPECT_TRUE(holds(message(box, "direction (0 1 1); " + rest), {"direction", "along no side", "x, y or z"}));
    EXPECT_TRUE(holds(message("min (0 0 0); max (5e-3 0 9e-3); ", up + rest), {"no extent along y", "max above min"}));
    EXPECT_TRUE(holds(message("min (0 0 0); max (1.5e-3 3.5e-3 9e-3); ", up + rest), {"room for 3 particles", "4 at the least"}));
    EXPECT_TRUE(holds(message(box, up + rest + " flowRate 1;"), {"'flowRate'"}));
    SourceScene scene(pool("5e-3"));
    EXPECT_TRUE(holds(messageOf([&] { scene.step(6e-3); }), {"'pool'", "deltaT of at most 0.005 s"}));
    EXPECT_TRUE(Sources::mayChange("pool.level"));
    EXPECT_FALSE(Sources::mayChange("pool.relaxationTime"));
}
