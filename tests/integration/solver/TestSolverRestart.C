// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that are stopped, killed or cut off in the middle of a write continue to the same bits as one that is not.

#include "SolverCase.H"

#include <csignal>

namespace shizuku::test
{

namespace
{

class Restart : public SolverCase
{
protected:
    // The fields of these times after a run from 0 to 9 ms at once; the case is left as it was before.
    Contents uninterrupted(const std::string& format) const
    {
        control("endTime 9e-3;" + format);
        const Outcome outcome = solve();
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        const Contents result = results();
        removeResults();
        return result;
    }

    Contents results() const
    {
        Contents result;
        for (const std::string time : {"0.006", "0.009"})
        {
            for (const auto& [name, bytes] : contents(time)) result[time + "/" + name] = bytes;
        }
        return result;
    }

    void expectContinuation(const Contents& expected, const std::string& format) const
    {
        control("endTime 9e-3;" + format);
        const Outcome outcome = solve();
        ASSERT_EQ(outcome.status, 0) << outcome.text;
        EXPECT_TRUE(same(expected, results()));
        for (const std::string& name : folder_.list("case")) EXPECT_FALSE(name.ends_with(".partial")) << name;
    }

    void expectRestart(const std::string& format) const
    {
        const Contents expected = uninterrupted(format);
        for (const std::string file : {"positions", "U", "id", "densityRatio"})
        {
            ASSERT_TRUE(expected.contains("0.009/liquid/" + file)) << file;
        }
        ASSERT_NE(expected.at("0.009/liquid/U"), expected.at("0.006/liquid/U"));
        control("endTime 5e-3;" + format);
        ASSERT_EQ(solve().status, 0);
        ASSERT_TRUE(exists("0.005"));
        ASSERT_FALSE(exists("0.006"));
        expectContinuation(expected, format);
    }

    void expectContinuationAfterKill(const std::function<bool()>& moment) const
    {
        const Contents expected = uninterrupted(ascii);
        control("endTime 1;" + ascii);
        Process process(command("pbfDroplet", ""), folder_.path()/"log");
        ASSERT_TRUE(process.runUntil(moment)) << process.log();
        ASSERT_EQ(process.end(SIGKILL), 128 + SIGKILL) << process.log();
        ASSERT_TRUE(exists("0.003"));
        // However late the kill came, the times that are compared are made by the run that continues.
        for (const std::string& name : folder_.list("case"))
        {
            if (name.starts_with("0.") && std::stod(name) > 5e-3) remove(name);
        }
        expectContinuation(expected, ascii);
    }

    static inline const std::string ascii = "writeFormat ascii; writePrecision 9;";
    static inline const std::string binary = "writeFormat binary;";
};

INSTANTIATE_TEST_SUITE_P(Devices, Restart, testing::ValuesIn(devices()));

}

TEST_P(Restart, BinaryContinuesToTheSameBits) { expectRestart(binary); }

TEST_P(Restart, AsciiContinuesToTheSameBits) { expectRestart(ascii); }

// A plane beside the block, which moves through it; what was taken out is a number of the liquid.
TEST_P(Restart, LiquidThatIsTakenOutStaysOut)
{
    write("constant/outlets", "side { type plane; point (3.2e-3 0 0); normal (1 0 0); }\n");
    fill({0.1, 0, 0});
    expectRestart(binary);
    EXPECT_TRUE(holds(read("0.009/uniform/liquid"), {"takenOutByside "}));
    EXPECT_FALSE(holds(read("0.009/uniform/liquid"), {"takenOutByside 0;"}));
    const Outcome outcome = (removeResults(), solve());
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"taken out: side ", " particles, "}));
}

// The block is pressed against a symmetry plane in the place of the wall, and half of it crosses a cyclic side meanwhile.
TEST_P(Restart, LiquidGoesOnAcrossSides)
{
    write("constant/walls", "floor { type particles; surface \"floor.stl\"; }\n");
    write("constant/wettability", "floor { theta 60; }\n");
    write("constant/boundary", "min (-3.5e-3 -6e-3 0); max (1 6e-3 1); sides { xMin symmetryPlane; yMin cyclic; yMax cyclic; }\n");
    fill({-0.2, 0.6, 0});
    expectRestart(binary);
    const Outcome outcome = (removeResults(), solve());
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Sides  : xMin symmetryPlane, y cyclic over 0.012 m"}));
}

