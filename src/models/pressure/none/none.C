// SPDX-License-Identifier: GPL-3.0-or-later
// No pressure: particles fly freely.

#include "models/pressure/Pressure.H"

namespace shizuku
{

namespace
{

class NoPressure : public Pressure
{
public:
    NoPressure(const Dictionary& dict, Liquid&, const Walls&, FreeSurface&) { dict.markUsed(); }

    void begin(scalar) override {}
    bool converged(Liquid&, const Neighbourhood&, const Walls&) override { return true; }
    void correct(Liquid&, const Neighbourhood&, const Walls&) override {}
    int iterations() const override { return 0; }
};

const PressureTable::Add<NoPressure> registered{"none", "particles fly freely"};

}

}
