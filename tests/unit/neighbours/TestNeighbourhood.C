// SPDX-License-Identifier: GPL-3.0-or-later
// The liquid's neighbours within two supports against all pairs.

#include "neighbours/Neighbourhood.H"

#include "device/Algorithms.H"
#include "support/BruteForce.H"
#include "support/LiquidCase.H"
#include "support/NeighbourLists.H"

#include <limits>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

testing::AssertionResult agrees(const LiquidCase& drop, const std::vector<std::vector<int>>& lists, scalar support)
{
    const auto points = drop.inOrder(drop.liquid.predicted);
    return agreesWithAllPairs(lists, points, points, support, true);
}

std::vector<std::vector<int>> nearOf(const LiquidCase& drop)
{
    const auto id = drop.liquid.id.download();
    return listsOf(drop.near.view(), id, id);
}

scalar numberOf(int i) { return scalar(i * 2654435761u >> 20); }

// A search may visit several at once: how many it finds, and sums of whole numbers below 2^12 that tell them apart.
struct SumFound
{
    NeighbourSearch wide;
    Span<const scalar> number;
    Span<scalar> count, sum;

    HOST_DEVICE void operator()(Group particles, Team team) const
    {
        const scalar support2 = wide.support * wide.support;
        GroupOfParticles group{{}, particles.members()};
        for (int p = 0; p < Group::most; ++p) group.index[p] = particles[p];
        Team::Scalar all[Group::most] = {}, numbers[Group::most] = {};
        wide.forEach(group, [&](auto j) { return number[j]; }, [&](int p, auto its, auto r)
        {
            const auto isNear = squared(r) < support2;
            const auto weight = isNear ? scalar(1) : scalar(0);
            all[p] += weight;
            numbers[p] += weight * its;
        }, team);
        const scalar found = team.sums(all), sumFound = team.sums(numbers);
        if (team.lane >= particles.size) return;
        count[particles.first + team.lane] = found;
        sum[particles.first + team.lane] = sumFound;
    }
};

// Against all pairs. Of random points none is at the support's edge.
testing::AssertionResult wideAgrees(const LiquidCase& drop, const std::vector<scalar>& counts, const std::vector<scalar>& sums)
{
    const scalar support = drop.near.wide(drop.liquid).support;
    const auto points = vectors(drop.liquid.predicted);
    const int n = int(points.size());
    for (int i = 0; i < n; ++i)
    {
        scalar expectedCount = 0, expectedSum = 0;
        for (int j = 0; j < n; ++j)
        {
            if (i == j || norm(points[i] - points[j]) >= support) continue;
            ++expectedCount;
            expectedSum += numberOf(j);
        }
        if (counts[i] == expectedCount && sums[i] == expectedSum) continue;
        return testing::AssertionFailure() << "particle " << i << " has " << counts[i] << " neighbours with the sum "
            << sums[i] << ", not " << expectedCount << " with " << expectedSum;
    }
    return testing::AssertionSuccess();
}

// By groups of all particles, and by groups of those selected, which are all.
void expectWideAgrees(const LiquidCase& drop)
{
    const int n = drop.liquid.owned();
    std::vector<scalar> number;
    for (int i = 0; i < n; ++i) number.push_back(numberOf(i));
    number.resize(n + 16, std::numeric_limits<scalar>::quiet_NaN());        // what a search that looks at several at once shall not take in
    const Buffer<scalar> numbers(number);
    Buffer<scalar> count(n), sum(n);
    const SumFound sumFound{drop.near.wide(drop.liquid), {numbers.span().data, n}, count.span(), sum.span()};
    forEachGroup(n, sumFound);
    EXPECT_TRUE(wideAgrees(drop, count.download(), sum.download()));

    count.setZero();
    Selection all;
    select(Buffer<std::uint8_t>(std::vector<std::uint8_t>(n, 1)), all);
    forEachGroup(all, sumFound);
    EXPECT_TRUE(wideAgrees(drop, count.download(), sum.download()));
}

}

// The wide search comes, changes and goes as models ask for it; the kernel's lists stay the same.
TEST(Neighbourhood, FindsPairsWithinTheKernelsAndAWiderSupport)
{
    LiquidCase drop;
    drop.place(randomPoints(1500, {-4, -4, -4}, {5, 5, 5}));
    const scalar h = drop.liquid.support();
    EXPECT_TRUE(agrees(drop, nearOf(drop), h));
    EXPECT_EQ(drop.near.wide(drop.liquid).support, 0);
    for (const scalar wide : {2 * h, 1.5f * h, scalar(0), 2 * h})
    {
        drop.near.update(drop.liquid, wide);
        EXPECT_TRUE(agrees(drop, nearOf(drop), h)) << wide;
        EXPECT_EQ(drop.near.wide(drop.liquid).support, wide);
        expectWideAgrees(drop);
    }
}

// Particles that moved are listed where they are now.
TEST(Neighbourhood, FollowsThePredictedPositions)
{
    LiquidCase drop;
    drop.place(randomPoints(500, {0, 0, 0}, {5, 5, 5}));
    const scalar wide = 2 * drop.liquid.support();
    drop.near.update(drop.liquid, wide);
    drop.liquid.predicted.upload(placed(randomPoints(500, {0, 0, 0}, {6, 5, 5}, 7)));
    drop.near.update(drop.liquid, wide);
    EXPECT_TRUE(agrees(drop, nearOf(drop), drop.liquid.support()));
    expectWideAgrees(drop);
}
