// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/ViscousDrop.H"

#include "reference/DropOscillation.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace shizuku;

namespace
{

// Of water but for the viscosity, R = 1 mm.
DropMode mode2(double nu) { return viscousDropMode(2, nu, 0.0728, 998, 1e-3); }

}

// Figures of a solver that is none of this project's, with as many digits as they have: half of the last one, and a bit for rho and sigma.
TEST(ViscousDrop, HasThePublishedModes)
{
    const struct
    {
        double nu, damping, digit, period, digitOfPeriod;       // m2/s, 1/s, ms
    }
    rows[] =
    {
        {1e-6, 4.85, 0.005, 8.23, 0.005}, {1e-5, 44.7, 0.05, 8.28, 0.005}, {2e-5, 84.2, 0.05, 8.38, 0.005}, {5e-5, 189, 0.5, 8.73, 0.005},
        {1e-4, 362, 0.5, 9.73, 0.005}, {2e-4, 714, 0.5, 33.1, 0.05}
    };
    for (const auto& row : rows)
    {
        const DropMode mode = mode2(row.nu);
        EXPECT_NEAR(mode.damping, row.damping, 1.2*row.digit) << row.nu;
        EXPECT_NEAR(2e3*std::numbers::pi/mode.frequency, row.period, 1.2*row.digitOfPeriod) << row.nu;
    }
}

// The layer at the surface in which the motion turns takes off a share of the order of sqrt(nu/(omega R^2)).
TEST(ViscousDrop, ComesToLambsDamping)
{
    for (const int l : {2, 3, 5})
    {
        const double omega = dropFrequency(l, 0.0728, 998, 1e-3);
        for (const double nu : {1e-8, 1e-9})
        {
            const DropMode mode = viscousDropMode(l, nu, 0.0728, 998, 1e-3);
            EXPECT_NEAR(mode.damping/dropDamping(l, nu, 1e-3), 1, 5*std::sqrt(nu/(omega*1e-6))) << l;
            EXPECT_NEAR(mode.frequency/omega, 1, 1e-4) << l;
        }
    }
}

// Without inertia mode 2 decays by 20/19 sigma/(rho nu R). Inertia is a small part of it at a hundred times the viscosity from which on it creeps.
TEST(ViscousDrop, CreepsWhereItIsThick)
{
    for (const double nu : {3e-4, 1e-3, 2e-2})
    {
        const DropMode mode = mode2(nu);
        EXPECT_EQ(mode.frequency, 0) << nu;
        const double creeping = 20.0/19*0.0728/(998*nu*1e-3);
        EXPECT_NEAR(mode.damping/creeping, 1, nu < 1e-3 ? 0.4 : nu < 1e-2 ? 0.02 : 1e-4) << nu;
    }
}
