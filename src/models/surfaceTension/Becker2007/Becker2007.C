// SPDX-License-Identifier: GPL-3.0-or-later
// Cohesion of Becker and Teschner 2007, Weakly compressible SPH for free surface flows: attraction in proportion to the
// kernel, which minimises curvature without computing it.
//
//     a_i = -kappa/m sum_j m W(r_ij) r_ij          W: the cubic spline over the kernel's support; never repulsive
//
// The paper leaves kappa a free number. Unless the case gives one, it follows from sigma by the integral of
// pairForce/PairForce.H, and the contact angle by wetting adhesionRatio: both are this program's way, not the paper's.
//
//     surfaceTension      Becker2007;
//     Becker2007Coeffs    { kappa 1e-6; }          // m3/s2; default: from sigma

#include "maths/CohesionSpline.H"
#include "models/surfaceTension/pairForce/PairForce.H"

namespace shizuku
{

namespace
{

constexpr Dimensions perKernelDimensions{{0, 3, -2, 0, 0, 0, 0}};

struct KernelForce
{
    CubicSpline W;
    scalar h, kappa;

    HOST_DEVICE scalar operator()(scalar r) const { return kappa * W.W(r) * r; }
};

KernelForce readKernelForce(const Dictionary& coeffs, const Liquid& liquid)
{
    const LiquidProperties& p = liquid.properties();
    const double h = liquid.units().toSI(liquid.support(), dimensions::length);
    // F = kappa m W r = F0 f(r/h) with F0 = kappa m/h^2 and f that of support 1.
    const double F0 = forceOfTension
    (
        p.surfaceTension, 1 / p.particleVolume(), h, separationIntegral(KernelForce{CubicSpline(1), 1, 1})
    );
    const double kappa = coeffs.lookupDimensionedOr("kappa", perKernelDimensions, F0 * h * h / p.particleMass());
    if (!(kappa >= 0)) throw FatalInputError(coeffs.where("kappa"), "A negative coefficient kappa", "0 or more");
    return {CubicSpline(liquid.support()), liquid.support(), liquid.units().toScaled(kappa, perKernelDimensions)};
}

class Becker2007 : public PairForce<KernelForce>
{
public:
    Becker2007(const Dictionary& coeffs, Liquid& liquid, const Walls& walls, FreeSurface&)
    :
        PairForce(readKernelForce(coeffs, liquid), liquid, walls)
    {}
};

const SurfaceTensionTable::Add<Becker2007> registered{"Becker2007", "cohesion in proportion to the kernel (Becker and Teschner 2007)"};

}

}
