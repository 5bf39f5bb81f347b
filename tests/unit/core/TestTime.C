// SPDX-License-Identifier: GPL-3.0-or-later
#include "unit/core/TimedCase.H"

#include <bit>
#include <cmath>
#include <cstdint>

using namespace shizuku;
using namespace shizuku::test;
namespace fs = std::filesystem;

namespace
{

std::uint64_t bits(double value)
{
    return std::bit_cast<std::uint64_t>(value);
}

}

TEST(Time, DoesNotDriftOverAMillionSteps)
{
    const TimedCase folder("endTime 10; deltaT 1e-5; writeInterval 1000000;");
    Time time(folder.path());
    double largest = 0;
    for (long step = 1; step <= 1000000; ++step)
    {
        time.advance();
        largest = std::max(largest, std::abs(time.value() - static_cast<double>(step) / 1e5));
    }
    EXPECT_EQ(time.index(), 1000000);
    // Half a unit in the last place of 1e-5, times 1e6, is 8.5e-16; two roundings near 10 add 1.8e-15 at most.
    // A sum of a million additions would be off by 1e-10.
    EXPECT_LT(largest, 3e-15);
    EXPECT_EQ(time.name(), "10");
    EXPECT_FALSE(time.running());
}

TEST(Time, RestartsWithBitwiseTheSameTimesAndIndices)
{
    const std::string controls = "endTime 3; deltaT 0.07; writeControl runTime; writeInterval 0.5;";
    std::vector<std::pair<long, std::uint64_t>> whole, continued;
    const auto run = [](Time& time, long stopAfter, auto& steps)
    {
        while (time.running() && static_cast<long>(steps.size()) < stopAfter)
        {
            time.advance();
            steps.emplace_back(time.index(), bits(time.value()));
            if (time.writeDue()) time.writing([](const fs::path&) {})();
        }
    };
    Names wholeNames, continuedNames;
    {
        const TimedCase folder(controls);
        Time time(folder.path());
        run(time, 1000, whole);
        wholeNames = folder.list();
    }
    {
        const TimedCase folder(controls);
        Time first(folder.path());
        run(first, 20, continued);              // killed after 20 steps, behind the write at step 14
        Time second(folder.path());
        EXPECT_GT(second.index(), 0);
        EXPECT_LT(second.index(), 20);
        continued.resize(second.index());
        run(second, 1000, continued);
        continuedNames = folder.list();
    }
    EXPECT_EQ(whole.size(), 43u);               // 43*0.07 = 3.01 is the first time at or behind 3
    EXPECT_EQ(whole, continued);
    EXPECT_EQ(wholeNames, continuedNames);
}

TEST(Time, ADeltaTThatChangedStartsFromTheExactTime)
{
    const TimedCase folder("endTime 1; deltaT 0.1; writeInterval 3;");
    {
        Time time(folder.path());
        for (int i = 0; i < 3; ++i) time.advance();
        time.writing([](const fs::path&) {})();
    }
    folder.control("endTime 1; deltaT 0.05; writeInterval 3;");
    Time time(folder.path());
    EXPECT_EQ(time.index(), 3);
    EXPECT_EQ(bits(time.value()), bits(3 * 0.1));
    EXPECT_EQ(time.path().filename(), "0.3");
    time.advance();
    EXPECT_EQ(time.index(), 4);
    EXPECT_NEAR(time.value(), 0.35, 1e-16);     // within a unit in the last place (5.6e-17)
}

TEST(Time, WritesEveryFewSteps)
{
    EXPECT_EQ(TimedCase("endTime 1; deltaT 0.1; writeControl timeStep; writeInterval 4;").run(), (Names{"0.4", "0.8", "1"}));
}

TEST(Time, WritesAtMultiplesOfAnInterval)
{
    // 0.25 lies between the steps 0.2 and 0.3: ties go to the earlier.
    const std::string rest = "endTime 1; deltaT 0.1; writeInterval 0.25;";
    EXPECT_EQ(TimedCase("writeControl runTime; " + rest).run(), (Names{"0.2", "0.5", "0.7", "1"}));
    EXPECT_EQ
    (
        TimedCase("writeControl adjustableRunTime; endTime 0.6; deltaT 0.1; writeInterval 0.2;").run(),
        (Names{"0.2", "0.4", "0.6"})
    );
    EXPECT_TRUE
    (
        holds
        (
            TimedCase("writeControl adjustableRunTime;\n" + rest).error(),
            {"writeInterval is 2.5", "whole number of deltaT", "line 2"}
        )
    );
    // No interval is lost or written twice where steps and intervals coincide only now and then.
    const TimedCase folder("writeControl runTime; endTime 300; deltaT 0.1; writeInterval 0.3;");
    Time time(folder.path());
    int writes = 0;
    while (time.running())
    {
        time.advance();
        if (!time.writeDue()) continue;
        ++writes;
        EXPECT_EQ(time.index() % 3, 0) << time.index();
    }
    EXPECT_EQ(writes, 1000);
}

