// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/StartCheck.H"

#include "support/LiquidCase.H"
#include "support/ReferenceKernels.H"

#include <algorithm>
#include <limits>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

Crowding crowdingOf(const std::vector<Vec3>& points, const std::string& kernel = "type cubicSpline; support 2;")
{
    LiquidCase drop({.kernel = kernel});
    drop.place(points);
    return measureCrowding(drop.liquid);
}

}

// Random particles, four to a lattice cell, by all pairs in double precision; sums of a hundred floats.
TEST(StartCheck, MeasuresByAllPairs)
{
    const auto points = randomPoints(500, {-2.5f, -2.5f, -2.5f}, {2.5f, 2.5f, 2.5f});
    LiquidCase drop;
    drop.place(points);
    const Crowding crowding = measureCrowding(drop.liquid);

    const Reference<CubicSpline> W{2};              // lengths in spacings, in which V = 1
    double latticeSum = 0;
    for (const Vec3& p : latticeBlock(5, 5, 5, 1, {-2, -2, -2})) latticeSum += W.W(norm(p));
    double mean = 0, most = 0, nearest = 10, squares = 0;
    int crowded = 0;
    std::size_t densest = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        double density = 0;
        for (std::size_t j = 0; j < points.size(); ++j)
        {
            const double r = norm(points[i] - points[j]);
            density += W.W(r) / latticeSum;
            if (j != i) nearest = std::min(nearest, r);
        }
        mean += density / double(points.size());
        crowded += density > 1.1;
        squares += density > 1 ? (density - 1) * (density - 1) : 0;
        if (density > most) densest = i;
        most = std::max(most, density);
    }
    EXPECT_NEAR(crowding.mean, mean, 2e-6 * mean);
    EXPECT_NEAR(crowding.most, most, 2e-6 * most);
    EXPECT_NEAR(crowding.nearest, nearest, 1e-5);
    EXPECT_EQ(crowding.crowded, crowded);
    EXPECT_NEAR(crowding.compression, std::sqrt(squares / 500), 1e-5);
    EXPECT_EQ(crowding.particles, 500);
    const std::vector<std::uint32_t> id = drop.liquid.id.download();
    EXPECT_EQ(crowding.densest, drop.liquid.positions()[std::find(id.begin(), id.end(), densest) - id.begin()]);
}

// Lattices as fillLiquid makes them, alone and two that touch; with every kernel a full neighbourhood has 1.
TEST(StartCheck, LetsLatticesAndTouchingBodiesPass)
{
    for (const char* kernel : {"type cubicSpline; support 1.5;", "type cubicSpline; support 4;", "type poly6Spiky; support 2.4;"})
    {
        const Crowding block = crowdingOf(latticeBlock(12, 12, 12, 1), kernel);
        EXPECT_NEAR(block.most, 1, 5e-6) << kernel;
        EXPECT_NEAR(block.nearest, 1, 1e-6);
        EXPECT_LT(block.mean, 1);
        EXPECT_FALSE(block.overlaps());
        // Layers half a spacing apart, the least that fillLiquid leaves: 1.42 with the narrowest kernel.
        auto touching = latticeBlock(12, 12, 6, 1);
        for (const Vec3& p : latticeBlock(12, 12, 6, 1, {0, 0, 5.5f})) touching.push_back(p);
        EXPECT_LT(crowdingOf(touching, kernel).most, 1.43) << kernel;
        EXPECT_FALSE(crowdingOf(touching, kernel).overlaps()) << kernel;
    }
}

