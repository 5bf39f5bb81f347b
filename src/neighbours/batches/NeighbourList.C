// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours/NeighbourList.H"

#include "device/Algorithms.H"
#include "neighbours/batches/Search.H"

#include <algorithm>

namespace shizuku
{

namespace
{

struct Search
{
    CellGridView grid;
    Span<const Position> points, sources;
    scalar support;
    bool sameSet;

    // visit(j, whether it is a neighbour) for several j after the others.
    template<class Visit>
    void forEach(int i, Visit visit) const
    {
        const Position p = points[i];
        const scalar support2 = support * support;
        const int self = sameSet ? i : -1;
        const SameImage isSame{!sameSet || grid.looksAtImages()};
        forEachBatch(grid, AroundPoint{p, support}, [&](auto j)
        {
            const Positions x = sources[j];
            const Ints isNear = areNear(p, x) & (squared(nearDifference(p, x)) < support2) & j.counts() & (j != self);
            visit(j, noneOf(isNear) ? isNear : sameAmong(isNear, p, sources, j, isSame));
        });
    }
};

// In whole batches.
struct LengthOf
{
    Span<const std::uint32_t> count;
    Span<std::uint32_t> length;

    void operator()(int i) const
    {
        constexpr std::uint32_t batch = device::batch;
        length[i] = (count[i] + batch - 1) / batch * batch;
    }
};

constexpr int partSize = 64;                // particles

// The lists of a part of the particles, one behind the other as they will be stored: to search once costs less than to copy.
struct FindNeighbours
{
    Search search;
    Span<std::uint32_t> count;
    std::vector<std::uint32_t>* parts;

    void operator()(int part) const
    {
        std::vector<std::uint32_t>& lists = parts[part];
        std::size_t free = 0;
        for (int i = part * partSize; i < std::min((part + 1) * partSize, count.size); ++i)
        {
            const std::size_t first = free;
            search.forEach(i, [&](Consecutive j, Ints isNear)
            {
                if (lists.size() < free + 2 * device::batch) lists.resize(2 * (free + device::batch));
                free += j.append(isNear, &lists[free]);
            });
            count[i] = std::uint32_t(free - first);
            for (; (free - first) % device::batch != 0; ++free) lists[free] = lists[free - 1];
        }
    }
};

struct CopyLists
{
    const std::vector<std::uint32_t>* parts;
    Span<const std::uint32_t> start;
    Span<std::uint32_t> rows;

    void operator()(int part) const
    {
        const std::uint32_t first = start[part * partSize], end = start[std::min((part + 1) * partSize, start.size - 1)];
        std::copy_n(parts[part].begin(), end - first, rows.data + first);
    }
};

}

void NeighbourList::search(Span<const Position> points, int n, const CellGrid& grid, Span<const Position> sources, bool sameSet)
{
    const Search search{grid.view(), points, sources, support_, sameSet};
    count_.resizeDiscarding(n);
    parts_.resize((n + partSize - 1) / partSize);
    forEach(int(parts_.size()), FindNeighbours{search, count_.span(), parts_.data()});
    length_.resizeDiscarding(n);
    forEach(n, LengthOf{count_.span(), length_.span()});
    rows_.resizeDiscarding(int(exclusiveScan(length_, lists_, "neighbours")));
    forEach(int(parts_.size()), CopyLists{parts_.data(), lists_.span(), rows_.span()});
}

}
