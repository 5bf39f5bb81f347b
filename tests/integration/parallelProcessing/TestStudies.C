// SPDX-License-Identifier: GPL-3.0-or-later
// speedAccuracy and stabilityMap on cases whose commands are short scripts: records, resuming, deaths, charts, refusals.

#include "core/fieldFile/CsvTable.H"
#include "support/Process.H"
#include "support/Programs.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>

namespace shizuku::test
{

namespace
{

namespace fs = std::filesystem;

// A run of n particles: ten steps of 0.1 s that take n ms each, an error of 8/n degrees.
const std::string allrun = R"(#!/bin/sh
echo ran >>"@ledger@"
@before@
mkdir -p postProcessing/timing/0 postProcessing/compareReference
{ echo 'Shizuku 0.4.0-abc, Nov 26 2026 10:00:00, host there, PID 1'; echo; echo 'Device : cuda, Some card, 80 GiB'
echo 'Liquid particles @n@, solid'
for i in 1 2 3 4 5; do
    printf 'Time = 0.%d s  (20 %%)\ndeltaT = 0.05 s, 2 sub-steps, limited by capillary\nExecutionTime = %d s  ClockTime = 9 s\n' $i $((i*@n@))
done; echo 'ExecutionTime = 999 s  ClockTime = 999 s'; } >log.pbfDroplet
{ echo 'time [s],wall [ms]'; for i in 1 2 3 4 5; do echo 0.$i,@n@; done; } >postProcessing/timing/0/stepTime.csv
{ echo 'comparison,quantity,unit,reference,measured,deviation,deviationUnit,target,verdict'
echo "angle,contact angle,deg,60,60,$(awk 'BEGIN { print -8/@n@ }'),deg,3,pass"
echo 'stability,particles that are no numbers,,0,0,0,,nan,-'
echo 'stability,rms speed over capillary speed,,0,@speed@,0,,nan,-'
echo 'stability,stray particles,%,0,0,0,%,nan,-'
echo 'stability,particles behind the walls,%,0,0,0,%,nan,-'
echo 'stability,distance to the nearest,spacings,1,1,0,spacings,nan,-'
echo 'stability,volume of the particles,m3,1,1,0,%,nan,-'
} >postProcessing/compareReference/comparison.csv
)";

const std::string error = "error { comparison angle; quantity \"contact angle\"; label \"error\"; least 0.01; }\n"
                          "cost wallTime;\nseries n;\n";

class Studies : public testing::Test
{
protected:
    Studies()
    {
        unsetenv("CUDA_VISIBLE_DEVICES");
        folder_.write("base/system/controlDict", "application pbfDroplet;\n");
        folder_.write("base/Allrun", allrun);
        fs::permissions(folder_.path()/"base/Allrun", fs::perms::owner_all);
        folder_.write("values", "n 1;\nspeed 0;\nbefore \":\";\nledger \"" + (folder_.path()/"ledger").string() + "\";\n");
    }

    void writeStudy(const std::string& axes, const std::string& rest) const
    {
        folder_.write("studyDict", "case\n{\n    layers (\"base\");\n    valuesFile \"values\";\n}\naxes { " + axes + " }\n" + rest);
    }
    std::string command(const std::string& tool, const std::string& options = "-jobs 2") const
    {
        return program(tool) + " " + folder_.path().string() + " -output " + (folder_.path()/"out").string() + " -device cpu " + options;
    }
    Outcome call(const std::string& tool, const std::string& options = "-jobs 2") const { return run("(" + command(tool, options) + ")"); }
    CsvTable table(const std::string& name) const { return CsvTable::read(folder_.path()/"out"/name); }
    std::string ran() const { return folder_.read("ledger"); }

