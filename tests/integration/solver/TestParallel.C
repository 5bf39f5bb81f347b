// SPDX-License-Identifier: GPL-3.0-or-later
// mpirun -np N pbfDroplet -parallel: on any number of ranks the same files, tables and steps as one process.

#include "SolverCase.H"

#include "caseFiles/VectorField.H"
#include "core/fieldFile/FieldFile.H"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <regex>
#include <thread>

namespace shizuku::test
{

namespace
{

class Parallel : public SolverCase
{
protected:
    static inline const std::string functions =
        "functions { state { type liquidState; } size { type volume; spray yes; } work { type energy; } push { type wallForces; } spread { type spreadDiameter; }"
        " angle { type contactAngle; wall floor; } gauge { type probes; fields (rho U p); probeLocations ((0 0 1e-3) (2e-3 1e-3 3e-3)); } }";
    static inline const std::string endless = "endTime 10; writeInterval 5; functions { drop { type liquidState; } }";

    Parallel()
    {
        setenv("OMP_NUM_THREADS", "1", 1);
        setenv("OMPI_MCA_mpi_yield_when_idle", "1", 1);         // ranks that wait by spinning take each other's core
        write
        (
            "constant/models",
            "pressure pbf;\nsurfaceTension Fujisawa2014;\nwetting contactAngle;\ncontactAngleCoeffs { solidNormal wall; }\nviscosity XSPH;\nbodyForce gravity;\n"
        );
        fill({0.1, 0.3, -0.2});         // so that particles go from part to part
    }

    std::string parallel(int ranks, const std::string& arguments = "") const
    {
        return "mpirun --oversubscribe --allow-run-as-root -np " + std::to_string(ranks) + " " + command("pbfDroplet", "-parallel " + arguments);
    }

    // Two ranks of a small program that differ (partsThatDiffer.C); before: settings of the environment.
    static Outcome differing(const std::string& how, const std::string& before)
    {
        return run(before + " mpirun --oversubscribe --allow-run-as-root -np 2 '" + std::string(std::getenv("SHIZUKU_BUILD")) + "/tests/partsThatDiffer' -parallel " + how);
    }

    // All that a run leaves: times and tables.
    Contents results() const
    {
        Contents all = contents();
        std::erase_if(all, [](const auto& file) { return file.first.starts_with("system") || file.first.starts_with("constant"); });
        return all;
    }

    // One process and so many ranks leave the same, and divide the steps alike.
    void expectTheSameOf(const std::vector<int>& counts) const
    {
        const Outcome one = solve();
        ASSERT_EQ(one.status, 0) << one.text;
        const Contents expected = results();
        const auto steps = stepsOf(one.text);
        ASSERT_EQ(steps.size(), 4u);
        for (const int ranks : counts)
        {
            SCOPED_TRACE(ranks);
            removeResults();
            const Outcome outcome = run(parallel(ranks));
            ASSERT_EQ(outcome.status, 0) << outcome.text;
            EXPECT_TRUE(same(expected, results()));
            const auto logged = stepsOf(outcome.text);
            ASSERT_EQ(logged.size(), steps.size()) << outcome.text;
            for (std::size_t k = 0; k < steps.size(); ++k)
            {
                EXPECT_EQ(logged[k].subSteps, steps[k].subSteps);
                EXPECT_EQ(logged[k].maxSpeed, steps[k].maxSpeed);
            }
        }
    }

    // Ranks of a run on this host, by the process that its log names.
    static std::vector<pid_t> ranksOf(const std::string& log)
    {
        std::smatch match;
        if (!std::regex_search(log, match, std::regex("PID (\\d+)"))) return {};
        std::ifstream status("/proc/" + match[1].str() + "/status");
        std::string word, parent;
        while (status >> word) if (word == "PPid:") status >> parent;
        std::ifstream children("/proc/" + parent + "/task/" + parent + "/children");
        std::vector<pid_t> ranks;
        for (pid_t rank; children >> rank;) ranks.push_back(rank);
        return ranks;
    }

