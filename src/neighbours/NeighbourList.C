#include "neighbours/NeighbourList.H"

#include "device/Algorithms.H"
#include "device/Atomic.H"
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

    // visit(j, look(first, end)) for every neighbour j of point i: it is one of a range of candidates that were looked at together.
    template<class Look, class Visit>
    HOST_DEVICE void forEach(int i, Look look, Visit visit) const
    {
        const Vec3 p = points[i];
        const float support2 = support * support;
        const int self = sameSet ? i : -1;
        grid.forEachRange(AroundPoint{p, support}, [&](int first, int end)
        {
            const auto range = look(first, end);
            for (int j = first; j < end; ++j)
            {
                if (squared(p - sources[j]) < support2 && j != self) visit(j, range);
            }
        });
    }

    // Whether all that is looked at for point i lies in these windows.
    HOST_DEVICE bool liesIn(const ListsOfGroup& list, int i) const
    {
        bool all = true;
        grid.forEachRange(AroundPoint{points[i], support}, [&](int first, int end)
        {
            all &= first == end || list.windowOf(first, end) < ListsOfGroup::windows;
        });
        return all;
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
    std::uint32_t room;                     // entries
#ifdef __CUDACC__
    Span<const ListsOfGroup> lists;
#endif
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
#ifdef __CUDACC__
        if (lists[group].isWide()) length[group] *= 2;
#endif
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

// What the entries of a window lack of the numbers that they stand for.
HOST_DEVICE inline int addOf(const ListsOfGroup& list, int window)
{
    return window == 0 ? list.add[0] : window == 1 ? list.add[1] : list.add[2];
}

// The windows of a group, around the cell of its first point and those below and above.
HOST_DEVICE inline ListsOfGroup windowsAround(const CellGridView& grid, Vec3 p)
{
    ListsOfGroup list;
    const int x = grid.cellOfX(p.x), y = grid.cellOf(p.y), z = grid.cellOf(p.z);
    #pragma unroll
    for (int k = 0; k < ListsOfGroup::windows; ++k)
    {
        const int middle = int(grid.start[int(grid.key(x, y, z + k - 1))]), half = int(ListsOfGroup::lengthOf(k) / 2);
        list.add[k] = middle - half - int(ListsOfGroup::firstOf(k));
    }
    return list;
}

// Counts each particle's neighbours, and stores those that its group's room holds.
struct FindNeighbours
{
    static constexpr int s = device::interleave;
    static constexpr Holds holds = Holds::few;

    Search search;
    int room;                               // entries
    int most;                               // of what is counted
    bool allWide;
    int roomsOfWide;                        // where not all groups are
    std::uint32_t build;                    // which one this is
    Span<std::uint32_t> count;
    Span<ListsOfGroup> lists;
    Span<std::uint32_t> misfits;            // [0]: a list that is longer than its room, [1]: too few rooms of wide groups, [2]: wide groups
    Span<NeighbourRow> rows;

    HOST_DEVICE void operator()(int i) const
    {
        const int group = i / s, place = i % s;
        const Team warp{place, s};
        ListsOfGroup list = allWide ? ListsOfGroup{wideRoom(0, group), {}} : windowsAround(search.grid, search.points[group * s]);
        if (!allWide) list.start = std::uint32_t(group * room);
        bool wide = allWide;
        bool becomesWide = warp.anyBeside(!wide && search.grid.isAtCopysEdge(search.points[i]) && !search.liesIn(list, i));
        int n;
        #pragma unroll 1
        for (;;)
        {
            if (becomesWide)
            {
                const int which = warp.ofFirst(place == 0 ? int(increment(misfits[2])) : 0);
                if (which >= roomsOfWide)
                {
                    misfits[1] = build;
                    n = 0;
                    break;
                }
                list.start = wideRoom(lists.size * room, which);
                wide = true;
            }
            bool fits = true;
            n = 0;
            search.forEach(i, [&](int first, int end) { return wide ? 0 : list.windowOf(first, end); }, [&](int j, int window)
            {
                fits &= window < ListsOfGroup::windows;
                const int add = addOf(list, window);
                if (n < room)
                {
                    NeighbourRow* const free = rows.data + list.row();
                    if (wide) free[2 * n].index(place) = std::uint32_t(j);
                    else free[n].of[place] = std::uint16_t(j - add);
                }
                ++n;
            });
            if (!warp.anyBeside(!fits)) break;
            becomesWide = true;             // once more: rarely but at the edge of a copy of the grid, where it was looked for before
        }
        note(i, n);
        if (place == 0) lists[group] = list;
    }

    HOST_DEVICE void operator()(Group group, Team team) const
    {
        const ListsOfGroup list{wideRoom(0, group.first / s), {}};           // few points: all groups are wide
        int n[Group::most] = {};
        search.forEachTurn(group, team, [&](int p, int j, bool isNear)
        {
            const Team::Place place = team.place(isNear);
            if (isNear & (n[p] + place.before < room)) store(rows, list, n[p] + place.before, group.first % s + p, j);
            n[p] += place.all;
        });
        if (!team.first()) return;
        if (group.first % s == 0) lists[group.first / s] = list;
        #pragma unroll
        for (int p = 0; p < Group::most; ++p)
        {
            if (p < group.size) note(group.first + p, n[p]);
        }
    }

    // An entry of those lists.
    HOST_DEVICE static void store(Span<NeighbourRow> rows, const ListsOfGroup& list, int k, int place, int j)
    {
        NeighbourRow* const first = rows.data + list.row();
        if (list.isWide())
        {
            first[2 * k].index(place) = std::uint32_t(j);
            return;
        }
        first[k].of[place] = std::uint16_t(j - addOf(list, list.windowOf(j, j + 1)));
    }

private:
    HOST_DEVICE std::uint32_t wideRoom(int first, int which) const { return std::uint32_t(first + 2 * which * room) | ListsOfGroup::wide; }

    HOST_DEVICE void note(int i, int n) const
    {
        count[i] = std::uint32_t(n < most ? n : most);
        if (n > room) misfits[0] = build;
    }
};

// The groups for which their room is too small get rows behind all rooms.
struct PlaceLongGroup
{
    std::uint32_t behind;
    Span<const std::uint32_t> length, before;
    Span<ListsOfGroup> lists;

    HOST_DEVICE void operator()(int group) const
    {
        if (length[group] == 0) return;
        std::uint32_t& start = lists[group].start;
        start = (behind + before[group]) | (start & ListsOfGroup::wide);
    }
};

// Their lists.
struct StoreNeighbours
{
    static constexpr int s = device::interleave;

    Search search;
    Span<const std::uint32_t> length;
    Span<const ListsOfGroup> lists;
    Span<NeighbourRow> rows;

    HOST_DEVICE void operator()(int i) const
    {
        if (length[i / s] == 0) return;
        const ListsOfGroup list = lists[i / s];
        int n = 0;
        search.forEach(i, [](int, int) { return 0; }, [&](int j, int) { FindNeighbours::store(rows, list, n++, i % s, j); });
    }

    HOST_DEVICE void operator()(Group group, Team team) const
    {
        if (length[group.first / s] == 0) return;
        const ListsOfGroup list = lists[group.first / s];
        int n[Group::most] = {};
        search.forEachTurn(group, team, [&](int p, int j, bool isNear)
        {
            const Team::Place place = team.place(isNear);
            if (isNear) FindNeighbours::store(rows, list, n[p] + place.before, group.first % s + p, j);
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
    count_.resizeDiscarding(n);
    lists_.resizeDiscarding(groups());
    if (builds_ == 0)
    {
        misfits_.resize(3);
        misfits_.setZero();
    }
    asked_ = !longLists_;
    find(points, n, grid, sources, sameSet, rowsOfRooms(), asked_ ? room_ : std::numeric_limits<int>::max());
    if (!asked_) storeLong(points, n, grid, sources, sameSet);
}

bool NeighbourList::cutOff()
{
    if (!asked_) return false;
    const std::uint32_t* const misfits = readMisfits_.wait();
    longLists_ = misfits[0] == builds_;
    return longLists_ || misfits[1] == builds_;
}

// Counts up to `most` entries of each list.
void NeighbourList::find
(
    Span<const Vec3> points, int n, const CellGrid& grid, Span<const Vec3> sources, bool sameSet, int rows, int most
)
{
    ++builds_;
    if (rows_.size() < rows)
    {
        rows_.discard();
        rows_.resize(rows);
    }
    if (!isWide()) misfits_.setZero(2);
    forEachPoint(n, FindNeighbours
    {
        {grid.view(), points, sources, support_, sameSet}, room_, most, isWide(), roomsOfWide_, builds_, count_.span(), lists_.span(),
        misfits_.span(), rows_.span()
    });
    readMisfits_.ask(misfits_);
}

// Whether there was too little.
bool NeighbourList::makeRoomForWide()
{
    const std::uint32_t* const misfits = readMisfits_.wait();
    if (misfits[1] != builds_) return false;
    constexpr int most = 64;                                // groups of which one at least has such a room
    roomsOfWide_ = int(misfits[2] + misfits[2] / 4) + (groups() + most - 1) / most;
    return true;
}

void NeighbourList::lengthen(Span<const Vec3> points, int n, const CellGrid& grid, Span<const Vec3> sources, bool sameSet)
{
    if (!cutOff()) return;
    asked_ = false;
    makeRoomForWide();
    find(points, n, grid, sources, sameSet, rowsOfRooms(), std::numeric_limits<int>::max());
    storeLong(points, n, grid, sources, sameSet);
}

// With all lists counted.
void NeighbourList::storeLong(Span<const Vec3> points, int n, const CellGrid& grid, Span<const Vec3> sources, bool sameSet)
{
    groupLength_.resizeDiscarding(groups());
    forEach(groups(), LongestOfGroup{count_.span(), std::uint32_t(room_), lists_.span(), groupLength_.span()});
    const int behind = int(exclusiveScan(groupLength_, before_, "rows of neighbours"));
    if (!isWide() && makeRoomForWide())
    {
        find(points, n, grid, sources, sameSet, rowsOfRooms(), std::numeric_limits<int>::max());
        return storeLong(points, n, grid, sources, sameSet);
    }
    const int inRooms = rowsOfRooms();
    longLists_ = behind > 0;
    if (!longLists_) return;
    if (rows_.size() - inRooms < behind)
    {
        const int rows = inRooms + behind + std::max(behind / 4, inRooms / 64);
        find(points, n, grid, sources, sameSet, rows, std::numeric_limits<int>::max());
    }
    forEach(groups(), PlaceLongGroup{std::uint32_t(inRooms), groupLength_.span(), before_.span(), lists_.span()});
    const Search search{grid.view(), points, sources, support_, sameSet};
    forEachPoint(n, StoreNeighbours{search, groupLength_.span(), lists_.span(), rows_.span()});

    // Of few points memory is little, and to wait for the sum of rows takes long.
    constexpr int more = 8, most = 60;
    if (n <= fewPoints && room_ < most) room_ += more;
}

#else

void NeighbourList::search(Span<const Vec3> points, int n, const CellGrid& grid, Span<const Vec3> sources, bool sameSet)
{
    const Search search{grid.view(), points, sources, support_, sameSet};
    count_.resizeDiscarding(n);
    parts_.resize((n + partSize - 1) / partSize);
    forEach(int(parts_.size()), FindNeighbours{search, count_.span(), parts_.data()});
    groupLength_.resizeDiscarding(groups());
    forEach(groups(), LongestOfGroup{count_.span(), 0, groupLength_.span()});
    rows_.resizeDiscarding(int(exclusiveScan(groupLength_, start_, "rows of neighbours")));
    forEach(int(parts_.size()), CopyLists{parts_.data(), start_.span(), rows_.span()});
}

bool NeighbourList::cutOff() { return false; }

void NeighbourList::lengthen(Span<const Vec3>, int, const CellGrid&, Span<const Vec3>, bool) {}

#endif

}
