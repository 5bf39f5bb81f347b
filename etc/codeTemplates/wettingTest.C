// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/wetting/Wetting.H"

#include "support/LiquidCase.H"

using namespace shizuku;
using namespace shizuku::test;

TEST(@class@, PullsWhatIsNearAWall)
{
    for (const std::string& walls : {floorPlane, sampledFloor})
    {
        LiquidCase drop({.walls = walls, .solidPositions = latticeBlock(3, 3, 1, 1, {-1, -1, -0.5f})});
        drop.place({{0, 0, 1}, {0, 0, 5}});
        const Dictionary models = Dictionary::parse
        (
            "surfaceTension none; wetting @word@; @word@Coeffs { strength 3; }"
        );
        const auto tension = SurfaceTension::New(models, drop.liquid, drop.walls, drop.surface);
        const auto model = Wetting::New(models, drop.liquid, drop.walls, *tension);
        Buffer<Vec3> field(drop.liquid.all());
        field.setZero();
        model->apply(drop.liquid, drop.near, drop.walls, field);

        const auto acceleration = drop.inOrder(field);
        const double found = drop.liquid.units().toSI(acceleration[0].z, dimensions::acceleration);
        EXPECT_NEAR(found, -3, 1e-6) << walls;     // single precision
        EXPECT_EQ(norm(acceleration[1]), 0) << walls;
    }
}

TEST(@class@, RefusesANegativePull)
{
    LiquidCase drop;
    const Dictionary models = Dictionary::parse
    (
        "surfaceTension none; wetting @word@; @word@Coeffs { strength -1; }", "constant/models"
    );
    const auto tension = SurfaceTension::New(models, drop.liquid, drop.walls, drop.surface);
    const auto make = [&] { Wetting::New(models, drop.liquid, drop.walls, *tension); };
    EXPECT_TRUE(holds(messageOf(make), {"constant/models", "0 or more"}));
}