TEST(Time, WritesTheEndThatIsNoMultiple)
{
    EXPECT_EQ(TimedCase("endTime 0.25; deltaT 0.1; writeInterval 100;").run(), Names{"0.3"});
}

TEST(Time, WritesNothingWhereThatIsAsked)
{
    const TimedCase folder("writeControl none; endTime 1; deltaT 0.1;");
    EXPECT_EQ(folder.run(), Names());
    EXPECT_EQ(folder.list(), (Names{"0", "system"}));
    // An interval may stay; and there is no next write to stop at.
    EXPECT_EQ(TimedCase("writeControl none; stopAt nextWrite; " + tenSteps).run(), Names());
    EXPECT_TRUE(holds(TimedCase("writeControl nothing; " + tenSteps).error(), {"nothing", "none", "timeStep"}));
}

TEST(Time, StopsAsToldByStopAt)
{
    EXPECT_EQ(TimedCase("stopAt writeNow; " + tenSteps).run(), Names{"0.1"});
    EXPECT_EQ(TimedCase("stopAt noWriteNow; " + tenSteps).run(), Names());
    EXPECT_EQ(TimedCase("stopAt nextWrite; " + tenSteps).run(), Names{"0.5"});
}

TEST(Time, FoldersKeepTheWholeState)
{
    const TimedCase folder(tenSteps);
    folder.run();
    EXPECT_EQ(folder.list(), (Names{"0", "0.5", "1", "system"}));
    EXPECT_EQ(folder.read("0/liquid/positions"), "initial");
    EXPECT_TRUE
    (
        holds
        (
            folder.read("0.5/uniform/time"),
            {"index           5;", "deltaT          0.10000000000000001;", "location    \"0.5/uniform\""}
        )
    );
}

TEST(Time, PurgesWhatThisRunWrote)
{
    const TimedCase folder("purgeWrite 2; endTime 1; deltaT 0.1; writeInterval 2;");
    EXPECT_EQ(folder.run().size(), 5u);
    EXPECT_EQ(folder.list(), (Names{"0", "0.8", "1", "system"}));
    folder.control("purgeWrite 1; endTime 1.4; deltaT 0.1; writeInterval 2;");
    folder.run();
    EXPECT_EQ(folder.list(), (Names{"0", "0.8", "1", "1.4", "system"}));
}

TEST(Time, AFailedWriteLeavesTheFormerTimes)
{
    const TimedCase folder(tenSteps);
    Time time(folder.path());
    time.advance();
    const auto diverged = [](const fs::path&) { throw FatalError("diverged"); };
    EXPECT_EQ(messageOf<FatalError>([&] { time.writing(diverged)(); }), "diverged");
    EXPECT_EQ(folder.list(), (Names{"0", "system"}));
}

// Two processes of a run, of which one makes the folder and gives it its name; what is purged goes with it.
TEST(Time, AFolderThatSeveralFillAppearsWhole)
{
    const TimedCase folder("purgeWrite 1; " + tenSteps);
    Time time(folder.path()), other(folder.path(), false);
    const auto advanced = [&](const std::string& text)
    {
        time.advance();
        other.advance();
        const Time::SharedWriting own = time.sharedWriting(), others = other.sharedWriting();
        EXPECT_EQ(own.folder, others.folder);
        own.begin();
        EXPECT_EQ(folder.list(own.folder.filename().string()), Names{});
        fs::create_directory(others.folder / "liquid");
        EXPECT_FALSE(fs::exists(time.path())) << text;
        own.end();
    };
    advanced("first");
    EXPECT_EQ(folder.list(), (Names{"0", "0.1", "system"}));
    const std::string state = folder.read("0.1/uniform/time");
    EXPECT_EQ(other.lastWritten(), folder.path() / "0.1");
    advanced("second");
    EXPECT_EQ(folder.list(), (Names{"0", "0.2", "system"}));
    EXPECT_EQ(folder.list("0.2"), (Names{"liquid", "uniform"}));

    const TimedCase alone(tenSteps);
    Time one(alone.path());
    one.advance();
    one.writing([](const fs::path&) {})();
    EXPECT_EQ(state, alone.read("0.1/uniform/time"));
}

TEST(Time, NeverReplacesTheFolderItStartedFrom)
{
    const TimedCase folder(tenSteps);
    Time time(folder.path());
    EXPECT_FALSE(time.writeDue());
    EXPECT_TRUE(holds(messageOf<FatalError>([&] { time.writing([](const fs::path&) {})(); }), {"would replace"}));
    EXPECT_EQ(folder.read("0/liquid/positions"), "initial");
}

