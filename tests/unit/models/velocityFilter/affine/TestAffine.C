// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/velocityFilter/VelocityFilter.H"

#include "support/DisorderedBall.H"
#include "support/LiquidCase.H"
#include "support/MotionSums.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

std::vector<Vec3> filtered
(
    LiquidCase& drop, const std::vector<Vec3>& points, const std::vector<Vec3>& velocities, const std::string& coeffs, scalar dt = 0.02f
)
{
    drop.place(points, velocities);
    const auto model = VelocityFilter::New(Dictionary::parse("velocityFilter affine; affineCoeffs { " + coeffs + " }"), drop.liquid);
    model->apply(drop.liquid, drop.near, drop.walls, dt);
    return drop.inOrder(drop.liquid.velocity);
}

}

// Translation, rotation and strain of any kind, up to the free surface.
TEST(Affine, LeavesLinearFlowsAlone)
{
    const auto points = disorderedBall(5);
    std::vector<Vec3> linear;
    for (const Vec3& p : points) linear.push_back({0.3f + 0.1f * p.x - 0.2f * p.y, 0.1f * p.z - 0.05f * p.x, 0.2f * p.y + 0.1f * p.x});
    LiquidCase drop;
    const auto result = filtered(drop, points, linear, "c 1;");
    // Velocities of order one, 6e-8 each, through a fit whose moments differ by tens.
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_LT(norm(result[i] - linear[i]), 1e-5f);
}

TEST(Affine, KeepsMomentumAndAngularMomentumAndTakesEnergyAlone)
{
    for (const std::string coeffs : {"c 0.2; perCapillaryStep 0;", "c 1;"})
    {
        for (const bool flat : {false, true})
        {
            const auto points = flat ? randomPoints(300, {0, 0, 0}, {14, 14, 0.3f}) : disorderedBall(5);
            const auto velocities = randomPoints(int(points.size()), {-1, -1, -1}, {1, 1, 1}, 2);
            LiquidCase drop;
            const auto result = filtered(drop, points, velocities, coeffs);
            const MotionSums before = motionOf(points, velocities), now = motionOf(points, result);
            EXPECT_LT(now.energy, before.energy) << coeffs;
            // 500 velocities of order one, rounded to 6e-8, at distances of up to 20. Where a flat layer leaves the gradient open, pairs of it turn.
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(now.momentum[c], before.momentum[c], 2e-5) << coeffs;
            if (flat) continue;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(now.angular[c], before.angular[c], 1e-4) << coeffs;
        }
    }
}

// One particle that moves among others at rest loses the share c of most of its velocity.
TEST(Affine, CalmsSingleParticles)
{
    const auto points = latticeBlock(7, 7, 7, 1);
    std::vector<Vec3> velocities(points.size());
    velocities[171] = {1, 0, 0};                                // the middle
    LiquidCase drop;
    const scalar lost = 1 - filtered(drop, points, velocities, "c 0.2; perCapillaryStep 0;")[171].x;
    EXPECT_GT(lost, 0.2f * 0.5f);                               // W of the particle itself is a third of all
    EXPECT_LT(lost, 0.2f);
}

// Walls take part with their share of c, as in XSPH; perCapillaryStep as there.
TEST(Affine, IsHeldBackByWalls)
{
    const auto taken = [](const std::string& coeffs)
    {
        LiquidCase flow(caseOnFloor({}));
        return 1 - filtered(flow, {{0, 0, 0.5f}}, {{1, 0, 0}}, coeffs)[0].x;
    };
    const scalar whole = taken("c 1; atWalls 1; slipAbove 0;");
    EXPECT_GT(whole, 0.1f);
    EXPECT_NEAR(taken("c 0.5; perCapillaryStep 0; atWalls 0.3; slipAbove 0;"), 0.15f * whole, 1e-6);
    EXPECT_EQ(taken("c 1; atWalls 0;"), 0);
    EXPECT_LT(taken("c 1; atWalls 1; slipAbove 1e-3;"), 0.1f * whole);
}

TEST(Affine, RefusesCoefficientsOutOfRange)
{
    LiquidCase drop;
    for (const std::string coeff : {"c -0.1", "c 1.5", "perCapillaryStep 1.5", "atWalls 2", "slipAbove -1"})
    {
        const Dictionary models = Dictionary::parse("velocityFilter affine; affineCoeffs { " + coeff + "; }", "constant/models");
        EXPECT_TRUE(holds(messageOf([&] { VelocityFilter::New(models, drop.liquid); }), {"constant/models", "out of range"})) << coeff;
    }
    LiquidCase slack(CaseText{.liquidProperties = "rho 1000; nu 1e-6; sigma 0;"});
    const Dictionary models = Dictionary::parse("velocityFilter affine; affineCoeffs { perCapillaryStep 0.5; }", "constant/models");
    EXPECT_TRUE(holds(messageOf([&] { VelocityFilter::New(models, slack.liquid); }), {"surface tension", "perCapillaryStep 0"}));
}

// A word alone means what the ladder validates.
TEST(Affine, WithoutCoefficientsIsWhatWasValidated)
{
    const auto result = [](const std::string& coeffs)
    {
        LiquidCase drop(caseOnFloor({}));
        return filtered(drop, latticeBlock(3, 3, 3, 1, {-1, -1, 0.5f}), randomPoints(27, {-1, -1, -1}, {1, 1, 1}, 2), coeffs, 0.05f);
    };
    const auto bare = result(""), said = result("c 0.2; perCapillaryStep 0.98; atWalls 1; slipAbove 0.1;");
    for (std::size_t i = 0; i < bare.size(); ++i) EXPECT_EQ(norm(bare[i] - said[i]), 0) << i;
}
