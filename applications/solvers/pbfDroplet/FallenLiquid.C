// SPDX-License-Identifier: GPL-3.0-or-later
#include "FallenLiquid.H"

#include "caseFiles/SolidParticles.H"
#include "core/messages/Error.H"
#include "device/Reduce.H"

#include <algorithm>
#include <sstream>

namespace shizuku
{

namespace
{

// Along a direction.
struct Heights
{
    double low = 1e300, high = -1e300;

    HOST_DEVICE void add(const Heights& other)
    {
        low = other.low < low ? other.low : low;
        high = other.high > high ? other.high : high;
    }
};

struct HeightOf
{
    double x, y, z;                     // m, of a unit of length along the axes
    Span<const Position> position;

    HOST_DEVICE Heights operator()(int i) const
    {
        const Place p = placeOf(position[i]);
        const double height = x * quanta::lengthOf(p.x) + y * quanta::lengthOf(p.y) + z * quanta::lengthOf(p.z);
        return {height, height};
    }
};

Heights heightsOf(const Liquid& liquid, const Vector3& up)
{
    const Vector3 each = liquid.units().length * up;
    Buffer<Heights> scratch;
    return liquid.parts().fold(reduce(liquid.owned(), HeightOf{each.x, each.y, each.z, liquid.position.span()}, scratch));
}

}

FallenLiquid::FallenLiquid(const CaseSetup& setup)
{
    constexpr double far = 100;         // spacings
    const Vector3 g = setup.models->bodyForce->uniform();
    looks_ = length(g) > 0 && setup.walls->particles() + setup.walls->surfaces() > 0 && !setup.population->changes();
    if (!looks_) return;
    up_ = -normalized(g);
    Heights all = heightsOf(*setup.liquid, up_);
    if (setup.walls->particles() > 0)
    {
        for (const Vector3& x : readSolidParticles(setup.path).positions) all.add({dot(x, up_), dot(x, up_)});
    }
    lowest_ = all.low;
    least_ = std::max(all.high - all.low, far * setup.liquid->properties().spacing);
}

void FallenLiquid::warn(const Liquid& liquid)
{
    if (!looks_) return;
    const double fallen = lowest_ - heightsOf(liquid, up_).low;
    if (!(fallen > least_)) return;
    looks_ = false;
    std::ostringstream text;
    text << "Liquid is " << fallen << " m below all that there was at the start, and falls on: the faster it gets, the shorter steps get.\n"
            "    constant/outlets takes out what leaves the scene";
    warning(text.str());
}

}
