// SPDX-License-Identifier: GPL-3.0-or-later
// Macros, directives and arithmetic.

#include "core/dictionary/CalcExpression.H"
#include "core/dictionary/Dictionary.H"
#include "support/ScratchFolder.H"
#include "unit/core/dictionary/Refused.H"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

using namespace shizuku;
using namespace shizuku::test;
using Vector = std::array<double, 3>;

// ---- Macros

TEST(Macro, StandsForAnEarlierValue)
{
    const Dictionary dict = Dictionary::parse
    (
        "x 3; w name; v (1 2 3); field uniform 5; p ($x ${x} 0); q $v; text $w; "
        "n 2($x $x); $w 7; u { y $x; } copy $field; alpha.a 1; b $alpha.a;"
    );
    EXPECT_EQ(dict.lookup<Vector>("p"), (Vector{3, 3, 0}));
    EXPECT_EQ(dict.lookup<Vector>("q"), (Vector{1, 2, 3}));
    EXPECT_EQ(dict.lookup<std::string>("text"), "name");
    EXPECT_EQ(dict.lookup<std::vector<int>>("n"), (std::vector<int>{3, 3}));
    EXPECT_EQ(dict.lookup<int>("name"), 7);
    EXPECT_EQ(dict.subDict("u").lookup<int>("y"), 3);
    EXPECT_EQ(dict.lookup<int>("b"), 1);
}

TEST(Macro, FindsItsScope)
{
    const Dictionary dict = Dictionary::parse
    (
        "x top; a { b { c 1; } }\n"
        "outer\n{\n    x middle; sibling { s 2; }\n"
        "    inner\n    {\n        x here;\n"
        "        plain $x; own $.x; parent $..x; grand $...x; slash ${../x}; far ${../../x}; top $:x;\n"
        "        dots $:a.b.c; slashes $:a/b/c; marked $!a/b/c; aside $sibling.s; "
        "open $:outer.sibling.s; back $..sibling.s;\n    }\n}\n"
    );
    const Dictionary inner = dict.subDict("outer").subDict("inner");
    const auto word = [&](const char* key) { return inner.lookup<std::string>(key); };
    EXPECT_EQ(word("plain"), "here");
    EXPECT_EQ(word("own"), "here");
    EXPECT_EQ(word("parent"), "middle");
    EXPECT_EQ(word("grand"), "top");
    EXPECT_EQ(word("slash"), "middle");
    EXPECT_EQ(word("far"), "top");
    EXPECT_EQ(word("top"), "top");
    EXPECT_EQ(word("dots"), "1");
    EXPECT_EQ(word("slashes"), "1");
    EXPECT_EQ(word("marked"), "1");
    EXPECT_EQ(word("aside"), "2");
    EXPECT_EQ(word("open"), "2");
    EXPECT_EQ(word("back"), "2");
}

