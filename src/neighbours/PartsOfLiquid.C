// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours/PartsOfLiquid.H"

#include "device/Algorithms.H"
#include "device/ForEach.H"
#include "device/Gather.H"

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>

namespace shizuku
{

namespace
{

using IndexList = std::vector<std::uint32_t>;

struct Row
{
    int y, z;
};

struct NotIn
{
    CellGridView grid;
    RowRectangle rows;
    Span<const Position> x;
    Span<std::uint8_t> is;

    HOST_DEVICE void operator()(int i) const
    {
        const CellPlace cell = grid.cellPlace(x[i]);
        is[i] = !rows.has(cell.y, cell.z);
    }
};

struct RowsOfSome
{
    CellGridView grid;
    Span<const std::uint32_t> index;
    Span<const Position> x;
    Span<Row> row;

    HOST_DEVICE void operator()(int k) const
    {
        const CellPlace cell = grid.cellPlace(x[int(index[k])]);
        row[k] = {cell.y, cell.z};
    }
};

// Of each part in turn the same particles.
struct SeenByParts
{
    CellGridView grid;
    Span<const RowRectangle> parts;
    scalar reach;
    Span<const std::uint32_t> index;
    Span<const Position> x;
    Span<std::uint8_t> is;

    HOST_DEVICE void operator()(int k) const
    {
        const int part = k / index.size;
        const CellPlace place = grid.cellPlace(x[int(index[k - part * index.size])]);
        is[k] = grid.squaredDistance(parts[part], place) < reach * reach;
    }
};

struct Remainders
{
    std::uint32_t divisor;
    Span<std::uint32_t> numbers;

    HOST_DEVICE void operator()(int k) const { numbers[k] %= divisor; }
};

// Particles for other parts: those of one part behind those of another, and how many these are.
struct Lists
{
    IndexList indices;
    std::vector<int> counts;

