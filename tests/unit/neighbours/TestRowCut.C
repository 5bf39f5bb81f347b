// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of rows of cells: each row has one part, parts have about as many particles each, and bisection makes fewer ghosts than slabs.

#include "neighbours/LayerCut.H"
#include "neighbours/RowCut.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

using namespace shizuku;

namespace
{

// A cube of so many rows along y and z, each with two particles to the width of a cell along each axis.
RowLoads block(int edge)
{
    RowLoads loads;
    for (int z = 0; z < edge; ++z)
    {
        for (int y = 0; y < edge; ++y) loads.push_back({y - edge / 3, z + 7, 8 * edge});
    }
    return sortedLoads(loads);
}

// Balls of 1,000 particles, six rows wide, in a cube that is eighty rows wide.
RowLoads drops(int count)
{
    RowLoads loads;
    std::mt19937 random(5);
    const auto place = [&] { return int(random() % 75); };
    for (int drop = 0; drop < count; ++drop)
    {
        const int y = place(), z = place();
        for (int j = 0; j < 6; ++j)
        {
            for (int k = 0; k < 6; ++k)
            {
                const double square = 9.5 - (j - 2.5) * (j - 2.5) - (k - 2.5) * (k - 2.5);
                if (square > 0) loads.push_back({y + j, z + k, std::int64_t(16 * std::sqrt(square))});
            }
        }
    }
    return sortedLoads(loads);
}

// The most particles that a part sees in rows next to its own.
std::int64_t mostSeen(const RowCut& cut, const RowLoads& loads)
{
    std::vector<std::int64_t> seen(cut.parts());
    for (const RowLoad& load : loads)
    {
        const int owner = cut.partOf(load.y, load.z);
        for (const int part : cut.partsNear(owner, 1)) seen[part] += cut.rowsOf(part).widened(1).has(load.y, load.z) ? load.particles : 0;
    }
    return *std::max_element(seen.begin(), seen.end());
}

double largest(const RowCut& cut, const RowLoads& loads)
{
    double all = 0, most = 0;
    for (const std::int64_t particles : cut.particles(loads))
    {
        all += double(particles);
        most = std::max(most, double(particles));
    }
    return most * cut.parts() / all;
}

// Far from the liquid too.
void expectOneOwnerEach(const RowCut& cut)
{
    for (int y = -60; y < 200; y += 3)
    {
        for (int z = -60; z < 200; z += 3)
        {
            int owners = 0;
            for (int part = 0; part < cut.parts(); ++part) owners += cut.rowsOf(part).has(y, z);
            ASSERT_EQ(owners, 1) << y << ' ' << z;
            ASSERT_TRUE(cut.rowsOf(cut.partOf(y, z)).has(y, z)) << y << ' ' << z;
        }
    }
}

}

TEST(TestRowCut, EachRowHasOnePart)
{
    const RowLoads loads = drops(40);
    expectOneOwnerEach(RowCut());
    for (const int parts : {1, 2, 3, 7, 64, 1000}) expectOneOwnerEach(cutBisected(loads, parts));
    expectOneOwnerEach(cutPencils(loads, 3, 4, false));
    expectOneOwnerEach(cutPencils(loads, 3, 4, true));
    expectOneOwnerEach(cutPencils(loads, 5, 1, true));
    expectOneOwnerEach(cutStraight(loads, 4, 3));
    expectOneOwnerEach(cutBisected({}, 4));
}

// Of 96 rows: two, four and eight parts find their planes, and have the same to the particle.
TEST(TestRowCut, ABlockIsHalvedAndQuartered)
{
    const RowLoads loads = block(96);
    for (const int parts : {2, 4, 8, 64}) EXPECT_EQ(largest(cutBisected(loads, parts), loads), 1) << parts;
    const std::int64_t face = 8 * 96 * 96;                          // of one layer of rows
    EXPECT_EQ(mostSeen(cutBisected(loads, 2), loads), face);
    EXPECT_EQ(mostSeen(cutBisected(loads, 4), loads), face + 8 * 96);           // two halves and the edge between them
    EXPECT_EQ(mostSeen(cutPencils(loads, 4, 1, false), loads), 2 * face);
    EXPECT_EQ(mostSeen(cutBisected(loads, 64), loads), face / 2 + 4 * 8 * 96);   // four eighths and four edges
    EXPECT_EQ(mostSeen(cutStraight(loads, 8, 8), loads), face / 2 + 4 * 8 * 96);
    EXPECT_EQ(cutBisected(loads, 64).partsNear(27, 2).size(), 8u);
}

