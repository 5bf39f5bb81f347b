// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/SourceSpace.H"

#include "core/messages/Error.H"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace shizuku
{

SourceSpace::SourceSpace(const Liquid& liquid) : spacing_(liquid.properties().spacing)
{
    const Images* images = liquid.ghosts().images();
    if (!images) return;
    const Sides& sides = images->sides();
    box_ = sides.box();
    for (int k = 0; k < 3; ++k)
    {
        if (!box_->isCyclic(k)) continue;
        const SideMaps& maps = sides.maps();
        periods_.of[k] = liquid.units().length*quanta::lengthOf(maps.at[k][1] - maps.at[k][0]);
    }
}

double SourceSpace::toPlane(const Vector3& place) const
{
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; box_ && k < 3; ++k)
    {
        if (box_->kind[k][0] == BoxSides::Kind::symmetryPlane) nearest = std::min(nearest, place[k] - box_->at[k][0]);
        if (box_->kind[k][1] == BoxSides::Kind::symmetryPlane) nearest = std::min(nearest, box_->at[k][1] - place[k]);
    }
    return nearest;
}

Vector3 SourceSpace::between(Vector3 place) const
{
    for (int k = 0; k < 3; ++k)
    {
        const double period = periods_.of[k];
        if (period == 0) continue;
        if (place[k] < box_->at[k][0]) place[k] += period;
        else if (place[k] >= box_->at[k][1]) place[k] -= period;
    }
    return place;
}

std::vector<Stream> SourceSpace::withImages(const Stream& stream) const
{
    std::vector<Stream> streams{stream};
    if (!box_) return streams;
    const Vector3 middle = stream.from + stream.length/2*stream.axis;
    streams[0].from += between(middle) - middle;
    for (int k = 0; k < 3; ++k)
    {
        const double period = periods_.of[k];
        if (period == 0) continue;
        const double along = std::abs(stream.axis[k]), half = along*stream.length/2 + std::sqrt(std::max(0.0, 1 - along*along))*stream.radius + spacing_;
        const double at = between(middle)[k];
        const std::size_t before = streams.size();
        const auto addShifted = [&](double by)
        {
            for (std::size_t i = 0; i < before; ++i)
            {
                streams.push_back(streams[i]);
                streams.back().from[k] += by;
            }
        };
        if (at - half < box_->at[k][0]) addShifted(period);
        if (at + half > box_->at[k][1]) addShifted(-period);
    }
    return streams;
}

void SourceSpace::refuseOutside(const std::string& source, const SourceLocation& where, const std::vector<Vector3>& places, double room) const
{
    if (!box_) return;
    const double rounding = 1e-4*spacing_;          // sides are whole quanta apart
    for (const Vector3& place : places)
    {
        std::ostringstream found, expected;
        found << "Liquid of the source '" << source << "' comes in at " << str(place) << " m, ";
        if (const double distance = toPlane(place); distance < room - rounding)
        {
            found << (distance < 0 ? "behind a symmetry plane" : "too near to a symmetry plane") << " of constant/boundary";
            expected << "a source in front of it" << (room > 0 ? ", half a spacing away" : "");
            throw FatalInputError(where, found.str(), expected.str());
        }
        const Vector3 inside = between(place);
        for (int k = 0; k < 3; ++k)
        {
            if (periods_.of[k] == 0 || (inside[k] >= box_->at[k][0] - rounding && inside[k] < box_->at[k][1] + rounding)) continue;
            found << "a period or more beyond the cyclic sides along " << "xyz"[k] << " of constant/boundary";
            throw FatalInputError(where, found.str(), "a source between these sides, or less than a period beyond one");
        }
    }
}

}
