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

struct NotOfPart
{
    CellGridView grid;
    OwnRows own;
    Span<const Position> x;
    Span<std::uint8_t> is;

    HOST_DEVICE void operator()(int i) const
    {
        const CellPlace cell = grid.cellPlace(x[i]);
        is[i] = !own.has(cell.y, cell.z);
    }
};

struct SeenBy
{
    CellGridView grid;
    RowCut cut;
    int part, rows;
    Span<const Position> x;
    Span<std::uint8_t> is;

    HOST_DEVICE void operator()(int i) const { is[i] = cut.sees(part, cut.rowOf(grid.cellPlace(x[i])), rows); }
};

struct RowsOfSome
{
    CellGridView grid;
    RowCut cut;
    Span<const std::uint32_t> index;
    Span<const Position> x;
    Span<std::uint32_t> row;

    HOST_DEVICE void operator()(int k) const { row[k] = std::uint32_t(cut.rowOf(grid.cellPlace(x[int(index[k])]))); }
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
    const int count = choose(NotOfPart{grid, cut_.rowsOf(liquid.parts().part()), liquid.predicted.span(), is.span()}, is);
    Leaving leaving;
    leaving.indices.resize(count);
    selection_.indices.download(leaving.indices.data(), count);
    Buffer<std::uint32_t> rows(count);
    forEach(count, RowsOfSome{grid, cut_, selection_.indices.span(), liquid.predicted.span(), rows.span()});
    leaving.rows = rows.download();
    return leaving;
}

void PartsOfLiquid::migrate(Liquid& liquid, const CellGridView& grid)
{
    const Leaving leave = leaving(liquid, grid);
    std::vector<IndexList> byPart(cut_.parts);
    for (std::size_t k = 0; k < leave.indices.size(); ++k) byPart[cut_.partOf(int(leave.rows[k]))].push_back(leave.indices[k]);

    FieldRegistry& fields = liquid.fields();
    const std::vector<Bytes> from = liquid.parts().exchange(packed(fields, Lists(byPart), moves));
    const std::vector<int> counts = countsOf(from, bytesOf(fields, moves));
    const Places places(liquid.owned(), leave.indices, std::accumulate(counts.begin(), counts.end(), 0));
    if (places.owned > liquid.owned()) liquid.resize(places.owned);
    const Buffer<std::uint32_t> come(places.come);
    unpack(fields, from, counts, moves, [&]<class T>(const std::vector<T>& values, Buffer<T>& field) { scatter(Buffer<T>(values), come, field); });
    move(fields, places.from, places.to);
    if (places.owned < liquid.owned()) liquid.resize(places.owned);
}

void PartsOfLiquid::addGhosts(Liquid& liquid, const CellGridView& grid, int rows)
{
    const int part = liquid.parts().part(), owned = liquid.owned();
    Buffer<std::uint8_t> is(owned);
    Buffer<std::uint32_t> sent;
    std::vector<int> counts(cut_.parts);
    for (int other = 0; other < cut_.parts; ++other)
    {
        if (other == part || !cut_.seesOf(other, part, rows)) continue;
        const int before = sent.size(), count = choose(SeenBy{grid, cut_, other, rows, liquid.predicted.span(), is.span()}, is);
        sent.resize(before + count);
        if (count > 0) device::copyOnDevice(sent.span().data + before, selection_.indices.span().data, count * sizeof(std::uint32_t));
        counts[other] = count;
    }
    Ghosts& ghosts = liquid.ghosts();
    liquid.resize(owned, ghosts.set(std::move(sent), std::move(counts), owned));
    for (const auto& entry : liquid.fields().entries())
    {
        if (entry->info.exchanged) std::visit([&](auto& field) { ghosts.copy(field); }, entry->values);
    }
}

void PartsOfLiquid::bring(Liquid& liquid, const CellGridView& grid, int rows)
{
    liquid.resize(liquid.owned());              // without the ghosts of the search before
    migrate(liquid, grid);
    addGhosts(liquid, grid, rows);
}

}
