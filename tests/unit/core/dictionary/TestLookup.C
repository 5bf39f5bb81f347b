// SPDX-License-Identifier: GPL-3.0-or-later
// Lookups: types, dimensions, choices, patterns, what is asked for and not there.

#include "core/dictionary/Dictionary.H"
#include "support/ScratchFolder.H"
#include "unit/core/dictionary/Refused.H"

#include <gtest/gtest.h>

using namespace shizuku;
using namespace shizuku::test;
using Vector = std::array<double, 3>;

TEST(Lookup, ReadsEveryType)
{
    const Dictionary dict =
        Dictionary::parse("x -1.5e-3; n 42; big 5000000000; on yes; w word; s \"a string\"; v (1 -2 3e1);");
    EXPECT_EQ(dict.lookup<double>("x"), -1.5e-3);
    EXPECT_EQ(dict.lookup<int>("n"), 42);
    EXPECT_EQ(dict.lookup<double>("n"), 42);
    EXPECT_EQ(dict.lookup<long>("big"), 5000000000L);
    EXPECT_TRUE(dict.lookup<bool>("on"));
    EXPECT_EQ(dict.lookup<std::string>("w"), "word");
    EXPECT_EQ(dict.lookup<std::string>("s"), "a string");
    EXPECT_EQ(dict.lookup<Vector>("v"), (Vector{1, -2, 30}));
    EXPECT_EQ(dict.lookupOr<int>("n", 7), 42);
    EXPECT_EQ(dict.lookupOr<int>("absent", 7), 7);
    EXPECT_EQ(dict.lookupOr<std::string>("absent", "other"), "other");
}

TEST(Lookup, ReadsDimensionedEntries)
{
    const Dictionary dict = Dictionary::parse
    (
        "bare 998; sized [1 -3 0 0 0 0 0] 998; named rho [1 -3 0 0 0 0 0] 998; "
        "five [1 -3 0 0 0] 998; units [kg/m^3] 998;\n"
        "g g [0 1 -2 0 0 0 0] (0 0 -9.81); dimensions [m/s];"
    );
    for (const char* key : {"bare", "sized", "named", "five", "units"})
    {
        EXPECT_EQ(dict.lookupDimensioned(key, dimensions::density), 998) << key;
    }
    EXPECT_EQ(dict.lookupDimensionedVector("g", dimensions::acceleration), (Vector{0, 0, -9.81}));
    EXPECT_EQ(dict.lookupDimensionedOr("absent", dimensions::density, 5), 5);
    EXPECT_EQ(dict.lookupDimensions("dimensions"), dimensions::velocity);
}

TEST(Lookup, RefusesWrongDimensions)
{
    const Dictionary dict =
        Dictionary::parse("a 1;\nnu [0 2 -2 0 0 0 0] 1e-6;\nbad [0 2] 1;\nunit [furlong] 1;", "someDict");
    const Refusal refusal = refusalOf([&] { dict.lookupDimensioned("nu", dimensions::kinematicViscosity); });
    EXPECT_EQ(refusal.line, 2);
    EXPECT_TRUE(holds(refusal.message, {"someDict", "[0 2 -2 0 0 0 0]", "[0 2 -1 0 0 0 0]"}));
    EXPECT_EQ(refusalOf([&] { dict.lookupDimensioned("bad", dimensions::length); }).line, 3);
    EXPECT_EQ(refusalOf([&] { dict.lookupDimensioned("unit", dimensions::length); }).line, 4);
}

TEST(Lookup, RefusesWhatIsNotPositive)
{
    const Dictionary dict = Dictionary::parse("a 0;\nb -1;\nc nan;\nd inf;\ne 2;", "someDict");
    EXPECT_EQ(dict.lookupPositive("e", dimensions::length), 2);
    EXPECT_EQ(dict.lookupPositive("a", dimensions::length, true), 0);
    EXPECT_EQ(refusalOf([&] { dict.lookupPositive("a", dimensions::length); }).line, 1);
    EXPECT_EQ(refusalOf([&] { dict.lookupPositive("b", dimensions::length, true); }).line, 2);
    EXPECT_EQ(refusalOf([&] { dict.lookupPositive("c", dimensions::length); }).line, 3);
    EXPECT_EQ(refusalOf([&] { dict.lookupPositive("d", dimensions::length); }).line, 4);
}

