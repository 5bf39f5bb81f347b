// SPDX-License-Identifier: GPL-3.0-or-later
// Dictionaries that are edited while the solver runs.

#include "SolverCase.H"

#include "core/fieldFile/FieldFile.H"
#include "support/Process.H"

#include <array>
#include <cmath>
#include <sstream>

namespace shizuku::test
{

namespace
{

constexpr double deltaT = 1e-3;         // s

class Changes : public SolverCase
{
protected:
    Changes() { begin("runTimeModifiable yes;"); }

    // A run of a minute's simulated time, unless something stops it.
    void begin(const std::string& more) const { control(frame + "endTime 60; " + more); }

    // Edits while the solver stands still after some steps, waits until the log holds `answer`, and stops it. Returns the log.
    std::string editedRun(const std::function<void()>& edit, const std::string& answer, const std::string& stop = "writeNow") const
    {
        std::filesystem::remove(folder_.path()/"log");          // of a run before, which would be taken for this one's
        Process process(command("pbfDroplet", ""), folder_.path()/"log");
        const auto steps = [&] { return stepsOf(process.log()).size(); };
        EXPECT_TRUE(process.runUntil([&] { return steps() > 2; })) << process.log();
        process.pause();
        edit();
        process.resume();
        EXPECT_TRUE(process.runUntil([&] { return process.log().find(answer) != std::string::npos; })) << process.log();
        const std::size_t then = steps();
        EXPECT_TRUE(process.runUntil([&] { return steps() > then + 2; })) << process.log();
        begin("runTimeModifiable yes; stopAt " + stop + ";");
        EXPECT_EQ(process.wait(), 0) << process.log();
        return process.log();
    }

    static std::size_t stepsBefore(const std::string& log, const std::string& text)
    {
        return stepsOf(log.substr(0, log.find(text))).size();
    }

    // The folder of the last time, its name aside.
    Contents liquidAfter(std::size_t steps) const { return contents(timeAfter(steps) + "/liquid"); }

    static std::string timeAfter(std::size_t steps)
    {
        std::ostringstream name;
        name << deltaT*double(steps);
        return name.str();
    }

    FieldData thetaOf(const std::string& time) const
    {
        return readField(path()/time/"solid/theta", FieldType::scalar, dimensions::none);
    }

    void solveTo(std::size_t steps) const
    {
        control(frame + "endTime " + std::to_string(deltaT*double(steps)) + ";");
        const Outcome outcome = solve();
        ASSERT_EQ(outcome.status, 0) << outcome.text;
    }

