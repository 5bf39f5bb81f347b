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

    template<class Visit>
    HOST_DEVICE void forEachNeighbour(int i, Visit visit) const
    {
        const Vec3 p = points[i];
        const float support2 = support * support;
        grid.forEachCandidate(p, support, [&](int j)
        {
            if (squared(p - sources[j]) < support2 && !(sameSet && i == j)) visit(j);
        });
    }
};

struct CountNeighbours
{
    Search search;
    Span<std::uint32_t> count;

    HOST_DEVICE void operator()(int i) const
    {
        std::uint32_t n = 0;
        search.forEachNeighbour(i, [&](int) { ++n; });
        count[i] = n;
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
        length[group] = longest * device::interleave;
    }
};

struct StoreNeighbours
{
    Search search;
    Span<const std::uint32_t> start;
    Span<std::uint32_t> index;

    HOST_DEVICE void operator()(int i) const
    {
        constexpr int s = device::interleave;
        std::uint32_t place = start[i / s] + std::uint32_t(i % s);
        search.forEachNeighbour(i, [&](int j)
        {
            index[int(place)] = std::uint32_t(j);
            place += s;
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
    forEach(n, CountNeighbours{search, count_.span()});
    forEach(groups, LongestOfGroup{count_.span(), groupLength_.span()});
    entries_ = exclusiveScan(groupLength_, start_, "neighbours");
    index_.resizeDiscarding(int(entries_));
    forEach(n, StoreNeighbours{search, start_.span(), index_.span()});
}

}
