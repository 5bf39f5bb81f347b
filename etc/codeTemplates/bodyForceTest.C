// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/bodyForce/BodyForce.H"

#include "support/LiquidCase.H"

using namespace shizuku;
using namespace shizuku::test;

TEST(@class@, ActsBelowItsTopAlone)
{
    LiquidCase drop({.g = "value (0 3 -4); top 2e-3;"});
    const Dictionary models = Dictionary::parse("bodyForce @word@;");
    const auto model = BodyForce::New(models, drop.folder.path() / "constant", drop.liquid);
    EXPECT_DOUBLE_EQ(model->acceleration(), 5);

    drop.place({{0, 0, 0}, {0, 0, 3}});             // 3 mm
    const Units& units = drop.liquid.units();
    model->predict(drop.liquid, units.toScaled(1e-3, dimensions::time));
    const auto before = drop.inOrder(drop.liquid.position), after = drop.inOrder(drop.liquid.predicted);
    // dt^2 g; roundings of single precision.
    EXPECT_EQ(after[0].x, 0);
    EXPECT_NEAR(units.toSI(after[0].y, dimensions::length), 3e-6, 1e-12);
    EXPECT_NEAR(units.toSI(after[0].z, dimensions::length), -4e-6, 1e-12);
    EXPECT_EQ(after[1].y, before[1].y);
    EXPECT_EQ(after[1].z, before[1].z);
}

TEST(@class@, RefusesATopThatIsNotAbove)
{
    LiquidCase drop({.g = "value (0 0 -9.81); top 0;"});
    const Dictionary models = Dictionary::parse("bodyForce @word@;");
    const auto make = [&] { BodyForce::New(models, drop.folder.path() / "constant", drop.liquid); };
    EXPECT_TRUE(holds(messageOf(make), {"constant/g", "more than 0"}));
}
