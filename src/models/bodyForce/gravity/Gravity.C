// Uniform gravity from constant/g:   dimensions [0 1 -2 0 0 0 0];  value (0 0 -9.81);
//
//     bodyForce   gravity;

#include "device/ForEach.H"
#include "models/bodyForce/BodyForce.H"

#include <cmath>

namespace shizuku
{

namespace
{

struct Accelerate
{
    Vec3 change;
    Span<Vec3> velocity;

    HOST_DEVICE void operator()(int i) const { velocity[i] += change; }
};

class Gravity : public BodyForce
{
public:
    Gravity(const std::filesystem::path& constant, const Liquid& liquid)
    {
        const Dictionary dict = Dictionary::read(constant / "g");
        if (dict.found("dimensions") && dict.lookupDimensions("dimensions") != dimensions::acceleration)
        {
            throw FatalInputError
            (
                dict.where("dimensions"), "Gravity has the dimensions " + dict.lookupDimensions("dimensions").str(),
                dimensions::acceleration.str()
            );
        }
        const auto g = dict.lookupDimensionedVector("value", dimensions::acceleration);
        dict.refuseUnused();
        magnitude_ = std::hypot(g[0], g[1], g[2]);
        const auto scaled = [&](double component) { return liquid.units().toScaled(component, dimensions::acceleration); };
        g_ = {scaled(g[0]), scaled(g[1]), scaled(g[2])};
    }

    void apply(Liquid& liquid, float dt) override
    {
        forEach(liquid.owned(), Accelerate{dt * g_, liquid.velocity.span()});
    }

    double acceleration() const override { return magnitude_; }

private:
    Vec3 g_;
    double magnitude_;
};

const BodyForceTable::Add<Gravity> registered{"gravity"};

}

}
