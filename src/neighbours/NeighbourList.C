#include "neighbours/NeighbourList.H"

#include "device/Algorithms.H"
#include "neighbours/GroupSearch.H"

#include <algorithm>
#include <limits>

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

#ifdef __CUDACC__

    // visit(j) for every neighbour j of point i.
    template<class Visit>
    HOST_DEVICE void forEach(int i, Visit visit) const
    {
        const Vec3 p = points[i];
        const float support2 = support * support;
        const int self = sameSet ? i : -1;
        grid.forEachCandidate(AroundPoint{p, support}, [&](int j)
        {
            if (squared(p - sources[j]) < support2 && j != self) visit(j);
        });
    }

    // visit(p, j, whether it is a neighbour of the group's p-th point), for one j after the other; each lane takes its turn, as often
    // as the others.
    template<class Visit>
    HOST_DEVICE void forEachTurn(Group group, Team team, Visit visit) const
    {
        Vec3 at[Group::most];
        #pragma unroll
        for (int p = 0; p < Group::most; ++p) at[p] = points[group[p]];
        const float support2 = support * support;
        const int self = sameSet ? group.first : -Group::most;
        searchTogether(grid, at, group.members(), support, [&](int j, bool counts, const auto& x)
        {
            const Vec3 source = sources[counts ? j : 0];
            #pragma unroll
            for (int p = 0; p < Group::most; ++p)
            {
                const bool isNear = squared(Vec3{x[p], at[p].y, at[p].z} - source) < support2;
                visit(p, j, counts & isNear & (j != self + p));
            }
        }, team);
    }

#else

    // visit(j, whether it is a neighbour) for several j after the others.
    template<class Visit>
    void forEachTurn(int i, Visit visit) const
    {
        const Vec3 p = points[i];
        const float support2 = support * support;
        const int self = sameSet ? i : -1;
        grid.forEachTurn(AroundPoint{p, support}, [&](auto j, int end)
        {
            visit(j, j < end && squared(p - sources[j]) < support2 && j != self);
        });
    }

#endif
};

// Rows for each group's longest list; none where it has room.
struct LongestOfGroup
{
    Span<const std::uint32_t> count;
    std::uint32_t room;                     // rows
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
        length[group] = longest > room ? (longest + batch - 1) / batch * batch : 0;
    }
};

#ifdef __CUDACC__

// A thread a point where points fill a GPU, else a warp for a group of them.
template<class F>
void forEachPoint(int n, const F& f)
{
    constexpr int many = 1 << 16;
    if (n > many) forEach(n, f);
    else forEachGroup(n, f);
}

// Counts each particle's neighbours, and stores those that its group's room holds.
struct FindNeighbours
{
    Search search;
    int room;                               // rows
    int most;                               // of what is counted
    std::uint32_t build;                    // which one this is
    Span<std::uint32_t> count, start, tooLong;
    Span<NeighbourRow> rows;

    HOST_DEVICE void operator()(int i) const
    {
        NeighbourRow* const free = firstRow(i);
        int n = 0;
        search.forEach(i, [&](int j)
        {
            if (n < room) free[n].of[i % device::interleave] = std::uint32_t(j);
            ++n;
        });
        note(i, n);
    }

    HOST_DEVICE void operator()(Group group, Team team) const
    {
        constexpr int s = device::interleave;       // a multiple of a group
        NeighbourRow* const free = firstRow(group.first);
        int n[Group::most] = {};
        search.forEachTurn(group, team, [&](int p, int j, bool isNear)
        {
            const Team::Place place = team.place(isNear);
            if (isNear & (n[p] + place.before < room)) free[n[p] + place.before].of[group.first % s + p] = std::uint32_t(j);
            n[p] += place.all;
        });
        if (!team.first()) return;
        #pragma unroll
        for (int p = 0; p < Group::most; ++p)
        {
            if (p < group.size) note(group.first + p, n[p]);
        }
    }

    HOST_DEVICE NeighbourRow* firstRow(int i) const { return rows.data + std::size_t(i / device::interleave) * room; }

    HOST_DEVICE void note(int i, int n) const
    {
        constexpr int s = device::interleave;
        count[i] = std::uint32_t(n < most ? n : most);
        if (n > room) tooLong[0] = build;
        if (i % s == 0) start[i / s] = std::uint32_t(i / s) * std::uint32_t(room);
    }
};

// The groups for which their room is too small get rows behind all rooms.
struct PlaceLongGroup
{
    std::uint32_t behind;
    Span<const std::uint32_t> length, before;
    Span<std::uint32_t> start;

    HOST_DEVICE void operator()(int group) const
    {
        if (length[group] > 0) start[group] = behind + before[group];
    }
};

// Their lists.
struct StoreNeighbours
{
    Search search;
    Span<const std::uint32_t> length, start;
    Span<NeighbourRow> rows;