TEST(Lookup, RefusesWrongTypes)
{
    const Dictionary dict = Dictionary::parse
    (
        "word abc;\nreal 1.5;\nhuge 3000000000;\ntwo 1 2;\nnone;\nshort (1 2);\n"
        "d { }\nlist 3(1 2);\nmixed (1 a);\nover 1e999;",
        "someDict"
    );
    const auto lineOf = [](const auto& call) { return refusalOf(call).line; };
    EXPECT_EQ(lineOf([&] { dict.lookup<double>("word"); }), 1);
    EXPECT_EQ(lineOf([&] { dict.lookup<bool>("word"); }), 1);
    EXPECT_EQ(lineOf([&] { dict.lookup<int>("real"); }), 2);
    EXPECT_EQ(lineOf([&] { dict.lookup<int>("huge"); }), 3);
    EXPECT_EQ(lineOf([&] { dict.lookup<double>("two"); }), 4);
    EXPECT_EQ(lineOf([&] { dict.lookup<double>("none"); }), 5);
    EXPECT_EQ(lineOf([&] { dict.lookup<Vector>("short"); }), 6);
    EXPECT_EQ(lineOf([&] { dict.lookup<double>("d"); }), 7);
    EXPECT_EQ(lineOf([&] { dict.lookup<std::vector<int>>("list"); }), 8);
    EXPECT_EQ(lineOf([&] { dict.lookup<std::vector<double>>("mixed"); }), 9);
    EXPECT_EQ(lineOf([&] { dict.lookup<double>("over"); }), 10);
    EXPECT_EQ(lineOf([&] { dict.subDict("word"); }), 1);
}

TEST(Lookup, RefusesNumbersThatAreNotFinite)
{
    const Dictionary dict = Dictionary::parse
    (
        "a nan;\nb -inf;\npoint (0 0 nan);\nlist (1 inf);\nplaces ((0 0 0) (0 nan 0));\ng [0 1 -2 0 0 0 0] (0 0 nan);\n"
        "flat (0 0 0);\nsome 2((0 0 0) (0 a 0));",
        "someDict"
    );
    const auto expectRefusal = [](int line, const std::string& found, const std::string& expected, const auto& call)
    {
        const Refusal refusal = refusalOf(call);
        EXPECT_EQ(refusal.line, line);
        EXPECT_TRUE(holds(refusal.message, {found, "Expected: " + expected}));
    };
    const std::string finite = "a finite number\n";
    expectRefusal(1, "'a': found nan", finite, [&] { dict.lookup<double>("a"); });
    expectRefusal(2, "'b': found -inf", finite, [&] { dict.lookupPositive("b", dimensions::length); });
    expectRefusal(3, "'point': found nan", finite, [&] { dict.lookup<Vector>("point"); });
    expectRefusal(4, "'list': found inf", finite, [&] { dict.lookup<std::vector<double>>("list"); });
    expectRefusal(5, "'places': found nan", finite, [&] { dict.lookup<std::vector<Vector>>("places"); });
    expectRefusal(6, "'g': found nan", finite, [&] { dict.lookupDimensionedVector("g", dimensions::acceleration); });
    // Whatever is wrong deep in a list, the entry is named.
    expectRefusal(7, "'flat': found the number 0", "a list of vectors", [&] { dict.lookup<std::vector<Vector>>("flat"); });
    expectRefusal(8, "'some': found the word 'a'", "a list of vectors", [&] { dict.lookup<std::vector<Vector>>("some"); });
}

TEST(Lookup, SuspectsAMissingSemicolon)
{
    const Dictionary dict = Dictionary::parse("a 1;\nrho 998\nnu 1e-6;\n", "someDict");
    const Refusal refusal = refusalOf([&] { dict.lookup<double>("rho"); });
    EXPECT_EQ(refusal.line, 2);
    EXPECT_TRUE(holds(refusal.message, {"'nu' follows the value", "a ';' may be missing"}));
}

