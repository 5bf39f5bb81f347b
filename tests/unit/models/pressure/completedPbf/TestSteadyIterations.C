// SPDX-License-Identifier: GPL-3.0-or-later
// How many iterations the steps of completedPbf make.

#include "models/pressure/shared/IterationCount.H"
#include "support/PairForceMeter.H"
#include "support/PressureReference.H"

#include <algorithm>
#include <string>
#include <vector>

using namespace shizuku;
using namespace shizuku::test;

// Six where the tolerance is out of reach, in a step of the capillary length sqrt(rho d^3/(2 pi sigma)) at most; of k times that
// the root of k as many, above 2.8 k/2.8 times that. Not without tension, where no such step is, nor where tolerance 0 asks for just so many.
TEST(SteadyIterations, IteratesMoreInStepsLongerThanTheCapillaryOne)
{
    const auto made = [](bool tension, const std::string& tolerance, scalar steps)
    {
        LiquidCase drop;
        const auto model = tension ? makeTension(drop, "continuumSurfaceForce") : nullptr;
        const auto pressure = makePressure(drop, "completedPbf", "tolerance " + tolerance + "; relaxation 0.01;");
        drop.place(latticeBlock(6, 6, 6, 0.9f));
        return iterate(*pressure, drop, drop.capillarySteps(steps));
    };
    EXPECT_EQ(made(true, "1e-9", 0.7f), 6);
    EXPECT_EQ(made(true, "1e-9", 1), 6);
    EXPECT_EQ(made(true, "1e-9", 2), 8);
    EXPECT_EQ(made(true, "1e-9", 2.8f), 10);
    EXPECT_EQ(made(true, "1e-9", 5), 24);
    EXPECT_EQ(made(false, "1e-9", 5), 6);
    EXPECT_EQ(made(true, "0", 5), 6);
}

// One more a step would leave the first long steps without an answer to their tension.
TEST(SteadyIterations, IteratesMoreInTheFirstLongStepAtOnce)
{
    LiquidCase drop;
    const auto model = makeTension(drop, "continuumSurfaceForce");
    const auto pressure = makePressure(drop, "completedPbf", "tolerance 1e-9; relaxation 0.01;");
    std::vector<int> made;
    for (const scalar steps : {0.7f, 5.0f, 5.0f, 0.7f, 2.8f})
    {
        drop.place(latticeBlock(6, 6, 6, 0.9f));
        made.push_back(iterate(*pressure, drop, drop.capillarySteps(steps)));
    }
    EXPECT_EQ(made, (std::vector<int>{6, 24, 24, 6, 10}));
}

// Also more than are allowed, and where the tolerance would be kept with fewer; but not where tolerance 0 asks for just so many.
TEST(SteadyIterations, MakesAnIterationForEachPartOfAForce)
{
    const auto made = [](const std::string& tolerance, int parts)
    {
        LiquidCase drop;
        const auto pressure = makePressure(drop, "completedPbf", "minIterations 1; maxIterations 4; tolerance " + tolerance + ";");
        drop.place(latticeBlock(6, 6, 6, 1.05f));
        pressure->requireIterations(parts);
        return iterate(*pressure, drop, 0.02f);
    };
    EXPECT_EQ(made("0.05", 0), 1);
    EXPECT_EQ(made("0.05", 3), 3);
    EXPECT_EQ(made("0.05", 9), 9);
    EXPECT_EQ(made("0", 9), 4);
}

// What a step needed that was too dense is given back by calm ones, an iteration every few steps (IterationCount), down to the least: also after a step
// that made as many as are allowed. A step does not know of its own liquid: the first calm one makes as many as the dense one.
TEST(SteadyIterations, TakesFewerIterationsWhereLittleIsLeft)
{
    for (const int least : {0, 1})
    {
        LiquidCase drop;
        const std::string controls = "minIterations " + std::to_string(least) + "; maxIterations 4; tolerance 0.05; relaxation 0.3;";
        const auto pressure = makePressure(drop, "completedPbf", controls);
        drop.place(latticeBlock(8, 8, 8, 0.8f));
        EXPECT_EQ(iterate(*pressure, drop, 0.02f), 4);
        constexpr int patience = IterationCount::leastPatience;
        for (int step = 0; step < 6*patience; ++step)
        {
            drop.place(latticeBlock(8, 8, 8, 1.05f));
            EXPECT_EQ(iterate(*pressure, drop, 0.02f), std::max(4 - step/patience, least)) << step;
        }
    }
}

// And dense liquid behind calm one gets an iteration more each step, up to the most: also where calm steps make none.
TEST(SteadyIterations, TakesMoreIterationsWhereMuchIsLeft)
{
    for (const int least : {0, 1})
    {
        LiquidCase drop;
        const std::string controls = "minIterations " + std::to_string(least) + "; maxIterations 4; tolerance 0.05;";
        const auto pressure = makePressure(drop, "completedPbf", controls);
        drop.place(latticeBlock(8, 8, 8, 1.05f));
        EXPECT_EQ(iterate(*pressure, drop, 0.02f), least);
        std::vector<int> made;
        for (int step = 0; step < 6; ++step)
        {
            drop.place(latticeBlock(8, 8, 8, 0.8f));
            made.push_back(iterate(*pressure, drop, 0.02f));
        }
        EXPECT_EQ(made, least == 0 ? (std::vector<int>{0, 1, 2, 3, 4, 4}) : (std::vector<int>{1, 2, 3, 4, 4, 4}));
    }
}

// Compressed by nine percent on the average, which so small corrections hardly change, below the tolerance and above half of it: as
// many iterations as the step before, be it all of them or one.
TEST(SteadyIterations, MakesAsManyIterationsAsBeforeWhereHalfIsLeft)
{
    LiquidCase drop, other;                 // the numbers of iterations are the liquid's
    const std::string controls = "minIterations 1; maxIterations 4; tolerance 0.13; relaxation 1e-3;";
    const auto calm = makePressure(other, "completedPbf", controls), before = makePressure(drop, "completedPbf", controls);
    drop.place(latticeBlock(8, 8, 8, 0.8f));
    EXPECT_EQ(iterate(*before, drop, 0.02f), 4);
    for (int step = 0; step < 3; ++step)
    {
        drop.place(latticeBlock(8, 8, 8, 0.97f));
        EXPECT_EQ(iterate(*before, drop, 0.02f), 4) << step;
        other.place(latticeBlock(8, 8, 8, 0.97f));
        EXPECT_EQ(iterate(*calm, other, 0.02f), 1) << step;
    }
}
