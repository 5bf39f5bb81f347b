// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/FunctionObjects.H"

#include "support/FlowCase.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// A speed [m/s] a step of 0.25 s; the first step, from 1, after which the end of the run is asked for, 0: never.
int endAsked(const std::string& condition, const std::vector<double>& speeds)
{
    FlowCase flow
    (
        "end { type runTimeControl; conditions { rest { type minMax; " + condition + " } } } drop { type liquidState; }"
    );
    const double unit = flow.liquid.units().of(dimensions::velocity);
    for (std::size_t step = 0; step < speeds.size(); ++step)
    {
        // Two particles, the second one at rest: the rms speed is the largest over sqrt(2).
        flow.step({{0, 0, 0}, {1, 0, 0}}, {{scalar(speeds[step]/unit), 0, 0}, {0, 0, 0}});
        if (!flow.reasonToEnd().empty()) return int(step) + 1;
    }
    return 0;
}

const std::string slow = "functionObject drop; fields (maxSpeed); mode minimum; value 1; ";

}

// The control stands before the liquidState that it looks at, and so sees each row a step later.
TEST(RunTimeControl, AsksForTheEndWhereAValueIsBelowOrAbove)
{
    EXPECT_EQ(endAsked(slow, {3, 2, 0.9, 0.8}), 4);
    EXPECT_EQ(endAsked(slow, {3, 2, 1.1, 1.1}), 0);
    EXPECT_EQ(endAsked("functionObject drop; fields (maxSpeed); mode maximum; value 2.5;", {2, 3, 1}), 3);
    // Of several fields all: the rms speed falls below 1 where the largest does below 1.41.
    EXPECT_EQ(endAsked("functionObject drop; fields (maxSpeed rmsSpeed); mode minimum; value 1;", {3, 1.3, 0.9, 0.9}), 4);
    EXPECT_EQ(endAsked("functionObject drop; fields (rmsSpeed); mode minimum; value 1;", {3, 1.3, 0.9, 0.9}), 3);
    // Of several conditions any.
    EXPECT_EQ(endAsked(slow + "} fast { type minMax; functionObject drop; fields (maxSpeed); mode maximum; value 2;", {3, 3}), 2);
}

TEST(RunTimeControl, AsksOnceItHasHeldForTheDuration)
{
    // Rows are seen at 0.5, 0.75 (slow), 1 (fast), 1.25, 1.5, 1.75, 2 s (slow).
    const std::vector<double> speeds{0.5, 0.5, 3, 0.5, 0.5, 0.5, 0.5, 0.5};
    EXPECT_EQ(endAsked(slow + "duration 0.25;", speeds), 3);
    EXPECT_EQ(endAsked(slow + "duration 0.5;", speeds), 7);
    EXPECT_EQ(endAsked(slow + "duration 0.75;", speeds), 8);
    EXPECT_EQ(endAsked(slow + "duration 1;", speeds), 0);
}

TEST(RunTimeControl, SeesTheRowOfTheStepWhereItStandsBehind)
{
    FlowCase flow("drop { type liquidState; } end { type runTimeControl; conditions { slow { type minMax; " + slow + " } } }");
    flow.step({{0, 0, 0}});
    EXPECT_EQ(flow.reasonToEnd(), "end: maxSpeed below 1");
}

TEST(RunTimeControl, TheRmsSpeedIsOverTheCapillarySpeedOfTheVolume)
{
    FlowCase flow("drop { type liquidState; }");
    const double unit = flow.liquid.units().of(dimensions::velocity);
    flow.step({{0, 0, 0}, {1, 0, 0}}, {{scalar(0.3/unit), 0, 0}, {0, 0, 0}});
    const std::string table = "drop/0/liquidState.csv";
    EXPECT_NEAR(flow.value(table, "rmsSpeed"), 0.3/std::sqrt(2), 1e-6);
    // sigma 0.072, rho 1000, and two particles of a cubic millimetre: a sphere of 0.7816 mm.
    EXPECT_NEAR(flow.value(table, "rmsOverCapillary"), 0.3/std::sqrt(2)/std::sqrt(0.072/(1000*0.78159e-3)), 1e-5);
}

TEST(RunTimeControl, RefusesWhatItCannotLookAt)
{
    const auto refusal = [](const std::string& condition) { return messageOf([&] { endAsked(condition, {0}); }); };
    const std::string rest = " fields (maxSpeed); mode minimum; value 1;";
    EXPECT_TRUE(holds(refusal("functionObject dorp;" + rest), {"'dorp'", "Did you mean 'drop'", "line 2"}));
    // One that measures nothing is no choice.
    EXPECT_TRUE(holds(refusal("functionObject end;" + rest), {"'end'", "drop"}));
    EXPECT_TRUE(holds
    (
        refusal("functionObject drop; fields (maxSped); mode minimum; value 1;"),
        {"'maxSped' in liquidState.csv", "Did you mean 'maxSpeed'", "kineticEnergy", "line 2"}
    ));
    EXPECT_TRUE(holds(refusal("functionObject drop; fields (); mode minimum; value 1;"), {"no field", "one at least"}));
    EXPECT_TRUE(holds(refusal("functionObject drop; fields (maxSpeed); mode least; value 1;"), {"'least'", "minimum", "maximum"}));
    EXPECT_TRUE(holds(refusal(slow + "duration -1;"), {"duration", "-1"}));
    EXPECT_TRUE(holds(refusal(slow + "groupID 1;"), {"'groupID'", "nothing reads it"}));
    EXPECT_TRUE(holds(messageOf([] { FlowCase("end { type runTimeControl; conditions { a { type average; } } }"); }), {"'average'", "minMax"}));
    EXPECT_TRUE(holds(messageOf([] { FlowCase("end { type runTimeControl; conditions { } }"); }), {"no condition"}));
}
