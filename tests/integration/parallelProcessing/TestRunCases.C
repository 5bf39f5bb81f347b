// SPDX-License-Identifier: GPL-3.0-or-later
// runCases on folders whose commands are short lines of sh: what it runs, leaves out, survives and refuses.

#include "support/Process.H"
#include "support/Programs.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>

namespace shizuku::test
{

namespace
{

namespace fs = std::filesystem;

class RunCases : public testing::Test
{
protected:
    RunCases()
    {
        unsetenv("OMP_NUM_THREADS");
        unsetenv("CUDA_VISIBLE_DEVICES");
    }

    // A line of sh that writes its process group, number 5 of /proc/<pid>/stat, to the file "id".
    const std::string groupToFile = "printf %s $(cut -d ' ' -f 5 /proc/$$/stat) >id; ";

    // A case whose Allrun is a line of sh.
    void writeCase(const std::string& name, const std::string& line) const
    {
        folder_.write(name + "/Allrun", "#!/bin/sh\n" + line + "\n");
        fs::permissions(folder_.path()/name/"Allrun", fs::perms::owner_all);
    }

    std::string command(const std::string& arguments) const
    {
        return "env -C '" + folder_.path().string() + "' " + program("runCases") + " " + arguments;
    }
    Outcome call(const std::string& arguments) const { return run("(" + command(arguments) + ")"); }

    std::string read(const std::string& file) const { return folder_.read(file); }
    bool exists(const std::string& file) const { return fs::exists(folder_.path()/file); }

    ScratchFolder folder_;
};

TEST_F(RunCases, RunsTheAllrunOfEachInItsFolder)
{
    writeCase("one", "pwd; echo \"with $*\"");
    writeCase("two", "echo to stderr >&2");
    const Outcome outcome = call("one two -device cpu -jobs 2");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(read("one/log.runCases"), fs::canonical(folder_.path()/"one").string() + "\nwith -device cpu\n");
    EXPECT_EQ(read("two/log.runCases"), "to stderr\n");
    EXPECT_TRUE(holds(outcome.text, {"Started  one", "(2 of 2: 100 %", "case  status            seconds", "End\n"}));
}

TEST_F(RunCases, AFailureLosesNoOtherAndIsRunAgain)
{
    writeCase("a", "echo ran; test -e mended || exit 7");
    writeCase("b", "echo ran");
    writeCase("c", "kill -9 $$");
    Outcome outcome = call("a b c -jobs 1");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(holds(outcome.text, {"failed, exit 7", "failed, exit 137", "2 of 3 cases failed", "log.runCases"}));
    EXPECT_EQ(read("b/log.runCases"), "ran\n");

    folder_.write("a/mended", "");
    writeCase("c", "true");
    outcome = call("a b c -jobs 1");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"of which finished before 1", "b     finished before"}));
    EXPECT_EQ(read("a/log.runCases"), "ran\nran\n");        // added to
    EXPECT_EQ(read("b/log.runCases"), "ran\n");             // left alone
}

TEST_F(RunCases, AnotherCommandIsAnotherRun)
{
    fs::create_directories(folder_.path()/"bare");
    ASSERT_EQ(call("bare -command 'echo \"$((1 + 1)) \\\\\"'").status, 0);
    ASSERT_EQ(call("bare -command 'echo \"$((1 + 1)) \\\\\"'").status, 0);
    EXPECT_EQ(read("bare/log.runCases"), "2 \\\n");
    ASSERT_EQ(call("bare -command 'echo 3'").status, 0);
    EXPECT_EQ(read("bare/log.runCases"), "2 \\\n3\n");
}

TEST_F(RunCases, RunsNoMoreThanTheJobsAtATime)
{
    // Each counts those that run beside it, itself included.
    const std::string line = "mkdir -p ../running/$$; sleep 0.3; ls ../running | wc -l; sleep 0.3; rmdir ../running/$$";
    std::string names;
    for (const char* const name : {"a", "b", "c", "d", "e"})
    {
        writeCase(name, line);
        names.append(name).append(" ");
    }
    const Outcome outcome = call(names + "-jobs 2");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    std::string most = "0";
    for (const char* const name : {"a", "b", "c", "d", "e"})
    {
        most = std::max(most, read(std::string(name) + "/log.runCases"));
    }
    EXPECT_EQ(most, "2\n");
}

