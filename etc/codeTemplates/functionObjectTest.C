// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/FunctionObjects.H"

#include "support/FlowCase.H"

using namespace shizuku;
using namespace shizuku::test;

TEST(@class@, WritesHowFarTheCentroidMoved)
{
    FlowCase flow("drift { type @word@; }");
    flow.step({{1, 0, 0}});
    flow.step({{1, 3, 4}});             // spacings of 1e-3 m
    EXPECT_EQ(flow.table("drift/0/@word@.csv"), "time [s],distance [m]\n0.25,0\n0.5,0.005\n");
}