TEST(Macro, MergesDictionaries)
{
    const Dictionary dict = Dictionary::parse
    (
        "defaults { solver PCG; tolerance 1e-6; sub { a 1; } }\n"
        "p { $defaults; tolerance 1e-8; sub { b 2; } }\n"
        "\"(U|k)\" { $defaults; }  UFinal { $U; relTol 0; }  last { $defaults }  whole $defaults;"
    );
    EXPECT_EQ(dict.subDict("p").lookup<std::string>("solver"), "PCG");
    EXPECT_EQ(dict.subDict("p").lookup<double>("tolerance"), 1e-8);
    EXPECT_EQ(dict.subDict("p").subDict("sub").keys(), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(dict.subDict("defaults").lookup<double>("tolerance"), 1e-6);
    EXPECT_EQ(dict.subDict("defaults").subDict("sub").keys(), std::vector<std::string>{"a"});
    EXPECT_EQ(dict.subDict("UFinal").lookup<double>("tolerance"), 1e-6);
    EXPECT_EQ(dict.subDict("UFinal").lookup<double>("relTol"), 0);
    EXPECT_EQ(dict.subDict("last").lookup<std::string>("solver"), "PCG");
    EXPECT_EQ(dict.subDict("whole").lookup<std::string>("solver"), "PCG");
}

TEST(Macro, FallsBackToTheEnvironmentAndToADefault)
{
    setenv("SHIZUKU_TEST_RADIUS", "0.25", 1);
    const Dictionary dict = Dictionary::parse("r $SHIZUKU_TEST_RADIUS; d ${absent:-7}; e ${r:-9};");
    EXPECT_EQ(dict.lookup<double>("r"), 0.25);
    EXPECT_EQ(dict.lookup<int>("d"), 7);
    EXPECT_EQ(dict.lookup<double>("e"), 0.25);
}

TEST(Macro, NeedsNoSemicolonAtTheEndOfItsLine)
{
    const Dictionary dict = Dictionary::parse
    (
        "name inner; base { a 1; b 2; }\n"
        "first\n{\n    $base\n    b 3;\n}\n"
        "second\n{\n    ${base}   // all of it\n    a 4;\n}\n"
        "$name\n{\n    c 5;\n}\n"
    );
    EXPECT_EQ(dict.subDict("first").keys(), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(dict.subDict("first").lookup<double>("b"), 3);
    EXPECT_EQ(dict.subDict("second").lookup<double>("a"), 4);
    EXPECT_EQ(dict.subDict("second").lookup<double>("b"), 2);
    EXPECT_EQ(dict.subDict("inner").lookup<double>("c"), 5);
}

TEST(Macro, ComposesNamesAndStartsAtTheTop)
{
    const Dictionary dict = Dictionary::parse
    (
        "model fast; endTime 8; fastCoeffs { n 1; } settings_fast { m 2; }\n"
        "inner { endTime 3; ${settings_${model}}; ${:${model}Coeffs}; top $/endTime; half #calc \"${/endTime}/2\"; }\n"
    );
    const Dictionary inner = dict.subDict("inner");
    EXPECT_EQ(inner.lookup<double>("m"), 2);
    EXPECT_EQ(inner.lookup<double>("n"), 1);
    EXPECT_EQ(inner.lookup<double>("top"), 8);
    EXPECT_EQ(inner.lookup<double>("half"), 4);
}

TEST(Macro, UndefinedIsRefused)
{
    const Refusal refusal = refusalOfText("radius 1;\na\n{\n    r $raduis;\n}\n");
    EXPECT_EQ(refusal.file, "someDict");
    EXPECT_EQ(refusal.line, 4);
    EXPECT_TRUE(holds(refusal.message, {"Undefined macro $raduis", "Did you mean 'radius'?"}));
    EXPECT_EQ(refusalOfText("a 1;\nb $..a;\n").line, 2);          // there is nothing around the top
    EXPECT_EQ(refusalOfText("a $b;\nb 1;\n").line, 1);            // only what stands before counts
    EXPECT_EQ(refusalOfText("a 1;\n$a;\n").line, 2);              // not a dictionary
    EXPECT_EQ(refusalOfText("a 1 2;\n$a 3;\n").line, 1);          // not one word: told at the source
}

// ---- Files

TEST(Include, TakesFilesRelativeToTheIncludingOne)
{
    const ScratchFolder folder;
    folder.write("system/controlDict", "endTime 1;");
    folder.write("constant/sub/more", "depth 2; #include \"../values\"\n");
    folder.write("constant/values", "FoamFile { class dictionary; }\nrho 998;\n\nnu 1e-6;");
    folder.write("constant/vector", "(1 2 3)");
    const auto main = folder.write
    (
        "constant/main",
        "FoamFile { object main; }\nname values;\n#include \"sub/more\"\n#include \"<case>/system/controlDict\"\n"
        "sub { #include \"<constant>/$name\" #include \"$FOAM_CASE/system/controlDict\" }\n"
        "v #include \"vector\";\n#includeIfPresent \"absent\"\nafter 1;\n"
    );
    const Dictionary dict = Dictionary::read(main);
    EXPECT_EQ(dict.lookup<int>("depth"), 2);
    EXPECT_EQ(dict.lookup<double>("rho"), 998);
    EXPECT_EQ(dict.lookup<int>("endTime"), 1);
    EXPECT_EQ(dict.subDict("sub").lookup<double>("nu"), 1e-6);
    EXPECT_EQ(dict.subDict("sub").lookup<double>("endTime"), 1);
    EXPECT_EQ(dict.lookup<Vector>("v"), (Vector{1, 2, 3}));
    EXPECT_EQ(dict.lookup<int>("after"), 1);
    EXPECT_FALSE(dict.subDict("FoamFile").found("class"));          // headers of included files are dropped
    EXPECT_EQ(dict.where("nu").line, 4);
    EXPECT_EQ(std::filesystem::path(dict.where("nu").file).filename(), "values");
    EXPECT_EQ(dict.where("after").line, 8);
}

TEST(Include, LooksForDefaultsInEtc)
{
    const ScratchFolder folder;
    folder.write("home/.shizuku/own", "a 1;");
    folder.write("dir/etc/own", "a 2;");
    folder.write("dir/etc/sub/given", "b 3;");
    const std::string oldHome = getenv("HOME") ? getenv("HOME") : "";
    const std::string oldDir = getenv("SHIZUKU_DIR") ? getenv("SHIZUKU_DIR") : "";
    setenv("HOME", (folder.path()/"home").c_str(), 1);
    setenv("SHIZUKU_DIR", (folder.path()/"dir").c_str(), 1);
    const Dictionary dict =
        Dictionary::parse("#includeEtc \"own\"\n#includeEtc \"sub/given\"\nc { #include \"<etc>/sub/given\" }");
    const Refusal refusal = refusalOfText("a 1;\n#includeEtc \"absent\"\n");
    setenv("HOME", oldHome.c_str(), 1);
    setenv("SHIZUKU_DIR", oldDir.c_str(), 1);
    EXPECT_EQ(dict.lookup<int>("a"), 1);
    EXPECT_EQ(dict.lookup<int>("b"), 3);
    EXPECT_EQ(dict.subDict("c").lookup<int>("b"), 3);
    EXPECT_EQ(refusal.line, 2);
}

TEST(Include, RefusesCirclesAndMissingFiles)
{
    const ScratchFolder folder;
    const auto first = folder.write("first", "a 1;\n#include \"second\"\n");
    folder.write("second", "\n\n#include \"./first\"\n");
    const Refusal circle = refusalOf([&] { Dictionary::read(first); });
    EXPECT_EQ(std::filesystem::path(circle.file).filename(), "second");
    EXPECT_EQ(circle.line, 3);
    EXPECT_TRUE(holds(circle.message, {"Circular include"}));

    const auto missing = folder.write("missing", "a 1;\n\n#include \"nowhere\"\n");
    EXPECT_EQ(refusalOf([&] { Dictionary::read(missing); }).line, 3);

    folder.write("broken", "a 1;\nb {\n");
    const Refusal inner = refusalOf([&] { Dictionary::read(folder.write("outer", "#include \"broken\"\n")); });
    EXPECT_EQ(std::filesystem::path(inner.file).filename(), "broken");
    EXPECT_EQ(inner.line, 2);
}

// ---- Other directives

TEST(InputMode, DecidesOnRepeatedKeywords)
{
    const auto text = [](const std::string& mode)
    {
        return "a 1; d { x 1; y 1; }\n#inputMode " + mode + "\na 2; d { y 2; }\nb 3;";
    };
    const auto values = [](const Dictionary& dict)
    {
        const Dictionary d = dict.subDict("d");
        return std::vector<int>{dict.lookup<int>("a"), d.lookupOr<int>("x", 0), d.lookup<int>("y"),
            dict.lookup<int>("b")};
    };
    EXPECT_EQ(values(Dictionary::parse(text("merge"))), (std::vector<int>{2, 1, 2, 3}));
    EXPECT_EQ(values(Dictionary::parse(text("default"))), (std::vector<int>{2, 1, 2, 3}));
    EXPECT_EQ(values(Dictionary::parse(text("overwrite"))), (std::vector<int>{2, 0, 2, 3}));
    EXPECT_EQ(values(Dictionary::parse(text("protect"))), (std::vector<int>{1, 1, 1, 3}));

    testing::internal::CaptureStderr();
    EXPECT_EQ(values(Dictionary::parse(text("warn"), "someDict")), (std::vector<int>{1, 1, 1, 3}));
    EXPECT_TRUE(holds(testing::internal::GetCapturedStderr(),
        {"'a' is there already, at line 1", "someDict at line 3"}));

    EXPECT_EQ(refusalOfText(text("error")).line, 3);
    const Refusal unknown = refusalOfText(text("protct"));
    EXPECT_EQ(unknown.line, 2);
    EXPECT_TRUE(holds(unknown.message, {"Did you mean 'protect'?"}));
}

TEST(Remove, TakesEntriesAway)
{
    const Dictionary dict = Dictionary::parse
    (
        "a 1; b 2; c1 3; c2 4; d { a 5; #remove a e 6; }\n#remove a\n#remove \"c.*\"\n#remove ( b absent )\nf 7;\n"
    );
    EXPECT_EQ(dict.keys(), (std::vector<std::string>{"d", "f"}));
    EXPECT_EQ(dict.subDict("d").keys(), std::vector<std::string>{"e"});
    EXPECT_EQ(refusalOfText("a 1;\n#remove { }\n").line, 2);
}

// ---- Branches

TEST(Conditional, ChoosesOneBranch)
{
    const Dictionary dict = Dictionary::parse
    (
        "fluid water; n 3;\n"
        "#ifeq $fluid water\n  rho 998;\n#else\n  rho 1;\n#endif\n"
        "walls { #ifeq ${fluid} oil\n  theta 20;\n#else\n  theta 60;\n#endif\n }\n"
        "#if #calc \"$n > 2\";\n  many yes;\n#endif\n"
        "#if off\n  never 1;\n#else\n  always 1;\n#endif\n"
        "#ifeq 3.0 $n\n  same 1;\n#endif\n"
        "#ifeq \"${fluid}_$n\" water_3\n  joined 1;\n#endif\n"
        "#ifeq ($!fluid water )\n  bracketed 1;\n#endif\n"
        "#if (#calc \"$<scalar>n < 4\")\n  few yes;\n#endif\n"
    );
    EXPECT_EQ(dict.lookup<double>("rho"), 998);
    EXPECT_EQ(dict.subDict("walls").lookup<double>("theta"), 60);
    EXPECT_EQ
    (
        dict.keys(),
        (std::vector<std::string>{"fluid", "n", "rho", "walls", "many", "always", "same", "joined", "bracketed", "few"})
    );
}

TEST(Conditional, NestsAndLeavesBranchesThatAreNotTakenAlone)
{
    const Dictionary dict = Dictionary::parse
    (
        "#if no\n  a $absent;\n  #if $absent\n    b 1;\n  #else\n    b 2;\n  #endif\n"
        "#else\n  #if yes\n    c 3;\n  #else\n    c 4;\n  #endif\n#endif\nd 5;\n"
    );
    EXPECT_EQ(dict.keys(), (std::vector<std::string>{"c", "d"}));
    EXPECT_EQ(dict.lookup<double>("c"), 3);
}

TEST(Conditional, RefusesWhatDoesNotPair)
{
    EXPECT_EQ(refusalOfText("a 1;\n#else\n").line, 2);
    EXPECT_EQ(refusalOfText("#if yes\n#endif\n#endif\n").line, 3);
    EXPECT_EQ(refusalOfText("#if yes\n#else\n#else\n#endif\n").line, 3);
    EXPECT_EQ(refusalOfText("a 1;\nb\n{\n#if yes\nc 1;\n}\n#endif\n").line, 4);
    EXPECT_EQ(refusalOfText("a 1;\n#if (1 2)\n#endif\n").line, 2);
    EXPECT_EQ(refusalOfText("a 1;\n#ifeq (1 1 1)\n#endif\n").line, 2);
    EXPECT_EQ(refusalOfText("a 1;\n#ifeq ()\n#endif\n").line, 2);
    EXPECT_EQ(refusalOfText("a 1;\n#if perhaps\n#endif\n").line, 2);
}

TEST(Directive, UnknownIsRefused)
{
    const Refusal statement = refusalOfText("a 1;\n#inclde \"file\"\n");
    EXPECT_EQ(statement.line, 2);
    EXPECT_TRUE(holds(statement.message, {"#inclde", "Did you mean 'include'?"}));
    EXPECT_EQ(refusalOfText("a 1;\nb #codeStream { code #{ x #}; };\n").line, 2);
    EXPECT_EQ(refusalOfText("a 1;\n#include\n").line, 2);
    for (const std::string function : {"mag(U)", "average (name = inlet, fields = (p U))", "\"file\"",
        "size\n(\n    name=n,\n    type=volume\n)"})
    {
        const Refusal call = refusalOfText("functions\n{\n    #includeFunc " + function + "\n    a 1;\n}\n");
        EXPECT_EQ(call.line, 3) << function;
        EXPECT_TRUE(holds(call.message, {"#includeFunc needs OpenFOAM's own function files"})) << function;
    }
}

// ---- Arithmetic

double value(const std::string& expression)
{
    const auto macro = [](const std::string& name) { return name == "two" ? 2.0 : 0.0; };
    return CalcExpression(expression, {"someDict", 3}, macro)();
}

TEST(Calc, KnowsOperatorsAndTheirOrder)
{
    EXPECT_EQ(value("1 + 2*3 - 4/8"), 6.5);
    EXPECT_EQ(value("(1 + 2)*3"), 9);
    EXPECT_EQ(value("2^3^2"), 512);         // from the right
    EXPECT_EQ(value("-2^2"), -4);           // the power binds tighter than the sign
    EXPECT_EQ(value("2^-1"), 0.5);
    EXPECT_EQ(value("8/4/2"), 1);           // from the left
    EXPECT_EQ(value("10 - 4 - 3"), 3);
    EXPECT_EQ(value("7 % 4 + 1"), 4);
    EXPECT_EQ(value("1/2"), 0.5);           // no integer division
    EXPECT_EQ(value("- -3 + +1"), 4);
    EXPECT_EQ(value("1e-3*1E3"), 1);
    EXPECT_EQ(value("1 + // a comment\n 2 /* and 3 */"), 3);
}

TEST(Calc, ComparesAndChooses)
{
    EXPECT_EQ(value("1 < 2"), 1);
    EXPECT_EQ(value("2 <= 1"), 0);
    EXPECT_EQ(value("1 + 1 == 2 && 3 != 4"), 1);
    EXPECT_EQ(value("0 || !1"), 0);
    EXPECT_EQ(value("2 > 1 ? 10 : 20"), 10);
    EXPECT_EQ(value("0 ? 1 : 0 ? 2 : 3"), 3);
    EXPECT_EQ(value("1 >= 1 ? 5 : 1/0"), 5);    // the other side is not evaluated
}

TEST(Calc, KnowsFunctions)
{
    // One rounding of the result, at most: equal to what the C library gives
    EXPECT_EQ(value("sqrt(16) + pow(2, 10)"), 1028);
    EXPECT_EQ(value("exp(1)"), std::exp(1.0));
    EXPECT_EQ(value("log(10) + log10(100)"), std::log(10.0) + 2);
    EXPECT_EQ(value("sin(1) + cos(1)*tan(1)"), std::fma(std::cos(1.0), std::tan(1.0), 0) + std::sin(1.0));
    EXPECT_EQ(value("asin(0.5) + acos(0.5)"), std::asin(0.5) + std::acos(0.5));
    EXPECT_EQ(value("atan(2)"), std::atan(2.0));
    EXPECT_EQ(value("atan2(1, -1)"), std::atan2(1.0, -1.0));
    EXPECT_EQ(value("min(1, 2) + max(3, 4)"), 5);
    EXPECT_EQ(value("abs(-2) + mag(-3) + sqr(4)"), 21);
    EXPECT_EQ(value("floor(1.7) + ceil(1.2)"), 3);
    EXPECT_EQ(value("hypot(3, 4)"), 5);
    EXPECT_EQ(value("degToRad(180)"), std::numbers::pi);
    EXPECT_EQ(value("radToDeg(pi)"), 180);
    EXPECT_EQ(value("2*pi()"), 2*std::numbers::pi);
    EXPECT_EQ(value("sinh(1) + cosh(1)"), std::sinh(1.0) + std::cosh(1.0));
    EXPECT_EQ(value("tanh(1)"), std::tanh(1.0));
    EXPECT_EQ(value("$two*${two}/ $two"), 2);
    EXPECT_EQ(value("3*$<scalar>two - $<scalar>{two}"), 4);
}

TEST(Calc, IfEvaluatesOnlyTheChosenSide)
{
    EXPECT_EQ(value("if(1, 5, 1/0)"), 5);
    EXPECT_EQ(value("if(1 > 2, 1/0, $two)"), 2);
    EXPECT_THROW(value("if(1, 5)"), FatalInputError);
}

TEST(Calc, VariablesTakeTheValuesOfEachCall)
{
    int asked = 0;
    const auto macro = [&asked](const std::string&) { return ++asked, 10.0; };
    const CalcExpression formula("$ten*x + min(y, 1)", {"someDict", 3}, macro, {"x", "y"});
    EXPECT_EQ(formula({2, 0.5}), 20.5);
    EXPECT_EQ(formula({-1, 7}), -9);
    EXPECT_EQ(asked, 1);
    const CalcExpression quotient("1/x", {"someDict", 3}, macro, {"x"});
    EXPECT_TRUE(holds(refusalOf([&] { quotient({0}); }).message, {"Division by zero", "1/x", "someDict"}));
    EXPECT_EQ(quotient({4}), 0.25);
    EXPECT_TRUE(holds
    (
        refusalOf([&] { CalcExpression("radius + 1", {"someDict", 3}, macro, {"radius2"}); }).message,
        {"Unknown name 'radius'", "Did you mean 'radius2'?"}
    ));
}

TEST(Calc, RefusesNonsense)
{
    for (const char* text
        : {"1/0", "1 % 0", "", "1 +", "(1", "1 2", "sqrt(-1)", "log(0)", "10^999", "sqrt(1, 2)", "sqroot(2)", "$"})
    {
        const Refusal refusal = refusalOf([&] { value(text); });
        EXPECT_EQ(refusal.line, 3) << text;
        EXPECT_EQ(refusal.file, "someDict") << text;
    }
    EXPECT_TRUE(holds(refusalOf([] { value("1/(2 - 2)"); }).message, {"Division by zero", "1/(2 - 2)"}));
    EXPECT_TRUE(holds(refusalOf([] { value("sqr2(2)"); }).message, {"Did you mean 'sqr'?"}));
    EXPECT_FALSE(holds(refusalOf([] { value("foo"); }).message, {"Did you mean"}));

    const auto expected = [](const char* text)
    {
        const std::string message = refusalOf([&] { value(text); }).message, head = "Expected: ";
        const std::size_t at = message.find(head);
        return at == std::string::npos ? message : message.substr(at + head.size(), message.find('\n', at) - at - head.size());
    };
    for (const char* text : {"", "60 +", "60+1/", "1 ? 2 :", "-", "(", "2^"})
    {
        EXPECT_EQ(expected(text), "a number, a name, a function or '('") << text;
    }
    EXPECT_TRUE(holds(refusalOf([] { value(" 60 + "); }).message, {"The end comes too early"}));
    EXPECT_EQ(expected("60 60"), "an operator or the end");
    EXPECT_EQ(expected("(60 60"), "an operator or ')'");
    EXPECT_EQ(expected("1 ? 2"), "an operator or ':'");
    EXPECT_EQ(expected("1 + $"), "the name of an entry");
    EXPECT_EQ(expected("${"), "the name of an entry");
}

TEST(Calc, WritesNumbersThatReadBack)
{
    EXPECT_EQ(numberText(0.1), "0.1");
    EXPECT_EQ(numberText(1e6), "1000000");      // readable as an integer
    EXPECT_EQ(numberText(-2), "-2");
    EXPECT_EQ(std::stod(numberText(1.0/3)), 1.0/3);
    EXPECT_EQ(std::stod(numberText(1e-300)), 1e-300);
}

TEST(Calc, StandsInDictionaries)
{
    const Dictionary dict = Dictionary::parse
    (
        "R 1e-3; n 2000; g g [0 1 -2 0 0 0 0] -9.81;\n"
        "spacing #calc \"pow(4.0/3.0*pi()*$R^3/$n, 1.0/3)\"; twice #eval{ 2*$n };  v (0 0 #eval \"2*$g\");\n"
        "sub { m #calc #{ $..n + 1 #}; k #calc \"$:R*2\"; }\n"
    );
    // (4/3 pi / 2000)^(1/3) mm = 0.12794 mm, by hand
    EXPECT_NEAR(dict.lookup<double>("spacing"), 0.12794e-3, 5e-9);
    EXPECT_EQ(dict.lookup<int>("twice"), 4000);
    EXPECT_EQ(dict.lookup<Vector>("v"), (Vector{0, 0, -19.62}));
    EXPECT_EQ(dict.subDict("sub").lookup<int>("m"), 2001);
    EXPECT_EQ(dict.subDict("sub").lookup<double>("k"), 2e-3);

    EXPECT_EQ(refusalOfText("a 0;\nb #calc \"1/$a\";\n").line, 2);
    EXPECT_EQ(refusalOfText("a word;\n\nb #calc \"1 + $a\";\n").line, 1);     // what is no number, at its place
    EXPECT_EQ(refusalOfText("a 1;\n\nb #calc \"1 + $c\";\n").line, 3);
}

// ---- As OpenFOAM reads them

TEST(Calc, KnowsFactorsOfAnglesAndBraces)
{
    const Dictionary dict = Dictionary::parse
    (
        "r 2; c #calc \"cos(60*degToRad())\"; d #calc \"pi()*radToDeg()\"; x ${{ $r*2 }}; v (0 ${{$r^2 + 1}} 0); e #calc \"pow3(cbrt(8))\";"
    );
    EXPECT_NEAR(dict.lookup<double>("c"), 0.5, 1e-15);          // rounding of pi/3
    EXPECT_NEAR(dict.lookup<double>("d"), 180, 1e-13);
    EXPECT_EQ(dict.lookup<double>("x"), 4);
    EXPECT_EQ(dict.lookup<Vector>("v"), (Vector{0, 5, 0}));
    EXPECT_NEAR(dict.lookup<double>("e"), 8, 1e-14);
    EXPECT_EQ(refusalOf([] { Dictionary::parse("\nx ${{ 1/0 }};"); }).line, 2);
}

TEST(Usage, APatternWhoseWordsAllHaveEntriesOfTheirOwnIsNoMistake)
{
    const Dictionary dict = Dictionary::parse("\".*\" { theta 90; } floor { theta 60; }", "text");
    EXPECT_EQ(dict.subDict("floor").lookup<double>("theta"), 60);
    EXPECT_NO_THROW(dict.refuseUnused());

    const Dictionary other = Dictionary::parse("floor { theta 60; }\n\"wal.*\" { theta 90; }", "text");
    EXPECT_EQ(other.subDict("floor").lookup<double>("theta"), 60);
    EXPECT_EQ(refusalOf([&] { other.refuseUnused(); }).line, 2);
}
