// SPDX-License-Identifier: GPL-3.0-or-later
// The grammar: what is read, and what is refused with which line.

#include "core/dictionary/Dictionary.H"
#include "support/ScratchFolder.H"
#include "unit/core/dictionary/Refused.H"

#include <gtest/gtest.h>

using namespace shizuku;
using namespace shizuku::test;
using Vector = std::array<double, 3>;

TEST(Grammar, ReadsHeaderCommentsAndNestedDictionaries)
{
    const Dictionary dict = Dictionary::parse
    (
        "/*--- a banner ---*\\\n  with { brackets ( and \"quotes\n\\*---*/\n"
        "FoamFile { version 2.0; format ascii; class dictionary; object x; }\n"
        "// * * * //\n"
        "outer // the outer one\n"
        "{\n"
        "    inner { depth /* two */ 2; };\n"
        "    empty { }\n"
        "    flag;\n"
        "}"
    );
    EXPECT_EQ(dict.keys(), std::vector<std::string>{"outer"});
    EXPECT_EQ(dict.subDict("FoamFile").lookup<std::string>("format"), "ascii");
    const Dictionary outer = dict.subDict("outer");
    EXPECT_EQ(outer.keys(), (std::vector<std::string>{"inner", "empty", "flag"}));
    EXPECT_EQ(outer.subDict("inner").lookup<int>("depth"), 2);
    EXPECT_TRUE(outer.subDict("empty").keys().empty());
    EXPECT_TRUE(outer.found("flag"));
}

TEST(Grammar, KnowsFileLineAndName)
{
    const Dictionary dict = Dictionary::parse("a 1;\n\nfloor\n{\n    theta\n        60;\n}\n", "constant/wettability");
    EXPECT_EQ(dict.where("floor").file, "constant/wettability");
    EXPECT_EQ(dict.where("floor").line, 3);
    EXPECT_EQ(dict.subDict("floor").where("theta").line, 5);
    EXPECT_EQ(dict.subDict("floor").where().line, 3);
    EXPECT_EQ(dict.subDict("floor").name(), "constant/wettability/floor");
}

TEST(Grammar, ReadsEveryFormOfLists)
{
    const Dictionary dict = Dictionary::parse
    (
        "plain (1 2.5 -3e2);  sized 3(1 2 3);  apart 2 (4 5);  uniform 4{0.5};  nothing ();  none 0();\n"
        "typed List<vector> 2 ((0 0 1) (0 0 2));\n"
        "field nonuniform List<scalar>\n3\n(\n7\n8\n9\n)\n;\n"
        "emptyField nonuniform List<scalar> 0;\n"
        "words (a \"b c\" d(e,f));  labels (1 -2 +3);  switches (on no);\n"
        "dicts ( first { x 1; } second { x 2; } { x 3; } );  deep ( ( (1) 2(3 4) ) );\n"
    );
    EXPECT_EQ(dict.lookup<std::vector<double>>("plain"), (std::vector<double>{1, 2.5, -300}));
    EXPECT_EQ(dict.lookup<std::vector<int>>("sized"), (std::vector<int>{1, 2, 3}));
    EXPECT_EQ(dict.lookup<std::vector<double>>("apart"), (std::vector<double>{4, 5}));
    EXPECT_EQ(dict.lookup<std::vector<double>>("uniform"), (std::vector<double>{0.5, 0.5, 0.5, 0.5}));
    EXPECT_TRUE(dict.lookup<std::vector<double>>("nothing").empty());
    EXPECT_TRUE(dict.lookup<std::vector<std::string>>("none").empty());
    EXPECT_EQ(dict.lookup<std::vector<Vector>>("typed"), (std::vector<Vector>{{0, 0, 1}, {0, 0, 2}}));
    EXPECT_EQ(dict.lookup<std::vector<double>>("field"), (std::vector<double>{7, 8, 9}));
    EXPECT_TRUE(dict.lookup<std::vector<double>>("emptyField").empty());
    EXPECT_EQ(dict.lookup<std::vector<std::string>>("words"), (std::vector<std::string>{"a", "b c", "d(e,f)"}));
    EXPECT_EQ(dict.lookup<std::vector<long>>("labels"), (std::vector<long>{1, -2, 3}));
    EXPECT_EQ(dict.lookup<std::vector<bool>>("switches"), (std::vector<bool>{true, false}));
    EXPECT_TRUE(dict.found("dicts") && dict.found("deep"));
}

TEST(Grammar, ReadsWordsAsOpenFoamWritesThem)
{
    const Dictionary dict = Dictionary::parse
    (
        "div(phi,U) upwind; div((nuEff*dev2(T(grad(U))))) linear; alpha.water 1; motorBike.stl x; 2D yes; pi() 3;\n"
        "path constant/triSurface/floor.stl; angle 60;//degrees\nlast a/*comment*/;\n"
    );
    EXPECT_EQ(dict.lookup<std::string>("div(phi,U)"), "upwind");
    EXPECT_EQ(dict.lookup<std::string>("div((nuEff*dev2(T(grad(U)))))"), "linear");
    EXPECT_EQ(dict.lookup<int>("alpha.water"), 1);
    EXPECT_EQ(dict.lookup<std::string>("motorBike.stl"), "x");
    EXPECT_TRUE(dict.lookup<bool>("2D"));
    EXPECT_EQ(dict.lookup<int>("pi()"), 3);
    EXPECT_EQ(dict.lookup<std::string>("path"), "constant/triSurface/floor.stl");
    EXPECT_EQ(dict.lookup<double>("angle"), 60);
    EXPECT_EQ(dict.lookup<std::string>("last"), "a");
}

