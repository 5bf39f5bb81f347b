// SPDX-License-Identifier: GPL-3.0-or-later
#include "advice/CaseEdits.H"
#include "support/ScratchFolder.H"

namespace shizuku::test
{

namespace
{

class CaseEdits : public testing::Test
{
protected:
    CaseEdits()
    {
        folder_.write("system/solution", "spacing 1e-3;     // m\n\npressure\n{\n    maxIterations 10;\n}\n");
        folder_.write("constant/models", "viscosity XSPH;\n");
    }

    ScratchFolder folder_;
};

TEST_F(CaseEdits, ChangeEntriesAndKeepTheRest)
{
    const auto written = changeCase
    (
        folder_.path(),
        {
            {"system/solution", "spacing", "2e-3"}, {"system/solution", "pressure/maxIterations", "4"},
            {"constant/models", "bodyForce", "none"}, {"constant/models", "XSPHCoeffs/c", "0.1"}
        },
        true
    );
    EXPECT_EQ(written.size(), 2u);
    EXPECT_EQ(folder_.read("system/solution"), "spacing 2e-3;     // m\n\npressure\n{\n    maxIterations 4;\n}\n");
    EXPECT_EQ(folder_.read("system/solution.old"), "spacing 1e-3;     // m\n\npressure\n{\n    maxIterations 10;\n}\n");
    const Dictionary models = Dictionary::read(folder_.path()/"constant/models");
    EXPECT_EQ(models.lookup<std::string>("viscosity"), "XSPH");
    EXPECT_EQ(models.lookup<std::string>("bodyForce"), "none");
    EXPECT_DOUBLE_EQ(models.subDict("XSPHCoeffs").lookup<double>("c"), 0.1);

    changeCase(folder_.path(), {{"system/solution", "spacing", "3e-3"}}, true);
    EXPECT_TRUE(holds(folder_.read("system/solution.old"), {"spacing 1e-3"}));      // what was first stays
    EXPECT_TRUE(holds(folder_.read("system/solution.old1"), {"spacing 2e-3"}));
}

TEST_F(CaseEdits, AllOrNothing)
{
    const auto change = [&]
    {
        changeCase
        (
            folder_.path(), {{"constant/models", "viscosity", "none"}, {"system/solution", "spacing", "{ ;"}}, true
        );
    };
    EXPECT_NE(messageOf(change), "no error");
    EXPECT_EQ(folder_.read("constant/models"), "viscosity XSPH;\n");
    EXPECT_EQ(folder_.list("constant"), std::vector<std::string>{"models"});
    EXPECT_EQ(folder_.list("system"), std::vector<std::string>{"solution"});
}

}

}
