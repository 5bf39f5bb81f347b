// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours/PartsOfLiquid.H"

#include "device/Algorithms.H"
#include "device/CountUp.H"
#include "device/ForEach.H"
#include "device/Gather.H"
#include "device/KeptMemory.H"
#include "neighbours/MarkRows.H"

#include <algorithm>
#include <utility>

namespace shizuku
{

namespace
{

using IndexList = std::vector<std::uint32_t>;

// A particle that another part owns next, and the row that it is in.
struct Leaver
{
    std::uint32_t index;
    int y, z;
};

// Of particles at the edge, those in other rows, by their places among these.
struct MarkLeavers
{
    CellGridView grid;
    RowRectangle rows;                          // of the part
    Span<const std::uint32_t> before;           // of each particle, at the edge
    Span<const Position> x;
    Span<std::uint8_t> leaves;

    HOST_DEVICE void operator()(int i) const
    {
        const CellPlace cell = grid.cellPlace(x[i]);
        leaves[int(before[i])] = !rows.has(cell.y, cell.z);
    }
};

struct FindLeaver
{
    CellGridView grid;
    Span<const std::uint32_t> index;
    Span<const Position> x;
    Span<Leaver> leaver;

    HOST_DEVICE void operator()(int k) const
    {
        const std::uint32_t i = index[k];
        const CellPlace cell = grid.cellPlace(x[int(i)]);
        leaver[k] = {i, cell.y, cell.z};
    }
};

// Those that one part sees: in lists of neighbours, or beyond.
struct SeenBy
{
    CellGridView grid;
    std::uint32_t owned;                        // those from here on have left
    RowRectangle rows;                          // of the part
    scalar support, reach;
    bool inLists;
    Span<const std::uint32_t> index;
    Span<const Position> x;
    Span<std::uint8_t> is;

    HOST_DEVICE void operator()(int k) const
    {
        if (index[k] >= owned)
        {
            is[k] = false;
            return;
        }
        const scalar distance2 = grid.squaredDistance(rows, grid.cellPlace(x[int(index[k])]));
        is[k] = distance2 < support * support ? inLists : !inLists && distance2 < reach * reach;
    }
};

// The same of images across sides.
struct SeesImage
{
    CellGridView grid;
    RowRectangle rows;
    scalar support, reach;
    bool inLists;
    SideMaps sides;
    Span<const std::uint32_t> particle;
    Span<const AtSides> across;
    Span<const Position> x;
    Span<std::uint8_t> is;

    HOST_DEVICE void operator()(int k) const
    {
        const scalar distance2 = grid.squaredDistance(rows, grid.cellPlace(sides.imageOf(x[int(particle[k])], across[k])));
        is[k] = distance2 < support * support ? inLists : !inLists && distance2 < reach * reach;
    }
};

// Who leaves, those who go to one part behind those of another.
struct Leaving
{
    IndexList index;
    std::vector<Exchange::Count> counts;        // by part

    Leaving(const RowCut& cut, const std::vector<Leaver>& leavers) : index(leavers.size()), counts(cut.parts())
    {
        std::vector<int> to;
        to.reserve(leavers.size());
        for (const Leaver& leaver : leavers)
        {
            to.push_back(cut.partOf(leaver.y, leaver.z));
            ++counts[to.back()].all;
        }
        std::vector<int> next(counts.size(), 0);
        for (std::size_t k = 1; k < next.size(); ++k) next[k] = next[k - 1] + counts[k - 1].all;
        for (std::size_t k = 0; k < leavers.size(); ++k) index[next[to[k]]++] = leavers[k].index;
    }
};

// Where those who come are put: into the places of those who left, then behind the others. What is left of these places is filled from behind; the order
// does not matter, particles are sorted next.
struct Places
{
    int owned;
    IndexList come, from, to;

