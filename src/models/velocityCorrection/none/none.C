// SPDX-License-Identifier: GPL-3.0-or-later
// Velocities stay what the step has made them.

#include "models/velocityCorrection/VelocityCorrection.H"

namespace shizuku
{

namespace
{

class NoCorrection : public VelocityCorrection
{
public:
    NoCorrection(const Dictionary&, Liquid&) {}
    void apply(Liquid&, const Neighbourhood&, const Walls&, scalar) override {}
};

const VelocityCorrectionTable::Add<NoCorrection> registered{"none", "velocities stay what the step has made them"};

}

}