    static bool isAt(const Process& process, const std::string& time) { return process.log().find("Time = " + time + " s") != std::string::npos; }
};

INSTANTIATE_TEST_SUITE_P(Devices, Parallel, testing::Values("cpu"));

}

TEST_P(Parallel, LeavesTheFilesTablesAndStepsOfOneProcess)
{
    control(functions);
    expectTheSameOf({1, 2, 3});
}

TEST_P(Parallel, LeavesTheSameFilesOfTheDefaultModels)
{
    write("constant/models", "pressure completedPbf;\nsurfaceTension laplacePressure;\nwetting extendedSurface;\nviscosity XSPH;\nbodyForce gravity;\n");
    control("writeFormat binary;" + functions);
    expectTheSameOf({3});
}

// Models of the literature, whose sound makes many sub-steps.
TEST_P(Parallel, LeavesTheSameFilesOfModelsOfTheLiterature)
{
    write("system/solution", "spacing 1e-3;\n");
    write("constant/models", "pressure WCSPH;\nsurfaceTension continuumSurfaceForce;\nwetting extendedSurface;\nviscosity laminar;\nbodyForce gravity;\n");
    control(functions);
    expectTheSameOf({3});
}

// Particles leave through a plane that cuts the block, from the first step on.
TEST_P(Parallel, MovesABodyAsOneProcessDoes)
{
    dropBall();
    control("functions { ball { type sixDoFRigidBodyState; } push { type wallForces; } }");
    expectTheSameOf({2});
}

TEST_P(Parallel, TakesOutWhatOneProcessDoes)
{
    write("constant/outlets", "side { type plane; point (0 2.9e-3 0); normal (0 1 0); }\nbelow { type plane; point (0 0 -1); normal (0 0 -1); }\n");
    control("writeFormat binary; functions { out { type outflow; } sizes { type drops; classes (0 4e-3 1e-2); } state { type liquidState; } }");
    expectTheSameOf({2, 3});
    EXPECT_TRUE(holds(read("postProcessing/out/0/outflow.csv"), {"time [s],particles,volume [m3],takenOut,takenOutVolume [m3],side [m3],below [m3]"}));
}

TEST_P(Parallel, GoesOnWithAnotherNumberOfRanks)
{
    control("writeFormat binary;");
    ASSERT_EQ(solve().status, 0);
    const Contents whole = contents("0.004");
    removeResults();
    control("writeFormat binary; endTime 1e-3;");
    ASSERT_EQ(run(parallel(2)).status, 0);
    control("writeFormat binary; endTime 2e-3;");
    write("system/decomposeParDict", "method simple;\nsimpleCoeffs { n (1 1 3); }\nrebalanceAbove 0;\n");
    const Outcome three = run(parallel(3));
    ASSERT_EQ(three.status, 0) << three.text;
    EXPECT_TRUE(holds(three.text, {"Parts  : 3, cut across z"}));
    control("writeFormat binary;");
    ASSERT_EQ(solve().status, 0);
    EXPECT_TRUE(same(whole, contents("0.004")));
}

TEST_P(Parallel, FollowsWhatIsChangedWhileItRuns)
{
    control(endless + "runTimeModifiable yes;");
    Process process(parallel(2), folder_.path()/"log");
    ASSERT_TRUE(process.runUntil([&] { return isAt(process, "0.003"); })) << process.log();
    write("constant/liquidProperties", "rho 998;\nnu 1e-6;\nsigma 0.05;\n");
    ASSERT_TRUE(process.runUntil([&] { return process.log().find("sigma: 0.0728 -> 0.05") != std::string::npos; })) << process.log();
    // The other rank may still be at the first change.
    write("constant/models", "pressure pbf;\nsurfaceTension none;\nwetting none;\nviscosity water;\nbodyForce none;\n");
    ASSERT_TRUE(process.runUntil([&] { return process.log().find("The change of constant/models is left out") != std::string::npos; })) << process.log();
    EXPECT_TRUE(holds(process.log(), {"water", "laminar"}));
    control("endTime 1e-3; runTimeModifiable yes; stopAt writeNow;");
    EXPECT_EQ(process.wait(), 0) << process.log();
    EXPECT_TRUE(holds(process.log(), {"\nEnd\n"}));
}

// Cut across y, along which it moves by several times its width, or across y and z.
TEST_P(Parallel, CutsTheLiquidAnewWhereItHasMoved)
{
    fill({0, 1, 0});
    control("endTime 30e-3; writeInterval 30; reportInterval 30;");
    ASSERT_EQ(solve().status, 0);
    const Contents whole = contents("0.03");
    const auto expectCutAnew = [&](int ranks, const std::string& dict, const std::string& cut)
    {
        SCOPED_TRACE(dict);
        removeResults();
        write("system/decomposeParDict", dict);
        const Outcome outcome = run(parallel(ranks));
        ASSERT_EQ(outcome.status, 0) << outcome.text;
        EXPECT_TRUE(holds(outcome.text, {cut, "The liquid is cut anew: the largest part had "}));
        EXPECT_TRUE(same(whole, contents("0.03")));
    };
    expectCutAnew(2, "method rows;\ndirection y;\nrebalanceAbove 0.05;\n", "Parts  : 2, cut across y,");
    expectCutAnew
    (
        4, "method hierarchical;\nhierarchicalCoeffs { n (1 2 2); order zyx; }\nprocessorWeights (2 1 1 1);\nrebalanceAbove 0.2;\nrebalanceInterval 5;\n",
        "Parts  : 4, cut across y and z,"
    );
}

TEST_P(Parallel, RunsWithMoreRanksThanRowsOfLiquid)
{
    control("endTime 2e-3;");
    ASSERT_EQ(solve().status, 0);
    const Contents whole = contents("0.002");
    removeResults();
    write("system/decomposeParDict", "method rows;\n");
    const Outcome outcome = run(parallel(6));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {" of 6 parts have no liquid: it lies in ", " rows of cells, which stay whole"}));
    EXPECT_TRUE(same(whole, contents("0.002")));
}