TEST(Time, RemovesWhatAKilledRunLeft)
{
    const TimedCase folder(tenSteps);
    folder.write(".0.5.partial/liquid/positions", "half");
    folder.write(".1e-05.old.partial/liquid/positions", "replaced");
    folder.write(".hidden/kept", "");
    folder.write(".backup.partial/kept", "");       // somebody's own
    Time time(folder.path());
    EXPECT_EQ(time.value(), 0);
    const Names before{".0.5.partial", ".1e-05.old.partial", ".backup.partial", ".hidden", "0", "system"};
    EXPECT_EQ(folder.list(), before);               // another run may be writing it
    time.advance();
    EXPECT_EQ(folder.list(), (Names{".backup.partial", ".hidden", "0", "system"}));
}

TEST(Time, StartsWhereItIsTold)
{
    const TimedCase folder(tenSteps);
    folder.run();
    folder.control("startFrom firstTime; " + tenSteps);
    EXPECT_EQ(Time(folder.path()).index(), 0);
    folder.control("startFrom startTime; startTime 0.5; " + tenSteps);
    EXPECT_EQ(Time(folder.path()).index(), 5);
    EXPECT_EQ(Time(folder.path()).startTime(), 0.5);
    folder.control("startFrom latestTime; " + tenSteps);
    EXPECT_EQ(Time(folder.path()).index(), 10);
    EXPECT_FALSE(Time(folder.path()).running());
    folder.control("startFrom startTime;\nstartTime 0.6;\n" + tenSteps);
    EXPECT_TRUE(holds(folder.error(), {"no folder of the startTime", "line 2", "0.5"}));
    folder.control("startFrom startTime;\n" + tenSteps);
    EXPECT_TRUE(holds(folder.error(), {"startTime"}));
}

TEST(Time, ARenamedFolderCountsByItsName)
{
    const TimedCase folder(tenSteps);
    folder.run();
    fs::remove_all(folder.path() / "0");
    fs::remove_all(folder.path() / "1");
    fs::rename(folder.path() / "0.5", folder.path() / "0");
    const Time time(folder.path());
    EXPECT_EQ(time.value(), 0);
    EXPECT_EQ(time.index(), 0);
}

TEST(Time, NamesAreAsLongAsTheyNeedToBe)
{
    const TimeNameFormat general{std::chars_format::general, 6};
    EXPECT_EQ(timeName(0, 0.1, general), "0");
    EXPECT_EQ(timeName(3 * 0.1, 0.1, general), "0.3");
    EXPECT_EQ(timeName(1e-5, 1e-5, general), "1e-05");
    EXPECT_EQ(timeName(1.0 / 3, 0.01, general), "0.333333");
    EXPECT_EQ(timeName(123.45678, 1e-5, general), "123.45678");
    EXPECT_EQ(timeName(0.5, 0.1, {std::chars_format::fixed, 3}), "0.500");
    EXPECT_EQ(timeName(0.5, 0.1, {std::chars_format::scientific, 2}), "5.00e-01");
    EXPECT_FALSE(timeOfName("constant"));
    EXPECT_FALSE(timeOfName("0.5old"));
    EXPECT_FALSE(timeOfName("nan"));
}

TEST(Time, ReportsAtIntervalsAndAtWrites)
{
    const TimedCase folder("endTime 1; deltaT 0.1; writeInterval 5; reportInterval 4;");
    Time time(folder.path());
    std::vector<long> reports;
    while (time.running())
    {
        time.advance();
        if (time.reportDue()) reports.push_back(time.index());
    }
    EXPECT_EQ(reports, (std::vector<long>{4, 5, 8, 10}));
}

TEST(Time, TellsTheProgress)
{
    const TimedCase folder(tenSteps);
    Time time(folder.path());
    EXPECT_EQ(time.progress(), "0 %");
    time.advance();
    time.advance();
    EXPECT_TRUE(time.progress().starts_with("20 %, about ")) << time.progress();
    EXPECT_TRUE(time.progress().ends_with(" left")) << time.progress();
}

