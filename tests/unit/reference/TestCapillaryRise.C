// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/CapillaryRise.H"

#include "core/messages/Error.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace shizuku;

// Without weight, of a liquid whose inertia lasts R^2/(8 nu) = 1.25e-5 s: (y + e)^2 grows as sigma cos(theta) R t/(2 rho nu). At 0.01 s that leaves 1e-3 of the time.
TEST(CapillaryRise, OfAThickLiquidIsLucasAndWashburns)
{
    const CapillaryRise rise{1e-3, 60, 1000, 1e-2, 0.05, 0, 0};
    const std::vector<double> y = rise.heights(0, {0, 0.01, 0.25, 4});
    const double entry = 0.6e-3, rate = 0.05*0.5*1e-3/(2*1000*1e-2);
    EXPECT_EQ(y[0], 0);
    for (const auto& [i, t] : {std::pair{1, 0.01}, {2, 0.25}, {3, 4.0}})
    {
        EXPECT_NEAR(std::pow(y[i] + entry, 2) - entry*entry, rate*t, 2e-3*rate*t) << t;
    }
}

// By hand: 2 x 0.0728 x 0.5/(998 x 9.81 x 1e-3) m; a dish of nine times the section that sinks by a ninth of the rise.
TEST(CapillaryRise, EndsWhereJurinHasIt)
{
    CapillaryRise rise{1e-3, 60, 998, 1e-4, 0.0728, 9.81, 2e-3};
    EXPECT_NEAR(rise.finalHeight(), 7.43587e-3, 1e-8);
    EXPECT_NEAR(rise.heights(0, {0, 20}).back(), rise.finalHeight(), 1e-8);
    rise.areaRatio = 1.0/9;
    EXPECT_NEAR(rise.heights(0, {0, 20}).back(), 0.9*7.43587e-3, 1e-7);
}

// Without viscosity a column that begins at the mouth overshoots by half of its height: (l v)^2/2 = g (h l^2/2 - l^3/3) by the momentum's equation, without what moves before the mouth.
// It begins at a thousandth of that height, which takes 1e-6 of it away.
TEST(CapillaryRise, OfAThinLiquidOvershootsByHalf)
{
    const CapillaryRise rise{1e-3, 60, 998, 0, 0.0728, 9.81, 0, 0, 0, 0};
    const double h = rise.finalHeight();
    std::vector<double> times;
    for (int i = 0; i <= 2000; ++i) times.push_back(1e-4*i);
    double highest = 0;
    for (const double y : rise.heights(1e-3*h, times)) highest = std::max(highest, y);
    EXPECT_NEAR(highest, 1.5*h, 1e-5*h);        // 1e-4 s beside the top: g (1e-4 s)^2/6 is 2e-6 of it
}

// A contact line that has to be pulled takes time, and none of the height.
TEST(CapillaryRise, OfAMovingAngleIsLate)
{
    CapillaryRise rise{1e-3, 30, 960, 5e-5, 0.0208, 9.81, 1.2e-3};
    const std::vector<double> still = rise.heights(0, {0, 0.05, 5});
    rise.slipLength = 1e-4;
    const std::vector<double> moving = rise.heights(0, {0, 0.05, 5});
    EXPECT_LT(moving[1], 0.9*still[1]);
    EXPECT_NEAR(moving[2], still[2], 1e-4*still[2]);
}

// A computed curve of a column between plates, half a gap of 5 mm, open below, 10 mm high at first, that creeps (Omega = 10): apexes, 0.84 mm below the mean height. The equation
// leaves out how the profile develops and the shape of the meniscus: 3 % of Jurin's 20 mm. Columns that swing differ by how liquid enters: at an end at zero pressure with its momentum.
TEST(CapillaryRise, BetweenPlatesIsThatOfAComputedCurve)
{
    const std::vector<double> times{0, 0.1, 0.2, 0.3, 0.5, 0.75, 1, 2.7}, apexes{9.2, 13.7, 16.2, 17.7, 18.6, 19.0, 19.1, 19.2};        // s, mm
    CapillaryRise rise{5e-3, 30, 3.3255, 0.01/3.3255, 0.01, 26.042, 0, 0, 0, 0};
    rise.isBetweenPlates = true;
    EXPECT_NEAR(rise.finalHeight(), 20e-3, 0.02e-3);
    const std::vector<double> y = rise.heights(10e-3, times);
    double squares = 0;
    for (std::size_t i = 1; i < y.size(); ++i) squares += std::pow(1e3*y[i] - 0.84 - apexes[i], 2);
    EXPECT_LT(100*std::sqrt(squares/double(y.size() - 1))/20, 3);
}

TEST(CapillaryRise, RefusesNoColumn)
{
    const CapillaryRise rise{1e-3, 60, 998, 0, 0.0728, 9.81, 0, 0, 0, 0};
    EXPECT_THROW(rise.heights(0, {0, 1}), FatalError);
}