// Of what is read, and of what the number of processes decides. What else is refused: TestBalance.C.
TEST_P(Parallel, RefusesWhatItCannotDoOnceAndLeavesTheCase)
{
    const auto refused = [&](const std::vector<std::string>& parts)
    {
        const Contents kept = contents();
        const Outcome outcome = run(parallel(3));
        EXPECT_EQ(outcome.status, 1) << outcome.text;
        EXPECT_TRUE(holds(outcome.text, parts));
        const std::size_t first = outcome.text.find("--> FATAL");
        EXPECT_EQ(outcome.text.find("--> FATAL", first + 1), std::string::npos) << outcome.text;
        EXPECT_TRUE(same(kept, contents()));
    };
    write("system/decomposeParDict", "method scotch;\n");
    refused({"scotch", "liquid moves", "system/decomposeParDict at line 1", "bisection", "rows", "simple", "hierarchical"});
    write("system/decomposeParDict", "method hierarchical;\nhierarchicalCoeffs { n (1 2 2); }\n");
    refused({"has 4 parts, and there are 3 processes", "mpirun -np 4"});
    remove("system/decomposeParDict");
}

// Half of the block crosses a cyclic side, and rain comes in across it. The surface is that of the mirrored whole.
TEST_P(Parallel, LiquidGoesOnAcrossSidesAsInOneProcess)
{
    write("constant/walls", "floor { type particles; surface \"floor.stl\"; }\n");
    write("constant/wettability", "floor { theta 60; }\n");
    write("constant/boundary", "min (-3.5e-3 -6e-3 0); max (1 6e-3 1); sides { xMin symmetryPlane; yMin cyclic; yMax cyclic; }\n");
    write("constant/sources", "shower { type rain; rate 0.2; corner (2e-3 -6e-3 0.015); along (0.01 0 0); across (0 0.012 0); direction (0 0 -1); speed 0.5; sizes { type oneSize; diameter 3e-3; } }\n");
    control("functions { state { type liquidState; } size { type volume; } }");
    fill({-0.2, 0.6, 0});
    expectTheSameOf({3});
    EXPECT_TRUE(holds(read("0.004/uniform/liquid"), {"enteredByshower 56;"}));         // four drops
}

