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

void bringBack(Liquid& liquid, const Sides& sides)
{
    Buffer<AtSides> across(liquid.owned());
    forEach(liquid.owned(), BringBack{sides.maps(), liquid.position.span(), liquid.predicted.span(), across.span()});
    if (!sides.box().has(Sides::Kind::symmetryPlane)) return;
    for (const auto& entry : liquid.fields().entries())
    {
        auto* const vector = std::get_if<Buffer<Vec3>>(&entry->values);
        if (vector && entry->info.sorted) forEach(liquid.owned(), MirrorVectors{sides.maps(), std::as_const(across).span(), vector->span()});
    }
}

}

void makeImages(Liquid& liquid, scalar reach)
{
    Images& images = *liquid.ghosts().images();
    images.sides().refuseNarrow(reach);
    liquid.resize(liquid.owned());              // without the images of the search before
    bringBack(liquid, images.sides());
    const int owned = liquid.owned();
    liquid.resize(owned, images.find(std::as_const(liquid.predicted).span(), owned, reach));
    liquid.ghosts().copy(liquid.fields().columnsOf(&FieldInfo::exchanged));
    images.renumber(liquid.id);
}

}
