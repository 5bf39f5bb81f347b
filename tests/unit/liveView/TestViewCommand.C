// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/messages/Error.H"
#include "liveView/ViewCommand.H"

#include <gtest/gtest.h>

using namespace shizuku;
using Kind = ViewCommand::Kind;

TEST(ViewCommand, EachWordIsTaken)
{
    EXPECT_EQ(ViewCommand::parse("pause").kind, Kind::pause);
    EXPECT_EQ(ViewCommand::parse("run").kind, Kind::run);
    EXPECT_EQ(ViewCommand::parse("step").kind, Kind::step);
    EXPECT_EQ(ViewCommand::parse("write").kind, Kind::write);
    EXPECT_EQ(ViewCommand::parse("stop").kind, Kind::stop);
    const ViewCommand next = ViewCommand::parse("next 200000");
    EXPECT_EQ(next.kind, Kind::next);
    EXPECT_EQ(next.value, 200000);
    const ViewCommand set = ViewCommand::parse("set g:z -9.81e0");
    EXPECT_EQ(set.kind, Kind::set);
    EXPECT_EQ(set.name, "g:z");
    EXPECT_EQ(set.value, -9.81);
}

TEST(ViewCommand, WhatIsNoneIsRefused)
{
    for (const std::string text :
        {"", " ", "paus", "PAUSE", "pause now", "pause ", "next", "next -1", "next 1.5", "next 1e99", "next 1 2", "set", "set ", "set  5", "set theta:floor",
            "set theta:floor ", "set theta:floor nan", "set theta:floor inf", "set theta:floor 60;", "set theta:floor 60 }", "set theta:floor 0x10", "time x",
            "next 1\n", "\xff\xfe"})
    {
        EXPECT_THROW(ViewCommand::parse(text), FatalInputError) << text;
    }
    EXPECT_THROW(ViewCommand::parse(std::string("pause\0", 6)), FatalInputError);
    EXPECT_THROW(ViewCommand::parse("set " + std::string(ViewCommand::longest, 'a') + " 1"), FatalInputError);
}
