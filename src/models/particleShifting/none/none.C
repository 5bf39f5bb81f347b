// SPDX-License-Identifier: GPL-3.0-or-later
// Particles stay where the step has brought them.

#include "models/particleShifting/ParticleShifting.H"

namespace shizuku
{

namespace
{

class NoShifting : public ParticleShifting
{
public:
    NoShifting(const Dictionary&, Liquid&, const Walls&, FreeSurface&) {}
    void apply(Liquid&, const Neighbourhood&, const Walls&) override {}
};

const ParticleShiftingTable::Add<NoShifting> registered{"none", "particles stay where the step has brought them"};

}

}
