// SPDX-License-Identifier: GPL-3.0-or-later
// Kondo, Koshizuka, Suzuki and Takimoto 2007, Surface tension model using inter-particle force in particle method: a
// potential between particles, which the solid has too.
//
//     phi(r) = -C/3 (r - 3 d/2 + h/2) (r - h)^2,   F = dphi/dr = C (r - d) (h - r)      for r < h: attracts from d on
//     2 sigma d^2 = -sum phi(r_ij)                 over pairs, i in a column of particles of section d^2 on one side of a cut, j
//                                                  on the other: the work that makes two surfaces
//     C_s/C = (1 + cos theta)/2                    wetting adhesionRatio
//
// The sum is the cubic lattice's. The paper's reach of 3.1 d is here the kernel's support.
//
//     surfaceTension      Kondo2007;

#include "models/surfaceTension/pairForce/PairForce.H"

namespace shizuku
{

namespace
{

struct PotentialForce
{
    scalar h, d, C;

    HOST_DEVICE scalar operator()(scalar r) const { return r < h ? C * (r - d) * (h - r) : 0; }
};

// -sum phi of the cut over C d^3, for d = 1: a pair that reaches down k layers belongs to k cuts.
double workOfCut(double h)
{
    const int reach = int(h);
    double work = 0;
    for (int k = 1; k <= reach; ++k)
    {
        for (int i = -reach; i <= reach; ++i)
        {
            for (int j = -reach; j <= reach; ++j)
            {
                const double r = std::sqrt(double(i * i + j * j + k * k));
                if (r < h) work += k / 3.0 * (r - 1.5 + h / 2) * (r - h) * (r - h);
            }
        }
    }
    return work;
}

PotentialForce forceOf(const Liquid& liquid)
{
    const LiquidProperties& p = liquid.properties();
    const double d = p.spacing;
    // [N/m2]: 2 sigma d^2 = C d^3 work.
    const double C = 2 * p.surfaceTension / (d * workOfCut(liquid.support() / liquid.spacing()));
    constexpr Dimensions perMass{{0, -1, -2, 0, 0, 0, 0}};
    return {liquid.support(), liquid.spacing(), liquid.units().toScaled(C / p.particleMass(), perMass)};
}

class Kondo2007 : public PairForce<PotentialForce>
{
public:
    Kondo2007(const Dictionary&, Liquid& liquid, const Walls& walls, FreeSurface&) : PairForce(forceOf(liquid), liquid, walls) {}
};

const SurfaceTensionTable::Add<Kondo2007> registered{"Kondo2007", "potential between particles (Kondo, Koshizuka, Suzuki and Takimoto 2007)"};

}

}