    HOST_DEVICE void operator()(int i) const
    {
        constexpr int s = device::interleave;
        if (length[i / s] == 0) return;
        NeighbourRow* free = rows.data + start[i / s];
        search.forEach(i, [&](int j) { (free++)->of[i % s] = std::uint32_t(j); });
    }

    HOST_DEVICE void operator()(Group group, Team team) const
    {
        constexpr int s = device::interleave;
        const int part = group.first / s;
        if (length[part] == 0) return;
        NeighbourRow* const free = rows.data + start[part];
        int n[Group::most] = {};
        search.forEachTurn(group, team, [&](int p, int j, bool isNear)
        {
            const Team::Place place = team.place(isNear);
            if (isNear) free[n[p] + place.before].of[group.first % s + p] = std::uint32_t(j);
            n[p] += place.all;
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
            search.forEachTurn(i, [&](Consecutive j, Ints isNear)
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
    search(points, n, grid, sources, sameSet);
    lengthen(points, n, grid, sources, sameSet);
}

#ifdef __CUDACC__

void NeighbourList::search(Span<const Vec3> points, int n, const CellGrid& grid, Span<const Vec3> sources, bool sameSet)
{
    const int groups = (n + device::interleave - 1) / device::interleave;
    count_.resizeDiscarding(n);
    start_.resizeDiscarding(groups);
    if (builds_++ == 0)
    {
        tooLong_.resize(1);
        tooLong_.setZero();
    }
    constexpr int all = std::numeric_limits<int>::max();
    asked_ = !longLists_;
    find(points, n, grid, sources, sameSet, groups * room_, asked_ ? room_ : all);
    if (asked_) readTooLong_.ask(tooLong_);
    else storeLong(points, n, grid, sources, sameSet);
}

bool NeighbourList::cutOff()
{
    if (asked_) longLists_ = *readTooLong_.wait() == builds_;
    return asked_ && longLists_;
}

// Counts up to `most` entries of each list.
void NeighbourList::find
(
    Span<const Vec3> points, int n, const CellGrid& grid, Span<const Vec3> sources, bool sameSet, int rows, int most
)
{
    if (rows_.size() < rows)
    {
        rows_.discard();
        rows_.resize(rows);
    }
    forEachPoint(n, FindNeighbours
    {
        {grid.view(), points, sources, support_, sameSet}, room_, most, builds_, count_.span(), start_.span(),
        tooLong_.span(), rows_.span()
    });
}

void NeighbourList::lengthen(Span<const Vec3> points, int n, const CellGrid& grid, Span<const Vec3> sources, bool sameSet)
{
    if (!cutOff()) return;
    asked_ = false;
    find(points, n, grid, sources, sameSet, start_.size() * room_, std::numeric_limits<int>::max());
    storeLong(points, n, grid, sources, sameSet);
}

// With all lists counted.
void NeighbourList::storeLong(Span<const Vec3> points, int n, const CellGrid& grid, Span<const Vec3> sources, bool sameSet)
{
    const int groups = start_.size(), inRooms = groups * room_;
    groupLength_.resizeDiscarding(groups);
    forEach(groups, LongestOfGroup{count_.span(), std::uint32_t(room_), groupLength_.span()});
    const int behind = int(exclusiveScan(groupLength_, before_, "rows of neighbours"));
    longLists_ = behind > 0;
    if (!longLists_) return;
    if (rows_.size() - inRooms < behind)
    {
        const int rows = inRooms + behind + std::max(behind / 4, inRooms / 64);
        find(points, n, grid, sources, sameSet, rows, std::numeric_limits<int>::max());
    }
    forEach(groups, PlaceLongGroup{std::uint32_t(inRooms), groupLength_.span(), before_.span(), start_.span()});
    const Search search{grid.view(), points, sources, support_, sameSet};
    forEachPoint(n, StoreNeighbours{search, groupLength_.span(), start_.span(), rows_.span()});

    // Of few points memory is little, and to wait for the sum of rows takes long.
    constexpr int few = 1 << 17, more = 8, most = 60;
    if (n <= few && room_ < most) room_ += more;
}

#else

void NeighbourList::search(Span<const Vec3> points, int n, const CellGrid& grid, Span<const Vec3> sources, bool sameSet)
{
    const Search search{grid.view(), points, sources, support_, sameSet};
    const int groups = (n + device::interleave - 1) / device::interleave;
    count_.resizeDiscarding(n);
    parts_.resize((n + partSize - 1) / partSize);
    forEach(int(parts_.size()), FindNeighbours{search, count_.span(), parts_.data()});
    groupLength_.resizeDiscarding(groups);
    forEach(groups, LongestOfGroup{count_.span(), 0, groupLength_.span()});
    rows_.resizeDiscarding(int(exclusiveScan(groupLength_, start_, "rows of neighbours")));
    forEach(int(parts_.size()), CopyLists{parts_.data(), start_.span(), rows_.span()});
}

bool NeighbourList::cutOff() { return false; }

void NeighbourList::lengthen(Span<const Vec3>, int, const CellGrid&, Span<const Vec3>, bool) {}

#endif

}
