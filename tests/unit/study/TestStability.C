// SPDX-License-Identifier: GPL-3.0-or-later
// Each class of stabilityMap, reached by numbers on its side of the rule's limit.

#include "study/Stability.H"

#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace shizuku::test
{

namespace
{

const StabilityLimits limits;

// A run without fault: 61 degrees where 60 are asked for, from 90.
StabilityEvidence good()
{
    StabilityEvidence e;
    e.nonFinite = 0;
    e.speed = 0.001;
    e.stray = 0;
    e.behindWalls = 0;
    e.volumeChange = 0.2;
    e.nearest = 0.95;
    e.reference = 60;
    e.measured = 61;
    e.start = 90;
    e.within = 10;
    return e;
}

std::string with(double StabilityEvidence::* number, double value)
{
    StabilityEvidence e = good();
    e.*number = value;
    return nameOf(classify(e, limits));
}

std::string stoppedFor(const std::string& reason)
{
    StabilityEvidence e;
    e.finished = false;
    e.reason = reason;
    return nameOf(classify(e, limits));
}

TEST(Stability, RunsThatEnd)
{
    EXPECT_EQ(nameOf(classify(good(), limits)), "calm");
    EXPECT_EQ(with(&StabilityEvidence::speed, 0.019), "calm");
    EXPECT_EQ(with(&StabilityEvidence::speed, 0.021), "noisy");
    EXPECT_EQ(with(&StabilityEvidence::speed, 10.1), "exploded");
    EXPECT_EQ(with(&StabilityEvidence::stray, 10.1), "exploded");
    EXPECT_EQ(with(&StabilityEvidence::stray, 9.9), "calm");
    EXPECT_EQ(with(&StabilityEvidence::nonFinite, 1), "notANumber");
    EXPECT_EQ(with(&StabilityEvidence::behindWalls, 0.6), "leaked");
    EXPECT_EQ(with(&StabilityEvidence::volumeChange, -1.1), "volumeLost");
    EXPECT_EQ(with(&StabilityEvidence::volumeChange, 1.1), "volumeLost");
    EXPECT_EQ(with(&StabilityEvidence::nearest, 0.59), "clustered");
    EXPECT_EQ(with(&StabilityEvidence::measured, 71), "wrong");         // 19 of 30 degrees done
    EXPECT_EQ(with(&StabilityEvidence::measured, 84), "frozen");        // 6 of 30, a fifth
    EXPECT_EQ(with(&StabilityEvidence::measured, 82), "wrong");         // 8 of 30, above a quarter
    EXPECT_EQ(with(&StabilityEvidence::measured, 49), "wrong");         // beyond the answer
    EXPECT_EQ(with(&StabilityEvidence::measured, std::nan("")), "wrong");
}

TEST(Stability, RunsThatWereStopped)
{
    EXPECT_EQ(stoppedFor("The run diverged at time 1 s: the position or velocity of 3 particles is not a finite number."), "notANumber");
    EXPECT_EQ(stoppedFor("a particle moves at 3 m/s, by 12 particle spacings in one step of 1 s."), "exploded");
    EXPECT_EQ(stoppedFor("The step of 1 s would need 2000 sub-steps (Courant limit), more than maxSubSteps 1000."), "exploded");
    EXPECT_EQ(stoppedFor("The step of 1 s would need 2000 sub-steps (capillary limit), more than maxSubSteps 1000."), "refused");
    EXPECT_EQ(stoppedFor("Particles are inside of the wall"), "refused");
    EXPECT_EQ(stoppedFor("ended by signal 9"), "died");
    EXPECT_EQ(stoppedFor("Stopped after 2 s, the limit of its time"), "died");
}

TEST(Stability, NumbersThatWereNotMeasuredAreNotJudged)
{
    EXPECT_EQ(nameOf(classify({}, limits)), "calm");
}

TEST(Stability, EveryClassHasANameOfItsOwn)
{
    std::vector<std::string> names;
    for (const Stability stability : allStabilities()) names.push_back(nameOf(stability));
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::unique(names.begin(), names.end()) - names.begin(), 11);
}

TEST(Stability, LimitsComeFromTheStudy)
{
    const StabilityLimits own = StabilityLimits::read(Dictionary::parse("noisySpeed 0.5;"));
    StabilityEvidence e = good();
    e.speed = 0.4;
    EXPECT_EQ(nameOf(classify(e, own)), "calm");
    EXPECT_EQ(own.volumeLoss, 1);
    EXPECT_TRUE(holds(messageOf([] { StabilityLimits::read(Dictionary::parse("volumeLoss -1;")); }), {"volumeLoss"}));
}

}

}
