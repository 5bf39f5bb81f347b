// SPDX-License-Identifier: GPL-3.0-or-later
// A uniform pull on liquid that has a wall within its support, against the mean normal of the walls there.
// (Equation and source of the model.)
//
//     a_i = -strength n_i/|n_i|,   n_i: sum of the normals of near walls and solid particles
//
//     wetting     @word@;
//     @word@Coeffs  { strength 10; }      // m/s2

#include "models/wetting/Wetting.H"

namespace shizuku
{

namespace
{

struct PullToWalls
{
    scalar strength;
    Span<const Position> x;
    WallView walls;
    Span<Vec3> acceleration;

    HOST_DEVICE void operator()(int i) const
    {
        Vec3 sum;
        walls.particles.near.forEach(i, [&](int k) { sum += walls.particles.normal[k]; });
        walls.forEachSurface(i, x[i], [&](const WallSurface&, const WallSurface::Nearest& wall, const HalfSpaceValues&)
        {
            sum += wall.normal;
        });
        const scalar length = norm(sum);
        if (length > 0) acceleration[i] -= strength / length * sum;
    }
};

class @class@ : public Wetting
{
public:
    @class@(const Dictionary& coeffs, Liquid& liquid, const Walls&, const SurfaceTension&)
    {
        const double strength = coeffs.lookupDimensionedOr("strength", dimensions::acceleration, 10);
        if (!(strength >= 0)) throw FatalInputError(coeffs.where("strength"), "The strength is negative", "0 or more");
        strength_ = liquid.units().toScaled(strength, dimensions::acceleration);
    }

    std::optional<Columns> readsOfNeighbours(Liquid&) const override { return Columns{}; }

    void apply(Liquid& liquid, const Neighbourhood&, const Walls& walls, Buffer<Vec3>& acceleration) override
    {
        if (walls.particles() == 0 && walls.surfaces() == 0) return;
        forEach(liquid.owned(), PullToWalls{strength_, liquid.predicted.span(), walls.view(liquid), acceleration.span()});
    }

private:
    scalar strength_;                   // scaled
};

const WettingTable::Add<@class@> registered{"@word@", "what it does, in a line"};

}

}
