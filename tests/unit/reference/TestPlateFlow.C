// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/PlateFlow.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace shizuku;

TEST(PlateFlow, IsCouettesInTheEnd)
{
    for (const double z : {0.0, 0.25, 1.0}) EXPECT_NEAR(plateFlow(z, 5), 1 - z, 1e-15);
}

// Series and error function, where both hold: the plate at rest has an image of erfc(1/(2 sqrt(0.02))) = 6e-7.
TEST(PlateFlow, IsStokesFirstProblemAtFirst)
{
    for (const double z : {0.05, 0.2, 0.5}) EXPECT_NEAR(plateFlow(z, 0.02), stokesFirstProblem(z/std::sqrt(0.02)), 2e-6) << z;
    EXPECT_NEAR(plateFlow(0.1, 0.01), plateFlow(0.1, 0.01*(1 - 1e-9)), 1e-8);       // where one takes over from the other
    EXPECT_EQ(plateFlow(0.5, 0), 0);
    EXPECT_EQ(plateFlow(0, 0), 1);
}

// du/dt = nu d2u/dz2, by differences: 1e-4 of what either is.
TEST(PlateFlow, SolvesTheDiffusionOfMomentum)
{
    constexpr double h = 1e-3, dt = 1e-6;
    for (const double z : {0.2, 0.6})
    {
        for (const double t : {0.03, 0.2})
        {
            const double rate = (plateFlow(z, t + dt) - plateFlow(z, t - dt))/(2*dt);
            const double bent = (plateFlow(z + h, t) - 2*plateFlow(z, t) + plateFlow(z - h, t))/(h*h);
            EXPECT_NEAR(rate, bent, 1e-4*std::abs(bent) + 1e-7);
        }
    }
}
