#include "surface/BlockMap.H"

#include "core/messages/Error.H"
#include "device/Algorithms.H"
#include "device/ForEach.H"
#include "device/Reduce.H"

namespace shizuku
{

namespace
{

struct Bounds
{
    Vec3 low{3e38f, 3e38f, 3e38f}, high{-3e38f, -3e38f, -3e38f};

    HOST_DEVICE void add(const Bounds& other)
    {
        low = {fminf(low.x, other.low.x), fminf(low.y, other.low.y), fminf(low.z, other.low.z)};
        high = {fmaxf(high.x, other.high.x), fmaxf(high.y, other.high.y), fmaxf(high.z, other.high.z)};
    }
};

struct BoundsOfParticle
{
    Span<const Vec3> positions;
    HOST_DEVICE Bounds operator()(int i) const { return {positions[i], positions[i]}; }
};

// Particles that share a block write the same word: the order does not matter.
struct MarkBlocks
{
    BlockMapView map;
    float reach;
    Span<const Vec3> positions;
    Span<std::uint32_t> active;

    HOST_DEVICE int block(float x) const { return BlockMapView::blockOf(int(floorf(x / map.cell))); }

    HOST_DEVICE void operator()(int i) const
    {
        const Vec3 p = positions[i];
        for (int z = block(p.z - reach) - map.lowZ; z <= block(p.z + reach) - map.lowZ; ++z)
            for (int y = block(p.y - reach) - map.lowY; y <= block(p.y + reach) - map.lowY; ++y)
                for (int x = block(p.x - reach) - map.lowX; x <= block(p.x + reach) - map.lowX; ++x)
                {
                    active[(z * map.ny + y) * map.nx + x] = 1;
                }
    }
};

struct PlaceBlocks
{
    Span<const std::uint32_t> first;
    Span<std::uint32_t> place;

    HOST_DEVICE void operator()(int block) const
    {
        if (first[block + 1] > first[block]) place[int(first[block])] = std::uint32_t(block);
    }
};

}

BlockMap::BlockMap(Span<const Vec3> positions, float cell, float reach)
{
    Buffer<Bounds> scratch;
    const Bounds box = reduce(positions.size, BoundsOfParticle{positions}, scratch);
    const auto block = [&](float x) { return BlockMapView::blockOf(int(std::floor(x / cell))); };
    map_.cell = cell;
    map_.lowX = block(box.low.x - reach);
    map_.lowY = block(box.low.y - reach);
    map_.lowZ = block(box.low.z - reach);
    map_.nx = block(box.high.x + reach) - map_.lowX + 1;
    map_.ny = block(box.high.y + reach) - map_.lowY + 1;
    map_.nz = block(box.high.z + reach) - map_.lowZ + 1;
    const double blocks = double(map_.nx) * map_.ny * map_.nz;
    if (!(blocks < 1e9))
    {
        throw FatalError
        (
            "The liquid is spread over " + std::to_string(blocks) + " blocks of cells, more than 1e9.\n"
            "    Use larger cells in system/meshSurfaceDict, or look for particles that flew away."
        );
    }

    active_.resize(int(blocks));
    active_.setZero();
    forEach(positions.size, MarkBlocks{map_, reach, positions, active_.span()});
    place_.resize(int(exclusiveScan(active_, first_, "blocks of cells")));
    forEach(int(blocks), PlaceBlocks{first_.span(), place_.span()});
}

BlockMapView BlockMap::view() const
{
    BlockMapView map = map_;
    map.first = first_.span();
    map.place = place_.span();
    return map;
}

}
