// SPDX-License-Identifier: GPL-3.0-or-later
// Parts that do not make the same calls end, with the call of each by name.

#include "core/messages/Error.H"
#include "parallel/AllParts.H"
#include "parallel/PartsOfProcess.H"

#include <gtest/gtest.h>

#include <functional>
#include <string>

using namespace shizuku;

namespace
{

std::string complaintOf(int parts, const std::function<void(const Communicator&)>& run)
{
    try
    {
        runParts(parts, run);
    }
    catch (const FatalError& error)
    {
        return error.what();
    }
    return {};
}

bool names(const std::string& text, const std::string& word) { return text.find(word) != std::string::npos; }

}

TEST(TestCheckedParts, TakeTheSameCallsOfAll)
{
    int sum = 0;
    EXPECT_EQ(complaintOf(3, [&](const Communicator& parts)
    {
        const int all = parts.count(parts.part() + 1);
        inAllParts(parts, [] {});
        gatherTexts(parts, std::string(parts.part(), 'a'));         // of another size each
        if (parts.part() == 2) sum = all;
    }), "");
    EXPECT_EQ(sum, 6);
}

// One of three takes another branch, whose messages would fit.
TEST(TestCheckedParts, NameTheBranchOfEach)
{
    const std::string text = complaintOf(3, [](const Communicator& parts)
    {
        parts.any(true);
        if (parts.part() == 1) gatherTexts(parts, "one");
        else inAllParts(parts, [] {});
    });
    EXPECT_TRUE(names(text, "call 2 of each")) << text;
    EXPECT_TRUE(names(text, "part 0: gather() of 1 bytes")) << text;
    EXPECT_TRUE(names(text, "part 1: exchange() of messages")) << text;
    EXPECT_TRUE(names(text, "shizuku::gatherTexts(")) << text;
    EXPECT_TRUE(names(text, "shizuku::inAllParts(")) << text;
    EXPECT_TRUE(names(text, "part 2: gather()")) << text;
}

// The same kind of call, by way of other functions.
TEST(TestCheckedParts, TellTwoWaysToOneKindOfCall)
{
    const std::string text = complaintOf(2, [](const Communicator& parts)
    {
        const auto texts = [&] { gatherTexts(parts, "text"); };
        if (parts.part() == 0) texts();
        else inAllParts(parts, texts);
    });
    EXPECT_TRUE(names(text, "part 0: exchange() of messages")) << text;
    EXPECT_TRUE(names(text, "part 1: exchange() of messages")) << text;
    EXPECT_TRUE(names(text, "shizuku::inAllParts(")) << text;
}

TEST(TestCheckedParts, NameAPartThatCallsWhenOthersHaveEnded)
{
    const std::string text = complaintOf(2, [](const Communicator& parts)
    {
        if (parts.part() == 1) gatherTexts(parts, "more");
    });
    EXPECT_TRUE(names(text, "part 0: has come to its end")) << text;
    EXPECT_TRUE(names(text, "shizuku::gatherTexts(")) << text;
}
