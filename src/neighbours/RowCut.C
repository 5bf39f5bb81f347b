// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours/RowCut.H"

#include "neighbours/LayerCut.H"
#include "parallel/AllParts.H"

#include <algorithm>
#include <functional>
#include <span>
#include <tuple>

namespace shizuku
{

// Of RowCutter, which as a friend of RowCut is no name of this file alone.
namespace rowCutting
{

using SomeLoads = std::span<const RowLoad>;

// Rows of a region, sorted by y and by z, and the parts that share them.
struct Section
{
    SomeLoads byY, byZ;
    RowRectangle region;
    int first, parts;

    SomeLoads by(bool z) const { return z ? byZ : byY; }
    int low(bool z) const { return z ? region.lowZ : region.lowY; }
};

// A cut of a section: row is the first one above.
struct Plane
{
    bool acrossZ;
    int row, partsBelow;
};

}

namespace
{

using rowCutting::Plane;
using rowCutting::Section;
using rowCutting::SomeLoads;

int layerOf(const RowLoad& load, bool acrossZ) { return acrossZ ? load.z : load.y; }

// A cut with so much of a section's load below it as rows allow; and what it costs.
struct EvenPlane
{
    int row;
    std::int64_t below = 0, all = 0, beside = 0;        // beside: in the two layers that touch it
};

EvenPlane planeOf(const Section& section, bool acrossZ, double share)
{
    const SomeLoads loads = section.by(acrossZ);
    EvenPlane plane{section.low(acrossZ)};
    for (const RowLoad& load : loads) plane.all += load.particles;
    const double wanted = share * double(plane.all);
    std::int64_t before = 0, last = 0;
    int lastLayer = plane.row;
    for (std::size_t k = 0; k < loads.size();)
    {
        const int layer = layerOf(loads[k], acrossZ);
        std::int64_t particles = 0;
        for (; k < loads.size() && layerOf(loads[k], acrossZ) == layer; ++k) particles += loads[k].particles;
        // In front of this layer, or behind it: whichever is nearer to what is wanted.
        if (2 * wanted < double(2 * before + particles))
        {
            return {layer, before, plane.all, particles + (before > 0 && lastLayer == layer - 1 ? last : 0)};
        }
        before += particles;
        last = particles;
        lastLayer = layer;
        plane.row = layer + 1;
    }
    plane.below = plane.all;
    plane.beside = last;
    return plane;
}

// What parts are to have, relative to each other.
class Weights
{
public:
    Weights(const std::vector<double>& weights, int parts) : before_(parts + 1)
    {
        for (int k = 0; k < parts; ++k) before_[k + 1] = before_[k] + (weights.empty() ? 1 : weights[k]);
    }

    double of(int first, int parts) const { return before_[first + parts] - before_[first]; }
    double shareBelow(const Section& section, int partsBelow) const { return of(section.first, partsBelow) / of(section.first, section.parts); }

private:
    std::vector<double> before_;
};

ParticlesOfLayers layersOf(const RowLoads& loads, bool acrossZ)
{
    ParticlesOfLayers layers;
    for (const RowLoad& load : loads) layers[layerOf(load, acrossZ)] += load.particles;
    return layers;
}

}

class RowCutter
{
public:
    using Choose = std::function<Plane(const Section&)>;

    RowCutter(const RowLoads& loads, const Choose& choose) : choose_(choose), byY_(loads), byZ_(loads)
    {
        std::stable_sort(byY_.begin(), byY_.end(), [](const RowLoad& a, const RowLoad& b) { return a.y < b.y; });
    }

    RowCut cut(int parts)
    {
        cut_.rows_.resize(parts);
        make({}, 0, parts, 0, byZ_.size());
        return std::move(cut_);
    }

private:
    // Of the rows begin ... end in both orders. Returns its number, or the complement of its part.
    int make(const RowRectangle& region, int first, int parts, std::size_t begin, std::size_t end)
    {
        if (parts == 1)
        {
            cut_.rows_[first] = region;
            return ~first;
        }
        const auto some = [&](const RowLoads& loads) { return SomeLoads(loads).subspan(begin, end - begin); };
        const Plane plane = choose_({some(byY_), some(byZ_), region, first, parts});
        const auto isBelow = [&](const RowLoad& load) { return layerOf(load, plane.acrossZ) < plane.row; };
        std::size_t middle = begin;
        for (RowLoads* loads : {&byY_, &byZ_})
        {
            middle = std::stable_partition(loads->begin() + long(begin), loads->begin() + long(end), isBelow) - loads->begin();
        }
        RowRectangle below = region, above = region;
        (plane.acrossZ ? below.highZ : below.highY) = plane.row;
        (plane.acrossZ ? above.lowZ : above.lowY) = plane.row;
        const std::size_t number = cut_.cuts_.size();
        cut_.cuts_.push_back({plane.acrossZ, plane.row, 0, 0});
        const int madeBelow = make(below, first, plane.partsBelow, begin, middle);
        const int madeAbove = make(above, first + plane.partsBelow, parts - plane.partsBelow, middle, end);
        cut_.cuts_[number].below = madeBelow;
        cut_.cuts_[number].above = madeAbove;
        return int(number);
    }

