// SPDX-License-Identifier: GPL-3.0-or-later
// SIGINT and SIGTERM end a run after the present step, with all written.

#include "SolverCase.H"

#include <algorithm>
#include <chrono>
#include <thread>
#include <csignal>

namespace shizuku::test
{

namespace
{

class Signals : public SolverCase
{
protected:
    static inline const std::string endless = "endTime 10; writeInterval 100000; functions { drop { type liquidState; } }";

    std::string lastTime() const
    {
        std::string last = "0";
        for (const std::string& name : folder_.list("case"))
        {
            if (name.starts_with("0.") && std::stod(name) > std::stod(last)) last = name;
        }
        return last;
    }
};

INSTANTIATE_TEST_SUITE_P(Devices, Signals, testing::ValuesIn(devices()));

}

TEST_P(Signals, EndTheRunAfterTheStepWithALastWrite)
{
    for (const auto& [signal, name] : {std::pair{SIGINT, std::string("SIGINT")}, {SIGTERM, "SIGTERM"}})
    {
        SCOPED_TRACE(name);
        control(endless);
        Process process(command("pbfDroplet", ""), folder_.path()/name);
        ASSERT_TRUE(process.runUntil([&] { return process.log().find("Time = 0.003 s") != std::string::npos; })) << process.log();
        EXPECT_EQ(process.end(signal), 128 + signal) << process.log();
        const std::string log = process.log();
        EXPECT_TRUE(holds(log, {"The present step is the last. " + name + " came", "pbfDroplet: stopped by " + name + "\n"}));
        EXPECT_EQ(log.find("\nEnd\n"), std::string::npos) << log;

        // It is the step that the log had last, with a row for each step.
        const std::string last = lastTime();
        const std::vector<LoggedStep> steps = stepsOf(log);
        ASSERT_GE(steps.size(), 3u);
        EXPECT_EQ(std::stod(last), steps.back().time);
        const std::string table = read("postProcessing/drop/0/liquidState.csv");
        EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), long(steps.size()) + 1);

        // The state is that of a run that was to end there.
        const Contents stopped = contents(last);
        removeResults();
        control(endless + " endTime " + last + ";");
        const Outcome outcome = solve();
        ASSERT_EQ(outcome.status, 0) << outcome.text;
        EXPECT_TRUE(same(stopped, contents(last)));
        removeResults();
    }
}

// In the middle of a step that takes minutes.
TEST_P(Signals, ASecondOneEndsTheRunAtOnce)
{
    control(endless + " maxCapillaryCo 1e-6; maxSubSteps 1000000000; maxCo 1e-3;");
    Process process(command("pbfDroplet", ""), folder_.path()/"log");
    ASSERT_TRUE(process.runUntil([&] { return process.log().find("Ready for the first step") != std::string::npos; })) << process.log();
    process.send(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));        // which of two at once is the second nobody knows
    EXPECT_EQ(process.end(SIGTERM), 128 + SIGTERM) << process.log();
    EXPECT_EQ(lastTime(), "0");
}

TEST_P(Signals, OnesThatAreIgnoredStaySo)
{
    control("endTime 0.02; writeInterval 20;");
    Process process("env --ignore-signal=INT " + command("pbfDroplet", ""), folder_.path()/"log");
    ASSERT_TRUE(process.runUntil([&] { return process.log().find("Ready for the first step") != std::string::npos; })) << process.log();
    EXPECT_EQ(process.end(SIGINT), 0) << process.log();
    EXPECT_EQ(lastTime(), "0.02");
}

}
