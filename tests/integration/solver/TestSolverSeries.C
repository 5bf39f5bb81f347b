// SPDX-License-Identifier: GPL-3.0-or-later
// Cases that one process runs one after another: each as by a process of its own, and none takes another with it.

#include "SolverCase.H"

namespace shizuku::test
{

namespace
{

class Series : public SolverCase
{
protected:
    Series()
    {
        for (const char* name : {"first", "broken", "last"}) std::filesystem::copy(path(), folder_.path()/name, std::filesystem::copy_options::recursive);
        folder_.write("broken/constant/models", "surfaceTension laplac;");
    }

    // By options and cases, which are told from the folder that holds them.
    Outcome pbfDroplet(const std::string& arguments) const
    {
        return run("cd '" + folder_.path().string() + "' && " + program("pbfDroplet") + " -device " + device() + " " + arguments);
    }

    bool writesInto(const std::string& name) const { return std::filesystem::exists(folder_.path()/name/"log.pbfDroplet"); }
};

INSTANTIATE_TEST_SUITE_P(Devices, Series, testing::ValuesIn(devices()));

}

TEST_P(Series, EachCaseHasTheResultsOfARunOfItsOwn)
{
    const Outcome series = pbfDroplet("first broken last");
    EXPECT_EQ(series.status, 1) << series.text;
    EXPECT_TRUE(holds(series.text, {"Finished first in", "FAILED   broken in", "Finished last in", "1 of 3 cases failed; what each printed is in its log.pbfDroplet"}));
    EXPECT_TRUE(holds(folder_.read("broken/log.pbfDroplet"), {"FATAL IO ERROR", "broken/constant/models", "pbfDroplet: stopped"}));
    const Outcome alone = solve();
    ASSERT_EQ(alone.status, 0) << alone.text;
    for (const std::string name : {"first", "last"})
    {
        SCOPED_TRACE(name);
        EXPECT_TRUE(folder_.read(name + "/log.pbfDroplet").ends_with("\nEnd\n"));
        for (const std::string time : {"0.001", "0.002", "0.003", "0.004"}) EXPECT_TRUE(same(contents("../" + name + "/" + time), contents(time)));
    }
}

TEST_P(Series, ACaseWhoseLogCannotBeWrittenStopsNoOther)
{
    std::filesystem::create_directory(folder_.path()/"first"/"log.pbfDroplet");
    const Outcome series = pbfDroplet("first last");
    EXPECT_EQ(series.status, 1);
    EXPECT_TRUE(holds(series.text, {"Cannot write ", "FAILED   first", "Finished last", "1 of 2 cases failed"}));
}

// The second call finds each case at its end, and says so behind what the first has said.
TEST_P(Series, LogsAreAddedTo)
{
    ASSERT_EQ(pbfDroplet("first").status, 0);
    const std::string before = folder_.read("first/log.pbfDroplet");
    ASSERT_EQ(pbfDroplet("first").status, 0);
    const std::string after = folder_.read("first/log.pbfDroplet");
    EXPECT_TRUE(after.starts_with(before));
    EXPECT_GT(after.size(), before.size());
}

TEST_P(Series, WhatCannotRunIsRefusedBeforeAnythingDoes)
{
    for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>
    {
        {"first nowhere", "The case directory does not exist"},
        {"first first", "The case is given twice"},
        {"first first/../first", "The case is given twice"},
        {"first -case last", "Option -case is given beside the case 'first'"},
        {"-view first", "Option -view is given beside cases"},
        {"-viewAt 8090 first", "Option -viewAt is given beside cases"},
    })
    {
        SCOPED_TRACE(arguments);
        const Outcome outcome = pbfDroplet(arguments);
        EXPECT_EQ(outcome.status, 1);
        EXPECT_TRUE(holds(outcome.text, {message}));
        EXPECT_FALSE(writesInto("first") || writesInto("last"));
    }
}

}
