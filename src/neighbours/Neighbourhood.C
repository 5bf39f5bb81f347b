// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours/Neighbourhood.H"

#include "neighbours/ImagesOfLiquid.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// A fifth more than the particles of a full neighbourhood.
int usualNeighbours(const Liquid& liquid)
{
    const scalar supports = liquid.support() / liquid.spacing();
    return int(1.2f * 4.18879f * supports * supports * supports);
}

}

Neighbourhood::Neighbourhood(const Liquid& liquid)
:
    grid_(liquid.support()),
    list_(liquid.support(), usualNeighbours(liquid))
{}

void Neighbourhood::update(Liquid& liquid, scalar wideSupport)
{
    search(liquid, wideSupport);
    lengthen(liquid);
}

void Neighbourhood::search(Liquid& liquid, scalar wideSupport, scalar ghosts)
{
    if (wideSupport != wideSupport_)
    {
        grid_ = CellGrid(liquid.support(), std::max(liquid.support(), wideSupport));
        wideSupport_ = wideSupport;
    }
    list_.forget();
    const scalar reach = std::max({liquid.support(), wideSupport, ghosts});
    const Images* const images = liquid.ghosts().images();
    if (images) bringBetweenSides(liquid, grid_.view().widened(reach));
    std::optional<CellGrid::Owned> owned;
    if (parts_)
    {
        parts_->bring(liquid, grid_, reach);
        owned = CellGrid::Owned{liquid.owned(), parts_->cut().rowsOf(liquid.parts().part()), {}};
    }
    else if (images)
    {
        makeImages(liquid, grid_.view().widened(reach));
        owned = CellGrid::Owned{liquid.owned(), {}, {}};
    }
    if (images) owned->across = images->across();
    const Buffer<std::uint32_t> order = grid_.build(liquid.predicted.span(), liquid.all(), liquid.id.span(), {}, owned);
    liquid.fields().reorder(order);
    if (owned) liquid.ghosts().reorder(order);
    if (parts_)
    {
        if (particlesOfAll_ == 0) particlesOfAll_ = liquid.parts().count(liquid.owned());
        keys_ = grid_.keys(liquid.predicted.span(), liquid.owned(), particlesOfAll_);
    }
    const Span<const Position> points = liquid.predicted.span();
    list_.search(points, liquid.owned(), grid_, points, true);
}

void Neighbourhood::lengthen(const Liquid& liquid)
{
    const Span<const Position> points = liquid.predicted.span();
    list_.lengthen(points, liquid.owned(), grid_, points, true);
}

}