// Of a block of 294 particles: each rank has some, and what it needs.
TEST_P(Parallel, ADryRunTellsWhatEachRankNeeds)
{
    const Contents kept = contents();
    const Outcome outcome = run(parallel(3, "-dry-run"));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const std::regex line("part (\\d) +: (\\d+) particles, (\\d+) ghosts, ([0-9.e+-]+) MiB");
    int ranks = 0, all = 0;
    for (std::sregex_iterator next(outcome.text.begin(), outcome.text.end(), line), end; next != end; ++next)
    {
        EXPECT_EQ(std::stoi((*next)[1]), ranks++);
        all += std::stoi((*next)[2]);
        EXPECT_GT(std::stoi((*next)[3]), 0);
        EXPECT_GT(std::stod((*next)[4]), 0);
    }
    EXPECT_EQ(ranks, 3) << outcome.text;
    EXPECT_EQ(all, particles);
    EXPECT_TRUE(same(kept, contents()));
}

// A bar that falls, cut in its middle: two rows of cells beside the cut are ghosts, 6 % of what a rank has, and of all that it holds of a particle it needs as much more. Four
// bytes are for the order of the whole, a thirty-second is room for what comes and goes, and what travels takes memory. What the start wanted is not there any more.
TEST_P(Parallel, NeedsLittleMoreMemoryThanOneProcess)
{
    std::vector<Vector3> positions;
    for (int x = 0; x < 20; ++x) for (int y = 0; y < 120; ++y) for (int z = 0; z < 20; ++z) positions.push_back(spacing*Vector3(x, y, z + 20));
    writeField(path()/"0/liquid/positions", toField("positions", dimensions::length, positions), {});
    FieldData velocity = toField("U", dimensions::velocity, {{0, 0, 0}});
    velocity.uniform = true;
    writeField(path()/"0/liquid/U", velocity, {});
    write("constant/models", "pressure completedPbf;\nsurfaceTension laplacePressure;\nwetting extendedSurface;\nviscosity newtonian;\nbodyForce gravity;\n");
    control("endTime 4e-4; deltaT 2e-4; adjustTimeStep no; writeControl none;");
    const auto bytesOf = [](const Outcome& outcome)
    {
        std::smatch match;
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        return std::regex_search(outcome.text, match, std::regex("(\\d+) bytes a liquid particle")) ? std::stoi(match[1]) : 0;
    };
    const int one = bytesOf(solve()), two = bytesOf(run(parallel(2)));
    EXPECT_GT(one, 0);
    EXPECT_LE(two, 1.15*one) << one << " and " << two;
}

// The ranks read a share each. Six particles of two shares in one place: the density there is above 1.9.
TEST_P(Parallel, LooksAtTheStartAsOneProcessDoes)
{
    FieldData positions = readField(path()/"0/liquid/positions");
    const std::size_t middle = 3*(positions.elements()/2);
    for (std::size_t k = 0; k < 15; ++k) positions.values[middle + k] = positions.values[k%3] + (k%3 == 0 ? 1e-5*double(k) : 0);
    writeField(path()/"0/liquid/positions", positions, {});
    const auto found = [](const std::string& text) { return text.substr(text.find("--> FATAL"), text.find("stopped") - text.find("--> FATAL")); };
    const Outcome one = solve(), several = run(parallel(3));
    ASSERT_EQ(one.status, 1);
    EXPECT_EQ(several.status, 1);
    EXPECT_TRUE(holds(one.text, {"starts overlapping itself"}));
    EXPECT_EQ(found(several.text), found(one.text));

    write("system/solution", read("system/solution") + "overlaps relax;\n");
    control("endTime 2e-3;");
    const Outcome relaxed = solve();
    ASSERT_EQ(relaxed.status, 0) << relaxed.text;
    EXPECT_TRUE(holds(relaxed.text, {"were moved apart in"}));
    const Contents whole = contents("0.002");
    removeResults();
    const Outcome inParts = run(parallel(3));
    ASSERT_EQ(inParts.status, 0) << inParts.text;
    EXPECT_TRUE(same(whole, contents("0.002")));
}

