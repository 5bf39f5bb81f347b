// SPDX-License-Identifier: GPL-3.0-or-later
// The neighbour lists against all pairs.

#include "neighbours/NeighbourList.H"

#include "device/Gather.H"
#include "support/BruteForce.H"
#include "support/NeighbourLists.H"
#include "support/PointSets.H"
#include "support/Threads.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr scalar support = 1.3f;

// Sorts `sources` by cell as every caller does, and lists their neighbours by the numbers they had before.
std::vector<std::vector<int>> neighboursOf
(
    const std::vector<Vec3>& points, const std::vector<Vec3>& sources, bool sameSet, NeighbourList& list,
    scalar cellSize = support
)
{
    const Buffer<Position> unsorted(placed(sources));
    CellGrid grid(cellSize, support);
    const std::vector<std::uint32_t> order = grid.build(unsorted.span(), unsorted.size()).download();
    Buffer<Position> sorted;
    gather(unsorted, Buffer<std::uint32_t>(order), sorted);
    Buffer<Position> targets(placed(points));
    if (sameSet) gather(unsorted, Buffer<std::uint32_t>(order), targets);

    list.build(targets.span(), targets.size(), grid, sorted.span(), sameSet);

    if (sameSet) return listsOf(list.view(), order, order);
    std::vector<std::uint32_t> unchanged(points.size());
    std::iota(unchanged.begin(), unchanged.end(), 0u);
    return listsOf(list.view(), unchanged, order);
}

std::vector<std::vector<int>> neighboursOf
(
    const std::vector<Vec3>& points, const std::vector<Vec3>& sources, bool sameSet, scalar cellSize = support
)
{
    NeighbourList list(support);
    return neighboursOf(points, sources, sameSet, list, cellSize);
}

void expectAllPairs(const std::vector<Vec3>& points, scalar cellSize = support)
{
    EXPECT_TRUE(agreesWithAllPairs(neighboursOf(points, points, true, cellSize), points, points, support, true));
}

// How often a search along each line visits each particle.
struct VisitAlong
{
    CellGridView grid;
    Span<const AroundLine> lines;
    int n;
    Span<std::uint32_t> visits;

    HOST_DEVICE void operator()(int line) const
    {
        grid.forEachCandidate(lines[line], [&](int j) { ++visits[line * n + j]; });
    }
};

// Whose neighbours within the support are those across edges and faces.
struct Lattice
{
    static constexpr scalar spacing = 0.8f;     // those across a face's diagonal are 1.13 away, across a cube's 1.39

    int edge;

    std::vector<Vec3> points() const
    {
        std::vector<Vec3> points;
        for (int z = 0; z < edge; ++z)
            for (int y = 0; y < edge; ++y)
                for (int x = 0; x < edge; ++x) points.push_back({spacing * scalar(x), spacing * scalar(y), spacing * scalar(z)});
        return points;
    }

    // In ascending order.
    std::vector<int> neighbours(int i, bool withItself) const
    {
        std::vector<int> found;
        for (int z = -1; z <= 1; ++z)
            for (int y = -1; y <= 1; ++y)
                for (int x = -1; x <= 1; ++x)
                {
                    const int all = x * x + y * y + z * z, a = i % edge + x, b = i / edge % edge + y, c = i / (edge * edge) + z;
                    const bool inside = std::min({a, b, c}) >= 0 && std::max({a, b, c}) < edge;
                    if (all <= 2 && (all > 0 || withItself) && inside) found.push_back((c * edge + b) * edge + a);
                }
        return found;
    }
};

std::vector<Vec3> shifted(std::vector<Vec3> points, Vec3 by)
{
    for (Vec3& p : points) p += by;
    return points;
}

}

TEST(NeighbourList, FindsAllPairsOfRandomPoints)
{
    expectAllPairs(randomPoints(3000, {0, 0, 0}, {10, 10, 10}));
}

TEST(NeighbourList, FindsAllPairsAtNegativeCoordinates)
{
    expectAllPairs(randomPoints(2000, {-9, -7, -3}, {2, 1, 4}));
    expectAllPairs(randomPoints(1000, {-60, -60, -60}, {-53, -53, -53}));
}

