// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/velocityCorrection/VelocityCorrection.H"

#include "support/LiquidCase.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

Dictionary correctionOfStrength(const std::string& strength)
{
    return Dictionary::parse("velocityCorrection @word@; @word@Coeffs { strength " + strength + "; }", "constant/models");
}

}

TEST(@class@, KeepsItsShareOfThePrediction)
{
    LiquidCase drop;
    drop.place({{0, 0, 0}, {3, 0, 0}}, {{1, 0, 0}, {0, -2, 0}});         // the predicted positions are these
    const auto model = VelocityCorrection::New(correctionOfStrength("0.25"), drop.liquid);
    model->notePrediction(drop.liquid);
    model->apply(drop.liquid, drop.near, drop.walls, 0.5f);
    const auto velocity = drop.inOrder(drop.liquid.velocity);
    EXPECT_EQ(velocity[0].x, 0.75f);                                     // halves and quarters are exact
    EXPECT_EQ(velocity[1].y, -1.5f);
}

TEST(@class@, RefusesAStrengthAboveOne)
{
    LiquidCase drop;
    EXPECT_TRUE(holds(messageOf([&] { VelocityCorrection::New(correctionOfStrength("2"), drop.liquid); }), {"constant/models", "0 to 1"}));
}
