#include "models/bodyForce/BodyForce.H"

#include "support/LiquidCase.H"

using namespace shizuku;
using namespace shizuku::test;

TEST(@class@, GrowsToItsFullForce)
{
    LiquidCase drop({.g = "value (0 3 -4); ramp 2e-3;"});
    const Dictionary models = Dictionary::parse("bodyForce @word@;");
    const auto model = BodyForce::New(models, drop.folder.path() / "constant", drop.liquid);
    EXPECT_DOUBLE_EQ(model->acceleration(), 5);

    drop.place({{0, 0, 0}});
    const Units& units = drop.liquid.units();
    for (int step = 0; step < 3; ++step) model->apply(drop.liquid, units.toScaled(1e-3, dimensions::time));
    const Vec3 velocity = drop.inOrder(drop.liquid.velocity)[0];
    // Half the force in the first step, all of it in the two others; roundings of single precision.
    EXPECT_EQ(velocity.x, 0);
    EXPECT_NEAR(units.toSI(velocity.y, dimensions::velocity), 3 * 2.5e-3, 1e-8);
    EXPECT_NEAR(units.toSI(velocity.z, dimensions::velocity), -4 * 2.5e-3, 1e-8);
}

TEST(@class@, RefusesARampOfNoTime)
{
    LiquidCase drop({.g = "value (0 0 -9.81); ramp 0;"});
    const Dictionary models = Dictionary::parse("bodyForce @word@;");
    const auto make = [&] { BodyForce::New(models, drop.folder.path() / "constant", drop.liquid); };
    EXPECT_TRUE(holds(messageOf(make), {"constant/g", "more than 0"}));
}
