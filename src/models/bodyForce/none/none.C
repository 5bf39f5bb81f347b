// SPDX-License-Identifier: GPL-3.0-or-later
// No force on the whole liquid.

#include "models/bodyForce/BodyForce.H"
#include "motion/Motion.H"

namespace shizuku
{

namespace
{

class NoBodyForce : public BodyForce
{
public:
    NoBodyForce(const std::filesystem::path&, const Liquid&) {}
    void predict(Liquid& liquid, scalar dt) const override { predictPositions(liquid, dt); }
};

const BodyForceTable::Add<NoBodyForce> registered{"none", "no force on the whole liquid"};

}

}
