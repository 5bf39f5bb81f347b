// SPDX-License-Identifier: GPL-3.0-or-later
// The liquid's surface goes on into the walls at the contact angle: what continuumSurfaceForce, laplacePressure and completedPbf sum
// over the walls follows from theta (freeSurface/ExtendedLiquid.H). Without it (wetting none) it meets them at 90 degrees.
//
//     wetting     extendedSurface;

#include "freeSurface/FreeSurface.H"
#include "models/wetting/Wetting.H"

namespace shizuku
{

namespace
{

class ExtendedSurface : public Wetting
{
public:
    ExtendedSurface(const Dictionary& coeffs, Liquid&, const Walls&, const SurfaceTension& tension)
    {
        if (!tension.freeSurface())
        {
            throw FatalInputError
            (
                coeffs.where(), "The wetting model extends the free surface into the walls, and the surface tension has none",
                "surfaceTension continuumSurfaceForce or laplacePressure, or another wetting model"
            );
        }
    }

    // It acts through the surface's reconstruction.
    bool accelerates() const override { return false; }
    bool continuesSurface() const override { return true; }
    std::optional<Columns> readsOfNeighbours(Liquid&) const override { return Columns{}; }
    void apply(Liquid&, const Neighbourhood&, const Walls&, Buffer<Vec3>&) override {}
};

const WettingTable::Add<ExtendedSurface> registered{"extendedSurface", "the surface goes on into walls at the contact angle"};

}

}
