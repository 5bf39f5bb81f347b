// SPDX-License-Identifier: GPL-3.0-or-later
// Tartakovsky and Meakin 2005, Modeling of surface tension and contact angles with smoothed particle hydrodynamics: a
// pairwise force that repels near by and attracts from afar.
//
//     F_ij = -s cos(3 pi r/(2 h)) for r <= h       positive attracts: repulsive below h/3, strongest at 2 h/3
//
// s follows from sigma by the integral of pairForce/PairForce.H: int_0^1 -cos(3 pi q/2) q^4 dq = 0.1079. Its repulsion adds to
// the pressure of the liquid.
//
//     surfaceTension          Tartakovsky2005;
//     Tartakovsky2005Coeffs   { s 1e-6; }          // N; default: from sigma

#include "maths/CohesionSpline.H"
#include "models/surfaceTension/pairForce/PairForce.H"

namespace shizuku
{

namespace
{

constexpr Dimensions forceDimensions{{1, 1, -2, 0, 0, 0, 0}};

struct CosineForce
{
    scalar h, scale;

    HOST_DEVICE scalar operator()(scalar r) const { return r < h ? -scale * cos(1.5f * kernels::pi * r / h) : 0; }
};

CosineForce readCosineForce(const Dictionary& coeffs, const Liquid& liquid)
{
    const LiquidProperties& p = liquid.properties();
    const double h = liquid.units().toSI(liquid.support(), dimensions::length);
    const double s = coeffs.lookupDimensionedOr
    (
        "s", forceDimensions,
        forceOfTension(p.surfaceTension, 1 / p.particleVolume(), h, separationIntegral(CosineForce{1, 1}))
    );
    if (!(s >= 0)) throw FatalInputError(coeffs.where("s"), "A negative strength s", "0 or more");
    return {liquid.support(), liquid.units().toScaled(s / p.particleMass(), dimensions::acceleration)};
}

class Tartakovsky2005 : public PairForce<CosineForce>
{
public:
    Tartakovsky2005(const Dictionary& coeffs, Liquid& liquid, const Walls& walls, FreeSurface&)
    :
        PairForce(readCosineForce(coeffs, liquid), liquid, walls)
    {}
};

const SurfaceTensionTable::Add<Tartakovsky2005> registered{"Tartakovsky2005", "pair force that repels near by and attracts from afar (Tartakovsky and Meakin 2005)"};

}

}
