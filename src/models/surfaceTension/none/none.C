// SPDX-License-Identifier: GPL-3.0-or-later
// No surface tension.

#include "models/surfaceTension/SurfaceTension.H"

namespace shizuku
{

namespace
{

class NoSurfaceTension : public SurfaceTension
{
public:
    NoSurfaceTension(const Dictionary&, Liquid&, const Walls&, FreeSurface&) {}

    bool active() const override { return false; }
    void apply(Liquid&, const Neighbourhood&, const Walls&, Buffer<Vec3>&) override {}
};

const SurfaceTensionTable::Add<NoSurfaceTension> registered{"none", "no surface tension"};

}

}