TEST(StartCheck, FindsWhatOverlaps)
{
    EXPECT_TRUE(crowdingOf(latticeBlock(6, 6, 6, 0.8f)).overlaps());            // few particles: by the densest one
    EXPECT_NEAR(crowdingOf(latticeBlock(6, 6, 6, 0.8f)).nearest, 0.8, 2 * quanta::each);
    EXPECT_TRUE(crowdingOf(latticeBlock(16, 16, 16, 0.93f)).overlaps());        // many: by the mean
    // A small body filled in twice in a large one: in each place two particles of a density of 2.
    auto twice = latticeBlock(16, 16, 16, 1);
    for (const Vec3& p : latticeBlock(5, 5, 5, 1, {4, 4, 4})) twice.push_back(p);
    const Crowding crowding = crowdingOf(twice);
    EXPECT_LT(crowding.mean, Crowding::mostMean);
    EXPECT_NEAR(crowding.most, 2, 1e-5);
    EXPECT_EQ(crowding.nearest, 0);
    EXPECT_TRUE(crowding.overlaps());
}

// 1,000 particles, as large a block as bursts. At 0.95 spacings the eight inner layers, half of all, are 1.17 times as dense as at
// rest; at 0.98 1.064 times: too much for a model of sound, whose bound is 0.03. Layers half a spacing apart, one in five, are
// no lattice that is too narrow.
TEST(StartCheck, KnowsAFirstStart)
{
    LiquidCase drop;
    FreeSurface surface;
    const auto limits = [&](const std::string& model, long index)
    {
        const auto pressure = Pressure::New
        (
            Dictionary::parse("pressure " + model + ";"), Dictionary::parse(""), drop.liquid, drop.walls, surface
        );
        return StartLimits::of(index, *pressure);
    };
    const StartLimits pbf = limits("completedPbf", 0), sound = limits("WCSPH", 0), gas = limits("idealGas", 0);
    EXPECT_NEAR(sound.compression, 0.03, 1e-12);
    EXPECT_NEAR(gas.compression, 0.03, 1e-12);
    const Crowding tight = crowdingOf(latticeBlock(10, 10, 10, 0.95f)), tighter = crowdingOf(latticeBlock(10, 10, 10, 0.98f)),
        good = crowdingOf(latticeBlock(10, 10, 10, 1));
    EXPECT_FALSE(tight.overlaps());
    EXPECT_TRUE(tight.overlaps(pbf));
    EXPECT_FALSE(tight.overlaps(limits("WCSPH", 1)));           // a restart: what was computed stays
    EXPECT_FALSE(tighter.overlaps(pbf));
    EXPECT_TRUE(tighter.overlaps(sound));
    EXPECT_FALSE(good.overlaps(sound));
    // With these such drops come to rest; those take all of it out in one step, and burst from 2,000 particles at 0.98 on.
    for (const char* slow : {"pbf", "Clavet2005"}) EXPECT_FALSE(tight.overlaps(limits(slow, 0))) << slow;
    const Crowding larger = crowdingOf(latticeBlock(17, 17, 17, 0.98f));
    EXPECT_FALSE(larger.overlaps(pbf));
    for (const char* sudden : {"PCISPH", "DFSPH"}) EXPECT_TRUE(larger.overlaps(limits(sudden, 0))) << sudden;
    auto touching = latticeBlock(10, 10, 5, 1);
    for (const Vec3& p : latticeBlock(10, 10, 5, 1, {0, 0, 4.5f})) touching.push_back(p);
    EXPECT_FALSE(crowdingOf(touching).overlaps(pbf));

    drop.place(latticeBlock(10, 10, 10, 0.98f));
    EXPECT_TRUE(holds(messageOf([&] { refuseOverlap(drop.liquid, "case/0", sound); }),
    {
        "case/0/liquid/positions", "1000 particles", "compression (root mean square) 0.04", "at most 0.03", "drives",
        "overlaps relax"
    }));
    EXPECT_EQ(messageOf([&] { refuseOverlap(drop.liquid, "case/0", pbf); }), "no error");
    EXPECT_GT(relaxOverlap(drop.liquid, drop.near, drop.walls, sound), 0);
    EXPECT_FALSE(measureCrowding(drop.liquid).overlaps(sound));
}

