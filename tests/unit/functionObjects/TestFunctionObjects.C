// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/FunctionObjects.H"

#include "parallel/AllParts.H"
#include "parallel/PartsOfProcess.H"
#include "support/FlowCase.H"

#include <cmath>
#include <numbers>

using namespace shizuku;
using namespace shizuku::test;

// Two particles a spacing apart, then one alone: the density error must be the one of the positions of its row.
TEST(FunctionObjects, LiquidStateMeasuresTheDensityOfItsRow)
{
    FlowCase flow("drop { type liquidState; }");
    const auto lastError = [&] { return flow.value("drop/0/liquidState.csv", "maxDensityError"); };
    std::vector<Vec3> crowd;
    for (int i = 0; i < 1000; ++i) crowd.push_back({0.7f * scalar(i % 10), 0.7f * scalar(i / 10 % 10), 0.7f * scalar(i / 100)});
    flow.step(crowd);
    // A cubic lattice of 0.7 spacings holds 1/0.343 = 2.9 times the particles; the kernel's sum is near that.
    EXPECT_NEAR(lastError(), 1.9, 0.1);
    flow.step({{0, 0, 0}});
    EXPECT_EQ(lastError(), 0);
}

// Two balls, one of them beside a particle that is alone: of n particles, a sphere of n spacings^3.
TEST(FunctionObjects, DropsAreCountedAndSized)
{
    FlowCase flow("sizes { type drops; classes (0 4e-3 5e-3 1e-2); }");
    const std::vector<Vec3> large = latticeBall(3), small = latticeBall(2.2f, {10, 0, 0});
    std::vector<Vec3> all = large;
    all.insert(all.end(), small.begin(), small.end());
    all.push_back({0, 10, 0});
    flow.step(all);
    const auto value = [&](const std::string& column) { return flow.value("sizes/0/drops.csv", column); };
    const auto diameter = [](const std::vector<Vec3>& ball) { return 1e-3 * std::cbrt(6 * double(ball.size()) / std::numbers::pi); };
    const double most = diameter(large), least = diameter(small);
    ASSERT_GT(large.size(), small.size() + 1);
    ASSERT_TRUE(most > 5e-3 && least > 4e-3 && least < 5e-3);
    EXPECT_EQ(value("drops"), 2);
    EXPECT_NEAR(value("meanDiameter"), (most + least) / 2, 1e-8);       // nine digits in the table
    EXPECT_NEAR(value("medianDiameter"), most, 1e-8);
    EXPECT_NEAR(value("largestDiameter"), most, 1e-8);
    EXPECT_NEAR(value("spray"), 1e-9, 1e-15);
    EXPECT_EQ(value("offLargest"), double(small.size()) + 1);
    EXPECT_EQ(value("alone"), 1);
    const std::string off = std::to_string(small.size() + 1);
    EXPECT_EQ(flow.report(), "sizes: drops 2, particles off the largest body " + off + ", in bodies below 20 1, alone 1\n");
    EXPECT_EQ(value("from0to0.004"), 0);
    EXPECT_EQ(value("from0.004to0.005"), 1);
    EXPECT_EQ(value("from0.005to0.01"), 1);

    const auto make = [](const std::string& classes) { FlowCase bad("sizes { type drops; classes " + classes + "; }"); };
    EXPECT_TRUE(holds(messageOf([&] { make("(1e-3 1e-3)"); }), {"ascending"}));
    EXPECT_TRUE(holds(messageOf([&] { make("(-1 1)"); }), {"ascending"}));
}