    const std::string frame = "writeInterval 1000000; writeFormat binary; ";
    const std::string made = "the models were made anew";
};

INSTANTIATE_TEST_SUITE_P(Devices, Changes, testing::ValuesIn(devices()));

}

// sigma, gravity, theta of the analytic and of the sampled wall at once: the run goes on as one that is restarted with them.
TEST_P(Changes, ActAsARestartWithThemWould)
{
    const std::string theta = read("0/solid/theta");
    const auto edit = [&]
    {
        write("constant/liquidProperties", "rho 998;\nnu 1e-6;\nsigma 0.2;\n");
        write("constant/g", "value (0 3 -2);\n");
        write("constant/wettability", "floor { theta 120; }\nside { theta 30; }\n");
    };
    const std::string log = editedRun(edit, made);
    EXPECT_TRUE(holds
    (
        log,
        {
            "constant/liquidProperties: sigma: 0.0728 -> 0.2\n", "constant/g: value: (0 0 -9.81) -> (0 3 -2)\n",
            "constant/wettability: floor.theta: 60 -> 120\n", "constant/wettability: side.theta: 90 -> 30\n",
            "solid/theta: 60 -> 120 degrees\n"
        }
    ));
    const std::size_t before = stepsBefore(log, made), all = stepsOf(log).size();
    ASSERT_GE(before, 3u);
    ASSERT_GE(all, before + 3);
    const Contents live = liquidAfter(all);
    EXPECT_EQ(live.size(), 4u);             // positions, U, densityRatio, id
    // What the run started with stays; the time that it wrote has the new angles.
    EXPECT_EQ(read("0/solid/theta"), theta);
    const FieldData written = thetaOf(timeAfter(all));
    EXPECT_GT(written.elements(), 0u);
    for (std::size_t i = 0; i < written.elements(); ++i) ASSERT_EQ(written(i), 120) << i;

    // The same in two runs, and theta by sampleTheta.
    removeResults();
    write("constant/liquidProperties", "rho 998;\nnu 1e-6;\nsigma 0.0728;\n");
    write("constant/g", "value (0 0 -9.81);\n");
    write("constant/wettability", "floor { theta 60; }\nside { theta 90; }\n");
    write("0/solid/theta", theta);
    solveTo(before);
    edit();
    ASSERT_EQ(run(program("sampleTheta") + " -case " + path().string()).status, 0);
    EXPECT_EQ(thetaOf("0")(0), 120);
    solveTo(all);
    EXPECT_TRUE(same(live, liquidAfter(all)));
    EXPECT_FALSE(std::filesystem::exists(path()/timeAfter(all)/"solid"));        // where nothing changed in the run

    // And not because nothing has changed.
    removeResults();
    write("constant/liquidProperties", "rho 998;\nnu 1e-6;\nsigma 0.0728;\n");
    solveTo(all);
    EXPECT_FALSE(same(live, liquidAfter(all)));
}

TEST_P(Changes, OfSolidThetaBySampleTheta)
{
    const std::string log = editedRun
    (
        [&]
        {
            std::string theta = read("0/solid/theta");
            for (std::size_t at; (at = theta.find("\n60\n")) != std::string::npos;) theta.replace(at, 4, "\n75\n");
            write("0/solid/theta", theta);
        },
        made
    );
    EXPECT_TRUE(holds(log, {"solid/theta: 60 -> 75 degrees"}));
}

// Angles that were changed in a run stay when something else is changed, and go on with a run from its last time; sampleTheta tells of them.
TEST_P(Changes, OfAnglesOutlastOtherChangesAndTheRun)
{
    begin("runTimeModifiable yes;");
    Process process(command("pbfDroplet", ""), folder_.path()/"log");
    const auto answered = [&](const std::string& answer)
    {
        return process.runUntil([&] { return process.log().find(answer) != std::string::npos; });
    };
    ASSERT_TRUE(process.runUntil([&] { return stepsOf(process.log()).size() > 2; })) << process.log();
    write("constant/wettability", "floor { theta 120; }\nside { theta 90; }\n");
    ASSERT_TRUE(answered("solid/theta: 60 -> 120 degrees")) << process.log();
    write("constant/g", "value (0 0 -5);\n");
    ASSERT_TRUE(answered("(0 0 -9.81) -> (0 0 -5)")) << process.log();
    begin("runTimeModifiable yes; stopAt writeNow;");
    ASSERT_EQ(process.wait(), 0) << process.log();
    EXPECT_EQ(process.log().find("120 -> 60"), std::string::npos);
    const std::size_t all = stepsOf(process.log()).size();
    EXPECT_EQ(thetaOf(timeAfter(all))(0), 120);
    EXPECT_EQ(thetaOf("0")(0), 60);

    control(frame + "startFrom latestTime; endTime " + std::to_string(deltaT*double(all + 2)) + ";");
    const Outcome further = solve();
    EXPECT_EQ(further.status, 0) << further.text;
    EXPECT_EQ(further.text.find("other contact angles"), std::string::npos) << further.text;
    const Outcome sampled = run(program("sampleTheta") + " -case " + path().string());
    EXPECT_EQ(sampled.status, 0);
    EXPECT_TRUE(holds(sampled.text, {"WARNING: Later times hold contact angles of their own", timeAfter(all)})) << sampled.text;
}

// Rain sets in: the run goes on as one that is restarted with it. Where it falls does not change.
TEST_P(Changes, OfSourcesAreHowFastLiquidComesIn)
{
    const auto rain = [&](const std::string& rate, const std::string& height = "0.015")
    {
        write("constant/sources", "shower { type rain; rate " + rate + "; corner (2e-3 -6e-3 " + height + "); along (0.01 0 0); across (0 0.012 0); direction (0 0 -1); speed 0.5; sizes { type oneSize; diameter 3e-3; } }\n");
    };
    rain("0");
    const std::string log = editedRun([&] { rain("0.2"); }, made);
    EXPECT_TRUE(holds(log, {"constant/sources: shower.rate: 0 -> 0.2\n", "entered: shower 14 particles"}));
    const std::size_t before = stepsBefore(log, made), all = stepsOf(log).size();
    const Contents live = contents(timeAfter(all));
    removeResults();
    rain("0");
    solveTo(before);
    rain("0.2");
    solveTo(all);
    EXPECT_TRUE(same(live, contents(timeAfter(all))));

    removeResults();
    begin("runTimeModifiable yes;");
    const std::string refused = editedRun([&] { rain("0.2", "0.02"); }, "is left out");
    EXPECT_TRUE(holds(refused, {"Entry 'shower.corner' was changed", "of sources a run follows flowRate, velocity, rate, speed and level alone"}));
}

// An edit that was left out because another file was wrong acts once that one is mended.
TEST_P(Changes, WaitForAnotherFileToBeMended)
{
    begin("runTimeModifiable yes;");
    Process process(command("pbfDroplet", ""), folder_.path()/"log");
    const auto answered = [&](const std::string& answer)
    {
        return process.runUntil([&] { return process.log().find(answer) != std::string::npos; });
    };
    ASSERT_TRUE(process.runUntil([&] { return stepsOf(process.log()).size() > 2; })) << process.log();
    write("constant/g", "value (0 0 fast);\n");
    ASSERT_TRUE(answered("The change of constant/g is left out")) << process.log();
    write("constant/wettability", "floor { theta 120; }\nside { theta 90; }\n");
    ASSERT_TRUE(answered("The change of constant/wettability is left out")) << process.log();
    write("constant/g", "value (0 0 -5);\n");
    ASSERT_TRUE(answered(made)) << process.log();
    begin("runTimeModifiable yes; stopAt writeNow;");
    ASSERT_EQ(process.wait(), 0) << process.log();
    EXPECT_TRUE(holds
    (
        process.log(),
        {"constant/g: value: (0 0 -9.81) -> (0 0 -5)\n", "floor.theta: 60 -> 120\n", "solid/theta: 60 -> 120 degrees\n"}
    )) << process.log();
    EXPECT_EQ(thetaOf(timeAfter(stepsOf(process.log()).size()))(0), 120);
}

// A wrong edit is left out, each with its reason: the run ends as one that nobody touched.
TEST_P(Changes, ThatAreWrongAreLeftOut)
{
    const std::pair<const char*, std::pair<std::string, std::string>> edits[] =
    {
        {"constant/liquidProperties", {"rho 998;\nnu 1e-6;\nsig", "the former values stay in force"}},
        {"constant/liquidProperties", {"rho 998;\nnu 1e-6;\nsigma -1;\n", "'sigma' is -1"}},
        {"constant/liquidProperties", {"rho 1200;\nnu 1e-6;\nsigma 0.07;\n", "'rho' was changed from 998 to 1200"}},
        {"system/solution", {"spacing 2e-3;\npressure { maxIterations 6; }\n", "'spacing' was changed from 1e-3 to 2e-3"}},
        {"constant/wettability", {"floor { theta 75; }\nside { the", "Unclosed '{'"}},
        {"constant/wettability", {"floor { theta 200; }\nside { theta 90; }\n", "is 200"}},
        {
            "constant/models",
            {
                "pressure pbf;\nsurfaceTension Fujsawa;\nwetting contactAngle;\nviscosity XSPH;\nbodyForce gravity;\n",
                "Unknown surfaceTension model 'Fujsawa'"
            }
        },
        {"constant/g", {"value (0 0 fast);\n", "the word 'fast'"}}
    };
    // What reads a prescribed angle while the solver runs is not led astray either.
    begin("runTimeModifiable yes; functions { angle { type contactAngle; wall side; } }");
    const std::string theta = read("0/solid/theta");
    Process process(command("pbfDroplet", ""), folder_.path()/"log");
    ASSERT_TRUE(process.runUntil([&] { return stepsOf(process.log()).size() > 1; })) << process.log();
    for (const auto& [file, textAndAnswer] : edits)
    {
        const std::string good = read(file);
        const auto& text = textAndAnswer.first;
        const auto& answer = textAndAnswer.second;
        // At once, as an editor does.
        write(std::string(file) + ".new", text);
        std::filesystem::rename(path()/(std::string(file) + ".new"), path()/file);
        ASSERT_TRUE(process.runUntil([&] { return holds(process.log(), {answer, "is left out"}); })) << file << process.log();
        write(std::string(file) + ".new", good);
        std::filesystem::rename(path()/(std::string(file) + ".new"), path()/file);
    }
    begin("runTimeModifiable yes; stopAt writeNow;");
    ASSERT_EQ(process.wait(), 0) << process.log();
    EXPECT_EQ(read("0/solid/theta"), theta);
    const std::size_t all = stepsOf(process.log()).size();
    const Contents live = liquidAfter(all);
    EXPECT_EQ(live.size(), 4u);
    removeResults();
    solveTo(all);
    EXPECT_TRUE(same(live, liquidAfter(all)));
}

TEST_P(Changes, OfControlDictAreNamed)
{
    const std::string log = editedRun
    (
        [&] { begin("runTimeModifiable yes; maxCo 0.25; functions { size { type volume; } }"); }, "maxCo", "noWriteNow"
    );
    EXPECT_TRUE(holds
    (
        log,
        {
            "system/controlDict anew", "    maxCo: absent -> 0.25\n",
            "    functions.size.type: absent -> volume   (acts at the next start)\n", "    stopAt: absent -> noWriteNow\n"
        }
    ));
    EXPECT_EQ(folder_.list("case"), (std::vector<std::string>{"0", "constant", "system"}));
}

TEST_P(Changes, OfTheEndTimeEndTheRun)
{
    Process process(command("pbfDroplet", ""), folder_.path()/"log");
    ASSERT_TRUE(process.runUntil([&] { return stepsOf(process.log()).size() > 2; })) << process.log();
    process.pause();
    const std::size_t end = stepsOf(process.log()).size() + 20;
    control(frame + "runTimeModifiable yes; endTime " + std::to_string(deltaT*double(end)) + ";");
    process.resume();
    ASSERT_EQ(process.wait(), 0) << process.log();
    EXPECT_TRUE(holds(process.log(), {"system/controlDict anew", "    endTime: 60 -> "}));
    EXPECT_EQ(stepsOf(process.log()).size(), end);
    EXPECT_EQ(liquidAfter(end).size(), 4u);
}

TEST_P(Changes, NextWriteStopsWithTheNextWrite)
{
    const std::string log = editedRun([&] { begin("runTimeModifiable yes; writeInterval 40;"); }, "writeInterval", "nextWrite; writeInterval 40");
    const std::size_t all = stepsOf(log).size();
    EXPECT_EQ(all % 40, 0u);
    EXPECT_EQ(liquidAfter(all).size(), 4u);
    // No step behind the write that was next when the change came.
    EXPECT_LE(all - stepsBefore(log, "nextWrite"), 40u);
}

TEST_P(Changes, AreIgnoredUnlessTheyAreAllowed)
{
    begin("endTime 0.03;");
    Process process(command("pbfDroplet", ""), folder_.path()/"log");
    ASSERT_TRUE(process.runUntil([&] { return stepsOf(process.log()).size() > 2; })) << process.log();
    write("constant/g", "value (0 0 fast);\n");
    ASSERT_EQ(process.wait(), 0) << process.log();
    EXPECT_EQ(process.log().find("left out"), std::string::npos);
    EXPECT_EQ(stepsOf(process.log()).size(), 30u);
}

// Pressure at a probe goes on being kept by the model that was made anew.
TEST_P(Changes, LeaveProbesTheirPressure)
{
    begin("runTimeModifiable yes; functions { gauges { type probes; fields (p); probeLocations ((0 0 2e-3)); } }");
    const std::string log = editedRun([&] { write("constant/g", "value (0 0 -5);\n"); }, made);
    std::istringstream table(read("postProcessing/gauges/0/probes.csv"));
    std::string line;
    std::getline(table, line);
    std::size_t rows = 0;
    for (; std::getline(table, line); ++rows) EXPECT_EQ(line.find("nan"), std::string::npos) << line;
    EXPECT_EQ(rows, stepsOf(log).size());
}

// What a body that the liquid moves is edited to acts from where it is, and gravity as well. Far above the liquid nothing else moves it.
TEST_P(Changes, OfABodyActFromWhereItIs)
{
    const auto walls = [&](const std::string& motion)
    {
        write("constant/walls", "floor { type plane; point (0 0 0); normal (0 0 1); }\nball { type sphere; centre (0 0 9); radius 2e-3; liquid outside;\nmotion { " + motion + " } }\n");
    };
    const std::string of = "type sixDoF; centreOfMass (0 0 9); mass 1e-5; momentOfInertia 1.6e-11; ", usual = of + "velocity (0.1 0 0);";
    dropBall();
    // The rows of its state: vx and vz of the last three, which are behind the edit.
    const auto lastRows = [&]
    {
        std::istringstream table(read("postProcessing/body/0/sixDoFRigidBodyState.csv"));
        std::vector<std::array<double, 2>> rows;
        std::string line;
        std::getline(table, line);
        while (std::getline(table, line))
        {
            std::istringstream columns(line);
            std::array<double, 7> numbers{};
            char comma;
            for (double& number : numbers) columns >> number >> comma;
            rows.push_back({numbers[4], numbers[6]});
        }
        rows.erase(rows.begin(), rows.end() - 3);
        return rows;
    };
    const std::string function = "functions { body { type sixDoFRigidBodyState; } }";
    const auto edited = [&](const std::function<void()>& edit, const std::string& answer)
    {
        removeResults();
        remove("postProcessing");
        write("constant/g", "value (0 0 -9.81);\n");
        walls(usual);
        begin("runTimeModifiable yes; " + function);
        return editedRun(edit, answer, "writeNow; " + function);
    };
    edited([&] { write("constant/g", "value (0 0 0);\n"); }, made);
    auto rows = lastRows();
    EXPECT_LT(rows[2][1], -1e-2);
    EXPECT_EQ(rows[2][1], rows[0][1]);              // it falls no faster
    EXPECT_EQ(rows[2][0], 0.1);
    edited([&] { walls(usual + "translations (y); rotations ();"); }, made);
    rows = lastRows();
    EXPECT_EQ(rows[2][0], 0);
    EXPECT_EQ(rows[2][1], 0);                       // it is held where it is
    const std::string log = edited([&] { walls(of + "velocity (0.2 0 0);"); }, "is left out, the former values stay in force");
    EXPECT_NE(log.find("its velocity was changed, which is that of its start"), std::string::npos) << log;
    rows = lastRows();
    EXPECT_LT(rows[2][1], rows[0][1]);              // and it goes on falling
}

}
