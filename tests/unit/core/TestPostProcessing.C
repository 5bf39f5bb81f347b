// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/PostProcessing.H"
#include "support/ScratchFolder.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

class PostProcessing : public testing::Test
{
protected:
    std::string table(const std::string& start) const { return folder_.read("postProcessing/drop/" + start + "/a.csv"); }
    void write(const std::string& start, const std::string& rows) const
    {
        folder_.write("postProcessing/drop/" + start + "/a.csv", "time [s],x\n" + rows);
    }
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path()/"postProcessing/drop"/name); }
    void drop(double start, const std::string& name) const { dropRowsBehind(start, folder_.path()/"postProcessing/drop"/name/"a.csv"); }

    const ScratchFolder folder_;
};

}

TEST_F(PostProcessing, OfEarlierRunsTheRowsUntilTheStartAreKept)
{
    write("0", "0.1,1\n0.2,2\n0.3,3\n");
    write("0.2", "0.3,3.1\n0.4,4.1\n");
    write("0.4", "0.5,5.1\n");
    drop(0.3, "0.3");
    EXPECT_EQ(table("0"), "time [s],x\n0.1,1\n0.2,2\n0.3,3\n");
    EXPECT_EQ(table("0.2"), "time [s],x\n0.3,3.1\n");
    EXPECT_FALSE(exists("0.4"));
    // Of several rows a time all, and its own table is another one's to replace.
    write("0.3", "0.4,4.2\n0.4,4.3\n0.5,5.2\n");
    drop(0.4, "0.4");
    EXPECT_EQ(table("0.3"), "time [s],x\n0.4,4.2\n0.4,4.3\n");
    drop(0.3, "0.3");
    EXPECT_EQ(table("0.3"), "time [s],x\n0.4,4.2\n0.4,4.3\n");
    // A run from the start measures all anew.
    drop(0, "0");
    EXPECT_TRUE(exists("0/a.csv"));
    EXPECT_FALSE(exists("0.2"));
    EXPECT_FALSE(exists("0.3"));
}

// Rows have nine digits, the start all: 1/3 + 0.1 is behind the row's number.
TEST_F(PostProcessing, TheRowOfTheStartItselfIsKept)
{
    write("0", "0.333333333,1\n0.433333333,2\n0.433333334,3\n");
    drop(1/3.0, "0.333333");
    EXPECT_EQ(table("0"), "time [s],x\n0.333333333,1\n");
    write("0", "0.666666667,1\n0.7,2\n");                 // ahead of it
    drop(2/3.0, "0.666667");
    EXPECT_EQ(table("0"), "time [s],x\n0.666666667,1\n");
}

TEST_F(PostProcessing, WhatInterruptedWritesLeftGoesAndWhatElseIsThereStays)
{
    write("0", "0.1,1\n");
    folder_.write("postProcessing/drop/0/.a.csv.partial", "time [s],x\n0.1");
    folder_.write("postProcessing/drop/0.2/a.csv", "time [s],x\n0.3,1\n0.4\n");        // by hand
    folder_.write("postProcessing/drop/0.4/a.csv", "time [s],x\n0.5,1\n");
    folder_.write("postProcessing/drop/0.4/a.png", "chart");
    folder_.write("postProcessing/drop/0.4/b.csv", "time [s],x\n0.5,1\n");
    folder_.write("postProcessing/drop/notes/a.csv", "time [s],x\n0.5,1\n");
    testing::internal::CaptureStderr();
    drop(0.1, "0.1");
    EXPECT_TRUE(holds(testing::internal::GetCapturedStderr(), {"0.2/a.csv", "line 3", "is left as it is"}));
    EXPECT_FALSE(exists("0/.a.csv.partial"));
    EXPECT_EQ(table("0.2"), "time [s],x\n0.3,1\n0.4\n");
    EXPECT_FALSE(exists("0.4/a.csv"));
    EXPECT_TRUE(exists("0.4/a.png"));
    EXPECT_TRUE(exists("0.4/b.csv"));
    EXPECT_TRUE(exists("notes/a.csv"));
    drop(0.1, "0.1");
    EXPECT_NO_THROW(dropRowsBehind(0, folder_.path()/"postProcessing/none/0/a.csv"));
}
