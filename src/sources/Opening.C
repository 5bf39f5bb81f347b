// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/Opening.H"

#include "caseFiles/UnitVector.H"
#include "core/messages/Error.H"

#include <cmath>
#include <numbers>
#include <sstream>

namespace shizuku
{

namespace
{

// Lattice points in the ring, of a lattice that has the axis on a point or between four.
std::vector<Vector3> latticeIn(const Opening& opening, double offset)
{
    const Vector3 u = perpendicular(opening.direction), v = cross(opening.direction, u);
    const int most = int(opening.radius/opening.spacing) + 1;
    constexpr double rounding = 1e-9;
    std::vector<Vector3> points;
    for (int i = -most; i <= most; ++i)
    {
        for (int j = -most; j <= most; ++j)
        {
            const double x = (i + offset)*opening.spacing, y = (j + offset)*opening.spacing, r = std::hypot(x, y);
            if (r <= opening.radius*(1 + rounding) && r >= opening.innerRadius*(1 - rounding)) points.push_back(x*u + y*v);
        }
    }
    return points;
}

}

Opening::Opening(const Dictionary& dict, double d, bool isRing)
:
    spacing(d), mouth(dict.lookupDimensionedVector("mouth", dimensions::length)), direction(readUnitVector(dict, "direction")),
    radius(dict.lookupPositive("radius", dimensions::length))
{
    if (isRing && dict.found("innerRadius")) innerRadius = dict.lookupPositive("innerRadius", dimensions::length, true);
    if (innerRadius >= radius)
    {
        throw FatalInputError(dict.where("innerRadius"), "The ring of " + dict.name() + " has an innerRadius that is not below its radius", "innerRadius below radius");
    }
    const double area = std::numbers::pi*(radius*radius - innerRadius*innerRadius);
    const std::vector<Vector3> on = latticeIn(*this, 0), between = latticeIn(*this, 0.5);
    const auto misses = [&](const std::vector<Vector3>& points) { return std::abs(double(points.size())*d*d - area); };
    columns = misses(on) <= misses(between) ? on : between;
    constexpr std::size_t least = 4;
    if (columns.size() >= least) return;
    std::ostringstream found;
    found << "The opening of " << dict.name() << " is so narrow that " << columns.size() << " columns of particles fit in";
    throw FatalInputError(dict.where("radius"), found.str(), std::to_string(least) + " at the least: a larger radius, or a smaller spacing in system/solution");
}

}