TEST_P(Parallel, RefusesLiquidInsideOfWallsThatOneRankFinds)
{
    FieldData positions = readField(path()/"0/liquid/positions");
    const std::size_t last = positions.elements() - 1;
    positions.values[3*last + 2] = -5e-3;
    writeField(path()/"0/liquid/positions", positions, {});
    const Outcome outcome = run(parallel(2));
    EXPECT_EQ(outcome.status, 1) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Liquid particle " + std::to_string(last) + " at ", "is inside the solid"}));
}

// Only the first rank looks at the lock.
TEST_P(Parallel, AnErrorOfOneRankEndsAllWithItsMessage)
{
    control(endless);
    Process other(command("pbfDroplet", ""), folder_.path()/"other");
    ASSERT_TRUE(other.runUntil([&] { return isAt(other, "0.001"); })) << other.log();
    const Outcome outcome = run(parallel(2));           // which the test's limit of time ends where a rank waits for the other
    EXPECT_EQ(outcome.status, 1) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Another solver runs in", "pbfDroplet: stopped\n"}));
    EXPECT_EQ(outcome.text.find("Ready for the first step"), std::string::npos) << outcome.text;
}

// Two tasks of a launcher that does not speak with MPI would each compute the whole case.
TEST_P(Parallel, OneProcessOfSeveralThatALauncherStartedIsRefused)
{
    const std::string alone = command("pbfDroplet", "-parallel");
    const Contents kept = contents();
    for (const std::string said : {"SLURM_NTASKS=2", "SLURM_STEP_NUM_TASKS=2 SLURM_PROCID=0", "PMI_SIZE=2", "OMPI_COMM_WORLD_SIZE=2", "PMIX_RANK=1", "FLUX_JOB_SIZE=2", "PALS_RANKID=1"})
    {
        const Outcome outcome = run("env " + said + " " + alone);
        EXPECT_EQ(outcome.status, 1) << said << outcome.text;
        EXPECT_TRUE(holds(outcome.text, {"By " + said.substr(0, said.find('=')) + " a launcher has started 2 processes", "mpirun -np 2 pbfDroplet -parallel"})) << outcome.text;
        EXPECT_TRUE(same(kept, contents())) << said;
    }
}

TEST_P(Parallel, OneProcessWithoutMpirunRunsAloneAndSaysSo)
{
    const std::string dry = command("pbfDroplet", "-parallel -dry-run"), text = "-parallel without mpirun: one process computes the whole case";
    const Outcome outcome = run(dry);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {text, "mpirun -np 4 pbfDroplet -parallel"}));
    for (const std::string& asked : {parallel(1, "-dry-run"), "env SLURM_NTASKS=4 " + parallel(1, "-dry-run")})
    {
        const Outcome one = run(asked);
        EXPECT_EQ(one.status, 0) << one.text;
        EXPECT_EQ(one.text.find("without mpirun"), std::string::npos) << one.text;
    }
}

// Files end at 5 kB: the first half of the positions fits, the second one does not.
TEST_P(Parallel, AShareThatCannotBeWrittenEndsAllAndLeavesNoTime)
{
    control("writeFormat binary;");
    const Contents kept = contents();
    const Outcome outcome = run
    (
        "mpirun --oversubscribe --allow-run-as-root --mca btl self,tcp -np 2 bash -c \"trap '' XFSZ; ulimit -f 5; exec " + command("pbfDroplet", "-parallel") + "\""
    );
    EXPECT_EQ(outcome.status, 1) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Part 1 of 2: Cannot write ", "liquid/positions: File too large"}));
    EXPECT_EQ(outcome.text.find("--> FATAL"), outcome.text.rfind("--> FATAL")) << outcome.text;
    EXPECT_TRUE(same(kept, contents()));
}

