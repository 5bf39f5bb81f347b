// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/viscosity/Viscosity.H"

#include "support/LiquidCase.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

const Dictionary laminar = Dictionary::parse("viscosity laminar;");

// Laplacian of u over nu, by one explicit step on a lattice: in 1/spacing^2, in order of the lattice's points.
std::vector<double> laplacianOf(LiquidCase& block, const std::vector<Vec3>& points, const std::vector<Vec3>& velocities)
{
    block.place(points, velocities);
    const scalar dt = 0.5f;
    Viscosity::New(laminar, block.liquid)->apply(block.liquid, block.near, block.walls, dt);
    const auto after = block.inOrder(block.liquid.velocity);
    const Units& units = block.liquid.units();
    const double nu = block.liquid.properties().viscosity / units.of(dimensions::kinematicViscosity);
    const double d = block.liquid.spacing();
    std::vector<double> laplacian;
    for (std::size_t i = 0; i < after.size(); ++i)
    {
        laplacian.push_back((double(after[i].x) - velocities[i].x) / (nu * dt) * d * d);
    }
    return laplacian;
}

bool isInterior(Vec3 p, scalar edge, scalar support)
{
    return std::min({p.x, p.y, p.z}) > support && std::max({p.x, p.y, p.z}) < edge - support;
}

}

// The lattice is symmetric, so a linear profile's contributions cancel: what is left are roundings of velocities up to
// 11, 1e-6, over nu dt.
TEST(Laminar, FindsNoForceInUniformShear)
{
    LiquidCase block({.liquidProperties = "rho 1000; nu 1e-4; sigma 0.072;"});
    const auto points = latticeBlock(12, 12, 12, 1);
    std::vector<Vec3> shear;
    for (const Vec3& p : points) shear.push_back({p.z, 0, 0});
    const auto laplacian = laplacianOf(block, points, shear);
    int interior = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        if (!isInterior(points[i], 11, 2)) continue;
        ++interior;
        ASSERT_NEAR(laplacian[i], 0, 1e-4) << i;
    }
    EXPECT_EQ(interior, 6 * 6 * 6);
}

// The Laplacian of z^2 is 2. The 0.01 h^2 in the denominator takes away 3.7 %, and the lattice, coarse for the kernel,
// adds one to five: within 3 %.
TEST(Laminar, FindsTheCurvatureOfAParabola)
{
    for (const scalar support : {2.0f, 3.0f})
    {
        const std::string kernel = "type cubicSpline; support " + std::to_string(support) + ";";
        LiquidCase block({.kernel = kernel, .liquidProperties = "rho 1000; nu 1e-4; sigma 0.072;"});
        const auto points = latticeBlock(12, 12, 12, 1);
        std::vector<Vec3> parabola;
        for (const Vec3& p : points) parabola.push_back({p.z * p.z, 0, 0});
        const auto laplacian = laplacianOf(block, points, parabola);
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            if (!isInterior(points[i], 11, support)) continue;
            ASSERT_NEAR(laplacian[i], 2, 0.06) << kernel;
        }
    }
}

// A wall at rest takes nu dt drag(s) of the velocity from uniform flow, at a half-space and, with noSlip off, nothing.
TEST(Laminar, IsHeldBackByAWall)
{
    for (const bool noSlip : {true, false})
    {
        LiquidCase flow({.liquidProperties = "rho 1000; nu 1e-4; sigma 0.072;",
                         .walls = floorPlane});
        flow.place({{0, 0, 0.5f}, {5, 0, 1.5f}, {10, 0, 2.5f}}, std::vector<Vec3>(3, {1, 0, 0}));
        const Dictionary models = Dictionary::parse
        (
            std::string("viscosity laminar; laminarCoeffs { noSlip ") + (noSlip ? "yes" : "no") + "; }"
        );
        const scalar dt = 0.1f;
        Viscosity::New(models, flow.liquid)->apply(flow.liquid, flow.near, flow.walls, dt);
        const auto velocity = flow.inOrder(flow.liquid.velocity);

        const auto table = tabulateHalfSpace(flow.liquid.kernel());
        const HalfSpaceView halfSpace{{table.data(), int(table.size())}, flow.liquid.support()};
        const scalar nu = flow.liquid.units().toScaled(1e-4, dimensions::kinematicViscosity), d = flow.liquid.spacing();
        for (int i = 0; i < 2; ++i)
        {
            const scalar lost = noSlip ? nu * dt * halfSpace((scalar(i) + 0.5f) * d).drag : 0;
            EXPECT_NEAR(velocity[i].x, 1 - lost, 2e-7);         // one rounding near one
            EXPECT_EQ(lost > 1e-5f, noSlip);
        }
        EXPECT_EQ(velocity[2].x, 1);                            // beyond the support
    }
}

TEST(Laminar, IsHeldBackBySolidParticles)
{
    LiquidCase flow({.liquidProperties = "rho 1000; nu 1e-4; sigma 0.072;",
                     .walls = sampledFloor,
                     .solidPositions = latticeBlock(9, 9, 1, 1, {-4, -4, -0.5f})});
    flow.place({{0, 0, 0.5f}, {0, 0, 2.5f}}, std::vector<Vec3>(2, {1, 0, 0}));
    const auto model = Viscosity::New(Dictionary::parse("viscosity laminar;"), flow.liquid);
    model->apply(flow.liquid, flow.near, flow.walls, 0.1f);
    const auto velocity = flow.inOrder(flow.liquid.velocity);
    EXPECT_LT(velocity[0].x, 0.9999f);
    EXPECT_GT(velocity[0].x, 0.9f);
    EXPECT_EQ(velocity[1].x, 1);
    EXPECT_EQ(velocity[0].z, 0);
}

TEST(Laminar, LimitsTheStepByDiffusionOverASpacing)
{
    LiquidCase drop;
    const auto model = Viscosity::New(laminar, drop.liquid);
    EXPECT_DOUBLE_EQ(model->stepLimit(drop.liquid.properties()), 0.125 * 1e-6 / 1e-6);
    EXPECT_EQ(model->stepLimit({1e-3, 1000, 0, 0.07}), std::numeric_limits<double>::infinity());
}
