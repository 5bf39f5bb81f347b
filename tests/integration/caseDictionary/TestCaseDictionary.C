// SPDX-License-Identifier: GPL-3.0-or-later
// The application as a user runs it: what it prints, what it leaves in the file, how it fails.

#include "support/Programs.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

class CaseDictionary : public testing::Test
{
protected:
    // Arguments as in a shell, without the name of the application.
    Outcome run(const std::string& arguments) const
    {
        return test::run(program("caseDictionary") + " -case " + folder_.path().string() + " " + arguments);
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
    const Outcome result = run("constant/wettability");
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.text, text_);
}

TEST_F(CaseDictionary, PrintsExpandedEntriesValuesKeywordsAndJson)
{
    EXPECT_EQ(run("constant/wettability -entry floor.theta").text, "theta           60;\n");
    EXPECT_EQ(run("constant/wettability -entry floor/theta -value").text, "60\n");
    EXPECT_EQ(run("constant/wettability -keywords").text, "base\nfloor\n");
    EXPECT_EQ(run("constant/wettability -entry floor -keywords").text, "theta\nregion\n");
    EXPECT_EQ(run("constant/wettability -entry floor.region -json").text, "{\n    \"x\": 1\n}\n");
    EXPECT_EQ
    (
        run("constant/wettability -expand").text,
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
    EXPECT_EQ(run("constant/wettability -entry base -value").text, "-1.5e-3\n");
    EXPECT_EQ(run("constant/wettability -entry base -set '{ c (1 2 3); }'").status, 0);
    EXPECT_EQ(run("constant/wettability -entry base.c -value").text, "(1 2 3)\n");
}

// What was meant may be written with a slip: the word is kept, and told.
TEST_F(CaseDictionary, AWordInPlaceOfANumberIsWarnedOf)
{
    EXPECT_TRUE(run("constant/wettability -entry base -set 50").text.empty());
    const Outcome slip = run("constant/wettability -entry base -set abc");
    EXPECT_EQ(slip.status, 0);
    EXPECT_TRUE(holds(slip.text, {"WARNING: Entry 'base' was the number 50, and is the word 'abc' now"}));
    EXPECT_TRUE(run("constant/wettability -entry base -set '#calc \"40+5\"'").text.empty());
}

TEST_F(CaseDictionary, AddAndRemoveKeepEverythingElse)
{
    EXPECT_EQ(run("constant/wettability -entry floor.region.y -add 2").status, 0);
    EXPECT_EQ(run("constant/wettability -entry roof -add '{ theta 90; }'").status, 0);
    std::string expected = text_;
    expected.replace(expected.find("{x 1;}"), 6, "{x 1; y 2; }");
    expected.insert(expected.find("// end"), "roof { theta 90; }\n");
    EXPECT_EQ(file(), expected);
    EXPECT_EQ(run("constant/wettability -entry roof.theta -value").text, "90\n");

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
        const Outcome result = run(arguments);
        EXPECT_EQ(result.status, 1) << arguments;
        EXPECT_TRUE(holds(result.text, parts)) << arguments;
        EXPECT_EQ(file(), text_) << arguments;
    };
    refuses("constant/wettability -entry floor.teta -set 30",
        {"FATAL IO ERROR", "Did you mean 'theta'?", "at line 3.", "-add in place of -set"});
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

TEST_F(CaseDictionary, LooksForDefaultsInItsOwnInstallationLast)
{
    // An installation of its own: a copy of the program, the libraries beside it linked to.
    const std::filesystem::path folder = folder_.path(), build = folder/"installation/build";
    std::filesystem::create_directories(build/"bin");
    std::filesystem::copy_file(program("caseDictionary"), build/"bin/caseDictionary");
    std::filesystem::create_directory_symlink(environment("SHIZUKU_BUILD") + "/lib", build/"lib");
    std::filesystem::create_symlink(build/"bin/caseDictionary", folder/"link");
    folder_.write("installation/etc/liquids/water", "rho 3;");
    folder_.write("dir/etc/liquids/water", "rho 2;");
    folder_.write("home/.shizuku/liquids/water", "rho 1;");

    // What a path to the program prints under environment variables, paths from the folder.
    const auto rho = [&](const std::string& variables, const std::string& path)
    {
        return test::run("cd " + folder.string() + " && env -u SHIZUKU_DIR -u HOME " + variables + " ./" + path
            + " dictionary -entry rho -value").text;
    };
    const std::string copy = "installation/build/bin/caseDictionary";
    folder_.write("dictionary", "#includeEtc \"liquids/water\"\n");
    EXPECT_EQ(rho("", copy), "3\n");
    EXPECT_EQ(rho("", "link"), "3\n");
    EXPECT_EQ(rho("SHIZUKU_DIR= HOME=", copy), "3\n");
    EXPECT_EQ(rho("SHIZUKU_DIR=/nowhere HOME=/nowhere", copy), "3\n");
    EXPECT_EQ(rho("SHIZUKU_DIR=$PWD/dir", copy), "2\n");
    EXPECT_EQ(rho("SHIZUKU_DIR=$PWD/dir HOME=$PWD/home", copy), "1\n");

    folder_.write("dictionary", "#includeEtc \"liquids/wine\"\n");
    EXPECT_TRUE(holds
    (
        rho("SHIZUKU_DIR=/nowhere HOME=/none", copy),
        {"liquids/wine", "at line 1.", "/none/.shizuku, /nowhere/etc, " + (folder/"installation/etc").string()}
    ));
}

TEST_F(CaseDictionary, FindsWhatAPatternGives)
{
    folder_.write("constant/wettability", "\".*\" { theta 90; }\nfloor { theta 60; }\n");
    EXPECT_EQ(run("constant/wettability -entry floor.theta -value").text, "60\n");
    EXPECT_EQ(run("constant/wettability -entry roof.theta -value").text, "90\n");
}

TEST_F(CaseDictionary, SetsWhatAnIncludeGives)
{
    folder_.write("constant/common", "cell 0.5;\nouter { inner { a 1; b 2; } }\n");
    folder_.write("constant/wettability", "#include \"common\"\n");
    EXPECT_EQ(run("constant/wettability -entry cell -set 0.2").status, 0);
    EXPECT_EQ(run("constant/wettability -entry outer.inner.a -set 7").status, 0);
    EXPECT_EQ(run("constant/wettability -entry cell -value").text, "0.2\n");
    EXPECT_EQ(run("constant/wettability -entry outer.inner.a -value").text, "7\n");
    EXPECT_EQ(run("constant/wettability -entry outer.inner.b -value").text, "2\n");
    EXPECT_EQ(folder_.read("constant/common"), "cell 0.5;\nouter { inner { a 1; b 2; } }\n");
    EXPECT_NE(run("constant/wettability -entry nowhere -set 7").status, 0);
}