    explicit Lists(const std::vector<IndexList>& ofParts)
    {
        for (const IndexList& of : ofParts)
        {
            indices.insert(indices.end(), of.begin(), of.end());
            counts.push_back(int(of.size()));
        }
    }
};

// For each part the values of its particles, of one field behind the other.
template<class Wanted>
std::vector<Bytes> packed(const FieldRegistry& fields, const Lists& lists, const Wanted& wanted)
{
    std::vector<Bytes> bytes(lists.counts.size());
    if (lists.indices.empty()) return bytes;
    const Buffer<std::uint32_t> index(lists.indices);
    for (const auto& entry : fields.entries())
    {
        if (!wanted(entry->info)) continue;
        std::visit
        (
            [&]<class T>(const Buffer<T>& field)
            {
                Buffer<T> values;
                gather(field, index, values);
                const std::vector<T> host = values.download();
                const auto* next = reinterpret_cast<const std::byte*>(host.data());
                for (std::size_t k = 0; k < bytes.size(); ++k)
                {
                    const auto* const end = next + lists.counts[k] * sizeof(T);
                    bytes[k].insert(bytes[k].end(), next, end);
                    next = end;
                }
            },
            entry->values
        );
    }
    return bytes;
}

// Bytes of a particle in what is packed.
template<class Wanted>
std::size_t bytesOf(const FieldRegistry& fields, const Wanted& wanted)
{
    std::size_t bytes = 0;
    for (const auto& entry : fields.entries())
    {
        if (wanted(entry->info)) std::visit([&]<class T>(const Buffer<T>&) { bytes += sizeof(T); }, entry->values);
    }
    return bytes;
}

// Puts the packed particles of all parts into the fields, by part.
template<class Wanted, class Put>
void unpack(FieldRegistry& fields, const std::vector<Bytes>& bytes, const std::vector<int>& counts, const Wanted& wanted, const Put& put)
{
    const int all = std::accumulate(counts.begin(), counts.end(), 0);
    if (all == 0) return;
    std::size_t before = 0;                     // bytes of a particle in the fields before
    for (const auto& entry : fields.entries())
    {
        if (!wanted(entry->info)) continue;
        std::visit
        (
            [&]<class T>(Buffer<T>& field)
            {
                std::vector<T> values(all);
                T* next = values.data();
                for (std::size_t k = 0; k < bytes.size(); next += counts[k++])
                {
                    if (counts[k] > 0) std::memcpy(next, bytes[k].data() + counts[k] * before, counts[k] * sizeof(T));
                }
                put(values, field);
                before += sizeof(T);
            },
            entry->values
        );
    }
}

std::vector<int> countsOf(const std::vector<Bytes>& bytes, std::size_t each)
{
    std::vector<int> counts;
    for (const Bytes& of : bytes) counts.push_back(int(of.size() / each));
    return counts;
}

bool moves(const FieldInfo& info) { return info.sorted; }

// Values of particles `from` become those of particles `to`.
void move(FieldRegistry& fields, const IndexList& from, const IndexList& to)
{
    if (from.empty()) return;
    const Buffer<std::uint32_t> source(from), target(to);
    for (const auto& entry : fields.entries())
    {
        if (!entry->info.sorted) continue;
        std::visit
        (
            [&]<class T>(Buffer<T>& field)
            {
                Buffer<T> values;
                gather(field, source, values);
                scatter(values, target, field);
            },
            entry->values
        );
    }
}

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

}

template<class Is>
int PartsOfLiquid::choose(const Is& is, Buffer<std::uint8_t>& chosen)
{
    if (chosen.size() == 0) return 0;
    forEach(chosen.size(), is);
    select(chosen, selection_, room_, count_);
    int count = int(*count_.wait());
    if (count > room_)
    {
        room_ = count + count / 4;
        select(chosen, selection_, room_, count_);
        count = int(*count_.wait());
    }
    return count;
}

PartsOfLiquid::Leaving PartsOfLiquid::leaving(const Liquid& liquid, const CellGridView& grid)
{
    Buffer<std::uint8_t> is(liquid.owned());
    const int count = choose(NotIn{grid, cut_.rowsOf(liquid.parts().part()), liquid.predicted.span(), is.span()}, is);
    Leaving leaving{IndexList(count), std::vector<IndexList>(cut_.parts())};
    selection_.indices.download(leaving.indices.data(), count);
    Buffer<Row> rows(count);
    forEach(count, RowsOfSome{grid, selection_.indices.span(), liquid.predicted.span(), rows.span()});
    const std::vector<Row> rowOf = rows.download();
    for (int k = 0; k < count; ++k) leaving.byPart[cut_.partOf(rowOf[k].y, rowOf[k].z)].push_back(leaving.indices[k]);
    return leaving;
}

void PartsOfLiquid::migrate(Liquid& liquid, const CellGridView& grid)
{
    const Leaving leave = leaving(liquid, grid);
    FieldRegistry& fields = liquid.fields();
    const std::vector<Bytes> from = liquid.parts().exchange(packed(fields, Lists(leave.byPart), moves));
    const std::vector<int> counts = countsOf(from, bytesOf(fields, moves));
    const Places places(liquid.owned(), leave.indices, std::accumulate(counts.begin(), counts.end(), 0));
    if (places.owned > liquid.owned()) liquid.resize(places.owned);
    const Buffer<std::uint32_t> come(places.come);
    unpack(fields, from, counts, moves, [&]<class T>(const std::vector<T>& values, Buffer<T>& field) { scatter(Buffer<T>(values), come, field); });
    move(fields, places.from, places.to);
    if (places.owned < liquid.owned()) liquid.resize(places.owned);
}

// Of the particles those at the edge, and of these for all parts that are near at once.
PartsOfLiquid::Seen PartsOfLiquid::seen(const Liquid& liquid, const CellGrid& grid, scalar reach)
{
    const CellGridView cells = grid.view();
    const int part = liquid.parts().part(), rows = grid.cellsWithin(reach);
    const std::vector<int> near = cut_.partsNear(part, rows);
    Seen seen{{}, std::vector<int>(cut_.parts())};
    if (near.empty()) return seen;

    Buffer<std::uint8_t> isAtEdge(liquid.owned());
    Buffer<std::uint32_t> edge(choose(NotIn{cells, cut_.rowsOf(part).widened(-rows), liquid.predicted.span(), isAtEdge.span()}, isAtEdge));
    if (edge.size() == 0) return seen;
    device::copyOnDevice(edge.span().data, selection_.indices.span().data, edge.size() * sizeof(std::uint32_t));

    std::vector<RowRectangle> rowsOfNear;
    std::vector<std::uint32_t> ends;
    for (const int other : near)
    {
        rowsOfNear.push_back(cut_.rowsOf(other));
        ends.push_back(std::uint32_t(rowsOfNear.size()) * std::uint32_t(edge.size()));
    }
    const Buffer<RowRectangle> parts(rowsOfNear);
    Buffer<std::uint8_t> isSeen(int(ends.back()));
    const int count = choose(SeenByParts{cells, parts.span(), cells.widened(reach), edge.span(), liquid.predicted.span(), isSeen.span()}, isSeen);
    if (count == 0) return seen;
    Buffer<std::uint32_t> before;
    gather(selection_.before, Buffer<std::uint32_t>(ends), before);
    const std::vector<std::uint32_t> endOf = before.download();
    for (std::size_t k = 0; k < near.size(); ++k) seen.counts[near[k]] = int(endOf[k] - (k > 0 ? endOf[k - 1] : 0));

    Buffer<std::uint32_t> places(count);
    device::copyOnDevice(places.span().data, selection_.indices.span().data, count * sizeof(std::uint32_t));
    forEach(count, Remainders{std::uint32_t(edge.size()), places.span()});
    gather(edge, places, seen.indices);
    return seen;
}

void PartsOfLiquid::addGhosts(Liquid& liquid, const CellGrid& grid, scalar reach)
{
    const int owned = liquid.owned();
    Seen seen = this->seen(liquid, grid, reach);
    Ghosts& ghosts = liquid.ghosts();
    liquid.resize(owned, ghosts.set(std::move(seen.indices), std::move(seen.counts), owned));
    for (const auto& entry : liquid.fields().entries())
    {
        if (entry->info.exchanged) std::visit([&](auto& field) { ghosts.copy(field); }, entry->values);
    }
}

void PartsOfLiquid::bring(Liquid& liquid, const CellGrid& grid, scalar reach)
{
    liquid.resize(liquid.owned());              // without the ghosts of the search before
    migrate(liquid, grid.view());
    addGhosts(liquid, grid, reach);
}

}
