// The liquid's two neighbour lists against all pairs.

#include "neighbours/Neighbourhood.H"

#include "support/BruteForce.H"
#include "support/LiquidCase.H"
#include "support/NeighbourLists.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

testing::AssertionResult agrees(LiquidCase& drop, const NeighbourView& view, float support)
{
    const auto points = drop.inOrder(drop.liquid.predicted);
    const auto id = drop.liquid.id.download();
    return agreesWithAllPairs(listsOf(view, id, id), points, points, support, true);
}

}

// The wide list comes, changes and goes as models ask for it; the kernel's stays the same.
TEST(Neighbourhood, ListsPairsWithinTheKernelsAndAWiderSupport)
{
    LiquidCase drop;
    drop.place(randomPoints(1500, {-4, -4, -4}, {5, 5, 5}));
    const float h = drop.liquid.support();
    EXPECT_TRUE(agrees(drop, drop.near.view(), h));
    EXPECT_EQ(drop.near.wide().count.size, 0);
    for (const float wide : {2 * h, 1.5f * h, 0.0f, 2 * h})
    {
        drop.near.update(drop.liquid, wide);
        EXPECT_TRUE(agrees(drop, drop.near.view(), h)) << wide;
        if (wide > 0)
        {
            EXPECT_TRUE(agrees(drop, drop.near.wide(), wide)) << wide;
        }
        else
        {
            EXPECT_EQ(drop.near.wide().count.size, 0);
        }
        EXPECT_EQ(drop.near.grid().view().cellSize, std::max(h, wide));
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
    EXPECT_TRUE(agrees(drop, drop.near.view(), drop.liquid.support()));
    EXPECT_TRUE(agrees(drop, drop.near.wide(), wide));
}
