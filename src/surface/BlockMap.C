// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/BlockMap.H"

#include "core/messages/Error.H"
#include "device/Algorithms.H"
#include "device/Atomic.H"
#include "device/ForEach.H"
#include "device/Reduce.H"

#include <algorithm>
#include <limits>
#include <string>

namespace shizuku
{

namespace
{

struct FarthestOfParticle
{
    Span<const Position> positions;

    HOST_DEVICE Farthest operator()(int i) const
    {
        const Place p = placeOf(positions[i]);
        Farthest all;
        for (const std::int64_t x : {p.x, p.y, p.z}) all.add({x < 0 ? -x : x});
        return all;
    }
};

// What is counted while keys are collected.
enum Count { stored, farParticles, misses, counts };

// Each block that a particle reaches once, as a key in a table with open places and, in no order, in a list. Where there is no
// room for all that is noted.
struct CollectKeys
{
    static constexpr std::uint64_t free = ~std::uint64_t(0);

    BlockMapView map;
    std::int64_t reach, most;                   // most: a coordinate that is too far
    BlockLayers layers;
    Span<const Position> positions;
    Span<std::uint64_t> table;                  // 2^bits places
    int bits;
    Span<std::uint64_t> keys;
    Span<std::uint32_t> count;

    // The lanes of a team share the blocks: it takes a chain of reads to find each.
    HOST_DEVICE void operator()(int i, Team team) const
    {
        const Place p = placeOf(positions[i]);
        const auto isFar = [this](std::int64_t x) { return x >= most || x <= -most; };
        if (isFar(p.x) || isFar(p.y) || isFar(p.z))
        {
            count[farParticles] = 1;
            return;
        }
        const int lowX = int(map.blockAt(p.x - reach)), alongX = int(map.blockAt(p.x + reach)) - lowX + 1;
        const int lowY = int(map.blockAt(p.y - reach)), alongY = int(map.blockAt(p.y + reach)) - lowY + 1;
        const int lowestZ = int(map.blockAt(p.z - reach)), highestZ = int(map.blockAt(p.z + reach));
        const int lowZ = lowestZ > layers.low ? lowestZ : layers.low, alongZ = (highestZ < layers.high ? highestZ : layers.high) - lowZ + 1;
        for (int k = team.lane; k < alongX * alongY * alongZ; k += team.width)
        {
            add(BlockMapView::key(lowX + k % alongX, lowY + k / alongX % alongY, lowZ + k / (alongX * alongY)));
        }
    }

    HOST_DEVICE void add(std::uint64_t key) const
    {
        // Fibonacci hashing: neighbouring keys far from each other.
        const std::uint32_t first = std::uint32_t(key * 0x9e3779b97f4a7c15u >> (64 - bits));
        for (int step = 0; step < table.size; ++step)
        {
            std::uint64_t& place = table[int((first + std::uint32_t(step)) & std::uint32_t(table.size - 1))];
            std::uint64_t there = look(place);
            if (there == free) there = replace(place, free, key);
            if (there == key) return;
            if (there == free)
            {
                const std::uint32_t number = increment(count[stored]);
                if (number < std::uint32_t(keys.size)) keys[int(number)] = key;
                else put(count[misses], 1u);
                return;
            }
            if (look(count[misses]) > 0) return;
        }
        put(count[misses], 1u);
    }
};

struct FindNext
{
    BlockMapView map;
    Span<std::int32_t> next;

    HOST_DEVICE void operator()(int k) const
    {
        const auto block = BlockMapView::blockOfKey(map.keys[k / 8]);
        const int dx = k & 1, dy = k >> 1 & 1, dz = k >> 2 & 1;
        next[k] = map.find(BlockMapView::key(block.x + dx, block.y + dy, block.z + dz));
    }
};

}

BlockMap::BlockMap(scalar cell, scalar reach)
:
    cell_(quanta::wholeOf(cell)), reach_(std::min(quanta::wholeOf(reach), BlockMapView::edge * cell_)),
    farthest_(cell_ * BlockMapView::edge * (BlockMapView::farthest - 2)), counts_(counts)
{}

void BlockMap::refuseFarParticles(Span<const Position> positions)
{
    const std::int64_t farthest = reduce(positions.size, FarthestOfParticle{positions}, scratch_).coordinate;
    throw FatalError
    (
        "A particle is " + std::to_string(long(farthest / cell_)) + " cells away from the origin, more than "
      + std::to_string(long(farthest_ / cell_))
      + ".\n    Look for particles that flew away, or use larger cells in system/meshSurfaceDict."
    );
}

void BlockMap::collect(Span<const Position> positions, const BlockLayers& layers)
{
    layers_ = layers;
    // Full blocks of cells of half a spacing hold 64 particles, and half of the places shall stay free.
    while (1 << bits_ < positions.size / 8) ++bits_;
    collectKeys(positions);
}

void BlockMap::collectKeys(Span<const Position> positions)
{
    table_.resizeDiscarding(1 << bits_);
    keys_.resizeDiscarding(1 << (bits_ - 1));
    device::setBytes(table_.span().data, 0xff, std::size_t(table_.size()) * sizeof(std::uint64_t));
    counts_.setZero();
    forEachTeam
    (
        positions.size,
        CollectKeys{view(), reach_, farthest_, layers_, positions, table_.span(), bits_, keys_.span(), counts_.span()}
    );
    readCounts_.ask(counts_);
}

void BlockMap::store(Span<const Position> positions)
{
    const std::uint32_t* count = readCounts_.wait();
    if (count[farParticles] > 0) refuseFarParticles(positions);
    for (; count[misses] > 0; count = readCounts_.wait())
    {
        bits_ += 2;
        if (bits_ > 30) throw FatalError("The liquid is spread over too many blocks of nodes: use larger cells in system/meshSurfaceDict.");
        collectKeys(positions);
    }
    constexpr int most = std::numeric_limits<int>::max() / BlockMapView::nodes;         // nodes are counted by int
    const int stored = int(count[Count::stored]);
    if (stored > most)
    {
        throw FatalError
        (
            "The liquid is spread over " + std::to_string(stored) + " blocks of nodes, more than " + std::to_string(most)
          + ".\n    Use larger cells in system/meshSurfaceDict, or mesh it in parts."
        );
    }
    keys_.resize(stored);
    sort(keys_);
    next_.resizeDiscarding(8 * stored);
    forEach(8 * stored, FindNext{view(), next_.span()});
}

BlockMap::Layer BlockMap::layer(int z) const
{
    const std::vector<std::uint64_t> keys = keys_.download();
    constexpr int lowest = -BlockMapView::farthest;
    const auto first = std::lower_bound(keys.begin(), keys.end(), BlockMapView::key(lowest, lowest, z));
    const auto end = std::lower_bound(first, keys.end(), BlockMapView::key(lowest, lowest, z + 1));
    return {int(first - keys.begin()), std::vector<std::uint64_t>(first, end)};
}

}
