// SPDX-License-Identifier: GPL-3.0-or-later
// Why a run has died: what is taken from a log.

#include "study/RunReason.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

namespace shizuku::test
{

namespace
{

std::string reasonOfLog(const std::string& log, int exit)
{
    const ScratchFolder folder;
    folder.write("log.runCases", log);
    return reasonOf(folder.path(), exit);
}

// As runApplication() prints it: what lies before and behind the message is no part of it.
TEST(RunReason, TheLastErrorOfTheLogOnOneLine)
{
    const std::string first = "sampling\n\n--> FATAL ERROR:\nThe wall is open\n\nsampleSurface: stopped\n";
    const std::string second = "\n--> FATAL IO ERROR:\nNo entry 'spacing'\n    file: solution\n \t\npbfDroplet: stopped\n";
    EXPECT_EQ(reasonOfLog(first, 1), "The wall is open");
    EXPECT_EQ(reasonOfLog(first + second, 1), "No entry 'spacing' file: solution");
}

TEST(RunReason, WhatTheExitStatusTellsWhereNoErrorStands)
{
    EXPECT_EQ(reasonOfLog("Time = 1\nls: no such file\n\n", 2), "exit 2; ls: no such file");
    EXPECT_EQ(reasonOfLog("", 2), "exit 2");
    EXPECT_EQ(reasonOfLog("Time = 1\n", 137), "ended by signal 9");
    EXPECT_EQ(reasonOf("absent", 127), "exit 127");
}

}

}
