// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/particleShifting/ParticleShifting.H"

#include "support/LiquidCase.H"

#include <numbers>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

Dictionary ofStrength(const std::string& strength)
{
    return Dictionary::parse("particleShifting @word@; @word@Coeffs { strength " + strength + "; }", "constant/models");
}

}

TEST(@class@, MovesAPairApartByItsFormula)
{
    LiquidCase drop;
    drop.place({{0, 0, 0}, {0.8f, 0, 0}});
    const auto model = ParticleShifting::New(ofStrength("0.02"), drop.liquid, drop.walls, drop.surface);
    model->apply(drop.liquid, drop.near, drop.walls);

    const auto position = drop.inOrder(drop.liquid.position);
    // In spacings V = 1 and h = 2; dW/dr at r/h = q = 0.4, below a half, is (8/pi)/h^4 (18 q^2 - 12 q).
    const double shift = 0.02 * 4 * (4.8 - 2.88) / (2 * std::numbers::pi), d = drop.liquid.spacing();
    // Places are rounded.
    EXPECT_NEAR(position[0].x, -shift * d, 2 * quanta::each);
    EXPECT_NEAR(position[1].x, (0.8 + shift) * d, 2 * quanta::each);
    EXPECT_EQ(position[0].y, 0);
}

TEST(@class@, RefusesANegativeStrength)
{
    LiquidCase drop;
    EXPECT_TRUE(holds(messageOf([&] { ParticleShifting::New(ofStrength("-1"), drop.liquid, drop.walls, drop.surface); }),
                      {"constant/models", "0 to 1"}));
}