// Bodies that lie in several parts, in whatever way their particles are dealt out, are counted once: tables to the byte. So are those of boxes and sections.
TEST(FunctionObjects, DropsOfPartsAreThoseOfOne)
{
    const std::string functions = "sizes { type drops; classes (0 4e-3 5e-3 1e-2); } box { type boundingBox; } cut { type crossSection; normal (0 0 1); places (0 2e-3); }";
    const std::string table = "sizes/0/drops.csv", box = "box/0/boundingBox.csv", cut = "cut/0/crossSection.csv";
    std::vector<Vec3> places;
    for (const Vec3& centre : {Vec3{0, 0, 0}, Vec3{10, 0, 0}, Vec3{0, 9, 0}, Vec3{20, 20, 20}})
    {
        for (const Vec3& place : latticeBall(2.2f, centre)) places.push_back(place);
    }
    for (int k = 0; k < 30; ++k) places.push_back({scalar(k), -10, 0});         // a thread through all
    places.push_back({0, 30, 0});
    FlowCase whole(functions);
    whole.step(places);
    for (const bool inTurn : {true, false})
    {
        for (const int parts : {2, 3, 5})
        {
            runParts(parts, [&](const Communicator& all)
            {
                std::vector<Vec3> own;
                const auto [first, end] = shareOf(all, places.size());
                for (std::size_t k = 0; k < places.size(); ++k)
                {
                    if (inTurn ? int(k) % parts == all.part() : k >= first && k < end) own.push_back(places[k]);
                }
                FlowCase flow(functions);
                flow.place(own);
                flow.liquid.ghosts().join(all);
                flow.view().cut(nullptr, false);
                flow.measure();
                EXPECT_EQ(flow.table(table), all.part() == 0 ? whole.table(table) : "") << parts << ' ' << inTurn;
                EXPECT_EQ(flow.table(box), all.part() == 0 ? whole.table(box) : "") << parts << ' ' << inTurn;
                EXPECT_EQ(flow.table(cut), all.part() == 0 ? whole.table(cut) : "") << parts << ' ' << inTurn;
            });
        }
    }
    EXPECT_EQ(whole.value(table, "drops"), 5);
    EXPECT_GT(whole.value(box, "maxX"), whole.value(box, "minX"));
    EXPECT_GT(whole.value(cut, "radius", 0), 0);
}

// A ball across an edge of cyclic sides is four pieces of one body, whole or in parts, in one of which each piece is; across an open side, and without sides, it is not.
TEST(FunctionObjects, DropsAcrossCyclicSidesAreOne)
{
    const std::string functions = "sizes { type drops; }", table = "sizes/0/drops.csv";
    const std::string cyclic = "min (0 0 0); max (0.02 0.02 0.02); sides { xMin cyclic; xMax cyclic; yMin cyclic; yMax cyclic; }";
    const std::string onlyX = "min (0 0 0); max (0.02 0.02 0.02); sides { xMin cyclic; xMax cyclic; }";
    std::vector<Vec3> places, ball = latticeBall(3.2f, {0, 0, 10});
    for (Vec3 place : ball)
    {
        if (place.x < 0) place.x += 20;
        if (place.y < 0) place.y += 20;
        places.push_back(place);
    }
    const auto drops = [&](const std::string& boundary)
    {
        FlowCase flow(functions, {.boundary = boundary});
        flow.step(places);
        return flow.value(table, "drops");
    };
    EXPECT_EQ(drops(cyclic), 1);
    EXPECT_EQ(drops(onlyX), 2);
    EXPECT_EQ(drops(""), 4);

    FlowCase whole(functions, {.boundary = cyclic});
    whole.step(places);
    EXPECT_NEAR(whole.value(table, "largestDiameter"), 1e-3 * std::cbrt(6 * double(ball.size()) / std::numbers::pi), 1e-8);
    runParts(4, [&](const Communicator& all)
    {
        std::vector<Vec3> own;
        for (const Vec3& place : places)
        {
            if ((place.x > 10) + 2 * (place.y > 10) == all.part()) own.push_back(place);
        }
        FlowCase flow(functions, {.boundary = cyclic});
        flow.place(own);
        flow.liquid.ghosts().join(all);
        flow.view().cut(nullptr, false);
        flow.measure();
        EXPECT_EQ(flow.table(table), all.part() == 0 ? whole.table(table) : "");
    });
}

TEST(FunctionObjects, OutflowWantsAnOutlet)
{
    EXPECT_TRUE(holds(messageOf([] { FlowCase flow("out { type outflow; }"); }), {"no outlet", "constant/outlets"}));
}

TEST(FunctionObjects, AValueAmongThemIsRefused)
{
    const auto make = [] { FlowCase flow("drop liquidState;"); };
    EXPECT_TRUE(holds(messageOf(make), {"'drop'", "functions", "controlDict at line 2"}));
}

TEST(FunctionObjects, ANameThatLeadsOutOfPostProcessingIsRefused)
{
    for (const std::string name : {"../x", "../../../outside", "a/b", "\"..\"", "\".\"", "/tmp/x"})
    {
        const std::string message = messageOf([&] { FlowCase flow(name + " { type liquidState; }"); });
        EXPECT_TRUE(holds(message, {"The function object is named", "postProcessing", "a name without '/'", "line 2"})) << name;
    }
}

TEST(FunctionObjects, AValueForAMacroIsNot)
{
    FlowCase flow("often 1; drop { type liquidState; executeInterval $often; }");
    flow.step({{0, 0, 0}});
    EXPECT_FALSE(flow.table("drop/0/liquidState.csv").empty());
}
