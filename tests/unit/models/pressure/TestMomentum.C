// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs push each other alike: pressure moves momentum between particles and makes none.

#include "support/PressureReference.H"
#include "support/VectorSum.H"

using namespace shizuku;
using namespace shizuku::test;

TEST(Pressure, ConservesMomentumWithoutWalls)
{
    for (const std::string word : {"Clavet2005", "DFSPH", "PCISPH", "WCSPH", "idealGas"})
    {
        LiquidCase drop;
        const bool explicitly = word == "Clavet2005" || word == "WCSPH" || word == "idealGas";
        const auto pressure = makePressure(drop, word, explicitly ? "maxSpeed 0.3;" : "maxIterations 3; tolerance 0;");
        RandomNumbers random(4);
        auto points = latticeBlock(8, 8, 8, 0.92f);
        disorder(points, 0.1f, random);
        drop.place(points, randomPoints(512, {-1, -1, -1}, {1, 1, 1}, 2));
        const auto sums = [&](const auto& field, const std::vector<Vec3>& before)
        {
            const VectorSum steps = sumOfSteps(before, drop.inOrder(field));
            // Values of up to eight units are rounded to 5e-7: 512 of them leave about 1e-5, several iterations more.
            for (const double component : steps.components) EXPECT_NEAR(component, 0, 1e-4) << word;
            return steps.sizes;
        };
        const auto before = drop.inOrder(drop.liquid.predicted);
        iterate(*pressure, drop, 0.02f);
        EXPECT_GT(sums(drop.liquid.predicted, before), 1) << word;

        const auto velocity = drop.inOrder(drop.liquid.velocity);
        pressure->correctVelocities(drop.liquid, drop.near, drop.walls);
        EXPECT_EQ(sums(drop.liquid.velocity, velocity) > 0.5, word == "DFSPH") << word;
    }
}