TEST(NeighbourList, FindsAllPairsFarFromTheOrigin)
{
    expectAllPairs(randomPoints(1000, {3000, -4000, 5000}, {3007, -3993, 5007}));
}

// Borders belong to the cell above them; a pair at the support exactly is none (support2 is not reached).
TEST(NeighbourList, FindsAllPairsOfPointsOnCellBorders)
{
    expectAllPairs(latticeBlock(9, 9, 9, support, {-4 * support, -4 * support, -4 * support}));
    expectAllPairs(latticeBlock(12, 12, 12, support / 2, {-3 * support, -3 * support, -3 * support}));
}

// Fewer particles than cells, and than the 27 cells around one.
TEST(NeighbourList, FindsAllPairsOfTinySets)
{
    expectAllPairs({});
    expectAllPairs({{-0.1f, 5, 3}});
    expectAllPairs({{0, 0, 0}, {1, 0.5f, 0.5f}});
    expectAllPairs({{0, 0, 0}, {100, 0, 0}});
    expectAllPairs({{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1.25f}});
}

TEST(NeighbourList, FindsAllPairsOfAThinFilm)
{
    expectAllPairs(latticeBlock(70, 50, 1, 0.5f, {-20, -10, 0.01f}));
}

TEST(NeighbourList, ListsPointsAtTheSamePlace)
{
    expectAllPairs({{0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f}});
}

// The grid wraps around after a power of two of cells; 2^12 cells is a multiple of any such period here.
TEST(NeighbourList, TellsClustersApartThatShareTheirCells)
{
    const auto cluster = randomPoints(300, {0, 0, 0}, {4, 4, 4});
    auto points = cluster;
    const scalar period = 4096 * support;
    for (const Vec3 by : {Vec3{period, 0, 0}, Vec3{0, -period, 0}, Vec3{0, 0, period}})
    {
        const auto copy = shifted(cluster, by);
        points.insert(points.end(), copy.begin(), copy.end());
    }
    expectAllPairs(points);
}

// Low words are those of a place 8,192 units away, and the cells may be the same: such places are no neighbours, wherever the blocks have their edges.
TEST(NeighbourList, TellsClustersApartWithTheSameLowWords)
{
    if constexpr (!quanta::single) GTEST_SKIP() << "low words hold whole numbers";
    constexpr scalar period = 8192;
    const auto cluster = randomPoints(200, {-2, -2, -2}, {2, 2, 2});       // across an edge of blocks
    std::vector<Position> places = placed(cluster);
    const auto copies = [&](double x, double y, double z)
    {
        for (const Vec3& p : cluster) places.push_back(positionAt(p.x + x * period, p.y + y * period, p.z + z * period));
    };
    copies(1, 0, 0);
    copies(0, -3, 0);
    copies(100, 20, -7);
    const int n = int(places.size()), each = int(cluster.size());
    const auto alone = neighboursOf(cluster, cluster, true);
    const Buffer<Position> unsorted(places);
    CellGrid grid(support, support);
    const std::vector<std::uint32_t> order = grid.build(unsorted.span(), n).download();
    Buffer<Position> sorted;
    gather(unsorted, Buffer<std::uint32_t>(order), sorted);
    NeighbourList list(support);
    list.build(sorted.span(), n, grid, sorted.span(), true);
    const auto lists = listsOf(list.view(), order, order);
    for (int i = 0; i < n; ++i)
    {
        std::vector<int> found = lists[i], expected = alone[i % each];
        for (int& j : expected) j += i / each * each;
        std::sort(found.begin(), found.end());
        std::sort(expected.begin(), expected.end());
        ASSERT_EQ(found, expected) << i;
    }
}

