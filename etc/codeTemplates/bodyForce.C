// Gravity that sets in over the first moments of a run, from constant/g. (Equation and source of the model.)
//
//     u_i += dt g min(t/ramp, 1),   t: since the start of the run, at the end of the step
//
//     bodyForce   @word@;
//     constant/g:   value [0 1 -2 0 0 0 0] (0 0 -9.81);  ramp 1e-3;      // m/s2, s

#include "device/ForEach.H"
#include "models/bodyForce/BodyForce.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

struct AddVelocity
{
    Vec3 change;
    Span<Vec3> velocity;

    HOST_DEVICE void operator()(int i) const { velocity[i] += change; }
};

class @class@ : public BodyForce
{
public:
    @class@(const std::filesystem::path& constant, const Liquid& liquid)
    {
        const Dictionary dict = Dictionary::read(constant / "g");
        const auto g = dict.lookupDimensionedVector("value", dimensions::acceleration);
        const double ramp = dict.lookupDimensionedOr("ramp", dimensions::time, 1e-3);
        if (!(ramp > 0)) throw FatalInputError(dict.where("ramp"), "The ramp is not positive", "more than 0, s");
        dict.refuseUnused();
        magnitude_ = std::hypot(g[0], g[1], g[2]);
        const auto scaled = [&](double a) { return liquid.units().toScaled(a, dimensions::acceleration); };
        g_ = {scaled(g[0]), scaled(g[1]), scaled(g[2])};
        ramp_ = liquid.units().toScaled(ramp, dimensions::time);
    }

    void apply(Liquid& liquid, scalar dt) override
    {
        time_ += dt;
        forEach(liquid.owned(), AddVelocity{dt * std::min(time_ / ramp_, scalar(1)) * g_, liquid.velocity.span()});
    }

    double acceleration() const override { return magnitude_; }

private:
    Vec3 g_;                            // scaled
    scalar ramp_, time_ = 0;            // scaled
    double magnitude_;                  // m/s2
};

const BodyForceTable::Add<@class@> registered{"@word@"};

}

}
