// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours/NeighbourList.H"

#include "device/Algorithms.H"
#include "device/Atomic.H"
#include "device/Sharing.H"
#include "neighbours/lanes/Search.H"

#include <algorithm>
#include <cstring>

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

    // visit(j, look(first, end)) for every neighbour j of point i: it is one of a range of candidates that were looked at together.
    template<class Look, class Visit>
    HOST_DEVICE void forEach(int i, Look look, Visit visit) const
    {
        const Position p = points[i];
        const scalar support2 = support * support;
        const int self = sameSet ? i : -1;
        const SameImage isSame{!sameSet || grid.looksAtImages()};
        grid.forEachRange(AroundPoint{p, support}, [&](int first, int end)
        {
            const auto range = look(first, end);
            for (int j = first; j < end; ++j)
            {
                const Position source = sources[j];
                if (squared(nearDifference(p, source)) < support2 && j != self && isSame(p, source, j)) visit(j, range);
            }
        });
    }

    // visit(p, j, whether it is a neighbour of the group's p-th point), for one j after the other; each lane takes its turn, as often
    // as the others.
    template<class Visit>
    HOST_DEVICE void forEachTurn(Group group, Team team, Visit visit) const
    {
        Position at[Group::most];
        #pragma unroll
        for (int p = 0; p < Group::most; ++p) at[p] = points[group[p]];
        const scalar support2 = support * support;
        const int self = sameSet ? group.first : -Group::most;
        searchTogether(grid, at, sources, SameImage{!sameSet || grid.looksAtImages()}, group.members(), support, [&](int j, bool counts, Vec3 there, const auto& x, const auto& y, const auto& z)
        {
            #pragma unroll
            for (int p = 0; p < Group::most; ++p)
            {
                const bool isNear = squared(Vec3{x[p], y[p], z[p]} - there) < support2;
                visit(p, j, counts & isNear & (j != self + p));
            }
        }, team);
    }
};

// A thread a point where points fill a GPU, else a warp for a group of them.
template<class F>
void forEachPoint(int n, const F& f)
{
    constexpr int many = 1 << 16;
    if (sharedAs(n) > many) forEach(n, f);
    else forEachGroup(n, f);
}

// Of few points: each group's lists have room for as many entries as lists usually have. Those beyond are left out.
struct FindNeighboursInRooms
{
    static constexpr int s = device::interleave;
    static constexpr Holds holds = Holds::few;

    Search search;
    int room;                               // entries
    Span<std::uint32_t> count;
    Span<ListsOfGroup> lists;
    Span<NeighbourRow> rows;
    Wanted* wanted;

    HOST_DEVICE void operator()(int i) const
    {
        NeighbourRow* const first = rows.data + rowOf(i / s);
        int n = 0;
        search.forEach(i, [](int, int) { return 0; }, [&](int j, int)
        {
            if (n < room) first[2 * n].index(i % s) = std::uint32_t(j);
            ++n;
        });
        if (i % s == 0) lists[i / s] = listsOf(i / s);
        note(i, n);
    }

    HOST_DEVICE void operator()(Group group, Team team) const
    {
        NeighbourRow* const first = rows.data + rowOf(group.first / s);
        int n[Group::most] = {};
        search.forEachTurn(group, team, [&](int p, int j, bool isNear)
        {
            const Team::Place place = team.place(isNear);
            const int k = n[p] + place.before;
            if (isNear & (k < room)) first[2 * k].index(group.first % s + p) = std::uint32_t(j);
            n[p] += place.all;
        });
        if (!team.first()) return;
        if (group.first % s == 0) lists[group.first / s] = listsOf(group.first / s);
        #pragma unroll
        for (int p = 0; p < Group::most; ++p)
        {
            if (p < group.size) note(group.first + p, n[p]);
        }
    }

private:
    HOST_DEVICE int rowOf(int group) const { return 2 * group * room; }
    HOST_DEVICE ListsOfGroup listsOf(int group) const { return {std::uint32_t(rowOf(group)) | ListsOfGroup::wide, {}}; }

    HOST_DEVICE void note(int i, int n) const
    {
        count[i] = std::uint32_t(n < room ? n : room);
        if (n > room) raise(wanted->entries, std::uint32_t(n));
    }
};

// What the entries of a window lack of the numbers that they stand for.
HOST_DEVICE inline int addOf(const ListsOfGroup& list, int window)
{
    return window == 0 ? list.add[0] : window == 1 ? list.add[1] : list.add[2];
}

// The windows of a group, around the cell of its first point and those below and above.
HOST_DEVICE inline ListsOfGroup windowsAround(const CellGridView& grid, Position p)
{
    ListsOfGroup list;
    const CellPlace cell = grid.cellPlace(p);
    const int x = grid.shortCell(cell.x, cell.in.x), y = cell.y, z = cell.z;
    #pragma unroll
    for (int k = 0; k < ListsOfGroup::windows; ++k)
    {
        const int middle = int(grid.start[int(grid.key(x, y, z + k - 1))]), half = int(ListsOfGroup::lengthOf(k) / 2);
        list.add[k] = middle - half - int(ListsOfGroup::firstOf(k));
    }
    return list;
}

// Of many: a group's lists stay in quick memory until the longest is known, and then take as many rows as it has entries. A group that has
// longer ones, or neighbours outside of its windows, is searched for once more.
struct FindNeighbours
{
    static constexpr int s = device::interleave, most = 40;
    static constexpr Holds holds = Holds::few;

    struct alignas(16) Shared
    {
        NeighbourRow row[most];
    };

