// SPDX-License-Identifier: GPL-3.0-or-later
// An inviscid liquid.

#include "models/viscosity/Viscosity.H"

namespace shizuku
{

namespace
{

class NoViscosity : public Viscosity
{
public:
    NoViscosity(const Dictionary&, Liquid&) {}
    void apply(Liquid&, const Neighbourhood&, const Walls&, scalar) override {}
};

const ViscosityTable::Add<NoViscosity> registered{"none", "inviscid liquid"};

}

}
