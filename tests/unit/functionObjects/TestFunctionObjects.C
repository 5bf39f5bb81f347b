// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/FunctionObjects.H"

#include "support/FlowCase.H"

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
