// SPDX-License-Identifier: GPL-3.0-or-later
// method poissonDisk: points at random on the triangles, kept where no earlier one is near. The layer starts with its
// least distance in place, and saturated it has nearly the density of a relaxed one.
// R. L. Cook: Stochastic sampling in computer graphics. ACM Transactions on Graphics 5, 1986.

#include "sampling/OrderedPlacing.H"
#include "sampling/RandomPlaces.H"
#include "sampling/SeedMethod.H"

namespace shizuku
{

class PoissonDisk : public SeedMethod
{
public:
    void addSeeds(ParticleLayer& layer, std::mt19937_64& random) const override
    {
        // Random discs of diameter d that leave room for no more cover 0.547 of an area, 0.70/d^2 a unit area.
        // At d = 0.8 spacings this is 0.94 of the lattice's density.
        constexpr double diameter = 0.8;
        // So many sweeps over the surface, a dart a particle in each, fill all but the last few percent, which are left to
        // fillHoles.
        constexpr int sweeps = 8;

        const double gap = diameter*layer.spacing();
        PointGrid grid = layer.grid(gap);
        const long darts = std::lround(latticeDensity(layer.spacing())*layer.surface().area());
        for (int sweep = 0; sweep < sweeps; ++sweep)
        {
            RandomPlaces sweepPlaces(layer.surface(), darts, random);
            for (auto places = sweepPlaces.next(); !places.empty(); places = sweepPlaces.next()) addWhereRoomIs(layer, grid, gap, places, false);
        }
    }
};

static const SeedMethodTable::Add<PoissonDisk> registered{"poissonDisk"};

}
