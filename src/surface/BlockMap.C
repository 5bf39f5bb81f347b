#include "surface/BlockMap.H"

#include "core/messages/Error.H"
#include "device/Algorithms.H"
#include "device/ForEach.H"
#include "device/Reduce.H"

#include <string>

namespace shizuku
{

namespace
{

struct FarthestOfParticle
{
    Span<const Vec3> positions;

    HOST_DEVICE Farthest operator()(int i) const
    {
        const Vec3 p = positions[i];
        return {fmaxf(fmaxf(fabsf(p.x), fabsf(p.y)), fabsf(p.z))};
    }
};

struct BlockOfParticle
{
    float cell;
    Span<const Vec3> positions;
    Span<std::uint64_t> keys;
    Span<std::uint32_t> order;

    HOST_DEVICE int block(float x) const { return BlockMapView::blockOf(int(floorf(x / cell))); }

    HOST_DEVICE void operator()(int i) const
    {
        const Vec3 p = positions[i];
        keys[i] = BlockMapView::key(block(p.x), block(p.y), block(p.z));
        order[i] = std::uint32_t(i);
    }
};

// Equal keys stand together: a run. Which key is the first of its run?
struct FindFirst
{
    Span<const std::uint64_t> keys;
    Span<std::uint32_t> first;

    HOST_DEVICE void operator()(int i) const { first[i] = i == 0 || keys[i] != keys[i - 1]; }
};

struct StoreRunStarts
{
    Span<const std::uint32_t> run;              // runs that begin before i
    Span<std::uint32_t> start;                  // of each run; behind the last: the number of keys

    HOST_DEVICE void operator()(int i) const
    {
        if (run[i + 1] > run[i]) start[int(run[i])] = std::uint32_t(i);
        if (i + 2 == run.size) start[start.size - 1] = std::uint32_t(i + 1);
    }
};

// Which of the 27 blocks around a block, and itself, its particles reach: one bit each, and how many.
struct FindReached
{
    float cell, reach;
    Span<const Vec3> positions;
    Span<const std::uint64_t> keys;
    Span<const std::uint32_t> order, start;
    Span<std::uint32_t> reached, count;

    // From the block's first node at `low` to -1, 0 or 1: the block that x is in.
    HOST_DEVICE int side(float x, int low) const
    {
        const int node = int(floorf(x / cell)) - low;
        return node < 0 ? -1 : node < BlockMapView::edge ? 0 : 1;
    }

    HOST_DEVICE void operator()(int k) const
    {
        const auto block = BlockMapView::blockOfKey(keys[int(start[k])]);
        const int edge = BlockMapView::edge;
        std::uint32_t bits = 0;
        for (std::uint32_t i = start[k]; i < start[k + 1]; ++i)
        {
            const Vec3 p = positions[int(order[int(i)])];
            for (int z = side(p.z - reach, edge * block.z); z <= side(p.z + reach, edge * block.z); ++z)
                for (int y = side(p.y - reach, edge * block.y); y <= side(p.y + reach, edge * block.y); ++y)
                    for (int x = side(p.x - reach, edge * block.x); x <= side(p.x + reach, edge * block.x); ++x)
                    {
                        bits |= 1u << ((z + 1) * 9 + (y + 1) * 3 + x + 1);
                    }
        }
        reached[k] = bits;
        std::uint32_t sum = 0;
        for (; bits != 0; bits &= bits - 1) ++sum;
        count[k] = sum;
    }
};

struct ListReached
{
    Span<const std::uint64_t> keys;
    Span<const std::uint32_t> start, reached, first;
    Span<std::uint64_t> list;
    Span<std::uint32_t> order;

    HOST_DEVICE void operator()(int k) const
    {
        const auto block = BlockMapView::blockOfKey(keys[int(start[k])]);
        int place = int(first[k]);
        for (int n = 0; n < 27; ++n)
        {
            if (!(reached[k] >> n & 1)) continue;
            list[place] = BlockMapView::key(block.x + n % 3 - 1, block.y + n / 3 % 3 - 1, block.z + n / 9 - 1);
            order[place] = std::uint32_t(place);
            ++place;
        }
    }
};

struct StoreKeys
{
    Span<const std::uint64_t> keys;
    Span<const std::uint32_t> start;
    Span<std::uint64_t> stored;

    HOST_DEVICE void operator()(int k) const { stored[k] = keys[int(start[k])]; }
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

BlockMap::BlockMap(float cell, float reach) : cell_(cell), reach_(fminf(reach, BlockMapView::edge * cell)) {}

void BlockMap::refuseFarParticles(Span<const Vec3> positions)
{
    const float farthest = reduce(positions.size, FarthestOfParticle{positions}, scratch_).coordinate;
    const float most = cell_ * BlockMapView::edge * (BlockMapView::farthest - 2);
    if (farthest < most) return;
    throw FatalError
    (
        "A particle is " + std::to_string(long(farthest / cell_)) + " cells away from the origin, more than "
      + std::to_string(long(most / cell_))
      + ".\n    Look for particles that flew away, or use larger cells in system/meshSurfaceDict."
    );
}

int BlockMap::findRuns(const Buffer<std::uint64_t>& sorted)
{
    flags_.resizeDiscarding(sorted.size());
    forEach(sorted.size(), FindFirst{sorted.span(), flags_.span()});
    const int runs = int(exclusiveScan(flags_, run_, "blocks of nodes"));
    start_.resizeDiscarding(runs + 1);
    forEach(sorted.size(), StoreRunStarts{run_.span(), start_.span()});
    return runs;
}

void BlockMap::cover(Span<const Vec3> positions)
{
    refuseFarParticles(positions);
    candidates_.resizeDiscarding(positions.size);
    order_.resizeDiscarding(positions.size);
    forEach(positions.size, BlockOfParticle{cell_, positions, candidates_.span(), order_.span()});
    sortByKey(candidates_, order_);

    const int occupied = findRuns(candidates_);
    reached_.resizeDiscarding(occupied);
    flags_.resizeDiscarding(occupied);
    forEach
    (
        occupied,
        FindReached
        {
            cell_, reach_, positions, candidates_.span(), order_.span(), start_.span(), reached_.span(), flags_.span()
        }
    );
    const int listed = int(exclusiveScan(flags_, firstReached_, "blocks of nodes"));
    keys_.resizeDiscarding(listed);
    order_.resizeDiscarding(listed);
    forEach
    (
        occupied,
        ListReached
        {
            candidates_.span(), start_.span(), reached_.span(), firstReached_.span(), keys_.span(), order_.span()
        }
    );
    sortByKey(keys_, order_);
    candidates_.swap(keys_);

    const int stored = findRuns(candidates_);
    constexpr int most = 0x7fffffff / (3 * BlockMapView::nodes);
    if (stored > most)
    {
        throw FatalError
        (
            "The liquid is spread over " + std::to_string(stored) + " blocks of nodes, more than " + std::to_string(most)
          + ".\n    Use larger cells in system/meshSurfaceDict, or mesh it in parts."
        );
    }
    keys_.resizeDiscarding(stored);
    forEach(stored, StoreKeys{candidates_.span(), start_.span(), keys_.span()});
    next_.resizeDiscarding(8 * stored);
    forEach(8 * stored, FindNext{view(), next_.span()});
}

}
