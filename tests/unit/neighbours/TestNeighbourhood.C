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

constexpr int most = 1000;          // within the wide support

struct StoreFound
{
    NeighbourSearch wide;
    Span<int> count, found;

    HOST_DEVICE void operator()(int i) const
    {
        count[i] = 0;
        wide.forEach(i, [&](int j)
        {
            if (count[i] < most) found[most * i + count[i]] = j;
            ++count[i];
        });
    }
};

std::vector<std::vector<int>> wideOf(const LiquidCase& drop)
{
    const auto id = drop.liquid.id.download();
    const int n = int(id.size());
    Buffer<int> count(n), found(most * n);
    forEach(n, StoreFound{drop.near.wide(drop.liquid), count.span(), found.span()});
    const auto counts = count.download(), numbers = found.download();
    std::vector<std::vector<int>> lists(n);
    for (int i = 0; i < n; ++i)
    {
        for (int k = 0; k < counts[i]; ++k) lists[id[i]].push_back(int(id[numbers.at(most * i + k)]));
    }
    return lists;
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
        EXPECT_TRUE(agrees(drop, wideOf(drop), wide)) << wide;
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
    EXPECT_TRUE(agrees(drop, wideOf(drop), wide));
}
