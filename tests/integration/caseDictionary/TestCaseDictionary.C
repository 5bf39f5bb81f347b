// The application as a user runs it: what it prints, what it leaves in the file, how it fails.

#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>

using namespace shizuku::test;

namespace
{

struct Result
{
    int status;
    std::string output;     // stdout and stderr
};

class CaseDictionary : public testing::Test
{
protected:
    // Arguments as in a shell, without the name of the application.
    Result run(const std::string& arguments) const
    {
        const std::string build = std::getenv("SHIZUKU_BUILD");
        const std::string command = build + "/bin/caseDictionary -case " + folder_.path().string() + " " + arguments
            + " 2>&1";
        FILE* pipe = popen(command.c_str(), "r");
        std::string output;
        char buffer[4096];
        for (std::size_t n; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) output.append(buffer, n);
        return {WEXITSTATUS(pclose(pipe)), output};
    }

    std::string file() const { return folder_.read("constant/wettability"); }

    const std::string text_ =
        "// Angles, measured inside the liquid.\n"
        "base            60;\n"
        "floor           /* the wall below */\n"
        "{\n"
        "    theta       $base;      // degrees\n"
        "\n"
        "    region  {x 1;}\n"
        "}\n"
        "// end\n";

    ScratchFolder folder_;
    std::filesystem::path path_ = folder_.write("constant/wettability", text_);
};

}

TEST_F(CaseDictionary, PrintsTheFileAsItStands)
{
    const Result result = run("constant/wettability");
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.output, text_);
}

TEST_F(CaseDictionary, PrintsExpandedEntriesValuesKeywordsAndJson)
{
    EXPECT_EQ(run("constant/wettability -entry floor.theta").output, "theta           60;\n");
    EXPECT_EQ(run("constant/wettability -entry floor/theta -value").output, "60\n");
    EXPECT_EQ(run("constant/wettability -keywords").output, "base\nfloor\n");
    EXPECT_EQ(run("constant/wettability -entry floor -keywords").output, "theta\nregion\n");
    EXPECT_EQ(run("constant/wettability -entry floor.region -json").output, "{\n    \"x\": 1\n}\n");
    EXPECT_EQ
    (
        run("constant/wettability -expand").output,
        "base            60;\nfloor\n{\n    theta           60;\n"
        "    region\n    {\n        x               1;\n    }\n}\n"
    );
    EXPECT_EQ(file(), text_);
}

TEST_F(CaseDictionary, SetChangesTheValueAlone)
{
    EXPECT_EQ(run("constant/wettability -entry floor.theta -set 30").status, 0);
    std::string expected = text_;
    expected.replace(expected.find("$base"), 5, "30");
    EXPECT_EQ(file(), expected);
    EXPECT_EQ(folder_.list("constant"), std::vector<std::string>{"wettability"});       // no temporary file is left

    EXPECT_EQ(run("constant/wettability -entry base -set -1.5e-3").status, 0);
    EXPECT_EQ(run("constant/wettability -entry base -value").output, "-1.5e-3\n");
    EXPECT_EQ(run("constant/wettability -entry base -set '{ c (1 2 3); }'").status, 0);
    EXPECT_EQ(run("constant/wettability -entry base.c -value").output, "(1 2 3)\n");
}

TEST_F(CaseDictionary, AddAndRemoveKeepEverythingElse)
{
    EXPECT_EQ(run("constant/wettability -entry floor.region.y -add 2").status, 0);
    EXPECT_EQ(run("constant/wettability -entry roof -add '{ theta 90; }'").status, 0);
    std::string expected = text_;
    expected.replace(expected.find("{x 1;}"), 6, "{x 1; y 2; }");
    expected.insert(expected.find("// end"), "roof { theta 90; }\n");
    EXPECT_EQ(file(), expected);
    EXPECT_EQ(run("constant/wettability -entry roof.theta -value").output, "90\n");

    EXPECT_EQ(run("constant/wettability -entry floor.region.y -remove").status, 0);
    EXPECT_EQ(run("constant/wettability -entry roof -remove").status, 0);
    expected = text_;
    expected.replace(expected.find("{x 1;}"), 6, "{x 1; }");
    EXPECT_EQ(file(), expected);
}

TEST_F(CaseDictionary, RefusesAndLeavesTheFileAlone)
{
    const auto refuses = [&](const std::string& arguments, const std::vector<std::string>& parts)
    {
        const Result result = run(arguments);
        EXPECT_EQ(result.status, 1) << arguments;
        EXPECT_TRUE(holds(result.output, parts)) << arguments;
        EXPECT_EQ(file(), text_) << arguments;
    };
    refuses("constant/wettability -entry floor.teta -set 30",
        {"FATAL IO ERROR", "Did you mean 'theta'?", "at line 3."});
    refuses("constant/wettability -entry floor.teta", {"Did you mean 'theta'?"});
    refuses("constant/wettability -entry floor.theta -add 30", {"is there already", "at line 5."});
    refuses("constant/wettability -entry floor.theta -set '30; x 1'", {"is not one entry"});
    refuses("constant/wettability -entry roof -remove", {"'roof' is not written"});
    refuses("constant/wettability -set 30", {"-set has no -entry"});
    refuses("constant/wettability -entry base -set 1 -remove", {"exclude each other"});
    refuses("constant/absent", {"Cannot open", "absent"});
    refuses("", {"No dictionary is given"});

    folder_.write("constant/broken", "a 1;\nb { c 2 }\n");
    refuses("constant/broken -entry a -set 2", {"broken at line 2.", "a ';' before '}'"});
}
