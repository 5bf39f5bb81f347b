// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/Occupied.H"

#include "support/LiquidCase.H"

#include <gtest/gtest.h>

using namespace shizuku;
using namespace shizuku::test;

// 625 places, thus three passes, the last with one bit of some: around a block of which some are in reach, by a sum over all pairs.
TEST(Occupied, EachOfManyPlacesIsNearLiquidOrNot)
{
    LiquidCase scene{CaseText{}};
    scene.place(latticeBlock(3, 3, 3, 1, {-1, -1, -1}));
    constexpr double reach = 1.3e-3;
    std::vector<Vector3> places;
    for (int k = 0; k < 625; ++k) places.push_back({(k%25 - 12.2)*0.37e-3, (k/25 - 11.9)*0.41e-3, 0.3e-3});
    const std::vector<bool> occupied = areOccupied(scene.liquid, SourceSpace(scene.liquid), places, reach);
    ASSERT_EQ(occupied.size(), places.size());
    const auto positions = scene.liquid.positions();
    int near = 0;
    for (std::size_t k = 0; k < places.size(); ++k)
    {
        bool expected = false;
        for (const Vector3& x : positions) expected = expected || length(places[k] - x) < reach;
        EXPECT_EQ(occupied[k], expected) << "place " << k;
        near += expected;
    }
    EXPECT_GT(near, 60);
    EXPECT_LT(near, 565);
    EXPECT_TRUE(areOccupied(scene.liquid, SourceSpace(scene.liquid), {}, reach).empty());
}