    Places(int before, IndexList left, int coming) : owned(before - int(left.size()) + coming)
    {
        std::sort(left.begin(), left.end());
        const std::size_t filled = std::min(left.size(), std::size_t(coming));
        come.assign(left.begin(), left.begin() + long(filled));
        for (int i = before; int(come.size()) < coming; ++i) come.push_back(std::uint32_t(i));
        std::size_t hole = filled, last = left.size();
        for (int i = before; i-- > owned;)
        {
            if (last > filled && left[last - 1] == std::uint32_t(i))
            {
                --last;
                continue;
            }
            from.push_back(std::uint32_t(i));
            to.push_back(left[hole++]);
        }
    }
};

// Puts those who come into their places, and fills those that are left.
void settle(const Columns& columns, const Exchange& exchange, const Places& places)
{
    const int moved = int(places.from.size());
    IndexList lists = places.come;
    lists.insert(lists.end(), places.from.begin(), places.from.end());
    lists.insert(lists.end(), places.to.begin(), places.to.end());
    const Buffer<std::uint32_t> indices(lists);
    const auto list = [&](std::size_t first, int n) { return Span<const std::uint32_t>{indices.span().data + first, n}; };
    exchange.unpack(columns, indices.span());
    RecordMemory memory(RecordLine::countFor(moved * recordOf(columns)));
    std::byte* const bytes = reinterpret_cast<std::byte*>(memory.span().data);
    pack(columns, list(places.come.size(), moved), bytes);
    unpack(bytes, list(places.come.size() + moved, moved), columns);
}

}

bool PartsOfLiquid::migrateRound(Liquid& liquid, const CellGridView& grid, int most)
{
    Buffer<std::uint8_t> leaves(liquid.owned());
    Selection leavers;
    Readback count;
    forEach(leaves.size(), MarkRows{grid, cut_.rowsOf(liquid.parts().part()), false, std::as_const(liquid.predicted).span(), leaves.span()});
    select(leaves, leavers, std::min(most, leaves.size()), count);
    const int all = int(*count.wait());
    migrate(liquid, grid, {leavers.indices.span().data, std::min(all, most)});
    return all > most;
}

PartsOfLiquid::Edge PartsOfLiquid::findEdge(const Liquid& liquid, const CellGrid& grid, int rows)
{
    const RowRectangle own = cut_.rowsOf(liquid.parts().part());
    const Span<const Position> x = std::as_const(liquid.predicted).span();
    Buffer<std::uint8_t> isEdge(liquid.owned()), leaves;
    Selection all, leavers;
    int found, leaving;
    forEach(liquid.owned(), MarkRows{grid.view(), own.widened(-rows), false, x, isEdge.span()});
    for (;;)
    {
        leaves.resizeDiscarding(room_);
        leaves.setZero();
        select(isEdge, all, room_, countEdge_);
        forEach(all, MarkLeavers{grid.view(), own, all.before.span(), x, leaves.span()});
        select(leaves, leavers, room_, countLeavers_);
        found = int(*countEdge_.wait());
        leaving = int(*countLeavers_.wait());
        if (found <= room_) break;
        room_ = found + found / 4;
    }
    Edge edge{std::move(all.indices), Buffer<std::uint32_t>(leaving)};
    forEach
    (
        leaving,
        device::Gather<std::uint32_t, device::EveryPlace>{std::as_const(leavers.indices).span(), {}, std::as_const(edge.all).span(), edge.leavers.span()}
    );
    edge.all.resize(found);
    return edge;
}

void PartsOfLiquid::migrate(Liquid& liquid, const CellGridView& grid, Span<const std::uint32_t> indices)
{
    Buffer<Leaver> found(indices.size);
    forEach(indices.size, FindLeaver{grid, indices, std::as_const(liquid.predicted).span(), found.span()});
    const std::vector<Leaver> leavers = found.download();
    Leaving gone(cut_, leavers);

    Exchange exchange;
    const int coming = exchange.set(liquid.parts(), Buffer<std::uint32_t>(gone.index), gone.counts);
    FieldRegistry& fields = liquid.fields();
    exchange.pack(fields.columnsOf(&FieldInfo::sorted));
    liquid.ghosts().pass(exchange);                 // all parts come to it
    if (coming == 0 && indices.size == 0) return;
    const Places places(liquid.owned(), std::move(gone.index), coming);
    if (places.owned > liquid.owned()) liquid.resize(places.owned);
    settle(fields.columnsOf(&FieldInfo::sorted), exchange, places);
    if (places.owned < liquid.owned()) liquid.resize(places.owned);
}

void PartsOfLiquid::addGhosts(Liquid& liquid, const CellGrid& grid, scalar reach, Span<const std::uint32_t> edge)
{
    const CellGridView cells = grid.view();
    const int part = liquid.parts().part(), owned = liquid.owned(), rows = grid.cellsWithin(reach);
    const scalar support = cells.widened(liquid.support()), farthest = cells.widened(reach);
    const std::vector<int> near = cut_.partsNear(part, rows);
    const Span<const Position> x = std::as_const(liquid.predicted).span();
    Ghosts& ghosts = liquid.ghosts();
    const Images* const images = ghosts.images();
    const Images::List all = images ? images->find(x, owned, farthest) : Images::List{};
    const bool anyImages = all.particle.size() > 0;

    // Of particles at the edge, or of images. All lists are asked for before the first is waited for.
    struct List
    {
        int part;
        bool inLists, ofImages;
        Selection places;
        int count;
    };
    std::vector<List> lists;
    Buffer<std::uint8_t> is(std::max(edge.size, all.particle.size()));
    const auto add = [&](int other, bool inLists, bool ofImages)
    {
        if (counts_.size() == lists.size()) counts_.emplace_back();
        List& list = lists.emplace_back(List{other, inLists, ofImages, {}, 0});
        const RowRectangle of = cut_.rowsOf(other);
        is.resizeDiscarding(ofImages ? all.particle.size() : edge.size);
        if (ofImages) forEach(is.size(), SeesImage{cells, of, support, farthest, inLists, images->sides().maps(), all.particle.span(), all.across.span(), x, is.span()});
        else forEach(is.size(), SeenBy{cells, std::uint32_t(owned), of, support, farthest, inLists, edge, x, is.span()});
        select(is, list.places, is.size(), counts_[lists.size() - 1]);
    };
    for (int other = 0; other < cut_.parts(); ++other)
    {
        const bool isNear = std::find(near.begin(), near.end(), other) != near.end(), seesImages = anyImages && !cut_.rowsOf(other).isEmpty();
        for (const bool inLists : {true, false})
        {
            if (isNear) add(other, inLists, false);
            if (seesImages) add(other, inLists, true);
        }
    }
    std::vector<Exchange::Count> counts(cut_.parts());
    int sum = 0, own = 0;
    for (std::size_t k = 0; k < lists.size(); ++k)
    {
        List& list = lists[k];
        list.count = int(*counts_[k].wait());
        if (list.part == part)
        {
            own += list.count;
            continue;
        }
        sum += list.count;
        counts[list.part].all += list.count;
        if (list.inLists) counts[list.part].inLists += list.count;
    }
    Images::List sent{Buffer<std::uint32_t>(sum), Buffer<AtSides>(images ? sum : 0)}, ofOwn{Buffer<std::uint32_t>(own), Buffer<AtSides>(own)};
    if (images) sent.across.setZero();
    int sentSoFar = 0, ownSoFar = 0;
    for (const List& list : lists)
    {
        Images::List& to = list.part == part ? ofOwn : sent;
        int& first = list.part == part ? ownSoFar : sentSoFar;
        const Span<const std::uint32_t> from = list.ofImages ? all.particle.span() : edge;
        const auto places = list.places.indices.span();
        forEach(list.count, device::Gather<std::uint32_t, device::EveryPlace>{places, {}, from, {to.particle.span().data + first, list.count}});
        if (list.ofImages) forEach(list.count, device::Gather<AtSides, device::EveryPlace>{places, {}, all.across.span(), {to.across.span().data + first, list.count}});
        first += list.count;
    }
    const int added = images ? ghosts.set(std::move(sent), counts, std::move(ofOwn), owned) : ghosts.set(std::move(sent.particle), counts, owned);
    liquid.resize(owned, added);
    ghosts.copy(liquid.fields().columnsOf(&FieldInfo::exchanged));
    if (images) images->renumber(liquid.id);
}

void PartsOfLiquid::bring(Liquid& liquid, const CellGrid& grid, scalar reach)
{
    liquid.resize(liquid.owned());              // without the ghosts of the search before
    const int most = std::exchange(atOnce_, unlimited);
    if (most < unlimited)
    {
        bool more;
        do more = migrateRound(liquid, grid.view(), most);
        while (liquid.parts().any(more));
        device::dropKeptMemory();               // of records: seldom do so many leave
    }
    const int before = liquid.owned();
    Edge edge = findEdge(liquid, grid, grid.cellsWithin(reach));
    migrate(liquid, grid.view(), std::as_const(edge.leavers).span());
    // Those who came were put into the places of those who left, which stand in it, or behind the others.
    const int known = edge.all.size(), behind = std::max(0, liquid.owned() - before);
    edge.all.resize(known + behind);
    forEach(behind, CountUp{{edge.all.span().data + known, behind}, std::uint32_t(before)});
    addGhosts(liquid, grid, reach, std::as_const(edge.all).span());
}

}
