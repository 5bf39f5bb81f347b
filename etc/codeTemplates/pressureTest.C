// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/pressure/Pressure.H"

#include "support/LiquidCase.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

std::unique_ptr<Pressure> makeModel(LiquidCase& drop, const std::string& iterations)
{
    const Dictionary solution = Dictionary::parse("pressure { iterations " + iterations + "; }", "system/solution");
    return Pressure::New(Dictionary::parse("pressure @word@;"), solution, drop.liquid, drop.walls, drop.surface);
}

}

TEST(@class@, SeparatesAPairByASpacing)
{
    LiquidCase drop;
    drop.place({{0, 0, 0}, {0.6f, 0, 0}, {5, 0, 0}});
    const auto model = makeModel(drop, "2");
    model->begin(1);
    while (!model->converged(drop.liquid, drop.near, drop.walls)) model->correct(drop.liquid, drop.near, drop.walls);
    EXPECT_EQ(model->iterations(), 2);

    const auto moved = drop.inOrder(drop.liquid.predicted);
    const scalar d = drop.liquid.spacing();
    // Both move by half of what is missing; places are rounded.
    EXPECT_NEAR(moved[0].x, -0.2 * d, 2 * quanta::each);
    EXPECT_NEAR(moved[1].x, 0.8 * d, 2 * quanta::each);
    EXPECT_EQ(moved[2].x, rounded(5 * d));
}

TEST(@class@, RefusesNoIterations)
{
    LiquidCase drop;
    EXPECT_TRUE(holds(messageOf([&] { makeModel(drop, "0"); }), {"system/solution", "1 or more"}));
}
