// SPDX-License-Identifier: GPL-3.0-or-later
// Studies: the grid, the cases that are made of it, and what is refused.

#include "study/Gnuplot.H"
#include "study/StudyCase.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <cstdlib>

namespace shizuku::test
{

namespace
{

const std::string head = "case\n{\n    layers (\"base\");\n    valuesFile \"values\";\n";

class StudyOf : public testing::Test
{
protected:
    StudyOf()
    {
        folder_.write("values", "particles 100;\nvolume 8;\nspacing #calc \"pow($volume/$particles, 1.0/3)\";\nset default;\n");
        folder_.write("base/system/solution", "spacing @spacing@;\npressure { tolerance 1e-3; }\n");
        folder_.write("base/Allrun", "#!/bin/sh\n");
        std::filesystem::permissions(folder_.path()/"base/Allrun", std::filesystem::perms::owner_all);
        folder_.write("sets/default/models", "pressure a;\n");
        folder_.write("sets/other/models", "pressure b;\n");
        folder_.write("over/system/solution", "spacing 7;\n");
    }

    Study study(const std::string& rest, const std::string& variant = "") const
    {
        return Study::read(folder_.write("studyDict", head + rest), variant);
    }
    std::string refusal(const std::string& rest) const
    {
        return messageOf([&] { const Study s = study(rest); for (const StudyRun& run : runsOf(s)) composeCase(s, run); });
    }