TEST(Time, RefusesBadControls)
{
    const auto error = [](const std::string& text) { return TimedCase(text).error(); };
    EXPECT_TRUE(holds(error("endTime 1;\ndeltaT -0.1;\nwriteInterval 1;"), {"deltaT", "line 2"}));
    EXPECT_TRUE(holds(error("endTime 1;\ndeltaT 0;\nwriteInterval 1;"), {"deltaT", "line 2"}));
    EXPECT_TRUE(holds(error("endTime 1;\ndeltaT soon;\nwriteInterval 1;"), {"deltaT", "soon", "line 2"}));
    EXPECT_TRUE(holds(error("endTime 1;\nwriteInterval 1;"), {"deltaT"}));
    EXPECT_TRUE(holds(error("deltaT 1;\nwriteInterval 1;"), {"endTime"}));
    EXPECT_TRUE(holds(error("deltaT 1;\nendTime inf;\nwriteInterval 1;"), {"endTime", "line 2"}));
    EXPECT_TRUE(holds(error("deltaT 1; endTime 1; writeInterval 1;\nfunctions 5;"), {"'functions' is no dictionary", "line 2"}));
    EXPECT_TRUE(holds(error("deltaT 0.1;\nendTime -1;\nwriteInterval 1;"), {"endTime is before the start", "line 2"}));
    EXPECT_TRUE(holds(error("deltaT 0.1;\nendTime [0 1 0 0 0 0 0] 1;\nwriteInterval 1;"), {"endTime", "line 2"}));
    EXPECT_TRUE(holds(error("deltaT 0.1;\nendTime 1;\nwriteInterval 0;"), {"writeInterval is 0", "line 3"}));
    EXPECT_TRUE(holds(error("deltaT 0.1;\nendTime 1;\nwriteInterval 2.5;"), {"writeInterval", "line 3"}));
    EXPECT_TRUE
    (
        holds(error("deltaT 0.1;\nendTime 1;\nwriteControl runTime;\nwriteInterval -1;"), {"writeInterval", "line 4"})
    );
    EXPECT_TRUE(holds(error("deltaT 0.1;\nendTime 1;"), {"writeInterval"}));
    EXPECT_TRUE(holds(error(tenSteps + "writeControl cpuTime;"), {"cpuTime", "adjustableRunTime", "line 2"}));
    EXPECT_TRUE(holds(error(tenSteps + "purgeWrite -1;"), {"purgeWrite is -1", "line 2"}));
    EXPECT_TRUE(holds(error(tenSteps + "writePrecision 18;"), {"writePrecision is 18", "1 to 17", "line 2"}));
    EXPECT_TRUE(holds(error(tenSteps + "writeFormat text;"), {"text", "binary", "line 2"}));
    EXPECT_TRUE
    (
        holds(error(tenSteps + "runTimeModifyable yes;"), {"runTimeModifyable", "runTimeModifiable", "line 2"})
    );
    EXPECT_TRUE(holds(error(tenSteps + "maxCo 0;"), {"maxCo", "line 2"}));
}

TEST(Time, KnowsTheKeywordsOfOpenFoam)
{
    const TimedCase folder
    (
        tenSteps + "application pbfDroplet; writeCompression off; timeFormat general; adjustTimeStep yes; maxCo 0.4;\n"
        "maxCapillaryCo 0.5; functions { volume { type volume;\n interval 1; } } libs (\"libown.so\");"
    );
    EXPECT_EQ(folder.error(), "no error");

    // Who owns a sub-dictionary still finds what is mistyped in it.
    const Time time(folder.path());
    const Dictionary volume = time.controlDict().subDict("functions").subDict("volume");
    EXPECT_EQ(volume.lookup<std::string>("type"), "volume");
    EXPECT_TRUE(holds(messageOf([&] { volume.refuseUnused(); }), {"interval", "line 4"}));
    EXPECT_TRUE(holds(TimedCase(tenSteps + "writeCompression on;").error(), {"writeCompression", "off", "line 2"}));
    EXPECT_TRUE(holds(TimedCase(tenSteps + "maxDeltaT 1;").error(), {"maxDeltaT", "deltaT", "line 2"}));
}

TEST(Time, NeedsATimeFolder)
{
    const TimedCase folder(tenSteps);
    fs::remove_all(folder.path() / "0");
    EXPECT_TRUE(holds(folder.error(), {"no time folder", folder.path().string()}));
    fs::remove_all(folder.path() / "system");
    EXPECT_TRUE(holds(folder.error(), {"controlDict"}));
}

TEST(Time, StopMakesTheNextStepTheLastAndWritesIt)
{
    const TimedCase folder(tenSteps);
    Time time(folder.path());
    time.advance();
    time.advance();
    time.stop();
    EXPECT_TRUE(time.running());
    EXPECT_EQ(folder.run(time), Names{"0.3"});
    Time again(folder.path());                  // a new run makes its own way to endTime
    EXPECT_EQ(folder.run(again), (Names{"0.5", "1"}));
}

TEST(Time, RefusesAStepThatNoLiquidKnows)
{
    EXPECT_TRUE(holds(TimedCase("endTime 1; deltaT 1e-30; writeInterval 5;").error(), {"deltaT is 1e-30", "1e-12 s or more"}));
    EXPECT_EQ(TimedCase("endTime 1; deltaT 1e-12; writeInterval 5;").error(), "no error");
}
