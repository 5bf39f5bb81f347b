// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallMotions/WallMotion.H"

#include "caseFiles/UnitVector.H"

#include <algorithm>
#include <limits>
#include <sstream>

namespace shizuku
{

WallMotion::WallMotion(const Dictionary& dict)
:
    start_(dict.lookupDimensionedOr("start", dimensions::time, 0)),
    stop_(dict.lookupDimensionedOr("stop", dimensions::time, std::numeric_limits<double>::infinity()))
{
    if (!(start_ >= 0))
    {
        std::ostringstream found;
        found << dict.name() << " starts at " << start_ << " s";
        throw FatalInputError(dict.where("start"), found.str(), "0 s or later: a wall is at its given place at time 0");
    }
    if (!(stop_ > start_))
    {
        std::ostringstream found;
        found << dict.name() << " stops at " << stop_ << " s and starts at " << start_ << " s";
        throw FatalInputError(dict.where("stop"), found.str(), "a time after start");
    }
}

Pose WallMotion::at(double time) const
{
    return time <= start_ ? Pose() : after(std::min(time, stop_) - start_);
}

TurningMotion::TurningMotion(const Dictionary& dict)
:
    WallMotion(dict), axis_{dict.lookupDimensionedVector("origin", dimensions::length), readUnitVector(dict, "axis")}
{}

}
