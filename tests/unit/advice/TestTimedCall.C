// SPDX-License-Identifier: GPL-3.0-or-later
// What a call takes is what its process lives, by the median; a program that fails says why.

#include "advice/TimedCall.H"

#include "core/messages/Error.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

namespace shizuku::test
{

namespace
{

struct TimedCall : testing::Test
{
    std::filesystem::path log() const { return folder.path()/"log"; }
    // A script of sh that also counts its calls, a line each.
    double seconds(const std::string& script, double calledFor) const
    {
        return secondsOfCall({"/bin/sh", "-c", "echo >>'" + calls().string() + "'; " + script}, log(), calledFor);
    }
    std::filesystem::path calls() const { return folder.path()/"calls"; }
    std::size_t called() const { return folder.read("calls").size(); }

    ScratchFolder folder;
};

// No less than the process sleeps, and no more than the test waits for it, however busy the machine is.
TEST_F(TimedCall, LastsFromTheCallToTheEnd)
{
    const auto begun = std::chrono::steady_clock::now();
    const double once = seconds("sleep 0.2", 0);
    EXPECT_GE(once, 0.2);
    EXPECT_LE(once, std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
    EXPECT_EQ(called(), 1u);
}

// The first of them is the slow one here: three of the others, which sleep for no time, would have to take as long to hide that.
TEST_F(TimedCall, OneSlowCallOfSeveralDoesNotCount)
{
    EXPECT_LT(seconds("[ $(wc -l <'" + calls().string() + "') -gt 1 ] || sleep 3", 60), 3);
    EXPECT_EQ(called(), 5u);
    // No more calls than fit in: a second one of 0.3 s would end at 0.6 s.
    folder.write("calls", "");
    EXPECT_GE(seconds("sleep 0.3", 0.5), 0.3);
    EXPECT_EQ(called(), 1u);
}

TEST_F(TimedCall, FailureIsToldByWhatTheProgramSays)
{
    const auto reason = [&](const std::vector<std::string>& command)
    {
        try
        {
            secondsOfCall(command, log(), 0);
        }
        catch (const FatalError& error)
        {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(reason({"/bin/sh", "-c", "echo Banner; echo '--> FATAL ERROR:' >&2; echo 'No drop' >&2; exit 1"}),
        "/bin/sh stopped:\n--> FATAL ERROR:\nNo drop");
    EXPECT_EQ(reason({"/bin/sh", "-c", "echo Banner; kill -9 $$"}), "/bin/sh stopped:\nBanner");
    EXPECT_NE(reason({"/nonexistent/program"}).find("Cannot start /nonexistent/program"), std::string::npos);
}

}

}
