// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/LiquidInside.H"

#include "caseFiles/SolidSides.H"
#include "device/Reduce.H"

#include <limits>

namespace shizuku
{

namespace
{

struct FirstInside
{
    static constexpr int none = std::numeric_limits<int>::max();

    int particle = none, surface = 0;

    HOST_DEVICE void add(const FirstInside& other)
    {
        if (other.particle < particle) *this = other;
    }
};

struct InsideSurface
{
    WallSurfacesView surfaces;
    scalar nearest;                 // distance that is far enough
    Span<const Position> position;

    HOST_DEVICE FirstInside operator()(int i) const
    {
        for (int a = 0; a < surfaces.count; ++a)
        {
            if (surfaces[a](placeOf(position[i])).distance < nearest) return {i, a};
        }
        return {};
    }
};

}

std::optional<LiquidInside> liquidInside(const Liquid& liquid, const WallSurfacesView& surfaces)
{
    if (surfaces.count == 0) return {};
    Buffer<FirstInside> scratch;
    const InsideSurface inside{surfaces, 0.25f * liquid.spacing(), liquid.position.span()};
    const FirstInside first = reduce(liquid.owned(), inside, scratch);
    if (first.particle == FirstInside::none) return {};
    return LiquidInside{first.particle, first.surface};
}

std::optional<LiquidInside> liquidInside(const Liquid& liquid, const SolidParticles& solid)
{
    if (solid.positions.empty()) return {};
    const double d = liquid.properties().spacing;
    SolidSides sides(solid, d);
    const std::vector<Vector3> positions = liquid.positions();
    for (int i = 0; i < liquid.owned(); ++i)
    {
        if (const auto patch = sides.patchInTheWay(positions[i], 0.5 * d)) return LiquidInside{i, *patch};
    }
    return {};
}

}
