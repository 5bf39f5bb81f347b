// Pairs push each other alike: pressure moves momentum between particles and makes none.

#include "support/PressureReference.H"

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
        for (Vec3& p : points) p += random({-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f});
        drop.place(points, randomPoints(512, {-1, -1, -1}, {1, 1, 1}, 2));
        const auto sums = [&](const Buffer<Vec3>& field, const std::vector<Vec3>& before)
        {
            double sum[3] = {0, 0, 0}, sizes = 0;
            const auto now = drop.inOrder(field);
            for (std::size_t i = 0; i < now.size(); ++i)
            {
                const Vec3 step = now[i] - before[i];
                sum[0] += step.x;
                sum[1] += step.y;
                sum[2] += step.z;
                sizes += norm(step);
            }
            // Values of up to eight units are rounded to 5e-7: 512 of them leave about 1e-5, several iterations more.
            for (const double component : sum) EXPECT_NEAR(component, 0, 1e-4) << word;
            return sizes;
        };
        const auto before = drop.inOrder(drop.liquid.predicted);
        iterate(*pressure, drop, 0.02f);
        EXPECT_GT(sums(drop.liquid.predicted, before), 1) << word;

        const auto velocity = drop.inOrder(drop.liquid.velocity);
        pressure->correctVelocities(drop.liquid, drop.near, drop.walls);
        EXPECT_EQ(sums(drop.liquid.velocity, velocity) > 0.5, word == "DFSPH") << word;
    }
}
