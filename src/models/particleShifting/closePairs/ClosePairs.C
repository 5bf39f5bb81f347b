// SPDX-License-Identifier: GPL-3.0-or-later
// Moves particles inside the liquid apart that have come closer to each other than those of liquid at rest.
//
//     s_i = 1/2 sum_j max(a - |r_ij|, 0) r_ij/|r_ij|,    |s_i| <= d/10,    r_ij = x_i - x_j
//
// Half of what each pair lacks to the distance a: what positions would be projected by if pairs were kept apart (XPBD without compliance, Macklin et al.
// 2016). Particles less than a spacing below the surface, its outermost layer, are not moved; walls are not passed.
//
// A kernel's slope falls towards its middle, so that a pair which has come close is hardly driven apart any more (pairing: Price 2012, Dehnen
// and Aly 2012). Liquid that is sheared with the lattice it started from ends in columns of such pairs, which a density reads as full
// where a tenth of the particles is missing. Shifting by the density's gradient (Lind et al. 2012) parts pairs as well, but moves
// calm liquid, too: trials in doc/notebook/theory/particleShifting.md.
//
//     particleShifting    closePairs;         // in constant/models
//     closePairsCoeffs    { distance 0.95; }  // a, spacings, up to 1

#include "device/ForEach.H"
#include "models/particleShifting/ParticleShifting.H"
#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

struct PartPairs
{
    scalar distance, most, outermost;       // outermost: how far below the surface particles stay where they are
    Span<const Position> x;
    NeighbourView near;
    FreeSurfaceView surface;
    WallStop stop;
    Span<Position> shifted;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const Position xi = x[i];
        Team::Vector sum;
        near.forEach(i, xi, x, [&](auto, auto r)
        {
            const auto apart = fmax(norm(r), 1e-6f * distance);
            sum += fmax(distance - apart, 0) / apart * r;
        }, team);
        const Vec3 shift = 0.5f * team.sum(sum);
        const scalar far = norm(shift);
        const Position admitted = stop(i, xi + (far > most ? most / far : 1) * shift, team);
        if (team.first()) shifted[i] = surface(i).depth >= outermost ? withBlock(xi, admitted) : xi;
    }
};

class ClosePairs : public ParticleShifting
{
public:
    ClosePairs(const Dictionary& coeffs, Liquid& liquid, const Walls&, FreeSurface& surface)
    :
        distance_(scalar(coeffs.lookupOr("distance", 0.95))),
        surface_(surface)
    {
        if (!(distance_ > 0 && distance_ <= 1))
        {
            throw FatalInputError(coeffs.where("distance"), "The distance of pairs is out of range", "above 0, up to 1 spacing");
        }
        surface.requireUsual(liquid);
    }

    std::optional<Columns> readsOfNeighbours(Liquid& liquid) const override { return Columns{valuesOf(liquid.position)}; }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls) override
    {
        constexpr scalar most = 0.1f, outermost = 1;        // spacings; a step; below the surface
        const scalar d = liquid.spacing();
        // The predicted positions are done with.
        NeighbourLoop(liquid).forEachTeam(PartPairs
        {
            distance_ * d, most * d, outermost * d, liquid.position.span(), near.view(), surface_.view(), walls.stop(liquid),
            liquid.predicted.span()
        });
        liquid.position.swap(liquid.predicted);
    }

private:
    scalar distance_;                                       // spacings
    FreeSurface& surface_;
};

const ParticleShiftingTable::Add<ClosePairs> registered{"closePairs", "moves particles apart that are closer than those of liquid at rest"};

}

}
