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

using IndexList = Ghosts::Indices;

struct OutsideOfRows
{
    CellGridView grid;
    RowCut cut;
    int low, high;
    Span<const Position> x;
    Span<std::uint8_t> is;

    HOST_DEVICE void operator()(int i) const
    {
        const int row = cut.rowOf(grid.cellPlace(x[i]));
        is[i] = row < low || row >= high;
    }
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
bool isSeen(const FieldInfo& info) { return info.exchanged; }

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

PartsOfLiquid::Chosen PartsOfLiquid::choose(const Liquid& liquid, const CellGridView& grid, int low, int high)
{
    const int n = liquid.owned();
    if (n == 0) return {};
    Buffer<std::uint8_t> is(n);
    forEach(n, OutsideOfRows{grid, cut_, low, high, liquid.predicted.span(), is.span()});
    select(is, selection_, room_, count_);
    int count = int(*count_.wait());
    if (count > room_)
    {
        room_ = count + count / 4;
        select(is, selection_, room_, count_);
        count = int(*count_.wait());
    }
    Chosen chosen;
    chosen.indices.resize(count);
    selection_.indices.download(chosen.indices.data(), count);
    Buffer<std::uint32_t> rows(count);
    forEach(count, RowsOfSome{grid, cut_, selection_.indices.span(), liquid.predicted.span(), rows.span()});
    chosen.rows = rows.download();
    return chosen;
}

void PartsOfLiquid::migrate(Liquid& liquid, const CellGridView& grid)
{
    const int part = liquid.parts().part();
    const Chosen leave = choose(liquid, grid, cut_.low(part), cut_.high(part));
    std::vector<IndexList> leaving(cut_.parts);
    for (std::size_t k = 0; k < leave.indices.size(); ++k) leaving[cut_.partOf(int(leave.rows[k]))].push_back(leave.indices[k]);

    FieldRegistry& fields = liquid.fields();
    const std::vector<Bytes> from = liquid.parts().exchange(packed(fields, Lists(leaving), moves));
    const std::vector<int> counts = countsOf(from, bytesOf(fields, moves));
    const Places places(liquid.owned(), leave.indices, std::accumulate(counts.begin(), counts.end(), 0));
    if (places.owned > liquid.owned()) liquid.resize(places.owned);
    const Buffer<std::uint32_t> come(places.come);
    unpack(fields, from, counts, moves, [&]<class T>(const std::vector<T>& values, Buffer<T>& field) { scatter(Buffer<T>(values), come, field); });
    move(fields, places.from, places.to);
    if (places.owned < liquid.owned()) liquid.resize(places.owned);
}

void PartsOfLiquid::addGhosts(Liquid& liquid, const CellGridView& grid, int reach)
{
    const int part = liquid.parts().part();
    constexpr int none = std::numeric_limits<int>::min(), all = std::numeric_limits<int>::max();
    const int low = cut_.low(part), high = cut_.high(part);
    const Chosen edge = choose(liquid, grid, low == none ? none : low + reach, high == all ? all : high - reach);
    std::vector<IndexList> seen(cut_.parts);
    for (int other = 0; other < cut_.parts; ++other)
    {
        if (other == part) continue;
        for (std::size_t k = 0; k < edge.indices.size(); ++k)
        {
            if (cut_.sees(other, int(edge.rows[k]), reach)) seen[other].push_back(edge.indices[k]);
        }
    }
    Lists lists(seen);
    const std::vector<Bytes> from = liquid.parts().exchange(packed(liquid.fields(), lists, isSeen));
    std::vector<int> counts = countsOf(from, bytesOf(liquid.fields(), isSeen));
    const int owned = liquid.owned();
    liquid.resize(owned, std::accumulate(counts.begin(), counts.end(), 0));
    unpack(liquid.fields(), from, counts, isSeen, [&]<class T>(const std::vector<T>& values, Buffer<T>& field) { field.upload(values, owned); });
    liquid.ghosts().set(lists.indices, std::move(lists.counts), std::move(counts), owned);
}

void PartsOfLiquid::bring(Liquid& liquid, const CellGridView& grid, int rows)
{
    liquid.resize(liquid.owned());
    migrate(liquid, grid);
    addGhosts(liquid, grid, rows);
}

}