TEST(StartCheck, SaysWhatWasFoundAndWhatToDo)
{
    LiquidCase drop;
    drop.place(latticeBlock(8, 8, 8, 0.7f, {1, 1, 1}));
    EXPECT_TRUE(holds(messageOf([&] { refuseOverlap(drop.liquid, "case/0.5"); }),
    {
        "case/0.5/liquid/positions", "512 particles", "overlapping", "2.9", "rest densities", "0.7 spacings", "fillLiquid",
        "0.001 m", "0.00070"
    }));
    drop.place(latticeBlock(8, 8, 8, 1));
    EXPECT_EQ(messageOf([&] { refuseOverlap(drop.liquid, "case/0"); }), "no error");
}

// From a lattice of 0.7 spacings, and from a body filled in twice, whose particles are in the same places by two. Corrections
// act in pairs: the centroid stays, but for the stirring: 0.25/sqrt(3) of a spacing along each axis over the root of 512, 0.0064, taken three times.
TEST(StartCheck, MovesApartWhatOverlaps)
{
    const auto block = latticeBlock(8, 8, 8, 0.7f, {-2.45f, -2.45f, -2.45f});
    auto twice = latticeBlock(7, 7, 6, 1);
    const std::size_t once = twice.size();
    for (std::size_t i = 0; i < once; ++i) twice.push_back(twice[i]);
    for (const auto& points : {block, twice})
    {
        LiquidCase drop;
        std::vector<Vec3> velocities;
        Vec3 before{}, after{};
        for (const Vec3& p : points)
        {
            velocities.push_back({p.x, scalar(velocities.size()), 0});
            before += (1.0f / scalar(points.size())) * p;
        }
        drop.place(points, velocities);
        ASSERT_TRUE(measureCrowding(drop.liquid).overlaps());
        const int rounds = relaxOverlap(drop.liquid, drop.near, drop.walls);
        EXPECT_GT(rounds, 0);
        EXPECT_LT(rounds, 100);
        const Crowding crowding = measureCrowding(drop.liquid);
        EXPECT_LT(crowding.most, 1.1);              // the average compression is below half a percent
        EXPECT_GT(crowding.nearest, 0.1);
        const auto x = drop.inOrder(drop.liquid.position), u = drop.inOrder(drop.liquid.velocity);
        ASSERT_EQ(x.size(), points.size());
        for (std::size_t i = 0; i < x.size(); ++i)
        {
            after += (1 / (scalar(x.size()) * drop.liquid.spacing())) * x[i];
            ASSERT_EQ(u[i].y, velocities[i].y);
        }
        EXPECT_LT(norm(after - before), 0.033f);
    }
}

TEST(StartCheck, LeavesAloneWhatDoesNotOverlap)
{
    LiquidCase drop;
    drop.place(latticeBlock(8, 8, 8, 1));
    const auto before = vectors(drop.liquid.position);
    EXPECT_EQ(relaxOverlap(drop.liquid, drop.near, drop.walls), 0);
    const auto after = vectors(drop.liquid.position);
    for (std::size_t i = 0; i < before.size(); ++i) ASSERT_EQ(norm(after[i] - before[i]), 0);
}

// The block of 512 lattice cells in a box of 64.
TEST(StartCheck, SaysWhereThereIsNoRoom)
{
    LiquidCase drop({.walls = "tank { type box; min (0 0 0); max (4e-3 4e-3 4e-3); }"});
    drop.place(latticeBlock(8, 8, 8, 0.5f, {0.25f, 0.25f, 0.25f}));
    EXPECT_TRUE(holds(messageOf([&] { relaxOverlap(drop.liquid, drop.near, drop.walls); }), {"still overlaps", "200 rounds", "leave room"}));
}

TEST(StartCheck, IsToldWhatToDo)
{
    EXPECT_FALSE(relaxesOverlap(Dictionary::parse("")));
    EXPECT_TRUE(relaxesOverlap(Dictionary::parse("overlaps relax;")));
    EXPECT_TRUE(holds(messageOf([] { relaxesOverlap(Dictionary::parse("overlaps relaxed;")); }), {"'relaxed'", "refuse", "relax"}));
}
