// SPDX-License-Identifier: GPL-3.0-or-later
// Cohesion: every particle pulls its neighbours, weighted by the kernel. (Equation and source of the model.)
//
//     a_i = -strength sigma/(rho0 d^3) sum_j V (x_i - x_j) W_ij
//
//     surfaceTension  @word@;
//     @word@Coeffs  { strength 1; }

#include "models/surfaceTension/SurfaceTension.H"
#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

constexpr Dimensions stiffnessDimensions{{0, 0, -2, 0, 0, 0, 0}};

template<class Kernel>
struct Attract
{
    Kernel W;
    scalar weight;                      // strength sigma/(rho0 d^3) V
    Span<const Position> x;
    NeighbourView near;
    Span<Vec3> acceleration;

    HOST_DEVICE void operator()(int i) const
    {
        const Position xi = x[i];
        Vec3 sum;
        near.forEach(i, [&](int j) { sum += W.W(norm(xi - x[j])) * (xi - x[j]); });
        acceleration[i] -= weight * sum;
    }
};

class @class@ : public SurfaceTension
{
public:
    @class@(const Dictionary& coeffs, Liquid& liquid, const Walls&, FreeSurface&)
    {
        const double strength = coeffs.lookupOr("strength", 1.0);
        if (!(strength >= 0)) throw FatalInputError(coeffs.where("strength"), "The strength is negative", "0 or more");
        const LiquidProperties& properties = liquid.properties();
        stiffness_ = liquid.units().toScaled
        (
            strength * properties.surfaceTension / properties.particleMass(), stiffnessDimensions
        );
    }

    // Ghosts have the predicted positions from the search for neighbours.
    std::optional<Columns> readsOfNeighbours(Liquid&) const override { return Columns{}; }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls&, Buffer<Vec3>& acceleration) override
    {
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                NeighbourLoop(liquid, {}, {placesOf(liquid.predicted)}).forEach(Attract<Kernel>
                {
                    W, stiffness_ * liquid.particleVolume(), liquid.predicted.span(), near.view(), acceleration.span()
                });
            },
            liquid.kernel()
        );
    }

private:
    scalar stiffness_;                  // scaled
};

const SurfaceTensionTable::Add<@class@> registered{"@word@", "what it does, in a line"};

}

}
