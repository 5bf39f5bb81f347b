// SPDX-License-Identifier: GPL-3.0-or-later
// What system/decomposeParDict may say. Runs in parts: tests/integration/solver/TestParallel.C.
#include "stepping/Balance.H"

#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

struct DecomposedCase
{
    ScratchFolder folder;

    BalanceControls read(const std::string& text) const
    {
        folder.write("system/decomposeParDict", text);
        return BalanceControls::read(folder.path());
    }
};

}

TEST(BalanceControls, WithoutADictionaryHalvesTheLiquid)
{
    const ScratchFolder folder;
    const BalanceControls controls = BalanceControls::read(folder.path());
    EXPECT_EQ(controls.method, BalanceControls::Method::bisection);
    EXPECT_FALSE(controls.parts.has_value());
    EXPECT_TRUE(controls.weights.empty());
}

TEST(BalanceControls, HaveAsManyPartsAsTheySay)
{
    EXPECT_EQ(DecomposedCase().read("numberOfSubdomains 4;\n").parts, 4);
}

TEST(BalanceControls, OfPiecesHaveAsManyPartsAndAnOrder)
{
    const BalanceControls controls = DecomposedCase().read("method hierarchical;\nhierarchicalCoeffs { n (1 2 3); order zyx; }\nprocessorWeights (1 1 2 2 1 1);\n");
    EXPECT_EQ(controls.method, BalanceControls::Method::hierarchical);
    EXPECT_EQ(controls.parts, 6);
    EXPECT_EQ(controls.alongY, 2);
    EXPECT_EQ(controls.alongZ, 3);
    EXPECT_EQ(controls.zFirst, true);
    EXPECT_EQ(controls.weights, (std::vector<double>{1, 1, 2, 2, 1, 1}));
}

TEST(BalanceControls, AreRefusedWithTheLineAndWhatToWrite)
{
    struct Refused
    {
        std::string text;
        std::vector<std::string> says;
    };
    const std::vector<std::string> methods{"bisection", "rows", "simple", "hierarchical"};
    const std::vector<Refused> all
    {
        {"method scotch;\n", {"scotch", "liquid moves", "system/decomposeParDict at line 1", methods[0], methods[1], methods[2], methods[3]}},
        {"method lines;\n", {"lines", "system/decomposeParDict at line 1", methods[0], methods[1], methods[2], methods[3]}},
        {"method simple;\nsimpleCoeffs { n (3 1 1); }\n", {"rows of cells along x stay whole", "system/decomposeParDict at line 2", "(1 M N)"}},
        {"method hierarchical;\nhierarchicalCoeffs { n (1 2 2); order yx; }\n", {"yx", "system/decomposeParDict at line 2", "xyz", "zyx"}},
        {"numberOfSubdomains 3;\nmethod simple;\nsimpleCoeffs { n (1 2 2); }\n", {"These are 4 parts, and numberOfSubdomains is 3", "system/decomposeParDict at line 3"}},
        {"direction z;\n", {"The method bisection chooses directions by itself", "system/decomposeParDict at line 1", "method rows"}},
        {"processorWeights (1 0 1);\n", {"Each part is to have some liquid", "system/decomposeParDict at line 1", "(1 1 2 2)"}},
        {"method simple;\nsimpleCoeffs { n (1 2 1); }\nprocessorWeights (1 2);\n", {"go through all parts", "system/decomposeParDict at line 3", "method bisection, rows or hierarchical"}},
        {"numberOfSubdomains 3;\nprocessorWeights (1 1);\n", {"weights of 2 parts, and there are 3", "system/decomposeParDict at line 2", "as many"}},
        {"rebalanceAbove -1;\n", {"The share is negative", "system/decomposeParDict at line 1", "0 or more"}},
        {"rebalanceInterval 0;\n", {"These are no steps", "system/decomposeParDict at line 1", "a whole number"}},
        {"rebalanceAbov 0.2;\n", {"rebalanceAbov", "rebalanceAbove"}},
    };
    for (const Refused& each : all)
    {
        const DecomposedCase decomposed;
        const std::string message = messageOf<FatalInputError>([&] { decomposed.read(each.text); });
        for (const std::string& part : each.says) EXPECT_NE(message.find(part), std::string::npos) << each.text << part << '\n' << message;
    }
}
