// SPDX-License-Identifier: GPL-3.0-or-later
// Gravity below a height alone, from constant/g. (Equation and source of the model.)
//
//     p_i = x_i + dt (u_i + dt g) where z_i < top, x_i + dt u_i elsewhere
//
//     bodyForce   @word@;
//     constant/g:   value [0 1 -2 0 0 0 0] (0 0 -9.81);  top 1e-3;       // m/s2, m

#include "device/ForEach.H"
#include "models/bodyForce/BodyForce.H"

#include <cmath>
#include <cstdint>

namespace shizuku
{

namespace
{

struct PredictBelow
{
    scalar dt;
    std::int64_t top;                   // quanta
    Vec3 change;                        // dt g
    Span<const Position> position;
    Span<const Vec3> velocity;
    Span<Position> predicted;

    HOST_DEVICE void operator()(int i) const
    {
        const Position x = position[i];
        predicted[i] = withBlock(x, x + dt * (placeOf(x).z < top ? velocity[i] + change : velocity[i]));
    }
};

class @class@ : public BodyForce
{
public:
    @class@(const std::filesystem::path& constant, const Liquid& liquid)
    {
        const Dictionary dict = Dictionary::read(constant / "g");
        const auto g = dict.lookupDimensionedVector("value", dimensions::acceleration);
        const double top = dict.lookupDimensionedOr("top", dimensions::length, 1e-3);
        if (!(top > 0)) throw FatalInputError(dict.where("top"), "The top is not above the origin", "more than 0, m");
        dict.refuseUnused();
        magnitude_ = std::hypot(g[0], g[1], g[2]);
        const auto scaled = [&](double a) { return liquid.units().toScaled(a, dimensions::acceleration); };
        g_ = {scaled(g[0]), scaled(g[1]), scaled(g[2])};
        top_ = quanta::wholeOf(liquid.units().toScaled(top, dimensions::length));
    }

    void predict(Liquid& liquid, scalar dt) const override
    {
        forEach(liquid.owned(), PredictBelow{dt, top_, dt * g_, liquid.position.span(), liquid.velocity.span(), liquid.predicted.span()});
    }

    double acceleration() const override { return magnitude_; }

private:
    Vec3 g_;                            // scaled
    std::int64_t top_;                  // quanta
    double magnitude_;                  // m/s2
};

const BodyForceTable::Add<@class@> registered{"@word@", "what it does, in a line"};

}

}
