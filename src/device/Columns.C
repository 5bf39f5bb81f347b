// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/Columns.H"

#include "device/ForEach.H"

#include <algorithm>

namespace shizuku
{

namespace
{

struct alignas(16) FourWords
{
    std::uint32_t words[4];
};

template<class Unit>
HOST_DEVICE inline void copyUnits(std::byte* to, const std::byte* from, unsigned bytes)
{
    for (unsigned at = 0; at < bytes; at += sizeof(Unit)) *reinterpret_cast<Unit*>(to + at) = *reinterpret_cast<const Unit*>(from + at);
}

// A few columns at a time: they are arguments of a kernel.
struct SomeColumns
{
    static constexpr int most = 8;

    struct Each
    {
        std::byte* values;
        const std::uint32_t* before;
        unsigned stride, bytes, offset, unit;           // offset: in the record; unit: bytes that are copied at once
    };

    Each of[most];
    int count = 0;
    std::size_t record;

    // copy(column, in the array, in the record) of those that index i has, lack(column, in the record) of the others.
    template<class Copy, class Lack>
    HOST_DEVICE void forEach(int i, int k, Copy copy, Lack lack) const
    {
        #pragma unroll
        for (int c = 0; c < most; ++c)
        {
            if (c >= count) break;
            const Each& column = of[c];
            std::size_t place = i;
            if (column.before)
            {
                place = column.before[i];
                if (column.before[i + 1] == place)
                {
                    lack(column, k * record + column.offset);
                    continue;
                }
            }
            copy(column, column.values + place * column.stride, k * record + column.offset);
        }
    }

    HOST_DEVICE static void copy(const Each& column, std::byte* to, const std::byte* from)
    {
        if (column.unit == 16) copyUnits<FourWords>(to, from, column.bytes);
        else if (column.unit == 8) copyUnits<std::uint64_t>(to, from, column.bytes);
        else if (column.unit == 4) copyUnits<std::uint32_t>(to, from, column.bytes);
        else copyUnits<std::uint8_t>(to, from, column.bytes);
    }
};

struct PackRecords
{
    SomeColumns columns;
    Span<const std::uint32_t> indices;
    std::byte* records;

    HOST_DEVICE void operator()(int k) const
    {
        columns.forEach(int(indices[k]), k, [&](const auto& column, const std::byte* value, std::size_t at)
        {
            SomeColumns::copy(column, records + at, value);
        },
        [&](const auto& column, std::size_t at)
        {
            for (unsigned b = 0; b < column.bytes; ++b) records[at + b] = {};      // records travel whole
        });
    }
};

struct UnpackRecords
{
    SomeColumns columns;
    Span<const std::uint32_t> indices;
    const std::byte* records;

    HOST_DEVICE void operator()(int k) const
    {
        columns.forEach(int(indices[k]), k, [&](const auto& column, std::byte* value, std::size_t at)
        {
            SomeColumns::copy(column, value, records + at);
        },
        [](const auto&, std::size_t) {});
    }
};

// The most bytes, 16 at most, that all of these are multiples of.
unsigned unitOf(std::size_t all)
{
    unsigned unit = 16;
    while (all % unit != 0 || unit == 2) unit /= 2;
    return unit;
}

// visit(some of the columns), until it has seen all.
template<class Visit>
void forSome(const Columns& columns, const Visit& visit)
{
    SomeColumns some;
    some.record = recordOf(columns);
    std::size_t offset = 0;
    for (const Column& column : columns)
    {
        const auto address = reinterpret_cast<std::uintptr_t>(column.values);
        const unsigned unit = unitOf(address | std::size_t(column.stride) | std::size_t(column.bytes) | offset | some.record);
        some.of[some.count++] = {column.values, column.before, unsigned(column.stride), unsigned(column.bytes), unsigned(offset), unit};
        offset += column.bytes;
        if (some.count < SomeColumns::most) continue;
        visit(some);
        some.count = 0;
    }
    if (some.count > 0) visit(some);
}

}

std::size_t recordOf(const Columns& columns)
{
    std::size_t bytes = 0;
    for (const Column& column : columns) bytes += column.bytes;
    return bytes;
}

void pack(const Columns& columns, Span<const std::uint32_t> indices, std::byte* records)
{
    forSome(columns, [&](const SomeColumns& some) { forEach(indices.size, PackRecords{some, indices, records}); });
}

void unpack(const std::byte* records, Span<const std::uint32_t> indices, const Columns& columns)
{
    forSome(columns, [&](const SomeColumns& some) { forEach(indices.size, UnpackRecords{some, indices, records}); });
}

}
