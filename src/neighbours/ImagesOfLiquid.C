// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours/ImagesOfLiquid.H"

#include "device/ForEach.H"

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

}
