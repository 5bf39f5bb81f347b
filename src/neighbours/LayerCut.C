// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours/LayerCut.H"

#include "parallel/AllParts.H"

#include <algorithm>
#include <limits>

namespace shizuku
{

int LayerCut::partOf(int layer) const { return int(std::upper_bound(first.begin() + 1, first.end(), layer) - first.begin()) - 1; }

int LayerCut::low(int part) const { return part == 0 ? std::numeric_limits<int>::min() : first[part]; }

int LayerCut::high(int part) const { return part + 1 == parts() ? std::numeric_limits<int>::max() : first[part + 1]; }

ParticlesOfLayers addUp(const ParticlesOfLayers& own, const Communicator& parts)
{
    struct Layer
    {
        std::int64_t layer, particles;
    };
    std::vector<Layer> list;
    for (const auto& [layer, particles] : own) list.push_back({layer, particles});
    ParticlesOfLayers all;
    for (const Layer& each : gatherLists(parts, list)) all[int(each.layer)] += each.particles;
    return all;
}

LayerCut cutEvenly(const ParticlesOfLayers& layers, int parts)
{
    std::int64_t all = 0;
    for (const auto& [layer, particles] : layers) all += particles;
    LayerCut cut{std::vector<int>(parts)};
    int part = 1;
    std::int64_t before = 0;
    const auto wanted = [&] { return all * part / parts; };
    for (const auto& [layer, particles] : layers)
    {
        // In front of this layer, or behind it: whichever is nearer to what is wanted.
        while (part < parts && 2 * wanted() < 2 * before + particles) cut.first[part++] = layer;
        before += particles;
    }
    while (part < parts && !layers.empty()) cut.first[part++] = layers.rbegin()->first + 1;
    return cut;
}

}
