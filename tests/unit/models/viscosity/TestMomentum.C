// SPDX-License-Identifier: GPL-3.0-or-later
// Viscosity moves momentum between particles and makes none.

#include "models/viscosity/Viscosity.H"

#include "support/LiquidCase.H"

using namespace shizuku;
using namespace shizuku::test;

TEST(Viscosity, ConservesMomentum)
{
    for (const std::string word : {"XSPH", "laminar", "newtonian"})
    {
        for (const std::string kernel : {"type cubicSpline; support 2;", "type poly6Spiky; support 2.5;"})
        {
            LiquidCase drop({.kernel = kernel, .liquidProperties = "rho 1000; nu 1e-5; sigma 0.072;"});
            const auto points = randomPoints(600, {0, 0, 0}, {8, 8, 8});
            drop.place(points, randomPoints(600, {-1, -1, -1}, {1, 1, 1}, 2));
            const auto before = drop.inOrder(drop.liquid.velocity);
            const auto model = Viscosity::New(Dictionary::parse("viscosity " + word + ";"), drop.liquid);
            model->apply(drop.liquid, drop.near, drop.walls, 0.02f);
            const auto after = drop.inOrder(drop.liquid.velocity);

            double sum[3] = {0, 0, 0}, changes = 0;
            for (int i = 0; i < 600; ++i)
            {
                const Vec3 change = after[i] - before[i];
                sum[0] += change.x;
                sum[1] += change.y;
                sum[2] += change.z;
                changes += norm(change);
            }
            // Velocities of order one, rounded to 6e-8: 600 of them leave about 25 times that.
            EXPECT_GT(changes, 0.5) << word;
            for (const double component : sum) EXPECT_NEAR(component, 0, 1e-5) << word;
        }
    }
}

TEST(Viscosity, LeavesUniformMotionAlone)
{
    for (const std::string word : {"XSPH", "laminar", "newtonian", "none"})
    {
        LiquidCase drop;
        drop.place(latticeBall(3), std::vector<Vec3>(latticeBall(3).size(), {1, -2, 0.3f}));
        const auto model = Viscosity::New(Dictionary::parse("viscosity " + word + ";"), drop.liquid);
        model->apply(drop.liquid, drop.near, drop.walls, 0.1f);
        for (const Vec3& u : drop.liquid.velocity.download())
        {
            ASSERT_EQ(u.x, 1);          // differences of equal velocities are zero: bitwise
            ASSERT_EQ(u.y, -2);
            ASSERT_EQ(u.z, 0.3f);
        }
    }
}