    const Choose& choose_;
    RowLoads byY_, byZ_;
    RowCut cut_;
};

RowLoads sortedLoads(RowLoads loads)
{
    std::sort(loads.begin(), loads.end(), [](const RowLoad& a, const RowLoad& b) { return std::tie(a.z, a.y) < std::tie(b.z, b.y); });
    RowLoads sorted;
    for (const RowLoad& load : loads)
    {
        if (!sorted.empty() && sorted.back().y == load.y && sorted.back().z == load.z) sorted.back().particles += load.particles;
        else sorted.push_back(load);
    }
    return sorted;
}

RowLoads addUp(const RowLoads& own, const Communicator& parts) { return sortedLoads(gatherLists(parts, own)); }

bool isLongerAlongZ(const RowLoads& loads) { return layersOf(loads, true).size() > layersOf(loads, false).size(); }

std::vector<int> RowCut::partsNear(int part, int rows) const
{
    std::vector<int> near;
    if (rows_[part].isEmpty()) return near;
    const RowRectangle seen = rows_[part].widened(rows);
    for (int other = 0; other < parts(); ++other)
    {
        if (other != part && !rows_[other].isEmpty() && seen.meets(rows_[other])) near.push_back(other);
    }
    return near;
}

bool RowCut::isAcross(bool z) const
{
    return std::any_of(cuts_.begin(), cuts_.end(), [&](const Cut& cut) { return cut.acrossZ == z; });
}

std::vector<std::int64_t> RowCut::particles(const RowLoads& loads) const
{
    std::vector<std::int64_t> particles(parts());
    for (const RowLoad& load : loads) particles[partOf(load.y, load.z)] += load.particles;
    return particles;
}

RowCut cutBisected(const RowLoads& loads, int parts, const std::vector<double>& weights)
{
    const Weights all(weights, parts);
    // Of the costlier side, a particle of a part: what the part has, and what it sees of the other side's, of which the parts along the cut have a share each.
    const auto cost = [&](const Section& section, const EvenPlane& plane, int partsBelow)
    {
        const double below = all.of(section.first, partsBelow), above = all.of(section.first + partsBelow, section.parts - partsBelow);
        return std::max(double(plane.below) / below, double(plane.all - plane.below) / above) + double(plane.beside) / std::min(below, above);
    };
    const auto choose = [&](const Section& section) -> Plane
    {
        const int partsBelow = section.parts / 2;
        const double share = all.shareBelow(section, partsBelow);
        const EvenPlane y = planeOf(section, false, share), z = planeOf(section, true, share);
        const bool acrossZ = cost(section, z, partsBelow) < cost(section, y, partsBelow);
        return {acrossZ, (acrossZ ? z : y).row, partsBelow};
    };
    return RowCutter(loads, choose).cut(parts);
}

RowCut cutPencils(const RowLoads& loads, int outer, int inner, bool zFirst, const std::vector<double>& weights)
{
    const Weights all(weights, outer * inner);
    const auto choose = [&](const Section& section) -> Plane
    {
        const int pieces = section.parts / inner, partsBelow = pieces > 1 ? pieces / 2 * inner : section.parts / 2;
        const bool acrossZ = pieces > 1 ? zFirst : !zFirst;
        return {acrossZ, planeOf(section, acrossZ, all.shareBelow(section, partsBelow)).row, partsBelow};
    };
    return RowCutter(loads, choose).cut(outer * inner);
}

RowCut cutStraight(const RowLoads& loads, int alongY, int alongZ)
{
    const LayerCut y = cutEvenly(layersOf(loads, false), alongY), z = cutEvenly(layersOf(loads, true), alongZ);
    const auto choose = [&](const Section& section) -> Plane
    {
        const int pieces = section.parts / alongY;
        if (pieces > 1) return {true, z.first[section.first / alongY + pieces / 2], pieces / 2 * alongY};
        const int partsBelow = section.parts / 2;
        return {false, y.first[section.first % alongY + partsBelow], partsBelow};
    };
    return RowCutter(loads, choose).cut(alongY * alongZ);
}

}
