// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/DropOscillation.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace shizuku;

namespace
{

constexpr double pi = std::numbers::pi;

}

// The validation ladder's own figure: a drop of water of R = 1 mm swings in mode 2 with a period of 8.2 ms.
TEST(DropOscillation, HasThePeriodOfRayleigh)
{
    EXPECT_NEAR(2*pi/dropFrequency(2, 0.0728, 998, 1e-3), 8.2e-3, 0.05e-3);
    // omega^2 of mode 3 to that of mode 2 is 30/8.
    EXPECT_NEAR(std::pow(dropFrequency(3, 1, 1, 1)/dropFrequency(2, 1, 1, 1), 2), 30.0/8, 1e-12);
    EXPECT_NEAR(dropDamping(2, 1e-6, 1e-3), 5, 1e-12);
}

TEST(DropOscillation, FitFindsFrequencyAndDamping)
{
    const double frequency = 766, damping = 25;
    std::vector<double> t, y;
    for (int i = 0; i <= 125; ++i)
    {
        t.push_back(2e-4*i);
        y.push_back(0.01 + 0.1*std::exp(-damping*t.back())*std::cos(frequency*t.back() + 0.4));
    }
    const auto fit = fitDampedOscillation(t, y, 700);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->frequency, frequency, 1e-5*frequency);     // the search ends at 1e-9; the damping's net is coarser
    EXPECT_NEAR(fit->damping, damping, 1e-3*damping);
    EXPECT_NEAR(fit->mean, 0.01, 1e-6);
    EXPECT_LT(fit->rms, 1e-6);
    EXPECT_NEAR(fit->at(3e-3), 0.01 + 0.1*std::exp(-damping*3e-3)*std::cos(frequency*3e-3 + 0.4), 1e-5);
}

// Noise of a tenth of the amplitude on three periods moves the frequency by some 0.1/(sqrt(n) omega T) of itself.
TEST(DropOscillation, FitBearsNoise)
{
    const double frequency = 766;
    std::vector<double> t, y;
    for (int i = 0; i <= 125; ++i)
    {
        t.push_back(2e-4*i);
        y.push_back(std::cos(frequency*t.back()) + 0.1*std::sqrt(2.0)*std::sin(12.9898*i*i));
    }
    const auto fit = fitDampedOscillation(t, y, 1000);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->frequency, frequency, 0.01*frequency);
}

TEST(DropOscillation, FitSaysWhereThereIsNone)
{
    EXPECT_FALSE(fitDampedOscillation({0, 1, 2}, {0, 1, 0}, 1));
    std::vector<double> t, slow;
    for (int i = 0; i <= 125; ++i)
    {
        t.push_back(2e-4*i);
        slow.push_back(std::cos(100*t.back()));         // far below the half of what is expected
    }
    EXPECT_FALSE(fitDampedOscillation(t, slow, 766));
}

TEST(DropOscillation, FitOfADecayFindsTheDamping)
{
    const double frequency = 190, damping = 714;
    std::vector<double> t, y, flat;
    for (int i = 0; i <= 40; ++i)
    {
        t.push_back(1e-3 + 1e-4*i);
        y.push_back(-0.02 + 0.1*std::exp(-damping*t.back())*std::cos(frequency*t.back() - 1));
        flat.push_back(0.3);
    }
    for (const double expected : {714.0, 300.0, 2000.0})
    {
        const auto fit = fitDecay(t, y, frequency, expected);
        ASSERT_TRUE(fit);
        EXPECT_NEAR(fit->damping, damping, 1e-4*damping);
        EXPECT_NEAR(fit->mean, -0.02, 1e-6);
    }
    EXPECT_FALSE(fitDecay(t, y, frequency, 8*damping));       // out of its reach
    EXPECT_FALSE(fitDecay({0, 1, 2}, {1, 2, 3}, frequency, damping));
}
