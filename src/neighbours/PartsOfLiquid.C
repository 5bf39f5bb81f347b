// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours/PartsOfLiquid.H"

#include "device/ForEach.H"
#include "device/Gather.H"

#include <cstring>
#include <numeric>

namespace shizuku
{

namespace
{

struct RowsOfParticles
{
    CellGridView grid;
    RowCut cut;
    Span<const Position> x;
    Span<std::uint32_t> row;

    HOST_DEVICE void operator()(int i) const { row[i] = std::uint32_t(cut.rowOf(grid.cellPlace(x[i]))); }
};

std::vector<int> rowsOf(const Liquid& liquid, const CellGridView& grid, const RowCut& cut)
{
    Buffer<std::uint32_t> rows(liquid.owned());
    forEach(liquid.owned(), RowsOfParticles{grid, cut, liquid.predicted.span(), rows.span()});
    const std::vector<std::uint32_t> words = rows.download();
    return {words.begin(), words.end()};
}

// The values of some particles, of one field behind the other.
template<class Wanted>
Bytes packed(const FieldRegistry& fields, const Ghosts::Indices& indices, const Wanted& wanted)
{
    Bytes bytes;
    const Buffer<std::uint32_t> index(indices);
    for (const auto& entry : fields.entries())
    {
        if (!wanted(entry->info)) continue;
        std::visit
        (
            [&]<class T>(const Buffer<T>& field)
            {
                Buffer<T> values;
                gather(field, index, values);
                const std::size_t before = bytes.size();
                bytes.resize(before + values.size() * sizeof(T));
                values.download(reinterpret_cast<T*>(bytes.data() + before), values.size());
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

// Puts n packed particles into the fields from `first` on.
template<class Wanted>
void unpack(FieldRegistry& fields, const Bytes& bytes, int n, int first, const Wanted& wanted)
{
    const std::byte* next = bytes.data();
    for (const auto& entry : fields.entries())
    {
        if (!wanted(entry->info)) continue;
        std::visit
        (
            [&]<class T>(Buffer<T>& field)
            {
                std::vector<T> values(n);
                if (n > 0) std::memcpy(values.data(), next, n * sizeof(T));
                next += n * sizeof(T);
                field.upload(values, first);
            },
            entry->values
        );
    }
}

// Gives each part the particles of its list, and puts what the others give where makeRoom(how many) says. How many each has given.
template<class Wanted, class MakeRoom>
std::vector<int> give(Liquid& liquid, const std::vector<Ghosts::Indices>& lists, const Wanted& wanted, const MakeRoom& makeRoom)
{
    std::vector<Bytes> to;
    for (const Ghosts::Indices& list : lists) to.push_back(packed(liquid.fields(), list, wanted));
    const std::vector<Bytes> from = liquid.parts().exchange(std::move(to));
    const std::size_t each = bytesOf(liquid.fields(), wanted);
    std::vector<int> counts;
    for (const Bytes& bytes : from) counts.push_back(int(bytes.size() / each));
    int first = makeRoom(std::accumulate(counts.begin(), counts.end(), 0));
    for (std::size_t k = 0; k < from.size(); ++k)
    {
        unpack(liquid.fields(), from[k], counts[k], first, wanted);
        first += counts[k];
    }
    return counts;
}

void migrate(Liquid& liquid, const CellGridView& grid, const RowCut& cut)
{
    std::vector<Ghosts::Indices> leaving(cut.parts);
    Ghosts::Indices staying;
    const std::vector<int> rows = rowsOf(liquid, grid, cut);
    for (int i = 0; i < int(rows.size()); ++i)
    {
        const int part = cut.partOf(rows[i]);
        (part == liquid.parts().part() ? staying : leaving[part]).push_back(std::uint32_t(i));
    }
    const bool anyLeaves = staying.size() < rows.size();
    if (!liquid.parts().any(anyLeaves)) return;
    give(liquid, leaving, [](const FieldInfo& info) { return info.sorted; }, [&](int come)
    {
        if (anyLeaves) liquid.fields().reorder(Buffer<std::uint32_t>(staying));
        liquid.resize(int(staying.size()) + come);
        return int(staying.size());
    });
}

void addGhosts(Liquid& liquid, const CellGridView& grid, const RowCut& cut, int reach)
{
    std::vector<Ghosts::Indices> seen(cut.parts), received;
    const std::vector<int> rows = rowsOf(liquid, grid, cut);
    for (int part = 0; part < cut.parts; ++part)
    {
        if (part == liquid.parts().part()) continue;
        for (int i = 0; i < int(rows.size()); ++i)
        {
            if (cut.sees(part, rows[i], reach)) seen[part].push_back(std::uint32_t(i));
        }
    }
    const std::vector<int> counts = give(liquid, seen, [](const FieldInfo& info) { return info.exchanged; }, [&](int come)
    {
        liquid.resize(liquid.owned(), come);
        return liquid.owned();
    });
    std::uint32_t next = std::uint32_t(liquid.owned());
    for (const int count : counts)
    {
        received.emplace_back(count);
        std::iota(received.back().begin(), received.back().end(), next);
        next += std::uint32_t(count);
    }
    liquid.ghosts().set(std::move(seen), std::move(received));
}

}

void bringToParts(Liquid& liquid, const CellGridView& grid, const RowCut& cut, int rows)
{
    liquid.resize(liquid.owned());
    migrate(liquid, grid, cut);
    addGhosts(liquid, grid, cut, rows);
}

}
