// SPDX-License-Identifier: GPL-3.0-or-later
// A controlDict that changes while a run goes on.

#include "unit/core/TimedCase.H"

using namespace shizuku;
using namespace shizuku::test;

TEST(TimeChanges, ActsOnAChangedControlDict)
{
    const TimedCase folder("runTimeModifiable yes; " + tenSteps);
    Time time(folder.path());
    EXPECT_FALSE(time.readIfModified());
    for (int i = 0; i < 3; ++i) time.advance();

    folder.control("runTimeModifiable yes; endTime 0.6; deltaT 0.05; writeInterval 4; writeFormat binary;");
    testing::internal::CaptureStdout();
    EXPECT_TRUE(time.readIfModified());
    EXPECT_TRUE(holds(testing::internal::GetCapturedStdout(), {"controlDict", "anew"}));
    EXPECT_FALSE(time.readIfModified());
    EXPECT_EQ(time.endTime(), 0.6);
    EXPECT_TRUE(time.format().binary);
    time.advance();
    EXPECT_EQ(time.index(), 4);
    EXPECT_NEAR(time.value(), 0.35, 1e-16);     // within a unit in the last place
    EXPECT_TRUE(time.writeDue());
}

TEST(TimeChanges, StopsWhenTheChangedControlDictSaysSo)
{
    for (const auto& [stopAt, expected] : std::vector<std::pair<std::string, Names>>
        {{"writeNow", {"0.4"}}, {"noWriteNow", {}}, {"nextWrite", {"0.5"}}})
    {
        const TimedCase folder("runTimeModifiable yes; " + tenSteps);
        Time time(folder.path());
        for (int i = 0; i < 3; ++i) time.advance();
        folder.control("runTimeModifiable yes; stopAt " + stopAt + "; " + tenSteps);
        EXPECT_TRUE(time.readIfModified());
        EXPECT_EQ(folder.run(time), expected) << stopAt;
    }
}

TEST(TimeChanges, AMalformedChangeLeavesTheFormerValues)
{
    const TimedCase folder("runTimeModifiable yes; " + tenSteps);
    Time time(folder.path());
    time.advance();
    for (const char* bad : {"runTimeModifiable yes; endTime 2; deltaT", "runTimeModifiable yes; endTime 2; deltaT 0;"})
    {
        folder.control(bad);
        testing::internal::CaptureStderr();
        EXPECT_FALSE(time.readIfModified());
        EXPECT_TRUE(holds(testing::internal::GetCapturedStderr(), {"WARNING", "deltaT", "former values"}));
        EXPECT_FALSE(time.readIfModified());        // warned once
        EXPECT_EQ(time.endTime(), 1);
        EXPECT_EQ(time.deltaT(), 0.1);
    }
    std::filesystem::remove(folder.path() / "system/controlDict");
    EXPECT_FALSE(time.readIfModified());
    folder.control("runTimeModifiable yes; endTime 2; deltaT 0.1; writeInterval 5;");
    EXPECT_TRUE(time.readIfModified());
    EXPECT_EQ(time.endTime(), 2);
}

TEST(TimeChanges, LeavesAChangedControlDictAloneUnlessModifiable)
{
    const TimedCase folder(tenSteps);
    Time time(folder.path());
    folder.control("endTime 2; deltaT 0.1; writeInterval 5;");
    EXPECT_FALSE(time.readIfModified());
    EXPECT_EQ(time.endTime(), 1);
}

// As an editor leaves it between opening the file and writing to it.
TEST(TimeChanges, AnEmptiedControlDictIsOneThatIsBeingWritten)
{
    const TimedCase folder("runTimeModifiable yes; " + tenSteps);
    Time time(folder.path());
    folder.control("");
    testing::internal::CaptureStderr();
    EXPECT_FALSE(time.readIfModified());
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    folder.control("runTimeModifiable yes; endTime 2; deltaT 0.1; writeInterval 5;");
    EXPECT_TRUE(time.readIfModified());
    EXPECT_EQ(time.endTime(), 2);
}