TEST_P(Restart, ARunEndsWhereAllLiquidIsTakenOut)
{
    write("constant/outlets", "all { type plane; point (0 0 0.05); normal (0 0 -1); }\n");
    control("functions { out { type outflow; } sizes { type drops; } state { type liquidState; } }");
    const Outcome outcome = solve();
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"all liquid was taken out", "taken out: all 294 particles, 2.94e-07 m3", "sizes: drops 0, ", "\nEnd\n"}));
    EXPECT_TRUE(exists("0.001/liquid/positions"));
    EXPECT_FALSE(exists("0.002"));
}

TEST_P(Restart, TheNumberOfThreadsChangesNoBit)
{
    ASSERT_EQ(setenv("OMP_NUM_THREADS", "3", 1), 0);
    const Contents three = uninterrupted(binary);
    ASSERT_EQ(setenv("OMP_NUM_THREADS", "1", 1), 0);
    const Contents one = uninterrupted(binary);
    unsetenv("OMP_NUM_THREADS");
    EXPECT_TRUE(same(three, one));
}

TEST_P(Restart, AKilledRunContinues)
{
    expectContinuationAfterKill([&] { return exists("0.003"); });
}

TEST_P(Restart, ARunKilledWhileItWritesContinues)
{
    expectContinuationAfterKill([&]
    {
        if (!exists("0.003")) return false;
        for (const std::string& name : folder_.list("case"))
        {
            if (name.ends_with(".partial")) return true;
        }
        return false;
    });
}

// Times that are purged are gone at once: none is left that looks whole and is not.
TEST_P(Restart, ARunThatPurgesContinuesAfterAKill)
{
    const Contents expected = uninterrupted(binary);
    control("endTime 1; writeInterval 1; purgeWrite 2;" + binary);
    Process process(command("pbfDroplet", ""), folder_.path()/"log");
    ASSERT_TRUE(process.runUntil([&] { return exists("0.005"); })) << process.log();
    ASSERT_EQ(process.end(SIGKILL), 128 + SIGKILL) << process.log();
    int times = 0;
    for (const std::string& name : folder_.list("case"))
    {
        if (!name.starts_with("0.")) continue;
        ++times;
        for (const std::string file : {"liquid/positions", "liquid/U", "liquid/id", "uniform/time"})
        {
            EXPECT_TRUE(exists(name + "/" + file)) << name << ' ' << file;
        }
        if (std::stod(name) > 5.5e-3) remove(name);
    }
    // Between a write and its purge there is one more.
    EXPECT_GE(times, 2);
    EXPECT_LE(times, 3);
    control("endTime 9e-3; startFrom latestTime;" + binary);
    const Outcome outcome = solve();
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(same(expected, results()));
}

// A file that may not be as large as its first field, the positions, of more than 8 KiB: an error that says so. And what a run leaves
// that is killed in the middle of it.
TEST_P(Restart, HalfATimeIsNoTime)
{
    const Contents expected = uninterrupted(ascii);
    control("endTime 5e-3;" + ascii);
    ASSERT_EQ(solve().status, 0);
    control("endTime 9e-3;" + ascii);
    const Outcome cut = run("ulimit -c 0; ulimit -f 16; " + command("pbfDroplet", ""));
    ASSERT_EQ(cut.status, 1) << cut.text;
    EXPECT_TRUE(holds(cut.text, {"Cannot write", "File too large"}));
    EXPECT_FALSE(exists(".0.006.partial"));
    ASSERT_FALSE(exists("0.006"));
    write(".0.006.partial/liquid/positions", "FoamFile { version 2.0; format ascii; class vec");

    const Outcome mesh = call("meshSurface", "-latestTime");
    EXPECT_EQ(mesh.status, 0) << mesh.text;
    EXPECT_TRUE(holds(mesh.text, {"Time = 0.005 s"}));
    expectContinuation(expected, ascii);
}

}