// A slip is told by its own line. An entry that was asked for is none, however near.
TEST(Lookup, NamesTheMisspeltKeywordFirst)
{
    const Dictionary dict = Dictionary::parse("a 1;\nliquid\n{\n    densty 998;\n    nu 1e-6;\n}\n", "constant/liquid");
    const Refusal refusal = refusalOf([&] { dict.subDict("liquid").lookup<double>("density"); });
    EXPECT_EQ(refusal.line, 4);
    EXPECT_TRUE(refusal.message.starts_with("Entry 'densty' in dictionary \"constant/liquid/liquid\": did you mean 'density'? That is missing\n"));
    EXPECT_FALSE(holds(refusal.message, {"Valid choices"}));

    const Dictionary points = Dictionary::parse("point1 1;\nother 2;\n", "someDict");
    points.lookup<double>("point1");
    const Refusal missing = refusalOf([&] { points.lookup<double>("point2"); });
    EXPECT_EQ(missing.line, 1);
    EXPECT_TRUE(holds(missing.message, {"Entry 'point2' is missing in dictionary \"someDict\"", "beside the entries that are there: point1, other"}));
}

TEST(Lookup, OffersChoices)
{
    const Dictionary dict = Dictionary::parse("startFrom latestTme;\nstopAt endTime;", "someDict");
    EXPECT_EQ(dict.lookupChoice("stopAt", {"endTime", "writeNow"}), "endTime");
    EXPECT_EQ(dict.lookupChoiceOr("absent", {"a", "b"}, "b"), "b");
    const Refusal refusal =
        refusalOf([&] { dict.lookupChoice("startFrom", {"startTime", "latestTime", "firstTime"}); });
    EXPECT_EQ(refusal.line, 1);
    EXPECT_TRUE(holds(refusal.message,
        {"latestTme", "Did you mean 'latestTime'?", "    firstTime\n    latestTime\n    startTime\n"}));
}

TEST(Lookup, MatchesPatternsExactFirstThenTheLast)
{
    const Dictionary dict = Dictionary::parse
    (
        "\".*\" any; \"[n-z].*\" late; \"(U|k)\" { tolerance 1e-6; } U { tolerance 1e-8; } keyX exact;"
    );
    EXPECT_EQ(dict.subDict("U").lookup<double>("tolerance"), 1e-8);
    EXPECT_EQ(dict.subDict("k").lookup<double>("tolerance"), 1e-6);
    EXPECT_EQ(dict.lookup<std::string>("keyX"), "exact");
    EXPECT_EQ(dict.lookup<std::string>("keyY"), "any");
    EXPECT_EQ(dict.lookup<std::string>("pressure"), "late");
    EXPECT_EQ(dict.lookup<std::string>("[n-z].*"), "late");     // its own text, as keys() gives it

    const Dictionary bad = Dictionary::parse("a 1;\n\"(U|k\" 2;", "someDict");
    EXPECT_EQ(refusalOf([&] { bad.found("k"); }).line, 2);
}

TEST(Lookup, GivesEmptyDictionariesForAbsentOnes)
{
    const Dictionary dict = Dictionary::parse("a { b 1; } c 2;");
    EXPECT_EQ(dict.subDictOrEmpty("a").lookup<int>("b"), 1);
    EXPECT_TRUE(dict.subDictOrEmpty("absent").keys().empty());
    EXPECT_EQ(refusalOf([&] { dict.subDictOrEmpty("c"); }).line, 1);
    EXPECT_TRUE(dict.isDict("a"));
    EXPECT_FALSE(dict.isDict("c"));
    EXPECT_FALSE(dict.isDict("absent"));
    EXPECT_TRUE(Dictionary().keys().empty());
}

