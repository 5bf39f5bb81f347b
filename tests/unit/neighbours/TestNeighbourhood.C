// The liquid's neighbours within two supports against all pairs.

#include "neighbours/Neighbourhood.H"

#include "support/BruteForce.H"
#include "support/LiquidCase.H"
#include "support/NeighbourLists.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

testing::AssertionResult agrees(const LiquidCase& drop, const std::vector<std::vector<int>>& lists, float support)
{
    const auto points = drop.inOrder(drop.liquid.predicted);
    return agreesWithAllPairs(lists, points, points, support, true);
}

std::vector<std::vector<int>> nearOf(const LiquidCase& drop)
{
    const auto id = drop.liquid.id.download();
    return listsOf(drop.near.view(), id, id);
}

// A search may visit several at once: how many it finds, and sums of whole numbers below 2^12 that tell them apart.
struct SumFound
{
    NeighbourSearch wide;
    Span<const float> number;
    Span<float> count, sum;

    HOST_DEVICE void operator()(int i) const
    {
        const float support2 = wide.support * wide.support;
        Team::Float all{}, numbers{};
        wide.forEach(i, [&](auto j, auto r)
        {
            const auto isNear = squared(r) < support2;
            all += isNear ? 1.0f : 0.0f;
            numbers += isNear ? number[j] : 0;
        });
        count[i] = Team{}.sum(all);
        sum[i] = Team{}.sum(numbers);
    }
};

// Against all pairs. Of random points none is at the support's edge.
testing::AssertionResult wideAgrees(const LiquidCase& drop)
{
    const NeighbourSearch wide = drop.near.wide(drop.liquid);
    const auto points = drop.liquid.predicted.download();
    const int n = int(points.size());
    std::vector<float> number;
    for (int i = 0; i < n; ++i) number.push_back(float(i * 2654435761u >> 20));
    const Buffer<float> numbers(number);
    Buffer<float> count(n), sum(n);
    forEach(n, SumFound{wide, numbers.span(), count.span(), sum.span()});
    const auto counts = count.download(), sums = sum.download();
    for (int i = 0; i < n; ++i)
    {
        float expectedCount = 0, expectedSum = 0;
        for (int j = 0; j < n; ++j)
        {
            if (i == j || norm(points[i] - points[j]) >= wide.support) continue;
            ++expectedCount;
            expectedSum += number[j];
        }
        if (counts[i] == expectedCount && sums[i] == expectedSum) continue;
        return testing::AssertionFailure() << "particle " << i << " has " << counts[i] << " neighbours with the sum "
            << sums[i] << ", not " << expectedCount << " with " << expectedSum;
    }
    return testing::AssertionSuccess();
}

}

// The wide search comes, changes and goes as models ask for it; the kernel's lists stay the same.
TEST(Neighbourhood, FindsPairsWithinTheKernelsAndAWiderSupport)
{
    LiquidCase drop;
    drop.place(randomPoints(1500, {-4, -4, -4}, {5, 5, 5}));
    const float h = drop.liquid.support();
    EXPECT_TRUE(agrees(drop, nearOf(drop), h));
    EXPECT_EQ(drop.near.wide(drop.liquid).support, 0);
    for (const float wide : {2 * h, 1.5f * h, 0.0f, 2 * h})
    {
        drop.near.update(drop.liquid, wide);
        EXPECT_TRUE(agrees(drop, nearOf(drop), h)) << wide;
        EXPECT_EQ(drop.near.wide(drop.liquid).support, wide);
        EXPECT_TRUE(wideAgrees(drop)) << wide;
    }
}

// Particles that moved are listed where they are now.
TEST(Neighbourhood, FollowsThePredictedPositions)
{
    LiquidCase drop;
    drop.place(randomPoints(500, {0, 0, 0}, {5, 5, 5}));
    const float wide = 2 * drop.liquid.support();
    drop.near.update(drop.liquid, wide);
    drop.liquid.predicted.upload(randomPoints(500, {0, 0, 0}, {6, 5, 5}, 7));
    drop.near.update(drop.liquid, wide);
    EXPECT_TRUE(agrees(drop, nearOf(drop), drop.liquid.support()));
    EXPECT_TRUE(wideAgrees(drop));
}
