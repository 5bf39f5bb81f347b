// SPDX-License-Identifier: GPL-3.0-or-later
// Input that would take the stack, minutes or gigabytes is refused by the name of the limit; what is long but plain is read.

#include "core/dictionary/Dictionary.H"
#include "core/dictionary/DictionaryExpansion.H"
#include "core/dictionary/DictionaryJson.H"
#include "core/dictionary/KeywordPattern.H"
#include "support/ScratchFolder.H"
#include "unit/core/dictionary/Refused.H"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <sstream>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

std::string repeated(const std::string& text, std::size_t times)
{
    std::string result;
    for (std::size_t i = 0; i < times; ++i) result += text;
    return result;
}

// Each takes 2 s at most, and 20 on a busy machine; without the limits it would be minutes to years.
class Limits : public testing::Test
{
    void TearDown() override
    {
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start_;
        EXPECT_LT(taken.count(), 60);
    }

    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Refused at that line of "text" with these words in the message.
void expectRefused(const std::string& text, int line, const std::string& words)
{
    const Refusal refusal = refusalOf([&] { Dictionary::parse(text, "text"); });
    EXPECT_EQ(refusal.file, "text");
    EXPECT_EQ(refusal.line, line);
    EXPECT_NE(refusal.message.find(words), std::string::npos) << refusal.message.substr(0, 500);
}

std::string calc(const std::string& expression)
{
    return "\na #calc \"" + expression + "\";";
}

// x0 is of one item, each line doubles the one before.
std::string doubling(int lines)
{
    std::string text = "x0 1;\n";
    for (int i = 1; i <= lines; ++i)
    {
        const std::string before = " $x" + std::to_string(i - 1);
        text += "x" + std::to_string(i) + before + before + ";\n";
    }
    return text;
}

}

