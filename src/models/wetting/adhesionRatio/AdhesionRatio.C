// SPDX-License-Identifier: GPL-3.0-or-later
// Solids attract as the liquid does, times a ratio that follows from the contact angle: Young's law, where the work of
// separation goes with the force between particles (Kondo et al. 2007; Tartakovsky and Meakin 2005).
//
//     F_ls/F_ll = (1 + cos theta)/2
//
// For surface tensions of a central force (surfaceTension/pairForce/PairForce.H), on sampled and analytic walls.
//
//     wetting     adhesionRatio;

#include "models/wetting/Wetting.H"

namespace shizuku
{

namespace
{

class AdhesionRatio : public Wetting
{
public:
    AdhesionRatio(const Dictionary& coeffs, Liquid&, const Walls&, const SurfaceTension& tension)
    :
        attraction_(tension.pairAttraction())
    {
        if (!attraction_)
        {
            throw FatalInputError
            (
                coeffs.where(), "The wetting model continues a central pair force at the walls, and the surface tension has none",
                "surfaceTension Becker2007, Kondo2007 or Tartakovsky2005, or another wetting model"
            );
        }
    }

    std::optional<Columns> readsOfNeighbours(Liquid&) const override { return Columns{}; }

    void apply(Liquid& liquid, const Neighbourhood&, const Walls& walls, Buffer<Vec3>& acceleration) override
    {
        if (walls.particles() + walls.surfaces() > 0) attraction_->attractToWalls(liquid, walls, acceleration);
    }

private:
    const PairAttraction* attraction_;
};

const WettingTable::Add<AdhesionRatio> registered{"adhesionRatio", "solids attract by a share of the cohesion that follows from the contact angle"};

}

}
