// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours/ImagesOfLiquid.H"

#include "device/ForEach.H"
#include "device/Reduce.H"

#include <utility>

namespace shizuku
{

namespace
{

// A step's beginning goes the way of its end, whole quanta, so that the way between them is the same, or its mirror image.
struct BringBack
{
    SideMaps sides;
    Span<Position> position, predicted;
    Span<AtSides> across;

    HOST_DEVICE void operator()(int i) const
    {
        across[i] = sides.within(0, placeOf(predicted[i]));
        if (across[i].bits == 0) return;
        predicted[i] = sides.imageOf(predicted[i], across[i]);
        position[i] = sides.imageOf(position[i], across[i]);
    }
};

struct MirrorVectors
{
    SideMaps sides;
    Span<const AtSides> across;
    Span<Vec3> vector;

    HOST_DEVICE void operator()(int i) const { vector[i] = sides.imageOf(vector[i], across[i]); }
};

// By axis, how many are near the lower side, and near the upper one.
struct NearSides
{
    int lower[3] = {}, upper[3] = {};

    HOST_DEVICE void add(const NearSides& other)
    {
        for (int k = 0; k < 3; ++k)
        {
            lower[k] += other.lower[k];
            upper[k] += other.upper[k];
        }
    }
};

struct CountNearSides
{
    SideMaps sides;
    std::int64_t reach;
    Span<const Position> position;

    HOST_DEVICE NearSides operator()(int i) const
    {
        const AtSides near = sides.within(reach, placeOf(position[i]));
        NearSides count;
        for (int k = 0; k < 3; ++k)
        {
            count.lower[k] = near.along(k) == AtSides::lower ? 1 : 0;
            count.upper[k] = near.along(k) == AtSides::upper ? 1 : 0;
        }
        return count;
    }
};

}

void bringBetweenSides(Liquid& liquid, scalar reach)
{
    const Sides& sides = liquid.ghosts().images()->sides();
    sides.refuseNarrow(reach);
    liquid.resize(liquid.owned());              // without the images of the search before
    Buffer<AtSides> across(liquid.owned());
    forEach(liquid.owned(), BringBack{sides.maps(), liquid.position.span(), liquid.predicted.span(), across.span()});
    if (!sides.box().has(Sides::Kind::symmetryPlane)) return;
    for (const auto& entry : liquid.fields().entries())
    {
        auto* const vector = std::get_if<Buffer<Vec3>>(&entry->values);
        if (vector && entry->info.sorted) forEach(liquid.owned(), MirrorVectors{sides.maps(), std::as_const(across).span(), vector->span()});
    }
}

void makeImages(Liquid& liquid, scalar reach)
{
    Ghosts& ghosts = liquid.ghosts();
    const int owned = liquid.owned();
    liquid.resize(owned, ghosts.set({}, {}, ghosts.images()->find(std::as_const(liquid.predicted).span(), owned, reach), owned));
    ghosts.copy(liquid.fields().columnsOf(&FieldInfo::exchanged));
    ghosts.images()->renumber(liquid.id);
}

bool mayLieAcross(const Liquid& liquid, const Sides& sides, double reach)
{
    if (!sides.box().has(Sides::Kind::cyclic)) return false;
    Buffer<NearSides> scratch;
    const NearSides near = reduce(liquid.owned(), CountNearSides{sides.maps(), quanta::wholeOf(reach), liquid.position.span()}, scratch);
    for (int k = 0; k < 3; ++k)
    {
        if (sides.box().isCyclic(k) && near.lower[k] > 0 && near.upper[k] > 0) return true;
    }
    return false;
}

}
