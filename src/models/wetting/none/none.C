// SPDX-License-Identifier: GPL-3.0-or-later
// Walls neither attract nor repel.

#include "models/wetting/Wetting.H"

namespace shizuku
{

namespace
{

class NoWetting : public Wetting
{
public:
    NoWetting(const Dictionary&, Liquid&, const Walls&, const SurfaceTension&) {}

    bool active() const override { return false; }
    void apply(Liquid&, const Neighbourhood&, const Walls&, Buffer<Vec3>&) override {}
};

const WettingTable::Add<NoWetting> registered{"none", "walls neither attract nor repel"};

}

}
