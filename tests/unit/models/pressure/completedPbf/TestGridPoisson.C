// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/pressure/completedPbf/GridPoisson.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace shizuku;

namespace
{

// A box full of liquid whose closed nodes `closed` says, with the same source everywhere.
struct FullBox
{
    GridBox box;
    GridPoisson poisson;

    FullBox(const GridBox& cells, scalar source, const std::function<bool(GridBox::Place)>& closed) : box(cells)
    {
        const Buffer<scalar> fill(std::vector<scalar>(box.cells(), 1.0f));
        std::vector<std::uint8_t> open;
        for (int k = 0; k < box.nodes(); ++k) open.push_back(!closed(box.nodeAt(k)));
        poisson.begin(box, fill, Buffer<std::uint8_t>(open));
        std::vector<scalar> sources(box.nodes(), 0.0f);
        for (int k = 0; k < box.nodes(); ++k)
        {
            if (open[k]) box.forEachCellAround(box.nodeAt(k), [&](int, int, int, int) { sources[k] += 0.125f * source; });
        }
        const Buffer<scalar> uploaded(sources);
        device::copyOnDevice(poisson.source().data, uploaded.span().data, sources.size() * sizeof(scalar));
    }

    std::vector<scalar> solve(int cycles)
    {
        poisson.solve(cycles);
        std::vector<scalar> q(box.nodes());
        device::copyToHost(q.data(), poisson.solution().data, q.size() * sizeof(scalar));
        return q;
    }
};

}

// Under a surface, closed in at the sides and below: q = (n^2 - z^2)/2 for a source of one, which the differences give exactly. Each cycle
// leaves less than 0.7 of the error, however deep the liquid is.
TEST(GridPoisson, CarriesASourceThroughTheWholeDepth)
{
    for (const int depth : {13, 50, 100})
    {
        FullBox column({5, 8, depth}, 1, [&](GridBox::Place at) { return at.z == depth; });
        const auto errorAfter = [&](int cycles)
        {
            const std::vector<scalar> q = column.solve(cycles);
            double most = 0;
            for (int k = 0; k < column.box.nodes(); ++k)
            {
                const double z = column.box.nodeAt(k).z, exact = 0.5 * (depth * depth - z * z);
                most = std::max(most, std::abs(q[k] - exact));
            }
            return most / (0.5 * depth * depth);
        };
        const double early = errorAfter(4);
        EXPECT_LT(early, 0.25) << depth;
        EXPECT_LT(errorAfter(10), early * std::pow(0.7, 6)) << depth;
    }
}

// Closed nodes at odd places only, which no coarser level has: liquid below them is one between a wall and a surface.
TEST(GridPoisson, SeesALayerOfClosedNodesBetweenCoarseOnes)
{
    FullBox column({8, 8, 40}, 1, [](GridBox::Place at) { return at.z == 15 || at.z == 40; });
    const std::vector<scalar> q = column.solve(12);
    for (int k = 0; k < column.box.nodes(); ++k)
    {
        const scalar z = scalar(column.box.nodeAt(k).z);
        const scalar exact = z < 15 ? 0.5f * (225 - z * z) : 0.5f * (z - 15) * (40 - z);
        EXPECT_NEAR(q[k], exact, 0.5f) << z;            // of 112
    }
}

TEST(GridPoisson, NeverPulls)
{
    FullBox block({12, 12, 12}, -1, [](GridBox::Place at) { return at.z == 12; });
    for (const scalar q : block.solve(3)) ASSERT_EQ(q, 0);
}

// Nothing says how high the pressure is, nor that there is none.
TEST(GridPoisson, StaysFiniteInAClosedTank)
{
    FullBox tank({9, 9, 9}, 1, [](GridBox::Place) { return false; });
    for (const scalar q : tank.solve(2)) ASSERT_TRUE(std::isfinite(q));
}

// The same box twice, a smaller one in between.
TEST(GridPoisson, ForgetsTheBoxBefore)
{
    const auto closed = [](GridBox::Place at) { return at.z == 0 || at.x == 0; };
    const GridBox large{40, 20, 30}, small{7, 5, 9};
    FullBox alone(small, 1, closed), after(large, 1, closed);
    after.solve(1);
    FullBox again(small, 1, closed);
    std::swap(again.poisson, after.poisson);            // memory of the large one
    const Buffer<scalar> fill(std::vector<scalar>(small.cells(), 1.0f));
    std::vector<std::uint8_t> open;
    std::vector<scalar> sources(small.nodes(), 0.0f);
    for (int k = 0; k < small.nodes(); ++k)
    {
        open.push_back(!closed(small.nodeAt(k)));
        if (open[k]) small.forEachCellAround(small.nodeAt(k), [&](int, int, int, int) { sources[k] += 0.125f; });
    }
    again.poisson.begin(small, fill, Buffer<std::uint8_t>(open));
    const Buffer<scalar> uploaded(sources);
    device::copyOnDevice(again.poisson.source().data, uploaded.span().data, sources.size() * sizeof(scalar));
    EXPECT_EQ(again.solve(3), alone.solve(3));
}
