// SPDX-License-Identifier: GPL-3.0-or-later
// Drag: velocities decay at a constant rate. (Equation and source of the model.)
//
//     u_i = u_i/(1 + rate dt)
//
//     viscosity   @word@;
//     @word@Coeffs  { rate 10; }      // 1/s

#include "models/viscosity/Viscosity.H"

namespace shizuku
{

namespace
{

constexpr Dimensions rateDimensions{{0, 0, -1, 0, 0, 0, 0}};

struct Decay
{
    scalar factor;
    Span<Vec3> velocity;

    HOST_DEVICE void operator()(int i) const { velocity[i] = factor * velocity[i]; }
};

class @class@ : public Viscosity
{
public:
    @class@(const Dictionary& coeffs, Liquid& liquid)
    {
        const double rate = coeffs.lookupDimensionedOr("rate", rateDimensions, 10);
        if (!(rate >= 0)) throw FatalInputError(coeffs.where("rate"), "The rate is negative", "0 or more, 1/s");
        rate_ = liquid.units().toScaled(rate, rateDimensions);
    }

    std::optional<Columns> readsOfNeighbours(Liquid&) const override { return Columns{}; }

    void apply(Liquid& liquid, const Neighbourhood&, const Walls&, scalar dt) override
    {
        forEach(liquid.owned(), Decay{1 / (1 + rate_ * dt), liquid.velocity.span()});
    }

private:
    scalar rate_;                       // scaled
};

const ViscosityTable::Add<@class@> registered{"@word@", "what it does, in a line"};

}

}