TEST_F(RunCases, GoesRoundTheGpus)
{
    std::string names;
    for (const char* const name : {"a", "b", "c", "d"})
    {
        writeCase(name, "echo $CUDA_VISIBLE_DEVICES; sleep 0.5");
        names.append(name).append(" ");
    }
    // Two GPUs, as nvidia-smi lists them.
    const fs::path tool = folder_.write("bin/nvidia-smi", "#!/bin/sh\necho 'GPU 0: a (UUID: x)'\necho 'GPU 1: b (UUID: y)'\n");
    fs::permissions(tool, fs::perms::owner_all);
    const std::string path = "PATH='" + tool.parent_path().string() + "':$PATH; ";
    Outcome outcome = run("(" + path + command(names + "-perDevice 2") + ")");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"at a time 4", "Started  b on GPU 1"}));
    std::string devices;
    for (const char* const name : {"a", "b", "c", "d"}) devices += read(std::string(name) + "/log.runCases");
    EXPECT_EQ(devices, "0\n1\n0\n1\n");

    // Those that the user allows.
    outcome = run("(" + path + "export CUDA_VISIBLE_DEVICES=5; " + command("a -perDevice 1 -command 'echo $CUDA_VISIBLE_DEVICES'") + ")");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(read("a/log.runCases"), "0\n5\n");
}

TEST_F(RunCases, SharesAGpuByTheMultiProcessService)
{
    const auto tool = [&](const std::string& name, const std::string& lines)
    {
        const fs::path file = folder_.write("bin/" + name, "#!/bin/sh\n" + lines);
        fs::permissions(file, fs::perms::owner_all);
    };
    const std::string path = "PATH='" + (folder_.path()/"bin").string() + "':$PATH; ";
    writeCase("good", "test -d \"$CUDA_MPS_PIPE_DIRECTORY\" && echo \"$CUDA_MPS_PIPE_DIRECTORY\"; grep -c start ../calls");
    writeCase("bad", "exit 1");
    EXPECT_TRUE(holds(call("good -device cpu -mps").text, {"the cases run on the CPU"}));

    tool("nvidia-smi", "echo 'GPU 0: a (UUID: x)'\n");
    tool("nvidia-cuda-mps-control", "exit 1\n");
    Outcome outcome = run("(" + path + command("good -mps") + ")");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(holds(outcome.text, {"multi-process service does not start", "or no -mps"}));
    EXPECT_FALSE(exists("good/log.runCases"));

    // Started once, on all GPUs, before any case, and ended although one failed.
    tool
    (
        "nvidia-cuda-mps-control",
        "if [ \"$1\" = -d ]; then echo start $CUDA_VISIBLE_DEVICES; else cat; fi >>'" + (folder_.path()/"calls").string() + "'\n"
    );
    outcome = run("(" + path + "export CUDA_VISIBLE_DEVICES=0; " + command("good bad -mps") + ")");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(read("calls"), "start\nquit\n");
    const std::string log = read("good/log.runCases");
    EXPECT_TRUE(log.ends_with("\n1\n")) << log;
    EXPECT_FALSE(fs::exists(log.substr(0, log.find('\n'))));        // its folder has gone
}

TEST_F(RunCases, DividesTheCores)
{
    writeCase("a", "echo $OMP_NUM_THREADS");
    ASSERT_EQ(call("a -device cpu -jobs 1000").status, 0);
    EXPECT_EQ(read("a/log.runCases"), "1\n");
    ASSERT_EQ(run("(export OMP_NUM_THREADS=3; " + command("a -jobs 1000") + ")").status, 0);
    EXPECT_EQ(read("a/log.runCases"), "1\n3\n");
}

TEST_F(RunCases, GoesOnAfterAnInterruption)
{
    writeCase("a", "echo ran");
    writeCase("b", "trap '' INT; " + groupToFile + "test -e ../short || sleep 60; echo ran");
    writeCase("c", "echo ran");
    Process process(command("a b c -jobs 1"), folder_.path()/"out");
    ASSERT_TRUE(process.runUntil([&] { return !read("b/id").empty(); })) << process.log();
    EXPECT_EQ(process.end(SIGINT), 1);
    EXPECT_TRUE(holds(process.log(), {"Interrupted by signal 2", "after 1 of 3 cases", "The same command goes on"}));
    // What it had started has gone, to the last child, once init has taken note of it.
    const std::string gone = "! kill -s 0 -- -" + read("b/id") + " 2>/dev/null";
    EXPECT_EQ(run("for i in $(seq 100); do " + gone + " && exit 0; sleep 0.05; done; exit 1").status, 0);

    folder_.write("short", "");
    const Outcome outcome = call("a b c -jobs 1");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"of which finished before 1"}));
    EXPECT_EQ(read("a/log.runCases") + read("b/log.runCases") + read("c/log.runCases"), "ran\nran\nran\n");
}

