// SPDX-License-Identifier: GPL-3.0-or-later
// Diffusion: particles move towards where fewer are. (Equation and source of the model.)
//
//     s_i = -a h^2 sum_j V grad W_ij
//
//     particleShifting  @word@;
//     @word@Coeffs  { strength 0.01; }      // a, 0 to 1

#include "device/ForEach.H"
#include "models/particleShifting/ParticleShifting.H"
#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

template<class Kernel>
struct Diffuse
{
    Kernel W;
    scalar factor;                      // a h^2 V
    Span<const Position> x;
    NeighbourView near;
    WallStop stop;
    Span<Position> shifted;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const Position xi = x[i];
        Team::Vector sum;
        near.forEach(i, xi, x, [&](auto, auto r) { sum += W.g(norm(r)) * r; }, team);
        const Position admitted = stop(i, xi - factor * team.sum(sum), team);
        if (team.first()) shifted[i] = withBlock(xi, admitted);
    }
};

class @class@ : public ParticleShifting
{
public:
    @class@(const Dictionary& coeffs, Liquid&, const Walls&, FreeSurface&)
    :
        strength_(scalar(coeffs.lookupOr("strength", 0.01)))
    {
        if (!(strength_ >= 0 && strength_ <= 1)) throw FatalInputError(coeffs.where("strength"), "The strength is out of range", "0 to 1");
    }

    std::optional<Columns> readsOfNeighbours(Liquid& liquid) const override { return Columns{valuesOf(liquid.position)}; }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls) override
    {
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                NeighbourLoop(liquid).forEachTeam(Diffuse<Kernel>
                {
                    W, strength_ * W.h * W.h * liquid.particleVolume(), liquid.position.span(), near.view(), walls.stop(liquid),
                    liquid.predicted.span()
                });
            },
            liquid.kernel()
        );
        liquid.position.swap(liquid.predicted);
    }

private:
    scalar strength_;
};

const ParticleShiftingTable::Add<@class@> registered{"@word@", "what it does, in a line"};

}

}
