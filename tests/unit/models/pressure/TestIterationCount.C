// SPDX-License-Identifier: GPL-3.0-or-later
// The number of pressure iterations over the steps: it rises at once, falls where that is borne, and does not go round.

#include "models/pressure/shared/IterationCount.H"

#include <gtest/gtest.h>

#include <vector>

using namespace shizuku;

namespace
{

constexpr IterationControls controls{2, 6, 1e-3};

// The numbers of a liquid, and what a step leaves to the next.
struct Steps
{
    double count = 2, borne = 0, patience = IterationCount::leastPatience, lowered = 0;

    int after(double compression)
    {
        IterationCount(count, borne, patience, lowered).follow(compression, controls);
        return int(count);
    }
};

}

TEST(IterationCount, RisesInEachStepAndNoFurtherThanAllowed)
{
    Steps steps;
    for (const int expected : {3, 4, 5, 6, 6, 6}) EXPECT_EQ(steps.after(1.1e-3), expected);
}

TEST(IterationCount, StaysWhereCompressionIsBetweenHalfAndTheWholeTolerance)
{
    Steps steps{.count = 4};
    for (int k = 0; k < 1000; ++k) EXPECT_EQ(steps.after(k % 2 ? 0.51e-3 : 0.99e-3), 4);
}

// Four steps in a row for each: 6, 5, 4, 3, 2.
TEST(IterationCount, FallsWhereFewerAreBorne)
{
    Steps steps{.count = 6};
    for (int k = 1; k <= 40; ++k) EXPECT_EQ(steps.after(1e-4), std::max(6 - k/4, 2)) << k;
    EXPECT_EQ(steps.patience, IterationCount::leastPatience);
}

TEST(IterationCount, AStepThatDoesNotBearFewerBeginsTheCountAnew)
{
    Steps steps{.count = 4};
    for (int k = 0; k < 100; ++k) EXPECT_EQ(steps.after(k % 4 == 3 ? 0.7e-3 : 0.4e-3), 4);
}

// Liquid whose compression relaxes by a fifth a step to what the number leaves: too much with two iterations, less than half of the tolerance with three. A
// number that follows each step is two in four of every sixteen steps. This one tries two less and less often, in the end once in 256 steps, for four.
TEST(IterationCount, DoesNotGoRound)
{
    Steps steps{.count = 3};
    double compression = 1e-3;
    std::vector<int> counts;
    for (int k = 0; k < 4000; ++k)
    {
        const double left = steps.count < 3 ? 1.5e-3 : 0.45e-3;
        compression += (left - compression)/5;
        counts.push_back(steps.after(compression));
    }
    int changes = 0, three = 0;
    for (int k = 2001; k < 4000; ++k)
    {
        changes += counts[k] != counts[k - 1];
        three += counts[k] == 3;
    }
    EXPECT_LE(changes, 2*(2000/256 + 1) + 2);
    EXPECT_GE(three, 1800);
    EXPECT_LE(*std::max_element(counts.begin() + 100, counts.end()), 4);
}

// After it has gone to and fro, liquid that has come to rest falls to the least number within three times the longest patience.
TEST(IterationCount, ForgetsThatItWentToAndFro)
{
    Steps steps{.count = 6, .patience = IterationCount::mostPatience};
    int taken = 0;
    while (steps.after(1e-4) > 2) ++taken;
    EXPECT_LE(taken, 3*IterationCount::mostPatience);
}