TEST_P(Parallel, ASignalToOneRankEndsAllWithALastWrite)
{
    control(endless);
    Process process(parallel(2), folder_.path()/"log");
    ASSERT_TRUE(process.runUntil([&] { return isAt(process, "0.003"); })) << process.log();
    const std::vector<pid_t> ranks = ranksOf(process.log());
    ASSERT_EQ(ranks.size(), 2u);
    ::kill(ranks[1], SIGTERM);
    EXPECT_EQ(process.wait(), 128 + SIGTERM) << process.log();
    EXPECT_TRUE(holds(process.log(), {"The present step is the last. SIGTERM came"}));
    const auto steps = stepsOf(process.log());
    std::ostringstream last;
    last << steps.back().time;
    EXPECT_TRUE(exists(last.str() + "/liquid/positions")) << process.log();
    const Contents stopped = contents(last.str());
    removeResults();
    control(endless + "endTime " + last.str() + ";");
    ASSERT_EQ(solve().status, 0);
    EXPECT_TRUE(same(stopped, contents(last.str())));
}

TEST_P(Parallel, AKilledRankEndsAllAndTheRunGoesOnFromTheLastTime)
{
    control(endless);
    {
        Process process(parallel(2), folder_.path()/"log");
        ASSERT_TRUE(process.runUntil([&] { return isAt(process, "0.007"); })) << process.log();
        const std::vector<pid_t> ranks = ranksOf(process.log());
        ASSERT_EQ(ranks.size(), 2u);
        ::kill(ranks[1], SIGKILL);
        EXPECT_EQ(process.wait(), 128 + SIGKILL) << process.log();
    }
    control("endTime 0.05; writeInterval 50; reportInterval 50;");
    ASSERT_EQ(run(parallel(3)).status, 0);
    const Contents gone = contents("0.05");
    removeResults();
    ASSERT_EQ(solve().status, 0);
    EXPECT_TRUE(same(gone, contents("0.05")));
}

TEST_P(Parallel, ChecksThatAllRanksMakeTheSameCalls)
{
    const Outcome branches = differing("branches", "SHIZUKU_CHECK_PARTS=1");
    EXPECT_EQ(branches.status, 1);
    EXPECT_TRUE(holds(branches.text, {"made different calls, call 2 of each", "part 0: exchange()", "gatherTexts(", "part 1: gather() of 1 bytes", "inAllParts("}));
    const Outcome ends = differing("ends", "SHIZUKU_CHECK_PARTS=1");
    EXPECT_EQ(ends.status, 1);
    EXPECT_TRUE(holds(ends.text, {"part 0: exchange()", "gatherTexts(", "part 1: has come to its end"}));
}

TEST_P(Parallel, RanksThatWaitForEachOtherSayWhereAndEnd)
{
    const std::string limit = "SHIZUKU_CHECK_PARTS=0 SHIZUKU_WAIT_LIMIT=1";
    const Outcome branches = differing("branches", limit);
    EXPECT_EQ(branches.status, 1);
    EXPECT_TRUE(holds(branches.text, {"Part 0 of 2 has waited", "gatherTexts(", "Part 1 of 2 has waited", "inAllParts("}));
    const Outcome ends = differing("ends", limit);
    EXPECT_EQ(ends.status, 1);
    EXPECT_TRUE(holds(ends.text, {"Part 0 of 2 has waited", "gatherTexts(", "Process 1 of this host has come to its end"}));
    const Outcome works = differing("works", limit);            // one of them, for four times the limit
    EXPECT_EQ(works.status, 0) << works.text;
}

// Faster than a part is wide, so that parts lose all their particles.
TEST_P(Parallel, ADropThatLeavesItsPartsMovesAsOnOneProcess)
{
    fill({0.1, 2, -0.1});
    control("");
    expectTheSameOf({2, 3, 5});
}

}
