#include "neighbours/NeighbourList.H"

#include "device/Algorithms.H"

#include <algorithm>

namespace shizuku
{

namespace
{

struct Search
{
    CellGridView grid;
    Span<const Vec3> points, sources;
    float support;
    bool sameSet;

    // visit(j, whether it is a neighbour), for one j after the other; each lane takes its turn, as often as the others.
    template<class Visit>
    HOST_DEVICE void forEachTurn(int i, Team team, Visit visit) const
    {
        const Vec3 p = points[i];
        const float support2 = support * support;
        const int self = sameSet ? i : -1;
        grid.forEachTurn(p, support, [&](auto j, int end)
        {
            visit(j, j < end && squared(p - sources[j]) < support2 && j != self);
        }, team);
    }
};

struct LongestOfGroup
{
    Span<const std::uint32_t> count;
    Span<std::uint32_t> length;

    HOST_DEVICE void operator()(int group) const
    {
        std::uint32_t longest = 0;
        for (int k = 0; k < device::interleave; ++k)
        {
            const int i = group * device::interleave + k;
            if (i < count.size && count[i] > longest) longest = count[i];
        }
        constexpr std::uint32_t batch = device::batch;
        length[group] = (longest + batch - 1) / batch * batch;
    }
};

#ifdef __CUDACC__

struct CountNeighbours
{
    Search search;
    Span<std::uint32_t> count;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        int n = 0;
        search.forEachTurn(i, team, [&](int, bool isNear) { n += team.place(isNear).all; });
        if (team.first()) count[i] = std::uint32_t(n);
    }
};

struct StoreNeighbours
{
    Search search;
    Span<const std::uint32_t> start;
    Span<NeighbourRow> rows;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        constexpr int s = device::interleave;
        NeighbourRow* free = rows.data + start[i / s];
        search.forEachTurn(i, team, [&](int j, bool isNear)
        {
            const Team::Place place = team.place(isNear);
            if (isNear) free[place.before].of[i % s] = std::uint32_t(j);
            free += place.all;
        });
    }
};

#else

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
            search.forEachTurn(i, Team{}, [&](Consecutive j, Ints isNear)
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
    Span<NeighbourRow> rows;

    void operator()(int part) const
    {
        const std::uint32_t first = start[part * partSize], end = start[std::min((part + 1) * partSize, start.size - 1)];
        std::transform(parts[part].begin(), parts[part].begin() + (end - first), rows.data + first, [](std::uint32_t j)
        {
            return NeighbourRow{{j}};
        });
    }
};

#endif

}

void NeighbourList::build(Span<const Vec3> points, int n, const CellGrid& grid, Span<const Vec3> sources, bool sameSet)
{
    const Search search{grid.view(), points, sources, support_, sameSet};
    const int groups = (n + device::interleave - 1) / device::interleave;
    count_.resizeDiscarding(n);
    groupLength_.resizeDiscarding(groups);
#ifdef __CUDACC__
    forEachTeam(n, CountNeighbours{search, count_.span()});
#else
    parts_.resize((n + partSize - 1) / partSize);
    forEach(int(parts_.size()), FindNeighbours{search, count_.span(), parts_.data()});
#endif
    forEach(groups, LongestOfGroup{count_.span(), groupLength_.span()});
    rows_.resizeDiscarding(int(exclusiveScan(groupLength_, start_, "rows of neighbours")));
#ifdef __CUDACC__
    forEachTeam(n, StoreNeighbours{search, start_.span(), rows_.span()});
#else
    forEach(int(parts_.size()), CopyLists{parts_.data(), start_.span(), rows_.span()});
#endif
}

}