TEST_F(Limits, OfExpressions)
{
    expectRefused(calc(repeated("(", 3840) + "1" + repeated(")", 3840)), 2, "nests brackets or choices too deep");
    expectRefused(calc(repeated("sqr(", 101) + "1" + repeated(")", 101)), 2, "at most 100");
    expectRefused(calc(repeated("1?1:", 101) + "1"), 2, "at most 100");
    expectRefused(calc("1" + repeated("^1", 4000)), 2, "4000 operators");
    expectRefused(calc(repeated("-", 1001) + "1"), 2, "at most 1000");
    expectRefused(calc(repeated("!", 1001) + "1"), 2, "at most 1000");
    expectRefused(calc("1" + repeated("+1", 100'000)), 2, "200001 characters");
    expectRefused(calc(repeated("+", 100'000) + "1"), 2, "at most 10000");

    EXPECT_EQ(Dictionary::parse(calc("1" + repeated("+1", 999))).lookup<double>("a"), 1000);
    EXPECT_EQ(Dictionary::parse(calc(repeated("(", 100) + "7" + repeated(")", 100))).lookup<double>("a"), 7);
    EXPECT_EQ(Dictionary::parse(calc("1" + repeated("^1", 999))).lookup<double>("a"), 1);
    EXPECT_EQ(Dictionary::parse(calc(repeated("-", 1000) + "3")).lookup<double>("a"), 3);
}

TEST_F(Limits, OfBrackets)
{
    expectRefused("\na " + repeated("(", 201) + repeated(")", 201) + ";", 2, "at most 200 levels");
    expectRefused("\n" + repeated("a { ", 100'000) + repeated("}", 100'000), 2, "at most 200 levels");
    // Brackets in quotes and comments are those of a macro's name, too.
    expectRefused("\na ${\"" + repeated("{", 100'000) + "\"};", 2, "");
    expectRefused("\na #eval{ /*" + repeated("{", 100'000) + "*/ 1 };", 2, "");
    EXPECT_NO_THROW(Dictionary::parse("a " + repeated("(", 199) + repeated(")", 199) + ";"));
}

TEST_F(Limits, OfMacros)
{
    expectRefused(doubling(40), 19, "Macros copy too much, the last of them $x17");     // 2^18 items and what was before
    expectRefused("#include \"" + repeated("${", 13'000) + "\"", 1, "Macros are nested too deep");

    std::string chain = "a0 (1);\n";
    for (int i = 1; i <= 1000; ++i) chain += "a" + std::to_string(i) + " ($a" + std::to_string(i - 1) + ");\n";
    expectRefused(chain, 199, "nests lists or dictionaries too deep");

    std::string many;
    for (int i = 0; i < 20'000; ++i) many += "key" + std::to_string(i) + " 1;\nuse" + std::to_string(i) + " $key0;\n";
    const Refusal refusal = refusalOf([&] { Dictionary::parse(many, "text"); });
    EXPECT_NE(refusal.message.find("Macros take too long to find"), std::string::npos);

    std::string nest, name = "a";
    for (int i = 0; i < 20; ++i) nest += "\"a[.a]*\" { ", name += ".a.a";
    expectRefused(nest + repeated("}", 20) + "\nx $" + name + ".b;", 2, "can be read in too many ways");
}

TEST_F(Limits, OfIncludes)
{
    const ScratchFolder folder;
    const auto write = [&](int i, const std::string& text) { std::ofstream(folder.path()/("f" + std::to_string(i))) << text; };
    const auto include = [](int i) { return "#include \"f" + std::to_string(i) + "\"\n"; };
    const auto read = [&] { return refusalOf([&] { Dictionary::read(folder.path()/"f0"); }).message; };

    for (int i = 0; i < 30; ++i) write(i, include(i + 1) + include(i + 1));
    write(30, "a 1;");
    EXPECT_NE(read().find("at most 1000 includes"), std::string::npos);

    for (int i = 0; i < 60; ++i) write(i, "d { " + include(i + 1) + "}");
    write(60, "a 1;");
    EXPECT_NE(read().find("Includes are nested too deep"), std::string::npos);

    write(0, "a 1;\n//" + std::string(17 << 20, ' '));
    EXPECT_NE(read().find("at most 16 MB of text"), std::string::npos);
}

TEST_F(Limits, OfConditions)
{
    expectRefused(repeated("#if yes\n", 300) + repeated("#endif\n", 300), 201, "#if are nested too deep");
}

TEST_F(Limits, ConditionsThatDoNotFitAreReadOnce)
{
    // Each would double the time if what follows were read anew for it.
    expectRefused("a 1;\n" + repeated("#e#ifeq", 100) + "\n", 2, "A keyword was expected");
    expectRefused("a 1;\n" + repeated("#if#ifeq ", 100) + "b 2;\n", 2, "A keyword was expected");
}

TEST_F(Limits, OfFileNames)
{
    const std::string name(300, 'n');
    expectRefused("\n#include \"" + name + "\"\n", 2, "there is no file");
    expectRefused("\n#include \"f0/" + name + "\"\n", 2, "there is no file");
    expectRefused("\n#includeEtc \"" + name + "\"\n", 2, "there is no such file");
    EXPECT_TRUE(Dictionary::parse("#includeIfPresent \"" + name + "\"\na 1;").found("a"));
}

TEST_F(Limits, OfLists)
{
    const Dictionary dict = Dictionary::parse("\na 4000000000{0};\nb 3{7};");
    const Refusal refusal = refusalOf([&] { dict.lookup<std::vector<double>>("a"); });
    EXPECT_EQ(refusal.line, 2);
    EXPECT_NE(refusal.message.find("more than 1000000"), std::string::npos);
    EXPECT_EQ(dict.lookup<std::vector<int>>("b"), (std::vector<int>{7, 7, 7}));

    std::ostringstream json;
    const auto tree = expandDictionary(SourceText("a 1000{1000{1000{1}}};", "text"));
    EXPECT_NE(refusalOf([&] { writeJson(json, *tree); }).message.find("Too many values for JSON"), std::string::npos);
}

TEST_F(Limits, OfPatterns)
{
    const auto refusal = [](const std::string& pattern)
    {
        return refusalOf([&] { KeywordPattern(pattern, {"text", 3}); });
    };
    EXPECT_EQ(refusal("(").line, 3);
    for (const char* malformed : {"(", ")", "a)(b", "[a", "[[:alpha:", "*a", "a{2", "a\\", "a{3,2}"})
    {
        EXPECT_NE(refusal(malformed).message.find("is not a regular expression"), std::string::npos) << malformed;
    }
    EXPECT_NE(refusal(repeated("(", 100) + repeated(")", 100)).message.find("at most 50 levels"), std::string::npos);
    EXPECT_NE(refusal(std::string(1001, 'a')).message.find("at most 1000 characters"), std::string::npos);
    EXPECT_NE(refusal("((((a{9}){9}){9}){9}){9}").message.find("repetitions written out"), std::string::npos);
    // Thirty of them kept the C library busy for minutes.
    for (const std::string& again : {"a" + repeated("+", 30), "(" + repeated("*", 30) + "a)", std::string("a*{2}"), std::string("(b?*)a")})
    {
        const std::string message = refusal(again).message;
        EXPECT_NE(message.find("repeats what is repeated already"), std::string::npos) << again << ": " << message;
    }
    EXPECT_NE(refusal("(a)\\1").message.find("refers back"), std::string::npos);
    expectRefused("\n\"" + repeated("(", 9000) + repeated(")", 9000) + "\" 1;\nx $y;", 2, "18000 characters long");
}

TEST_F(Limits, PatternsMatchInLinearTime)
{
    const auto matches = [](const std::string& pattern, const std::string& word) { return KeywordPattern(pattern, {}).matches(word); };
    const std::string letters(1'000'000, 'a');
    EXPECT_FALSE(matches("(a*)*b", letters));
    EXPECT_FALSE(matches("(a|a)*b", letters));
    EXPECT_FALSE(matches("(.*)*(.*)*c", letters));
    EXPECT_TRUE(matches("(a*)*b", letters + "b"));
    EXPECT_TRUE(matches(".*", letters));

    EXPECT_TRUE(matches("(U|k).*", "kappa"));
    EXPECT_FALSE(matches("(U|k).*", "xkappa"));         // all of the word
    EXPECT_TRUE(matches("a|bc", "bc"));
    EXPECT_FALSE(matches("a|bc", "ac"));
    EXPECT_TRUE(matches("[]x]{2,3}[[:digit:]]+", "]x]42"));
    EXPECT_TRUE(matches("b\xC3\xBC.*", "b\xC3\xBCgel"));
}

TEST_F(Limits, LongButPlainTextIsRead)
{
    const std::string word(1'000'000, 'a');
    EXPECT_EQ(Dictionary::parse("w " + word + ";").lookup<std::string>("w"), word);
    EXPECT_EQ(Dictionary::parse("b\xC3\xBC \xE6\xB5\xB7\xC3\xA0;").lookup<std::string>("b\xC3\xBC"), "\xE6\xB5\xB7\xC3\xA0");
    EXPECT_EQ(Dictionary::parse("l (" + repeated("1 ", 50'000) + ");").lookup<std::vector<int>>("l").size(), 50'000u);
}
