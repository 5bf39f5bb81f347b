// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/messages/Progress.H"

#include <gtest/gtest.h>

#include <thread>

using namespace shizuku;

TEST(Progress, PrintsPartDoneAndTimeLeftWhenDue)
{
    Progress progress("Sampling floor.stl", 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    testing::internal::CaptureStdout();
    progress.update(0.37);
    const std::string line = testing::internal::GetCapturedStdout();
    EXPECT_EQ(line, "Sampling floor.stl: 37 %, about 0 s left\n");
}

TEST(Progress, IsSilentBetweenTheIntervals)
{
    Progress progress("Sampling", 1000);
    testing::internal::CaptureStdout();
    progress.update(0.5);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(Progress, ExtrapolatesTheTimeLeft)
{
    const Progress progress("Sampling");
    EXPECT_LT(progress.secondsLeft(0), 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    // A fifth took at least 0.2 s, so four times that is left at least; a busy machine makes it more.
    EXPECT_GE(progress.secondsLeft(0.2), 0.8);
    EXPECT_LT(progress.secondsLeft(0.2), 80);
    EXPECT_EQ(progress.secondsLeft(1), 0);
    EXPECT_EQ(progress.text(0), "0 %");
    EXPECT_EQ(progress.text(1e-30), "0 %");         // an endTime that nobody lives to see
}

TEST(Progress, SaysWhatHasEnded)
{
    const Progress progress("Cases");
    EXPECT_EQ(progress.ended("drop1", false, 200, 2, 2), "FAILED   drop1 in 3 min 20 s  (2 of 2: 100 %, about 0 s left)");
    EXPECT_TRUE(progress.ended("drop1", true, 3, 1, 4).starts_with("Finished drop1 in 3 s  (1 of 4: 25 %"));
}

TEST(Progress, RoundsDurationsForPeople)
{
    EXPECT_EQ(durationText(0.4), "0 s");
    EXPECT_EQ(durationText(59.4), "59 s");
    EXPECT_EQ(durationText(60), "1 min");
    EXPECT_EQ(durationText(200), "3 min 20 s");
    EXPECT_EQ(durationText(7500), "2 h 5 min");
    EXPECT_EQ(durationText(4 * 86400 + 3 * 3600), "4 d 3 h");
}
