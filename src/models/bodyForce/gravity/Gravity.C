// SPDX-License-Identifier: GPL-3.0-or-later
// Uniform gravity from constant/g:   dimensions [0 1 -2 0 0 0 0];  value (0 0 -9.81);
//
//     bodyForce   gravity;

#include "models/bodyForce/BodyForce.H"
#include "motion/Motion.H"

#include <cmath>

namespace shizuku
{

namespace
{

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
        value_ = dict.lookupDimensionedVector("value", dimensions::acceleration);
        dict.refuseUnused();
        const auto scaled = [&](double component) { return liquid.units().toScaled(component, dimensions::acceleration); };
        g_ = {scaled(value_[0]), scaled(value_[1]), scaled(value_[2])};
    }

    void predict(Liquid& liquid, scalar dt) const override { predictPositions(liquid, dt, dt * g_); }

    double acceleration() const override { return std::hypot(value_[0], value_[1], value_[2]); }
    std::array<double, 3> uniform() const override { return value_; }

private:
    std::array<double, 3> value_;       // m/s2
    Vec3 g_;                            // scaled
};

const BodyForceTable::Add<Gravity> registered{"gravity", "uniform gravity of constant/g"};

}

}