    ScratchFolder folder_;
};

TEST_F(StudyOf, TheGridIsEveryCombination)
{
    const Study s = study("}\naxes { particles (1 8); set (default other); }\n");
    const std::vector<StudyRun> runs = runsOf(s);
    ASSERT_EQ(runs.size(), 4u);
    EXPECT_EQ(runs[0].name, "1-default");
    EXPECT_EQ(runs[1].name, "1-other");
    EXPECT_EQ(runs[3].name, "8-other");
    EXPECT_EQ(s.axis({"set", {}}), 1u);
}

// All combinations stand in memory before some are left out.
TEST_F(StudyOf, AGridWithoutEndIsRefused)
{
    std::string axes;
    for (const char* word : {"particles", "volume", "spacing", "set", "more"}) axes += std::string(word) + " (1 2 3 4 5 6 7 8 9 10 11); ";
    folder_.write("values", "particles 1;\nvolume 1;\nspacing 1;\nset 1;\nmore 1;\n");
    const std::string found = messageOf([&] { runsOf(study("}\naxes { " + axes + "}\n")); });
    EXPECT_TRUE(holds(found, {"14641 combinations before the axis 'more' of 11 choices", "at most 100000"})) << found;
}

TEST_F(StudyOf, ValuesFollowTheChoice)
{
    const Study s = study("folders { m \"sets/@set@\"; }\n}\naxes { particles (1 8); set (other); }\n");
    const StudyCase first = composeCase(s, runsOf(s)[0]), second = composeCase(s, runsOf(s)[1]);
    EXPECT_EQ(first.files.at("system/solution").text, "spacing 2;\npressure { tolerance 1e-3; }\n");    // (8/1)^(1/3)
    EXPECT_EQ(second.files.at("system/solution").text, "spacing 1;\npressure { tolerance 1e-3; }\n");
    EXPECT_EQ(first.files.at("m/models").text, "pressure b;\n");
    EXPECT_NE(first.digest(), second.digest());
    EXPECT_EQ(first.digest(), composeCase(s, runsOf(s)[0]).digest());
    EXPECT_EQ(first.values.at("particles"), "1");

    second.write(folder_.path()/"made");
    EXPECT_EQ(folder_.read("made/system/solution"), "spacing 1;\npressure { tolerance 1e-3; }\n");
    EXPECT_NE(std::filesystem::status(folder_.path()/"made/Allrun").permissions() & std::filesystem::perms::owner_exec, std::filesystem::perms::none);
}

TEST_F(StudyOf, ChoicesGiveEntriesAndLayers)
{
    const Study s = study
    (
        "}\naxes { how { loose { set { system/solution { pressure/tolerance \"@volume@\"; } } } "
        "coarse { layers (\"over\"); values { volume 1; } } } }\n"
    );
    EXPECT_TRUE(holds(composeCase(s, runsOf(s)[0]).files.at("system/solution").text, {"{ tolerance 8; }"}));
    EXPECT_EQ(composeCase(s, runsOf(s)[1]).files.at("system/solution").text, "spacing 7;\n");
    EXPECT_EQ(composeCase(s, runsOf(s)[1]).values.at("volume"), "1");
}

// What a dictionary takes in quotes alone, and a backslash, which stays one.
TEST_F(StudyOf, ValuesKeepTheirText)
{
    folder_.write("base/note", "@set@\n");
    const Study s = study("}\naxes { set (\"a \\d \\\"b\\\"\" \"(1 2)\" \"\"); }\n");
    EXPECT_EQ(composeCase(s, runsOf(s)[0]).files.at("note").text, "a \\d \"b\"\n");
    EXPECT_EQ(composeCase(s, runsOf(s)[1]).files.at("note").text, "(1 2)\n");
    EXPECT_EQ(composeCase(s, runsOf(s)[2]).files.at("note").text, "\n");
}

TEST_F(StudyOf, NumbersOfItsTexts)
{
    const std::map<std::string, std::string> words{{"theta", "-1e2"}, {"set", "12 degrees"}};
    EXPECT_EQ(numberOf({"@theta@", {}}, words), -100);
    EXPECT_TRUE(holds(messageOf([&] { numberOf({"@set@", {"studyDict", 3}}, words); }), {"'12 degrees' is no number", "studyDict at line 3"}));
}

TEST_F(StudyOf, AVariantReplacesChoicesAndValues)
{
    const std::string rest = "}\naxes { particles (1 8); set (default other); }\n"
                             "variants { quick { axes { particles (64); set (other); } values { volume 64; } } }\n";
    EXPECT_EQ(runsOf(study(rest)).size(), 4u);
    const Study s = study(rest, "quick");
    ASSERT_EQ(runsOf(s).size(), 1u);
    EXPECT_EQ(runsOf(s)[0].name, "64-other");
    EXPECT_TRUE(holds(composeCase(s, runsOf(s)[0]).files.at("system/solution").text, {"spacing 1;"}));
    EXPECT_TRUE(holds(messageOf([&] { study(rest, "quik"); }), {"no variant 'quik'", "Did you mean 'quick'?"}));
}

TEST_F(StudyOf, AVariantMayHaveAnAxisOfItsOwn)
{
    const auto variants = [](const std::string& axis)
    {
        return "}\naxes { set (default other); }\nvariants { wide { axes { " + axis + " (1 8); set (other); } } }\n";
    };
    EXPECT_EQ(runsOf(study(variants("volume"))).size(), 2u);
    const std::vector<StudyRun> runs = runsOf(study(variants("volume"), "wide"));
    ASSERT_EQ(runs.size(), 2u);
    EXPECT_EQ(runs[1].name, "other-8");
    EXPECT_TRUE(holds(messageOf([&] { study(variants("volum"), "wide"); }), {"no value 'volum'", "Did you mean 'volume'?"}));
}

TEST_F(StudyOf, AVariantsLeftOutRunsStandInPlaceOfTheStudys)
{
    const std::string rest = "}\naxes { volume (1 8); set (default other); }\nleaveOut { one { volume (1); set (other); } }\n"
                             "variants { few { axes { volume (8 27); } leaveOut { all { set (other); } } } same { values { particles 50; } } }\n";
    EXPECT_EQ(runsOf(study(rest)).size(), 3u);
    EXPECT_EQ(runsOf(study(rest, "same")).size(), 3u);
    EXPECT_EQ(runsOf(study(rest, "few")).size(), 2u);
    const std::string wrong = "}\naxes { volume (1 8); }\nvariants { few { leaveOut { one { volume (2); } } } odd { axis { volume (1); } } }\n";
    EXPECT_TRUE(holds(messageOf([&] { study(wrong, "few"); }), {"'2'", "8"}));
    EXPECT_TRUE(holds(messageOf([&] { study(wrong, "odd"); }), {"axis"}));
    EXPECT_EQ(runsOf(study(wrong)).size(), 2u);
}

TEST_F(StudyOf, LeavesOutWhatAllAxesOfARuleHold)
{
    const std::string axes = "}\naxes { particles (1 8 64); set (default other); }\n";
    const std::vector<StudyRun> runs = runsOf(study(axes + "leaveOut { slow { particles (8 64); set (other); } }\n"));
    ASSERT_EQ(runs.size(), 4u);
    EXPECT_EQ(runs[1].name, "1-other");
    EXPECT_EQ(runs[3].name, "64-default");
    EXPECT_TRUE(holds(refusal(axes + "leaveOut { a { particles (9); } }\n"), {"Axis 'particles' has no choice '9'", "line 7"}));
    EXPECT_TRUE(holds(refusal(axes + "leaveOut { a { set (default other); } }\n"), {"the grid is empty"}));
}

TEST_F(StudyOf, RefusesWhatIsWrongWithFileAndLine)
{
    EXPECT_TRUE(holds(refusal("}\naxes { particles (); }\n"), {"Axis 'particles' has no choice", "the grid is empty", "studyDict at line 6"}));
    EXPECT_TRUE(holds(refusal("}\naxes { }\n"), {"There is no axis", "the grid is empty"}));
    EXPECT_TRUE(holds(refusal("}\naxes { particles (1 1); }\n"), {"has the choice '1' twice"}));
    EXPECT_TRUE(holds(refusal("}\naxes { partickles (1); }\n"), {"no value 'partickles'", "line 6", "Did you mean 'particles'?", "volume"}));
    EXPECT_TRUE(holds(refusal("set { system/solution { pressure/tolerence 1; } }\n}\naxes { particles (1); }\n"),
        {"no entry 'pressure/tolerence'", "studyDict at line 5", "Did you mean 'tolerance'?"}));
    EXPECT_TRUE(holds(refusal("set { system/solutions { spacing 1; } }\n}\naxes { particles (1); }\n"),
        {"no file 'system/solutions'", "Did you mean 'system/solution'?"}));
    EXPECT_TRUE(holds(refusal("folders { m \"sets/@set@\"; }\n}\naxes { set (absent); }\n"), {"There is no folder", "sets/absent", "line 5"}));
    folder_.write("base/system/more", "\nx @nothing@;\n");
    EXPECT_TRUE(holds(refusal("}\naxes { particles (1); }\n"), {"The word @nothing@ has no value", "base/system/more at line 2"}));
}

TEST(Gnuplot, DrawsInFoldersOfAnyName)
{
    const ScratchFolder folder;
    folder.write("it's 'here'/empty", "");
    drawChart(folder.path()/"it's 'here'"/"chart", "plot sin(x)");
    EXPECT_TRUE(std::filesystem::exists(folder.path()/"it's 'here'"/"chart.gnuplot"));
    const bool draws = std::system("command -v gnuplot >/dev/null") == 0;
    EXPECT_EQ(std::filesystem::exists(folder.path()/"it's 'here'"/"chart.png"), draws);
}

}

}
