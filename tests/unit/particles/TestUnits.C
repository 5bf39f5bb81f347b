// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/Units.H"

#include "particles/Liquid.H"
#include "support/PointSets.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// Of drops of a micrometre, a millimetre and a metre, made of water.
std::vector<Units> unitsOfDrops()
{
    std::vector<Units> units;
    for (const double spacing : {1.3e-7, 1.28e-4, 0.11})
    {
        const LiquidProperties water{spacing, 998, 1e-6, 0.0728};
        units.push_back(Units::near(spacing, water.characteristicTime(), water.particleMass()));
    }
    return units;
}

}

TEST(Units, ArePowersOfTwoNearTheGivenValues)
{
    for (const double value : {1.28e-4, 3.7e-12, 0.7, 900.0})
    {
        const Units units = Units::near(value, value, value);
        int exponent;
        EXPECT_EQ(std::frexp(units.length, &exponent), 0.5);
        EXPECT_LE(std::abs(std::log2(value / units.length)), 0.5);      // nearest on the scale of exponents
        EXPECT_EQ(units.time, units.length);
        EXPECT_EQ(units.mass, units.length);
    }
}

// A power of two shifts the exponent: not one bit of a scalar is lost on the way to SI and back.
TEST(Units, RoundTripBitwise)
{
    const Dimensions all[]
    {
        dimensions::none, dimensions::length, dimensions::velocity, dimensions::acceleration, dimensions::density,
        dimensions::kinematicViscosity, dimensions::surfaceTension
    };
    RandomNumbers random(11);
    for (const Units& units : unitsOfDrops())
    {
        for (const Dimensions& d : all)
        {
            for (int i = 0; i < 200; ++i)
            {
                const scalar value = std::exp(random(-20, 20)) * random(-1, 1);
                ASSERT_EQ(units.toScaled(units.toSI(value, d), d), value) << d.str();
            }
        }
    }
}

TEST(Units, CombineByTheExponents)
{
    const Units units{0.5, 0.25, 4};
    EXPECT_EQ(units.of(dimensions::acceleration), 0.5 / (0.25 * 0.25));
    EXPECT_EQ(units.of(dimensions::surfaceTension), 4 / (0.25 * 0.25));
    EXPECT_EQ(units.of(dimensions::density), 4 / 0.125);
    EXPECT_EQ(units.of(dimensions::none), 1);
    EXPECT_EQ(units.toScaled(3, dimensions::length), 6);
    EXPECT_EQ(units.toSI(6, dimensions::length), 3);
}

// sqrt(rho d^3/sigma), and with no tension the time in which gravity moves a particle by its spacing.
TEST(LiquidProperties, GiveTheCharacteristicTime)
{
    EXPECT_DOUBLE_EQ((LiquidProperties{1e-3, 1000, 1e-6, 0.1}.characteristicTime()), std::sqrt(1000 * 1e-9 / 0.1));
    EXPECT_DOUBLE_EQ((LiquidProperties{1e-3, 1000, 1e-6, 0}.characteristicTime()), std::sqrt(1e-3 / 9.81));
}