// Shifted by whole cells, and by blocks, the lists are the same to the order of their entries.
TEST(NeighbourList, IsTheSameAnywhere)
{
    const auto places = placed(randomPoints(1000, {-4, -4, -4}, {4, 4, 4}));
    CellGrid grid(support, support);
    const auto listsAt = [&](std::int64_t x, std::int64_t y, std::int64_t z)
    {
        grid.build(Buffer<Position>(places).span(), int(places.size()));
        const std::int64_t cell = std::int64_t(grid.view().width) << CellGridView::coarseBits;
        std::vector<Position> moved;
        for (const Position& p : places)
        {
            const Place at = placeOf(p);
            moved.push_back(positionAt(Place{at.x + x * cell, at.y + y * cell, at.z + z * cell}));
        }
        const Buffer<Position> unsorted(moved);
        const std::vector<std::uint32_t> order = grid.build(unsorted.span(), unsorted.size()).download();
        Buffer<Position> sorted;
        gather(unsorted, Buffer<std::uint32_t>(order), sorted);
        NeighbourList list(support);
        list.build(sorted.span(), sorted.size(), grid, sorted.span(), true);
        return listsOf(list.view(), order, order);
    };
    const auto here = listsAt(0, 0, 0);
    for (const std::int64_t far : {64, 6400, 640000})       // multiples of the grid's own width: the order of cells is the same
    {
        auto there = listsAt(far, 0, 0);
        EXPECT_EQ(there, here) << far;
    }
}

TEST(NeighbourList, FindsPairsOfTwoSets)
{
    const auto liquid = randomPoints(700, {-3, -3, 0}, {3, 3, 3}, 1);
    const auto solid = latticeBlock(17, 17, 1, 0.5f, {-4, -4, -0.25f});
    EXPECT_TRUE(agreesWithAllPairs(neighboursOf(liquid, solid, false), liquid, solid, support, false));
    // A point of one set is a neighbour of the same place in the other.
    EXPECT_TRUE(agreesWithAllPairs(neighboursOf(solid, solid, false), solid, solid, support, false));
    EXPECT_TRUE(agreesWithAllPairs(neighboursOf(liquid, {}, false), liquid, {}, support, false));
}

// Cells smaller than the support: many cells a search, few particles a cell.
TEST(NeighbourList, FindsAllPairsInGridsOfSmallerCells)
{
    for (const scalar cells : {1.5f, 2.0f, 4.0f})
    {
        for (const auto& points :
            {randomPoints(2000, {-5, -5, -5}, {4, 4, 4}), latticeBlock(9, 9, 9, support / 2),
             latticeBlock(12, 12, 12, support / cells, {-3 * support, -3 * support, -3 * support})})
        {
            expectAllPairs(points, support / cells);
        }
    }
}

// Lists that fit into their groups' rooms beside some that do not; more of these, and fewer, in one list after another.
TEST(NeighbourList, StoresListsThatFindNoRoom)
{
    auto few = randomPoints(600, {0, 0, 0}, {8, 8, 8}), many = few;
    const auto cluster = randomPoints(300, {3, 3, 3}, {5, 6, 5});
    many.insert(many.end(), cluster.begin(), cluster.end());
    for (const int room : {1, 12, 400})
    {
        NeighbourList list(support, room);
        for (const auto* points : {&few, &many, &few})
        {
            EXPECT_TRUE(agreesWithAllPairs(neighboursOf(*points, *points, true, list), *points, *points, support, true));
        }
    }
}

// In parts: what search() cuts off is made whole, and where some lists were too long nothing is cut off the next time.
TEST(NeighbourList, LengthensWhatItHasCutOff)
{
    const auto points = randomPoints(900, {0, 0, 0}, {5, 5, 5});
    const Buffer<Position> unsorted(placed(points));
    CellGrid grid(support, support);
    const std::vector<std::uint32_t> order = grid.build(unsorted.span(), unsorted.size()).download();
    Buffer<Position> sorted;
    gather(unsorted, Buffer<std::uint32_t>(order), sorted);
    const int n = sorted.size();
    for (const int room : {20, 400})
    {
        NeighbourList list(support, room);
        list.search(sorted.span(), n, grid, sorted.span(), true);
        const bool cutOff = list.cutOff();
        EXPECT_EQ(cutOff, device::interleave > 1 && room == 20);           // a CPU knows each list's length before it stores it
        if (cutOff) list.lengthen(sorted.span(), n, grid, sorted.span(), true);
        EXPECT_FALSE(list.cutOff());
        EXPECT_TRUE(agreesWithAllPairs(listsOf(list.view(), order, order), points, points, support, true));
        list.search(sorted.span(), n, grid, sorted.span(), true);
        EXPECT_FALSE(list.cutOff());
        EXPECT_TRUE(agreesWithAllPairs(listsOf(list.view(), order, order), points, points, support, true));
    }
}

