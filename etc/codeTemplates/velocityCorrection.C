// SPDX-License-Identifier: GPL-3.0-or-later
// Velocities keep a share of those that were predicted before forces moved the particles. (Equation and source of the model.)
//
//     u_i += a (w_i/dt - u_i),   w_i: the predicted way
//
//     velocityCorrection  @word@;
//     @word@Coeffs  { strength 0.1; }      // a, 0 to 1

#include "device/ForEach.H"
#include "models/velocityCorrection/VelocityCorrection.H"

namespace shizuku
{

namespace
{

struct NoteWay
{
    Span<const Position> predicted, position;
    Span<Vec3> way;

    HOST_DEVICE void operator()(int i) const { way[i] = predicted[i] - position[i]; }
};

struct KeepShare
{
    scalar share, perStep;
    Span<const Vec3> way;
    Span<Vec3> velocity;

    HOST_DEVICE void operator()(int i) const { velocity[i] += share * (perStep * way[i] - velocity[i]); }
};

class @class@ : public VelocityCorrection
{
public:
    @class@(const Dictionary& coeffs, Liquid&) : strength_(scalar(coeffs.lookupOr("strength", 0.1)))
    {
        if (!(strength_ >= 0 && strength_ <= 1)) throw FatalInputError(coeffs.where("strength"), "The strength is out of range", "0 to 1");
    }

    void notePrediction(const Liquid& liquid) override
    {
        way_.resizeDiscarding(liquid.owned());
        forEach(liquid.owned(), NoteWay{liquid.predicted.span(), liquid.position.span(), way_.span()});
    }

    std::optional<Columns> readsOfNeighbours(Liquid&) const override { return Columns{}; }

    void apply(Liquid& liquid, const Neighbourhood&, const Walls&, scalar dt) override
    {
        forEach(liquid.owned(), KeepShare{strength_, 1 / dt, way_.span(), liquid.velocity.span()});
    }

private:
    scalar strength_;
    Buffer<Vec3> way_;                  // of this step
};

const VelocityCorrectionTable::Add<@class@> registered{"@word@", "what it does, in a line"};

}

}
