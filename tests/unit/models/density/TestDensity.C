// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/density/Density.H"

#include "support/LiquidCase.H"
#include "support/ReferenceKernels.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr const char* kernelTexts[]
{
    "type cubicSpline; support 2;", "type cubicSpline; support 2.7;", "type poly6Spiky; support 2.4;"
};

}

// The density of a full neighbourhood is read as that of the lattice. Sums of 30 to 90 floats: 1e-6.
TEST(Density, IsOneOnTheLattice)
{
    for (const char* kernel : kernelTexts)
    {
        LiquidCase block({.kernel = kernel});
        const auto points = latticeBlock(9, 9, 9, 1, {-4, -4, -4});
        block.place(points);
        computeDensity(block.liquid, block.near, block.walls);
        const auto density = block.inOrder(block.liquid.density);
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const scalar edge = std::max({std::abs(points[i].x), std::abs(points[i].y), std::abs(points[i].z)});
            if (edge < 2)
            {
                ASSERT_NEAR(density[i], 1, 2e-6) << kernel;
            }
            else
            {
                ASSERT_LT(density[i], 1 + 2e-6) << kernel;
            }
        }
        EXPECT_LT(density[0], 0.7f) << kernel;          // a corner: an eighth of space, and the faces along it
    }
}

TEST(Density, OfALoneParticleIsItsOwnShare)
{
    LiquidCase drop;
    drop.place({{0, 0, 0}, {100, 0, 0}});
    computeDensity(drop.liquid, drop.near, drop.walls);
    const scalar own = drop.liquid.particleVolume() * CubicSpline(drop.liquid.support()).W(0) / drop.liquid.latticeSum();
    for (const scalar density : drop.liquid.density.download()) EXPECT_FLOAT_EQ(density, own);
}

// Random particles between solid particles and an analytic wall, by all pairs in double precision.
TEST(Density, AddsTheSharesOfWalls)
{
    const auto solid = latticeBlock(15, 15, 1, 0.9f, {-6.3f, -6.3f, -0.5f});
    LiquidCase drop({.walls = sampledFloor +
                              "side { type plane; point (-3e-3 0 0); normal (1 0 0); }",
                     .solidPositions = solid});
    const auto points = randomPoints(200, {-3, -3, 0.2f}, {3, 3, 4});
    drop.place(points);
    computeDensity(drop.liquid, drop.near, drop.walls);
    const auto density = drop.inOrder(drop.liquid.density);

    const Reference<CubicSpline> W{2};              // lengths in spacings, in which V = 1
    const auto table = tabulateHalfSpace(CubicSpline(2));
    const HalfSpaceView halfSpace{{table.data(), int(table.size())}, 2};
    const double latticeSum = [&]
    {
        double sum = 0;
        for (const Vec3& p : latticeBlock(5, 5, 5, 1, {-2, -2, -2})) sum += W.W(norm(p));
        return sum;
    }();
    const auto near = download(drop.walls.view(drop.liquid).particles.volume);
    const auto position = download(drop.walls.view(drop.liquid).particles.position);
    const scalar d = drop.liquid.spacing();
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        double expected = 0;
        for (const Vec3& p : points) expected += W.W(norm(points[i] - p)) / latticeSum;
        for (std::size_t k = 0; k < near.size(); ++k)
        {
            expected += near[k] / (d * d * d) * W.W(norm(points[i] - (1 / d) * position[k]));
        }
        expected += halfSpace(points[i].x + 3).density;
        ASSERT_NEAR(density[i], expected, 5e-6) << i;
    }
}
