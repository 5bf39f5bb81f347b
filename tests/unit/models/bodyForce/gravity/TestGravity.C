// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/bodyForce/BodyForce.H"

#include "support/LiquidCase.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

const Dictionary gravity = Dictionary::parse("bodyForce gravity;");

}

TEST(Gravity, AddsItsVelocityToWhatPositionsArePredictedBy)
{
    LiquidCase drop({.g = "dimensions [0 1 -2 0 0 0 0]; value (1 -2 -9.81);"});
    const auto model = BodyForce::New(gravity, drop.folder.path() / "constant", drop.liquid);
    EXPECT_DOUBLE_EQ(model->acceleration(), std::sqrt(5 + 9.81 * 9.81));

    const Units& units = drop.liquid.units();
    drop.place({{0, 0, 0}, {5, 0, 0}}, {{0, 0, 0}, {1, 1, 1}});
    constexpr double step = 3e-4;
    const scalar dt = units.toScaled(step, dimensions::time);
    model->predict(drop.liquid, dt);
    const auto predicted = drop.inOrder(drop.liquid.predicted), velocity = drop.inOrder(drop.liquid.velocity);
    const auto si = [&](scalar v) { return units.toSI(v, dimensions::velocity); };
    // Places are rounded to half a quantum, and velocities of one unit to 6e-8.
    const double half = 0.5 * units.toSI(quanta::each, dimensions::length) / step, single = 5e-7 * si(1);
    EXPECT_NEAR(si(predicted[0].x / dt), 3e-4, half);
    EXPECT_NEAR(si(predicted[0].y / dt), -6e-4, half);
    EXPECT_NEAR(si(predicted[0].z / dt), -9.81 * 3e-4, half);
    EXPECT_NEAR(si(predicted[1].z / dt) - si(1), -9.81 * 3e-4, half + single);
    EXPECT_EQ(velocity[0].z, 0);
    EXPECT_EQ(velocity[1].z, 1);
}

TEST(Gravity, RefusesOtherDimensionsAndMissingValues)
{
    const auto refusal = [](const std::string& g)
    {
        LiquidCase drop({.g = g});
        return messageOf([&] { BodyForce::New(gravity, drop.folder.path() / "constant", drop.liquid); });
    };
    EXPECT_TRUE(holds(refusal("dimensions [0 1 -1 0 0 0 0]; value (0 0 -9.81);"), {"constant/g", "[0 1 -2 0 0 0 0]"}));
    EXPECT_TRUE(holds(refusal("dimensions [0 1 -2 0 0 0 0];"), {"value"}));
    EXPECT_TRUE(holds(refusal("value (0 0 -9.81); valeu (0 0 0);"), {"valeu"}));
}