TEST(Grammar, ReadsStringsAndVerbatimText)
{
    const Dictionary dict = Dictionary::parse
    (
        "quote \"a \\\"b\\\" c\"; path \"C:\\dir\"; joined \"one \\\ntwo\"; marks \"; } // no comment\"; none \"\";\n"
        "code #{ if (a) { return \"x; }  // kept\n #};\n"
    );
    EXPECT_EQ(dict.lookup<std::string>("quote"), "a \"b\" c");
    EXPECT_EQ(dict.lookup<std::string>("path"), "C:\\dir");
    EXPECT_EQ(dict.lookup<std::string>("joined"), "one two");
    EXPECT_EQ(dict.lookup<std::string>("marks"), "; } // no comment");
    EXPECT_EQ(dict.lookup<std::string>("none"), "");
    EXPECT_EQ(dict.lookup<std::string>("code"), " if (a) { return \"x; }  // kept\n ");
}

TEST(Grammar, ReadsFilesOfOtherSystems)
{
    const Dictionary dict = Dictionary::parse("\xEF\xBB\xBF" "a 1;\r\nb { c 2; }\r\n");    // UTF-8 mark, CR LF
    EXPECT_EQ(dict.lookup<int>("a"), 1);
    EXPECT_EQ(dict.where("b").line, 2);
    EXPECT_EQ(dict.subDict("b").lookup<int>("c"), 2);
    EXPECT_TRUE(Dictionary::parse("").keys().empty());
    EXPECT_TRUE(Dictionary::parse("// nothing but a comment").keys().empty());
}

TEST(Grammar, LastOfRepeatedEntriesStaysAndDictionariesMerge)
{
    const Dictionary dict = Dictionary::parse("a 1; d { x 1; y 2; } a 2; d { y 3; z 4; } e 1; e { f 5; }");
    EXPECT_EQ(dict.lookup<int>("a"), 2);
    EXPECT_EQ(dict.subDict("d").keys(), (std::vector<std::string>{"x", "y", "z"}));
    EXPECT_EQ(dict.subDict("d").lookup<int>("y"), 3);
    EXPECT_EQ(dict.subDict("e").lookup<int>("f"), 5);
}

struct BadText
{
    const char* name;
    const char* text;
    int line;
    const char* message;
};

class Refuses : public testing::TestWithParam<BadText> {};

TEST_P(Refuses, WithFileLineAndReason)
{
    const Refusal refusal = refusalOfText(GetParam().text);
    EXPECT_EQ(refusal.file, "someDict");
    EXPECT_EQ(refusal.line, GetParam().line) << refusal.message;
    EXPECT_TRUE(holds(refusal.message, {GetParam().message}));
}

INSTANTIATE_TEST_SUITE_P
(
    Grammar, Refuses,
    testing::Values
    (
        BadText{"MissingSemicolonAtBracket", "a 1;\nb\n{\n    rho 998\n}\n", 4, "a ';' before '}' at line 5"},
        BadText{"MissingSemicolonAtEnd", "a 1;\nb 2", 2, "a ';' before the end of the file"},
        BadText{"MissingSemicolonBeforeDictionary", "a 1\nb { c 2; }", 1, "The entry 'a' has no end"},
        BadText{"UnclosedBrace", "a\n{\n    b 1;\n", 2, "Unclosed '{'"},
        BadText{"UnclosedList", "a 1;\nb (1 2;\n", 2, "Unclosed '('"},
        BadText{"UnclosedDimensions", "a 1;\n\nb [0 1 2 1e-6;\n", 3, "Unclosed '['"},
        BadText{"WrongPartner", "a\n{\n b (1 2 }\n", 3, "does not close the '(' of line 3"},
        BadText{"ClosesNothing", "a 1;\n}\n", 2, "closes nothing"},
        BadText{"UnclosedString", "a 1;\nb \"text;\n", 2, "Unclosed string"},
        BadText{"UnclosedComment", "a 1;\n/* b 2;\n", 2, "Unclosed comment"},
        BadText{"UnclosedVerbatim", "a 1;\nb #{ text;\n", 2, "Unclosed verbatim"},
        BadText{"NumberAsKeyword", "a 1;\n5 b;\n", 2, "A keyword was expected where '5' at line 2"},
        BadText{"ListWithoutKeyword", "(1 2 3)\n", 1, "A keyword was expected"},
        BadText{"SemicolonInList", "a (1 2;\n 3);\n", 1, "Unexpected ';'"},
        BadText{"Apostrophe", "a 'b';\n", 1, "The entry 'a' has no end"}
    ),
    [](const auto& info) { return info.param.name; }
);

TEST(Grammar, RefusesBinaryLists)
{
    const std::string text("a 1;\nU 1(\x00\x00\x80\x3f);\n", 17);
    const Refusal refusal = refusalOfText(text);
    EXPECT_EQ(refusal.line, 2);
    EXPECT_TRUE(holds(refusal.message, {"no text", "field files"}));
}

TEST(Grammar, RefusesFilesThatCannotBeRead)
{
    const ScratchFolder folder;
    EXPECT_TRUE(holds(messageOf([&] { Dictionary::read(folder.path()/"absent"); }), {"Cannot open", "absent"}));
    EXPECT_TRUE(holds(messageOf([&] { Dictionary::read(folder.path()); }), {"Cannot open"}));
}

TEST(Grammar, BearsDeepNestingAndRefusesMore)
{
    const auto nested = [](int depth)
    {
        return "a 1;\nb " + std::string(depth, '(') + "1" + std::string(depth, ')') + ";";
    };
    EXPECT_TRUE(Dictionary::parse(nested(200)).found("b"));
    EXPECT_EQ(refusalOfText(nested(201)).line, 2);
    EXPECT_EQ(refusalOfText(nested(1000000)).line, 2);
}
