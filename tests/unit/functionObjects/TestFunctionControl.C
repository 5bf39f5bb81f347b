// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/FunctionControl.H"

#include "support/FlowCase.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// The times of the rows of a liquidState after six steps of 0.25 s in a case that writes every third step.
std::string rowsOf(const std::string& entries)
{
    FlowCase flow("drop { type liquidState; " + entries + " }", {}, "", "endTime 1.5; writeInterval 3;");
    for (int step = 0; step < 6; ++step) flow.step({{0, 0, 0}});
    std::string times;
    std::istringstream table(flow.table("drop/0/liquidState.csv"));
    for (std::string line; std::getline(table, line);)
    {
        if (!line.starts_with("time")) times += line.substr(0, line.find(',')) + " ";
    }
    return times;
}

}

TEST(FunctionControl, MeasuresWhenItIsTold)
{
    EXPECT_EQ(rowsOf(""), "0.25 0.5 0.75 1 1.25 1.5 ");
    EXPECT_EQ(rowsOf("executeInterval 2;"), "0.5 1 1.5 ");
    EXPECT_EQ(rowsOf("executeControl timeStep; executeInterval 4;"), "1 ");
    EXPECT_EQ(rowsOf("executeControl runTime; executeInterval 0.6;"), "0.5 1.25 ");        // the steps nearest to 0.6, 1.2
    EXPECT_EQ(rowsOf("executeControl adjustableRunTime; executeInterval 0.75;"), "0.75 1.5 ");
    EXPECT_EQ(rowsOf("executeControl writeTime;"), "0.75 1.5 ");
    EXPECT_EQ(rowsOf("executeControl writeTime; executeInterval 2;"), "1.5 ");
    EXPECT_EQ(rowsOf("executeControl onEnd;"), "1.5 ");
    // As in OpenFOAM: a row whenever the table is written.
    EXPECT_EQ(rowsOf("writeControl timeStep; writeInterval 2;"), "0.5 1 1.5 ");
    EXPECT_EQ(rowsOf("writeControl timeStep; writeInterval 2; executeInterval 3;"), "0.75 1.5 ");
}

TEST(FunctionControl, WritesWhenItIsTold)
{
    FlowCase flow
    (
        "each { type liquidState; executeInterval 1; writeControl timeStep; writeInterval 2; } fields { type liquidState; }",
        {}, "", "endTime 10; writeInterval 3;"
    );
    const auto rows = [&](const std::string& name)
    {
        const std::string table = flow.table(name + "/0/liquidState.csv");
        return std::count(table.begin(), table.end(), '\n') - 1;
    };
    flow.step({{0, 0, 0}});
    EXPECT_EQ(rows("each"), -1);                    // no file yet
    flow.step({{0, 0, 0}});
    EXPECT_EQ(rows("each"), 2);
    EXPECT_EQ(rows("fields"), -1);
    flow.step({{0, 0, 0}});
    EXPECT_EQ(rows("each"), 3);                     // with the fields all
    EXPECT_EQ(rows("fields"), 3);
}

TEST(FunctionControl, RefusesWhatMeansNothing)
{
    const auto refusal = [](const std::string& entries) { return messageOf([&] { rowsOf(entries); }); };
    EXPECT_TRUE(holds(refusal("executeControl sometimes;"), {"'sometimes'", "writeTime", "onEnd", "runTime"}));
    EXPECT_TRUE(holds(refusal("executeInterval 0;"), {"executeInterval is 0", "from 1", "line 2"}));
    EXPECT_TRUE(holds(refusal("executeControl runTime;"), {"'executeInterval' is missing"}));
    EXPECT_TRUE(holds(refusal("executeControl runTime; executeInterval -1;"), {"'executeInterval' is -1", "> 0"}));
    EXPECT_TRUE(holds(refusal("executeControl adjustableRunTime; executeInterval 0.3;"), {"1.2", "whole number of deltaT"}));
    EXPECT_TRUE(holds(refusal("executeControl onEnd; executeInterval 2;"), {"'executeInterval'", "nothing reads it"}));
    EXPECT_TRUE(holds(refusal("writeControl never;"), {"'never'", "writeTime"}));
}