// So many that a GPU takes a thread each, and that it stores them in windows: of a lattice, whose neighbours are known, with rooms for few and for
// all of a list.
TEST(NeighbourList, FindsTheNeighboursOfManyPoints)
{
    for (const int edge : {41, 52})
    {
        const Lattice lattice{edge};
        const auto points = lattice.points();
        for (const int room : {4, 20})
        {
            NeighbourList list(support, room);
            auto lists = neighboursOf(points, points, true, list);
            for (int i = 0; i < int(points.size()); ++i)
            {
                std::sort(lists[i].begin(), lists[i].end());
                ASSERT_EQ(lists[i], lattice.neighbours(i, false)) << i << " of " << points.size() << " with a room of " << room;
            }
        }
    }
}

// Many with long lists: each point of a lattice several times, so that a neighbourhood has up to 75 others; the last group of 32 is not full.
TEST(NeighbourList, FindsLongListsOfManyPoints)
{
    constexpr int copies = 4;
    const Lattice lattice{41};
    const auto once = lattice.points();
    const int n = int(once.size());
    std::vector<Vec3> points;
    for (int copy = 0; copy < copies; ++copy) points.insert(points.end(), once.begin(), once.end());
    NeighbourList list(support, 20);
    auto lists = neighboursOf(points, points, true, list);
    for (int i = 0; i < copies * n; ++i)
    {
        std::sort(lists[i].begin(), lists[i].end());
        const auto around = lattice.neighbours(i % n, true);
        std::vector<int> expected;
        for (int copy = 0; copy < copies; ++copy)
        {
            for (const int j : around)
            {
                if (j + copy * n != i) expected.push_back(j + copy * n);
            }
        }
        ASSERT_EQ(lists[i], expected) << i;
    }
}

// Many that lie across the edge of the grid's copies, where indices of neighbours lie in many places: what finds no room on a GPU is cut off, made whole,
// and finds room the next time. The grid of so many points has 64 cells along y and 32 along z.
TEST(NeighbourList, FindsTheNeighboursOfManyPointsAcrossAnEdgeOfTheGrid)
{
    const Lattice lattice{52};
    const std::vector<Vec3> points = shifted(lattice.points(), {0, 50 * support, 20 * support});
    const Buffer<Position> unsorted(placed(points));
    CellGrid grid(support, support);
    const std::vector<std::uint32_t> order = grid.build(unsorted.span(), unsorted.size()).download();
    Buffer<Position> sorted;
    gather(unsorted, Buffer<std::uint32_t>(order), sorted);
    NeighbourList list(support, 20);
    for (int turn = 0; turn < 2; ++turn)
    {
        list.search(sorted.span(), sorted.size(), grid, sorted.span(), true);
        const bool cutOff = list.cutOff();
        EXPECT_EQ(cutOff, device::interleave > 1 && turn == 0);
        if (cutOff)             // as long as they will be, but of the first point of each group
        {
            const auto cut = listsOf(list.view(), order, order);
            for (int k = 0; k < sorted.size(); ++k)
            {
                const int i = int(order[k]), first = int(order[k / device::interleave * device::interleave]);
                ASSERT_EQ(cut[i], std::vector<int>(lattice.neighbours(i, false).size(), first)) << i;
            }
        }
        list.lengthen(sorted.span(), sorted.size(), grid, sorted.span(), true);
        auto lists = listsOf(list.view(), order, order);
        for (int i = 0; i < int(points.size()); ++i)
        {
            std::sort(lists[i].begin(), lists[i].end());
            ASSERT_EQ(lists[i], lattice.neighbours(i, false)) << i << " in turn " << turn;
        }
    }
}

