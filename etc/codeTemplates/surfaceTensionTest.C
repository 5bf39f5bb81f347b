// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/surfaceTension/SurfaceTension.H"

#include "support/LiquidCase.H"
#include "support/ReferenceKernels.H"

using namespace shizuku;
using namespace shizuku::test;

TEST(@class@, PullsAPairTogetherByItsFormula)
{
    LiquidCase drop;
    drop.place({{0, 0, 0}, {1.2f, 0, 0}, {9, 0, 0}});
    const Dictionary models = Dictionary::parse("surfaceTension @word@; @word@Coeffs { strength 2; }");
    const auto model = SurfaceTension::New(models, drop.liquid, drop.walls, drop.surface);
    Buffer<Vec3> field(drop.liquid.all());
    field.setZero();
    model->apply(drop.liquid, drop.near, drop.walls, field);

    const auto acceleration = drop.inOrder(field);
    // In spacings, in which V = 1; sigma/(rho0 d^3) with the case's 0.072 N/m, 1000 kg/m3 and 1 mm.
    const double expected = 2 * 0.072 / (1000 * 1e-9) * 1.2e-3 * Reference<CubicSpline>{2}.W(1.2);
    const double found = drop.liquid.units().toSI(acceleration[0].x, dimensions::acceleration);
    EXPECT_NEAR(found, expected, 1e-5 * expected);      // single precision near the end of the kernel
    EXPECT_NEAR(acceleration[1].x, -acceleration[0].x, 1e-6 * acceleration[0].x);
    EXPECT_EQ(norm(acceleration[2]), 0);
}

TEST(@class@, RefusesANegativeStrength)
{
    LiquidCase drop;
    const Dictionary models = Dictionary::parse
    (
        "surfaceTension @word@; @word@Coeffs { strength -1; }", "constant/models"
    );
    const auto make = [&] { SurfaceTension::New(models, drop.liquid, drop.walls, drop.surface); };
    EXPECT_TRUE(holds(messageOf(make), {"constant/models", "0 or more"}));
}
