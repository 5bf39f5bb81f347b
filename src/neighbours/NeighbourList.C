#include "neighbours/NeighbourList.H"

#include "device/Algorithms.H"

namespace shizuku
{

namespace
{

struct SearchGrid
{
    CellGridView grid;
    Span<const Vec3> points, sources;
    float support2;
    bool sameSet;

    template<class Visit>
    HOST_DEVICE void forEachNeighbour(int i, Visit visit) const
    {
        const Vec3 p = points[i];
        grid.forEachCandidate(p, [&](int j)
        {
            if (squared(p - sources[j]) < support2 && !(sameSet && i == j)) visit(j);
        });
    }
};

struct SearchList
{
    NeighbourView wider;
    Span<const Vec3> points;
    float support2;

    template<class Visit>
    HOST_DEVICE void forEachNeighbour(int i, Visit visit) const
    {
        const Vec3 p = points[i];
        wider.forEach(i, [&](int j)
        {
            if (squared(p - points[j]) < support2) visit(j);
        });
    }
};

template<class Search>
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

template<class Search>
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

template<class Search>
void NeighbourList::collect(int n, const Search& search)
{
    const int groups = (n + device::interleave - 1) / device::interleave;
    count_.resizeDiscarding(n);
    groupLength_.resizeDiscarding(groups);
    forEach(n, CountNeighbours<Search>{search, count_.span()});
    forEach(groups, LongestOfGroup{count_.span(), groupLength_.span()});
    entries_ = exclusiveScan(groupLength_, start_, "neighbours");
    index_.resizeDiscarding(int(entries_));
    forEach(n, StoreNeighbours<Search>{search, start_.span(), index_.span()});
}

void NeighbourList::build(Span<const Vec3> points, int n, const CellGrid& grid, Span<const Vec3> sources, bool sameSet)
{
    collect(n, SearchGrid{grid.view(), points, sources, support_ * support_, sameSet});
}

void NeighbourList::buildWithin(const NeighbourList& wider, Span<const Vec3> points, int n)
{
    collect(n, SearchList{wider.view(), points, support_ * support_});
}

}
