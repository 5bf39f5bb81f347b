// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/wetting/Wetting.H"

#include "support/PairReference.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// Tension first, as in a step: it computes the densities and normals that the wetting continues with.
std::vector<Vec3> wettingOf(LiquidCase& drop, const std::vector<Vec3>& points, const std::string& solidNormal)
{
    const Dictionary models = Dictionary::parse
    (
        "surfaceTension Fujisawa2014; Fujisawa2014Coeffs { gamma 1.5; }"
        "wetting contactAngle; contactAngleCoeffs { solidNormal " + solidNormal + "; }"
    );
    const auto tension = SurfaceTension::New(models, drop.liquid, drop.walls, drop.surface);
    const auto wetting = Wetting::New(models, drop.liquid, drop.walls, *tension);
    drop.place(points);
    Buffer<Vec3> acceleration(drop.liquid.all());
    acceleration.setZero();
    tension->apply(drop.liquid, drop.near, drop.walls, acceleration);
    acceleration.setZero();
    wetting->apply(drop.liquid, drop.near, drop.walls, acceleration);
    return drop.inOrder(acceleration);
}

const auto points = randomPoints(250, {-3, -3, 0.1f}, {3, 3, 5});
const auto solid = latticeBlock(11, 11, 1, 0.8f, {-4, -4, -0.4f});

}

// Some twenty terms a particle, each rounded to 1e-7: 2e-5 of the largest acceleration.
TEST(ContactAngleWetting, EqualsTheSumOverSolidParticles)
{
    for (const double theta : {0.0, 60.0, 150.0})
    {
        for (const std::string solidNormal : {"zero", "wall", "SPH"})
        {
            LiquidCase drop({.walls = sampledFloor, .solidPositions = solid,
                             .solidTheta = std::vector<double>(solid.size(), theta)});
            auto reference = pairSystem<CubicSpline>(drop, points, solid);
            reference.solidCosTheta = std::cos(theta * std::numbers::pi / 180);
            reference.solidNormal = Vector3(0, 0, solidNormal == "wall" ? 1 : 0);
            reference.liquidNormals = solidNormal == "SPH";
            reference.wallNormals = true;
            reference.prepare();
            EXPECT_TRUE(agree(wettingOf(drop, points, solidNormal), drop.liquid.units(), reference.wetting(), 2e-5))
                << theta << ", " << solidNormal;
        }
    }
}

// The half-space's tables are interpolated: 1e-3.
TEST(ContactAngleWetting, EqualsTheIntegralOverAnAnalyticFloor)
{
    for (const std::string solidNormal : {"zero", "wall", "SPH"})
    {
        LiquidCase drop({.walls = floorPlane,
                         .wettability = "floor { theta 60; }"});
        auto reference = pairSystem<CubicSpline>(drop, points);
        reference.floor = true;
        reference.floorCosTheta = 0.5;
        reference.solidNormal = Vector3(0, 0, solidNormal == "wall" ? 1 : 0);
        reference.liquidNormals = solidNormal == "SPH";
        reference.wallNormals = true;
        reference.prepare();
        EXPECT_TRUE(agree(wettingOf(drop, points, solidNormal), drop.liquid.units(), reference.wetting(), 1e-3))
            << solidNormal;
    }
}

// gamma_LS = gamma (1 + cos theta)/2 vanishes at 180 degrees: nothing pulls.
TEST(ContactAngleWetting, PullsNothingAt180Degrees)
{
    LiquidCase drop({.walls = sampledFloor, .solidPositions = solid,
                     .solidTheta = std::vector<double>(solid.size(), 180)});
    for (const Vec3& a : wettingOf(drop, points, "wall")) ASSERT_EQ(norm(a), 0);
}

TEST(ContactAngleWetting, NeedsAPairForce)
{
    LiquidCase drop;
    const Dictionary off = Dictionary::parse("surfaceTension none;");
    const auto none = SurfaceTension::New(off, drop.liquid, drop.walls, drop.surface);
    const Dictionary models = Dictionary::parse("wetting contactAngle;");
    EXPECT_TRUE(holds(messageOf([&] { Wetting::New(models, drop.liquid, drop.walls, *none); }),
                      {"surfaceTension Akinci2013 or Fujisawa2014"}));
}