// Points that follow each other lie anywhere among many sources, so that a group's neighbours are in more windows than a GPU has for it; twice, as the
// second search knows that. With rooms for few and for all of a list.
TEST(NeighbourList, FindsNeighboursInManyPlaces)
{
    const Lattice lattice{61};
    const auto sources = lattice.points();
    const std::size_t n = sources.size();
    constexpr std::size_t prime = 104729;       // divides no power of 61
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < n; ++i) points.push_back(sources[i * prime % n]);
    for (const int room : {4, 20})
    {
        NeighbourList list(support, room);
        for (int turn = 0; turn < 2; ++turn)
        {
            auto lists = neighboursOf(points, sources, false, list);
            for (std::size_t i = 0; i < n; ++i)
            {
                std::sort(lists[i].begin(), lists[i].end());
                ASSERT_EQ(lists[i], lattice.neighbours(int(i * prime % n), true)) << i << " with a room of " << room;
            }
        }
    }
}

// The order of a list decides the order of a sum: it must not depend on the threads.
TEST(NeighbourList, ListsInTheSameOrderOnAnyNumberOfThreads)
{
    const auto points = randomPoints(2000, {-4, -4, -4}, {4, 4, 4});
    const auto expected = neighboursOf(points, points, true);
    for (const int threads : {1, 3})
    {
        const UseThreads use(threads);
        EXPECT_EQ(neighboursOf(points, points, true), expected);
    }
}

// Many points a cell, in no order: the same points give the same order, whichever thread comes first.
TEST(CellGrid, OrdersPointsByCellAndThoseOfACellByNumber)
{
    const auto points = randomPoints(5000, {-4, -4, -4}, {4, 4, 4});
    CellGrid grid(support);
    const Buffer<Position> positions(placed(points));
    const auto order = grid.build(positions.span(), int(points.size())).download();
    std::vector<std::uint32_t> expected(points.size());
    std::iota(expected.begin(), expected.end(), 0u);
    const CellGridView view = grid.view();
    const auto places = placed(points);
    std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return view.key(places[a]) < view.key(places[b]); });
    EXPECT_EQ(order, expected);
}

// Along lines in all directions, at borders of cells and across the grid's own.
TEST(CellGrid, SearchesAlongALine)
{
    const auto points = randomPoints(4000, {-4, -4, -4}, {4, 4, 4});
    constexpr scalar reach = 0.9f, half = 1.7f;
    CellGrid grid(support, 2 * support);
    const Buffer<Position> positions(placed(points));
    const Buffer<std::uint32_t> order = grid.build(positions.span(), int(points.size()));
    Buffer<Position> sorted;
    gather(positions, order, sorted);
    const std::vector<AroundLine> lines
    {
        {positionAt(0, 0, 0), reach, half, {1, 0, 0}}, {positionAt(support, -support, 2 * support), reach, half, {0, -1, 0}},
        {positionAt(0.3, 1, -2), reach, half, {0, 0, 1}}, {positionAt(-3, 2, 1), reach, half, {0.6f, 0, 0.8f}},
        {positionAt(1, -2, 0.5), reach, half, {-0.48f, 0.6f, 0.64f}}, {positionAt(3.5, 3.5, -3.5), reach, half, {0.57735f, 0.57735f, -0.57735f}}
    };
    const int n = int(points.size()), all = int(lines.size());
    Buffer<AroundLine> regions(lines);
    Buffer<std::uint32_t> visits(n * all);
    visits.setZero();
    forEach(all, VisitAlong{grid.view(), regions.span(), n, visits.span()});
    const auto places = sorted.download();
    const auto visited = visits.download();
    for (int line = 0; line < all; ++line)
    {
        const auto& [p, within, length, direction] = lines[line];
        int candidates = 0;
        for (int j = 0; j < n; ++j)
        {
            const Vec3 r = places[j] - p;
            const scalar s = std::clamp(dot(r, direction), -length, length);
            if (norm(r - s * direction) < within) { EXPECT_EQ(visited[line * n + j], 1u); }
            EXPECT_LE(visited[line * n + j], 1u);
            candidates += int(visited[line * n + j]);
        }
        // The neighbourhood has 11.7 of the 512 units of volume, and up to 90 with what rows of cells reach beyond it; a ball
        // around all of it would have 73.6, and 150.
        EXPECT_LT(candidates, n * 90 / 512) << line;
    }
}

TEST(NeighbourView, WithoutAListHasNoNeighbours)
{
    const NeighbourView none;
    int visits = 0;
    none.forEach(3, [&](int) { ++visits; });
    EXPECT_EQ(visits, 0);
}
