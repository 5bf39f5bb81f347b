// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/viscosity/Viscosity.H"

#include "support/LiquidCase.H"

using namespace shizuku;
using namespace shizuku::test;

TEST(@class@, SlowsTheLiquidByItsRate)
{
    LiquidCase drop;
    drop.place({{0, 0, 0}, {1, 0, 0}}, {{1, -2, 3}, {0, 0, 0}});
    const auto model = Viscosity::New(Dictionary::parse("viscosity @word@; @word@Coeffs { rate 100; }"), drop.liquid);
    const scalar dt = drop.liquid.units().toScaled(1e-3, dimensions::time);
    for (int step = 0; step < 2; ++step) model->apply(drop.liquid, drop.near, drop.walls, dt);

    const auto velocity = drop.inOrder(drop.liquid.velocity);
    // 1/(1 + 100*1e-3) twice, in single precision.
    EXPECT_NEAR(velocity[0].x, 1 / 1.21, 1e-6);
    EXPECT_NEAR(velocity[0].y, -2 / 1.21, 2e-6);
    EXPECT_NEAR(velocity[0].z, 3 / 1.21, 3e-6);
    EXPECT_EQ(norm(velocity[1]), 0);
}

TEST(@class@, RefusesANegativeRate)
{
    LiquidCase drop;
    const Dictionary models = Dictionary::parse("viscosity @word@; @word@Coeffs { rate -1; }", "constant/models");
    EXPECT_TRUE(holds(messageOf([&] { Viscosity::New(models, drop.liquid); }), {"constant/models", "0 or more"}));
}