// Not worse than slabs on two parts, better on more; and no part has a tenth too much.
TEST(TestRowCut, BisectionMakesFewerGhostsThanSlabs)
{
    for (const RowLoads& loads : {block(96), drops(1000)})
    {
        for (int parts = 2; parts <= 8; ++parts)
        {
            const RowCut bisected = cutBisected(loads, parts), slabs = cutPencils(loads, parts, 1, isLongerAlongZ(loads));
            if (parts == 2) EXPECT_LE(mostSeen(bisected, loads), mostSeen(slabs, loads));
            else EXPECT_LT(mostSeen(bisected, loads), 0.85 * double(mostSeen(slabs, loads))) << parts;
            EXPECT_LT(largest(bisected, loads), 1.1) << parts;
        }
    }
}

TEST(TestRowCut, PartsHaveWhatTheirWeightsSay)
{
    const RowLoads loads = block(96);
    const std::vector<double> weights{1, 3, 2, 2};
    for (const RowCut& cut : {cutBisected(loads, 4, weights), cutPencils(loads, 2, 2, false, weights), cutPencils(loads, 4, 1, true, weights)})
    {
        const std::vector<std::int64_t> particles = cut.particles(loads);
        // Within a layer of rows, a ninety-sixth of all.
        for (int part = 0; part < 4; ++part) EXPECT_NEAR(double(particles[part]), 8 * 96 * 96 * 96 * weights[part] / 8, 8 * 96 * 96);
    }
}

// A row is never cut.
TEST(TestRowCut, PartsBeyondTheRowsHaveNothing)
{
    const RowLoads loads{{5, 3, 100}, {6, 3, 10}, {5, 4, 1}};
    const RowCut cut = cutBisected(loads, 8);
    std::vector<std::int64_t> particles = cut.particles(loads);
    std::sort(particles.begin(), particles.end());
    EXPECT_EQ(particles, (std::vector<std::int64_t>{0, 0, 0, 0, 0, 1, 10, 100}));
}

TEST(TestRowCut, DirectionsAreThoseOfTheCuts)
{
    const RowLoads loads = block(12);
    EXPECT_TRUE(cutPencils(loads, 3, 1, false).isAcross(false));
    EXPECT_FALSE(cutPencils(loads, 3, 1, false).isAcross(true));
    EXPECT_TRUE(cutPencils(loads, 3, 1, true).isAcross(true));
    EXPECT_FALSE(cutPencils(loads, 3, 1, true).isAcross(false));
    // Straight cuts are where others would be of the whole; pencils follow the load of their piece.
    const RowLoads twoHeaps{{0, 0, 10}, {0, 1, 10}, {9, 8, 10}, {9, 9, 10}};
    EXPECT_EQ(cutPencils(sortedLoads(twoHeaps), 2, 2, false).particles(twoHeaps), (std::vector<std::int64_t>{10, 10, 10, 10}));
    EXPECT_EQ(cutStraight(sortedLoads(twoHeaps), 2, 2).particles(twoHeaps), (std::vector<std::int64_t>{20, 0, 0, 20}));
}

TEST(TestLayerCut, LayersGoToPartsEvenly)
{
    const LayerCut cut = cutEvenly({{-3, 10}, {0, 10}, {4, 20}, {5, 10}, {6, 10}}, 3);
    EXPECT_EQ(cut.first, (std::vector<int>{0, 4, 5}));
    for (const auto& [layer, part] : std::map<int, int>{{-100, 0}, {3, 0}, {4, 1}, {5, 2}, {100, 2}}) EXPECT_EQ(cut.partOf(layer), part) << layer;
    EXPECT_EQ(LayerCut().parts(), 1);                               // the whole
    const LayerCut few = cutEvenly({{2, 1}}, 3);
    EXPECT_EQ(few.low(1), few.high(1));
    EXPECT_EQ(few.partOf(1), 0);
    EXPECT_EQ(few.partOf(2), 2);
}