TEST_F(RunCases, StartsNoCaseTwice)
{
    writeCase("a", "true");
    const std::string hold = "exec 9>>" + (folder_.path()/"a/log.runCases").string() + "; flock -n 9; ";
    const Outcome outcome = run(hold + command("a -jobs 1"));
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(holds(outcome.text, {"The case is being run already"}));
}

TEST_F(RunCases, ItsCasesEndWhereItIsKilled)
{
    // It has looked for `short` before it tells its group.
    writeCase("a", "test -e ../short || { " + groupToFile + "sleep 60; }");
    writeCase("b", "true");
    Process process(command("a -jobs 1"), folder_.path()/"out");
    ASSERT_TRUE(process.runUntil([&] { return !read("a/id").empty(); })) << process.log();
    EXPECT_EQ(process.end(SIGKILL), 128 + SIGKILL);
    folder_.write("short", "");
    // Its guard ends the group; ten seconds are what it waits at most before it kills, and as much again.
    const Outcome gone = run("for i in $(seq 200); do kill -s 0 -- -" + read("a/id") + " 2>/dev/null || exit 0; sleep 0.05; done; exit 1");
    EXPECT_EQ(gone.status, 0);
    const Outcome outcome = call("a b -jobs 1");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Finished a", "Finished b"}));
}

TEST_F(RunCases, RefusesBeforeItRunsAnything)
{
    writeCase("a", "touch ran");
    folder_.write("bare/file", "");
    folder_.write("plain/Allrun", "echo never\n");
    const auto refused = [&](const std::string& arguments, const std::vector<std::string>& parts)
    {
        const Outcome outcome = call(arguments);
        EXPECT_EQ(outcome.status, 1) << arguments;
        EXPECT_TRUE(holds(outcome.text, parts));
        EXPECT_FALSE(exists("a/ran")) << arguments;
    };
    refused("", {"No case is given", "runCases CASE ..."});
    refused("a absent", {"absent", "The case is no directory"});
    refused("a bare", {"bare", "has no Allrun that can be executed", "-command"});
    refused("a plain", {"plain", "has no Allrun that can be executed"});
    refused("a ./a", {"The case is given twice"});
    refused("a -jobs 0", {"Option -jobs has the value '0'", "a whole number from 1"});
    refused("a -jobs 1.5", {"Option -jobs has the value '1.5'"});
    refused("a -device cpu -perDevice 2", {"-perDevice", "on the CPU"});
    refused("a -devise cpu", {"Unknown option '-devise'", "'-device'"});
    const Outcome outcome = run("(export CUDA_VISIBLE_DEVICES=; " + command("a -device cuda") + ")");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(holds(outcome.text, {"Option -device asks for cuda, but no GPU is here"}));
}

TEST_F(RunCases, ADamagedRecordCountsAsNone)
{
    writeCase("a", "echo ran");
    folder_.write("a/log.runCases.json", "{ \"command\": \"./All");
    const Outcome outcome = call("a");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(holds(outcome.text, {"record cannot be read", "log.runCases.json", "Finished a"}));
}

TEST_F(RunCases, ACaseThatCannotBeWrittenFailsAlone)
{
    if (geteuid() == 0) folder_.write("a/log.runCases/inTheWay", "");      // root may write everywhere
    writeCase("a", "true");
    if (geteuid() != 0) fs::permissions(folder_.path()/"a", fs::perms::owner_read | fs::perms::owner_exec);
    writeCase("b", "true");
    const Outcome outcome = call("a b -jobs 1");
    fs::permissions(folder_.path()/"a", fs::perms::owner_all);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(holds(outcome.text, {"FAILED   a", "Cannot write", "Finished b", "1 of 2 cases failed"}));
}

}

}
