// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/BackgroundWriter.H"

#include "core/fieldFile/AtomicFile.H"
#include "support/ScratchFolder.H"

#include <atomic>
#include <chrono>
#include <thread>

using namespace shizuku;
using namespace shizuku::test;
using namespace std::chrono_literals;

namespace
{

// A job that takes as long as the test wants.
struct Gate
{
    std::promise<void> opened;
    std::shared_future<void> open = opened.get_future().share();

    WriteJob job(std::string& log, const std::string& name) const
    {
        return [&log, name, gate = open] { gate.wait(); log += name; };
    }
};

WriteJob failing(const std::string& message)
{
    return [message] { throw FatalError(message); };
}

}

TEST(BackgroundWriter, KeepsTheOrderAndDoesAllOfIt)
{
    std::string log;
    BackgroundWriter writer;
    for (const std::string write : {"a", "b", "c"})
    {
        for (const std::string job : {"1", "2"}) writer.add([&log, write, job] { log += write + job + " "; });
        writer.start();
    }
    writer.finish();
    EXPECT_EQ(log, "a1 a2 b1 b2 c1 c2 ");
}

TEST(BackgroundWriter, WritesBehindTheCaller)
{
    std::string log;
    Gate gate;
    BackgroundWriter writer;
    writer.add(gate.job(log, "slow"));
    writer.start();
    writer.start();                             // nothing new: nothing to wait for
    EXPECT_EQ(log, "");
    EXPECT_EQ(writer.waited(), 0);
    EXPECT_FALSE(writer.isIdle());
    gate.opened.set_value();
    writer.finish();
    EXPECT_TRUE(writer.isIdle());
    EXPECT_EQ(log, "slow");
}

TEST(BackgroundWriter, WaitsWhereTheWriteBeforeIsNotDone)
{
    std::string log;
    Gate gate;
    BackgroundWriter writer;
    writer.add(gate.job(log, "first "));
    writer.start();
    std::atomic<bool> second = false;
    writer.add([&] { second = true; });
    std::thread disk([&]
    {
        std::this_thread::sleep_for(50ms);
        EXPECT_FALSE(second);                   // one at a time
        gate.opened.set_value();
    });
    writer.start();
    EXPECT_EQ(log, "first ");
    EXPECT_GT(writer.waited(), 0.03);           // of 50 ms, less what the threads' start took
    writer.finish();
    EXPECT_TRUE(second);
    disk.join();
}

TEST(BackgroundWriter, ThrowsWhatAJobThrewAndLeavesOutTheRestOfThatWrite)
{
    std::string log;
    BackgroundWriter writer;
    writer.add([&] { log += "fields "; });
    writer.add(failing("Cannot write: disk full"));
    writer.add([&] { log += "table "; });
    writer.start();
    EXPECT_EQ(messageOf<FatalError>([&] { writer.finish(); }), "Cannot write: disk full");
    EXPECT_EQ(log, "fields ");

    // The same by the next start(), at the latest by one that has something to write.
    writer.add(failing("once more"));
    writer.start();
    writer.add([&] { log += "later"; });
    EXPECT_EQ(messageOf<FatalError>([&] { writer.start(); }), "once more");
    writer.finish();
    EXPECT_EQ(log, "fields ");
}

TEST(BackgroundWriter, FinishesWhenItIsLeftByAnException)
{
    const ScratchFolder folder;
    const auto file = folder.path() / "U";
    EXPECT_THROW
    (
        {
            BackgroundWriter writer;
            writer.add([&] { writeAtomically(file, [](std::ostream& stream) { stream << "whole"; }); });
            writer.start();
            writer.add([&] { writeAtomically(folder.path() / "table", [](std::ostream& stream) { stream << "too"; }); });
            throw FatalError("diverged");
        },
        FatalError
    );
    EXPECT_EQ(folder.read("U"), "whole");
    EXPECT_EQ(folder.read("table"), "too");
}

TEST(BackgroundWriter, SaysWhatWentWrongWhenNobodyAsksAnyMore)
{
    testing::internal::CaptureStderr();
    {
        BackgroundWriter writer;
        writer.add(failing("Cannot write: disk full"));
    }
    EXPECT_TRUE(holds(testing::internal::GetCapturedStderr(), {"Cannot write: disk full"}));
}
