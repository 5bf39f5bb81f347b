#include "neighbours/NeighbourList.H"

#include "device/Algorithms.H"

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
        grid.forEachRange(p, support, [&](int first, int end)
        {
            for (int turn = first; turn < end; turn += team.width)
            {
                const int j = turn + team.lane;
                visit(j, j < end && squared(p - sources[j]) < support2 && !(sameSet && i == j));
            }
        });
    }
};

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
        length[group] = longest;
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

}

void NeighbourList::build(Span<const Vec3> points, int n, const CellGrid& grid, Span<const Vec3> sources, bool sameSet)
{
    const Search search{grid.view(), points, sources, support_, sameSet};
    const int groups = (n + device::interleave - 1) / device::interleave;
    count_.resizeDiscarding(n);
    groupLength_.resizeDiscarding(groups);
    forEachTeam(n, CountNeighbours{search, count_.span()});
    forEach(groups, LongestOfGroup{count_.span(), groupLength_.span()});
    rows_.resizeDiscarding(int(exclusiveScan(groupLength_, start_, "rows of neighbours")));
    forEachTeam(n, StoreNeighbours{search, start_.span(), rows_.span()});
}

}
