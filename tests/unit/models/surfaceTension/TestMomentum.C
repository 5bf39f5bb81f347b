// SPDX-License-Identifier: GPL-3.0-or-later
// Central forces are equal and opposite; the curvature of the colour field has no such pairs.

#include "support/PairForceMeter.H"
#include "support/VectorSum.H"

using namespace shizuku;
using namespace shizuku::test;

TEST(SurfaceTension, ConservesMomentumWhereItsForcesArePairs)
{
    for (const std::string word : {"Becker2007", "Kondo2007", "Tartakovsky2005", "Mueller2003"})
    {
        LiquidCase drop;
        const auto tension = makeTension(drop, word);
        drop.place(randomPoints(500, {0, 0, 0}, {7, 7, 7}, 9));
        const VectorSum forces = sumOf(accelerationsOf(drop, *tension));
        // What is left are the roundings of 500 sums of some thirty terms.
        double left = 0;
        for (const double component : forces.components) left += std::abs(component);
        EXPECT_EQ(left < 3e-6 * forces.sizes, word != "Mueller2003") << word << ' ' << left / forces.sizes;
    }
}
