// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/SurfaceCut.H"

#include "parallel/AllParts.H"

#include <algorithm>

namespace shizuku
{

BlockLayers SurfaceCut::own() const
{
    const BlockLayers all;
    const auto within = [&](int layer) { return std::clamp(layer, all.low, all.high); };
    return {within(layers.low(parts.part())), within(layers.high(parts.part()))};
}

std::optional<int> SurfaceCut::below() const
{
    for (int part = parts.part() - 1; part >= 0; --part)
    {
        if (layers.low(part) < layers.high(part)) return part;
    }
    return {};
}

std::optional<int> SurfaceCut::above() const
{
    for (int part = parts.part() + 1; part < parts.parts(); ++part)
    {
        if (layers.low(part) < layers.high(part)) return part;
    }
    return {};
}

SurfaceCut cutSurface(const std::vector<Position>& share, const BlockMapView& map, const Communicator& parts)
{
    ParticlesOfLayers counts;
    for (const Position& p : share) ++counts[int(map.blockAt(placeOf(p).z))];
    return {parts, cutEvenly(addUp(counts, parts), parts.parts())};
}

std::vector<Position> bringToLayers(const std::vector<Position>& share, const SurfaceCut& cut, const BlockMapView& map, std::int64_t halo)
{
    std::vector<std::vector<Position>> lists(cut.parts.parts());
    for (const Position& p : share)
    {
        const std::int64_t z = placeOf(p).z;
        const int last = cut.layers.partOf(int(map.blockAt(z + halo)));
        for (int part = cut.layers.partOf(int(map.blockAt(z - halo))); part <= last; ++part) lists[part].push_back(p);
    }
    std::vector<Bytes> to;
    for (std::vector<Position>& list : lists)
    {
        to.push_back(bytesOf(list));
        list = {};
    }
    std::vector<Position> own;
    for (const Bytes& bytes : cut.parts.exchange(std::move(to))) appendTo(own, bytes);
    return own;
}

}