    // Rows at the beginning that groups have in common which find no others: until there is room their lists are as long, but all entries are zero and
    // mean the group's first point (which lies beside the others: nobody takes these for surface), or the first of other sources.
    static constexpr int common = most;

    Search search;
    Span<std::uint32_t> count;
    Span<ListsOfGroup> lists;
    Span<NeighbourRow> rows;
    Wanted* wanted;

    HOST_DEVICE void operator()(int i, Shared& found) const
    {
        const int group = i / s, place = i % s;
        const Team warp{place, s};
        ListsOfGroup list = windowsAround(search.grid, search.points[group * s]);
        NeighbourRow* to = found.row;
        int room = most, n;
        bool wide = false;
        #pragma unroll 1
        for (;;)
        {
            bool fits = true;
            n = 0;
            const auto look = [&](int first, int end) { return wide ? 0 : list.windowOf(first, end); };
            if (i < count.size) search.forEach(i, look, [&](int j, int window)
            {
                fits &= window < ListsOfGroup::windows;
                if (n < room) store(to, wide, n, place, std::uint32_t(wide ? j : j - addOf(list, window)));
                ++n;
            });
            if (to != found.row) break;
            const int longest = warp.mostBeside(n);
            wide = warp.anyBeside(!fits);
            const int row = claim(wide ? 2 * longest : longest, warp);
            list.start = std::uint32_t(row) | (wide ? ListsOfGroup::wide : 0);
            if (row < common)
            {
                list = {0, {search.sameSet ? group * s : 0, 0, 0}};
                n = n < most ? n : most;
                for (int k = 0; k < n; ++k) store(rows.data, false, k, place, 0);
                break;
            }
            if (!wide && longest <= most)
            {
                warp.meet();
                copy(found, longest, row, place);
                break;
            }
            to = rows.data + row;
            room = n;
        }
        if (i < count.size) count[i] = std::uint32_t(n);
        if (place == 0) lists[group] = list;
    }

private:
    HOST_DEVICE static void store(NeighbourRow* first, bool wide, int k, int place, std::uint32_t entry)
    {
        if (wide) first[2 * k].index(place) = entry;
        else first[k].of[place] = std::uint16_t(entry);
    }

    // The first of so many rows that nobody else has; 0 where there are not so many.
    HOST_DEVICE int claim(int n, Team warp) const
    {
        int row = 0;
        if (warp.first())
        {
            const std::uint64_t first = common + add(wanted->rows, std::uint64_t(n));
            if (first + n <= std::uint64_t(rows.size)) row = int(first);
        }
        return warp.ofFirst(row);
    }

    // Sixteen bytes a lane at a time.
    HOST_DEVICE void copy(const Shared& found, int length, int row, int place) const
    {
        struct alignas(16) Words
        {
            std::uint32_t word[4];
        };
        constexpr int ofRow = sizeof(NeighbourRow) / sizeof(Words);
        const Words* const from = reinterpret_cast<const Words*>(found.row);
        Words* const there = reinterpret_cast<Words*>(rows.data + row);
        for (int k = place; k < length * ofRow; k += s) there[k] = from[k];
    }
};

}

void NeighbourList::build(Span<const Position> points, int n, const CellGrid& grid, Span<const Position> sources, bool sameSet)
{
    search(points, n, grid, sources, sameSet);
    lengthen(points, n, grid, sources, sameSet);
}

void NeighbourList::search(Span<const Position> points, int n, const CellGrid& grid, Span<const Position> sources, bool sameSet)
{
    count_.resizeDiscarding(n);
    lists_.resizeDiscarding(groups());
    const bool begins = wanted_.size() == 0;
    wanted_.resize(sizeof(Wanted) / sizeof(std::uint32_t));
    const Search search{grid.view(), points, sources, support_, sameSet};
    if (isFew())
    {
        if (begins) wanted_.setZero();              // later it holds no more than there is room for
        makeRows(2 * groups() * room_);
        forEachPoint(n, FindNeighboursInRooms{search, room_, count_.span(), lists_.span(), rows_.span(), wanted()});
    }
    else
    {
        wanted_.setZero();
        makeRows(FindNeighbours::common);
        forEachSharing(n, FindNeighbours{search, count_.span(), lists_.span(), rows_.span(), wanted()});
    }
    readWanted_.ask(wanted_);
    asked_ = true;
}

// At least so many.
void NeighbourList::makeRows(int n)
{
    if (rows_.size() >= n) return;
    rows_.discard();
    rows_.resize(n);
}

// Waits for it.
Wanted NeighbourList::readWanted()
{
    Wanted wanted;
    std::memcpy(&wanted, readWanted_.wait(), sizeof(wanted));
    return wanted;
}

bool NeighbourList::cutOff()
{
    if (!asked_) return false;
    const Wanted wanted = readWanted();
    return isFew() ? wanted.entries > std::uint32_t(room_) : FindNeighbours::common + wanted.rows > std::uint64_t(rows_.size());
}

void NeighbourList::lengthen(Span<const Position> points, int n, const CellGrid& grid, Span<const Position> sources, bool sameSet)
{
    if (!cutOff()) return;
    const Wanted wanted = readWanted();
    constexpr int more = 2;                         // entries: that a room is soon too small again is rare
    if (isFew()) room_ = int(wanted.entries) + more;
    else makeRows(countOf(FindNeighbours::common + wanted.rows + wanted.rows / 32, "rows of neighbours"));
    search(points, n, grid, sources, sameSet);
    asked_ = false;
}

}