    ScratchFolder folder_;
};

TEST_F(Studies, MeasuresErrorAndCostAndMarksTheFront)
{
    writeStudy("n (4 8); speed (0 1);", error);
    folder_.write("references.csv", "source,cost [s/s],error [deg]\nother,1000,4\n");
    folder_.write("studyDict", folder_.read("studyDict") + "references \"references.csv\";\ntimeLimit 100;\n");
    const Outcome outcome = call("speedAccuracy");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const CsvTable runs = table("runs.csv");
    ASSERT_EQ(runs.rows(), 4u);
    EXPECT_EQ(runs.number(3, "error"), 1);                      // 8/8
    EXPECT_DOUBLE_EQ(runs.number(3, "wallTime"), 0.08);         // four steps of 8 ms over 0.4 s
    EXPECT_NEAR(runs.number(3, "cpuTime"), 80, 1e-6);           // 8 s of 0.1 s each
    EXPECT_EQ(runs.number(3, "particleSteps"), 160);            // 8 particles, a sub-step of 0.05 s
    EXPECT_EQ(runs.text(3, "end"), "finished");
    const CsvTable points = table("speedAccuracy.csv");
    ASSERT_EQ(points.rows(), 5u);
    EXPECT_EQ(points.text(4, "source"), "other");
    EXPECT_EQ(points.text(0, "front") + points.text(3, "front"), "yesyes");      // slower and more exact both stand
    EXPECT_TRUE(holds(outcome.text, {"Pareto front (n, speed, cost, error)", "4 0: 0.04, 2"}));
    EXPECT_TRUE(holds(folder_.read("out/runs/8-0/study.json"), {"\"n\": \"8\"", "\"end\": \"finished\"", "\"error\": \"1\""}));
    EXPECT_TRUE(holds(folder_.read("out/speedAccuracy.gnuplot"), {"set logscale xy", "0.08 1", "1000 4 \"other\""}));
    if (run("command -v gnuplot").status == 0)
    {
        EXPECT_EQ(folder_.read("out/speedAccuracy.png").substr(1, 3), "PNG");
        EXPECT_TRUE(holds(folder_.read("out/speedAccuracy.svg"), {"<svg", "front", "0.4.0-abc; Some card; Nov 26 2026"}));
    }
}

TEST_F(Studies, CombinesTheRunsOfAPoint)
{
    writeStudy("n (2 4); speed (0 1);", "error { comparison angle; quantity \"contact angle\"; label e; least 1; over (n); combine worst; }\n"
                                        "cost particleSteps;\nseries speed;\n");
    ASSERT_EQ(call("speedAccuracy").status, 0);
    const CsvTable points = table("speedAccuracy.csv");
    ASSERT_EQ(points.rows(), 2u);
    EXPECT_EQ(points.number(0, "error"), 4);                    // the worse of 4 and 2
    EXPECT_EQ(points.number(0, "cost"), 60);                    // mean of 40 and 80
}

// A line goes through the setting that has all points, and of those the one that is better for its cost; repeats are one point, with its spread.
TEST_F(Studies, DrawsALineOfTheBestSettingAndHowRepeatsSpread)
{
    writeStudy
    (
        "n (2 4 8); speed (0 1); dear { no { } yes { values { before \"true\"; } } }",
        "error { comparison angle; quantity \"contact angle\"; label e; least 1; repeats (dear); }\ncost particleSteps;\nseries speed;\nalong n;\n"
    );
    ASSERT_EQ(call("speedAccuracy").status, 0);
    const CsvTable points = table("speedAccuracy.csv");
    ASSERT_EQ(points.rows(), 6u);                               // n and speed
    for (std::size_t row = 0; row < points.rows(); ++row)
    {
        EXPECT_EQ(points.number(row, "runs"), 2);
        EXPECT_EQ(points.text(row, "line"), "yes");             // each series has but one setting
        EXPECT_EQ(points.number(row, "errorFrom"), points.number(row, "error"));
        EXPECT_EQ(points.number(row, "errorTo"), points.number(row, "error"));
    }
    EXPECT_TRUE(holds(folder_.read("out/speedAccuracy.gnuplot"), {"yerrorbars", "linespoints", "\"8\""}));
}

TEST_F(Studies, ADeathIsRecordedWithItsReasonAndLosesNoOther)
{
    writeStudy
    (
        "how { good { values { n 8; } } dies { values { before \"echo '--> FATAL ERROR:'; echo The liquid is gone from `pwd`/0; exit 1\"; } } "
        "hangs { values { before \"sleep 60\"; } } killed { values { before \"kill -9 $$\"; } } "
        "silent { values { before \"exit 0\"; } } }",
        "error { comparison angle; quantity \"contact angle\"; label e; least 1; }\ncost wallTime;\nseries how;\ntimeLimit 1;\n"
    );
    Outcome outcome = call("speedAccuracy", "-jobs 5");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    CsvTable runs = table("runs.csv");
    EXPECT_EQ(runs.number(0, "error"), 1);
    EXPECT_EQ(runs.text(1, "end") + ": " + runs.text(1, "reason"), "died: The liquid is gone from 0");
    EXPECT_EQ(runs.text(2, "reason"), "Stopped after 1 s; the limit of its time");
    EXPECT_EQ(runs.text(3, "reason"), "ended by signal 9");
    EXPECT_EQ(runs.text(4, "end"), "unmeasured");
    EXPECT_TRUE(holds(outcome.text, {"No result: dies, died: The liquid is gone from 0"}));

    // What has ended is not run again, unless that is asked for.
    const std::string before = ran();
    ASSERT_EQ(call("speedAccuracy", "-jobs 5").status, 0);
    EXPECT_EQ(ran(), before);
    outcome = call("speedAccuracy", "-jobs 5 -retry");
    EXPECT_EQ(ran().size(), before.size() + 3*4) << outcome.text;       // "ran\n" of the three that died
}

TEST_F(Studies, GoesOnAfterAKillAndRunsAnewWhatHasChanged)
{
    writeStudy("n (1 2 3);", error);
    folder_.write("base/Allrun", std::string(allrun).replace(allrun.find("@before@"), 8, "test @n@ != 2 || test -e ../../../go || { echo $$ >../../../id; exec sleep 60; }"));
    folder_.write("values", "n 1;\nspeed 0;\nledger \"" + (folder_.path()/"ledger").string() + "\";\n");
    Process process(command("speedAccuracy", "-jobs 1"), folder_.path()/"log");
    ASSERT_TRUE(process.runUntil([&] { return folder_.read("id").size() > 1; })) << process.log();
    EXPECT_EQ(process.end(SIGKILL), 128 + SIGKILL);
    EXPECT_EQ(ran(), "ran\nran\n");
    EXPECT_EQ(table("runs.csv").text(0, "end") + table("runs.csv").text(1, "end"), "finishednot run");

    // Its case has ended with it, and is run anew.
    folder_.write("go", "");
    run("until flock -n " + (folder_.path()/"out/runs/2/log.runCases").string() + " true; do sleep 0.02; done");
    const Outcome outcome = call("speedAccuracy", "-jobs 1");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"of which ended before 1"}));
    EXPECT_EQ(ran(), "ran\nran\nran\nran\n") << outcome.text;           // 1, 2 cut off, 3, 2 anew
    EXPECT_EQ(table("runs.csv").text(1, "end"), "finished");

    writeStudy("n (1 2 3 4);", error);          // one more
    ASSERT_EQ(call("speedAccuracy", "-jobs 1").status, 0);
    EXPECT_EQ(ran().size(), 5*4u);
    folder_.write("base/system/controlDict", "application pbfDroplet;\nendTime 1;\n");
    ASSERT_EQ(call("speedAccuracy", "-jobs 1").status, 0);
    EXPECT_EQ(ran().size(), 9*4u);              // another case: all anew
}