TEST(Usage, RefusesWhatNobodyRead)
{
    const Dictionary dict = Dictionary::parse
    (
        "FoamFile { version 2; }\n_note x;\nbase 5;\ncopy $base;\nkernel\n{\n    type spline;\n    suport 2;\n}\n",
            "system/solution"
    );
    dict.lookup<int>("copy");
    const Dictionary kernel = dict.subDict("kernel");
    kernel.lookup<std::string>("type");
    kernel.lookupOr<double>("support", 2);
    const Refusal refusal = refusalOf([&] { dict.refuseUnused(); });
    EXPECT_EQ(refusal.file, "system/solution");
    EXPECT_EQ(refusal.line, 8);
    EXPECT_TRUE(holds(refusal.message, {"'suport'", "system/solution/kernel", "Did you mean 'support'?"}));

    kernel.markUsed();
    EXPECT_NO_THROW(dict.refuseUnused());
}

TEST(Usage, MergedEntriesCountAsUnreadInEachPlace)
{
    const Dictionary dict = Dictionary::parse("defaults { x 1; y 2; }\na { $defaults; }\n", "someDict");
    dict.subDict("a").lookup<int>("x");
    const Refusal refusal = refusalOf([&] { dict.refuseUnused(); });
    EXPECT_TRUE(holds(refusal.message, {"'y'", "someDict/a"}));
    dict.subDict("a").lookup<int>("y");
    EXPECT_NO_THROW(dict.refuseUnused());
}

TEST(Error, LaysOutMessagePlaceExpectationAndChoices)
{
    const FatalInputError error
    (
        {"constant/models", 12}, "Unknown model 'Akinci2031'", "one of the models below", {"none", "Akinci2013"},
            "Akinci2031"
    );
    EXPECT_STREQ
    (
        error.what(),
        "Unknown model 'Akinci2031'\n\nfile: constant/models at line 12.\n\nExpected: one of the models below\n\n"
        "Did you mean 'Akinci2013'?\n\nValid choices:\n\n    Akinci2013\n    none\n"
    );
    EXPECT_STREQ(FatalInputError({}, "Only this").what(), "Only this\n");
}

TEST(Error, FindsTheNearestWord)
{
    EXPECT_EQ(nearestWord("thetta", {"theta", "surface"}), "theta");
    EXPECT_EQ(nearestWord("Theta", {"theta", "beta"}), "theta");
    EXPECT_EQ(nearestWord("teh", {"the", "ten"}), "the");           // a swap is one slip, as is a wrong letter
    EXPECT_EQ(nearestWord("gravity", {"theta", "surface"}), "");
    EXPECT_EQ(nearestWord("foo", {"cos", "rho"}), "");              // two wrong letters of three are another word,
    EXPECT_EQ(nearestWord("plain", {"plane", "sphere"}), "plane");  // of five are not
    EXPECT_EQ(nearestWord("x", {"y"}), "");
    EXPECT_EQ(nearestWord("newton", {"newtonian", "none"}), "newtonian");     // three letters short
    EXPECT_EQ(nearestWord("surf", {"surfaceTension", "surfaceEnergy"}), "");   // of two
    EXPECT_EQ(nearestWord("non", {"nonconforming"}), "");                      // too short to mean one
    EXPECT_EQ(nearestWord("", {"a"}), "");
}

TEST(DimensionsText, ReadsExponentsAndUnits)
{
    EXPECT_EQ(parseDimensions("0 2 -1 0 0 0 0"), dimensions::kinematicViscosity);
    EXPECT_EQ(parseDimensions("m^2/s"), dimensions::kinematicViscosity);
    EXPECT_EQ(parseDimensions("m^2 s^-1"), dimensions::kinematicViscosity);
    EXPECT_EQ(parseDimensions("N/m"), dimensions::surfaceTension);
    EXPECT_EQ(parseDimensions("kg m^-1 s^-2"), dimensions::pressure);
    EXPECT_EQ(parseDimensions("J"), dimensions::energy);
    EXPECT_EQ(parseDimensions("1/s"), (Dimensions{{0, 0, -1}}));
    EXPECT_EQ(parseDimensions(""), dimensions::none);
    EXPECT_FALSE(parseDimensions("0 1 2"));
    EXPECT_FALSE(parseDimensions("furlong"));
    EXPECT_FALSE(parseDimensions("m^"));
    EXPECT_EQ(dimensions::kinematicViscosity.str(), "[0 2 -1 0 0 0 0]");
}
