// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/CapillaryWave.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace shizuku;

// Reference points of Basilisk's test capwave, between two liquids of one density: amplitude of 0.01 at the start, times in 1/omega_0. Half of
// their last digit, and what six digits of the time leave.
TEST(CapillaryWave, HasThePublishedAmplitudes)
{
    const CapillaryWave wave{2*std::numbers::pi, 0.0182571749236, 1, 1, 1};
    const struct { double time, amplitude; } points[] =
    {
        {0.338877, 0.0094816}, {0.677755, 0.00806175}, {1.01663, 0.0059584}, {1.28773, 0.00395254}
    };
    for (const auto& [time, amplitude] : points) EXPECT_NEAR(0.01*wave.amplitude(time/wave.frequency()), amplitude, 2e-7) << time;
}

// Next to no viscosity: a cosine, damped by 2 nu k^2 to first order in nu k^2/omega_0, 1e-4.
TEST(CapillaryWave, OfAThinLiquidSwings)
{
    const CapillaryWave wave{2*std::numbers::pi/4e-3, 2e-8, 0.0728, 998, 0};
    const double omega = wave.frequency(), rate = wave.nu*wave.k*wave.k;
    EXPECT_NEAR(wave.amplitude(0), 1, 1e-9);
    for (double t = 0.1/omega; t < 20/omega; t += 0.7/omega)
    {
        EXPECT_NEAR(wave.amplitude(t), std::exp(-2*rate*t)*std::cos(omega*t), 5e-4) << t;
    }
}

// Rayleigh's fastest wave.
TEST(CapillaryWave, OfAThreadGrows)
{
    EXPECT_NEAR(threadGrowth(0.697, 1, 1, 1), 0.3433, 1e-4);
    EXPECT_LT(threadGrowth(0.66, 1, 1, 1), threadGrowth(0.697, 1, 1, 1));
    EXPECT_LT(threadGrowth(0.73, 1, 1, 1), threadGrowth(0.697, 1, 1, 1));
    EXPECT_EQ(threadGrowth(1, 1, 1, 1), 0);
}