TEST_F(Studies, DrawsAMapOfClasses)
{
    writeStudy
    (
        "n (1 2); speed (0.001 0.5 50);",
        "map { x speed; y n; xLabel speed; }\ntitle \"a map\";\n"
    );
    const Outcome outcome = call("stabilityMap");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const CsvTable runs = table("runs.csv");
    EXPECT_EQ(runs.text(0, "class") + runs.text(1, "class") + runs.text(2, "class"), "calmnoisyexploded");
    EXPECT_TRUE(holds(folder_.read("out/stabilityMap.md"), {"| n | 0.001 | 0.5 | 50 |", "| 2 | calm | noisy | exploded |"}));
    EXPECT_TRUE(holds(folder_.read("out/stabilityMap.gnuplot"), {"\"noisy\" at 1,0", "\"0.5\" 1"}));
    if (run("command -v gnuplot").status == 0)
    {
        EXPECT_TRUE(holds(folder_.read("out/stabilityMap.svg"), {"exploded"}));
    }
}

TEST_F(Studies, RefusesBadInputBeforeAnythingRuns)
{
    const auto refused = [&](const std::string& tool, const std::string& axes, const std::string& rest, const std::vector<std::string>& parts)
    {
        writeStudy(axes, rest);
        const Outcome outcome = call(tool);
        EXPECT_EQ(outcome.status, 1) << rest;
        EXPECT_TRUE(holds(outcome.text, parts));
        EXPECT_EQ(ran(), "") << rest;
    };
    refused("speedAccuracy", "n ();", error, {"Axis 'n' has no choice", "the grid is empty", "studyDict at line 6"});
    refused("speedAccuracy", "m (1);", error, {"The case has no value 'm'", "Valid choices", "speed"});
    refused("speedAccuracy", "speed (1);", error, {"The study has no axis 'n'", "one of its axes", "speed"});
    refused("speedAccuracy", "n (1);", error + "costs wallTime;\n", {"costs", "studyDict at line 10"});
    refused("stabilityMap", "n (1); speed (1 2);", "map { x n; y n; }\n", {"The map shows no axis 'speed'"});
    const Outcome outcome = run("(" + program("speedAccuracy") + ")");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(holds(outcome.text, {"No study is given"}));
}

TEST_F(Studies, AnUnknownMeasureEndsTheStudyWithThoseThatAre)
{
    writeStudy("n (1 2);", "error { comparison angle; quantity \"contact angel\"; label e; least 1; }\ncost wallTime;\nseries n;\n");
    const Outcome outcome = call("speedAccuracy", "-jobs 1");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(holds(outcome.text, {"Unknown measure", "'contact angel'", "studyDict at line 7", "angle: contact angle"}));
    EXPECT_EQ(ran(), "ran\n");
}

}

}
