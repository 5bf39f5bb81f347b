// SPDX-License-Identifier: GPL-3.0-or-later
// method bell: points at random on the triangles, as many as a lattice would have, which relaxation spreads evenly.
// N. Bell, Y. Yu, P. J. Mucha: Particle-based simulation of granular materials. Symposium on Computer Animation 2005;
// the repulsion is that of G. Turk: Re-tiling polygonal surfaces. SIGGRAPH 1992.

#include "sampling/SeedMethod.H"

namespace shizuku
{

class Bell : public SeedMethod
{
public:
    void addSeeds(ParticleLayer& layer, std::mt19937_64& random) const override
    {
        // Points clump before they are relaxed, and what thins them out afterwards takes the worst pairs only: a few
        // percent below the lattice's density leave room for the rest.
        constexpr double density = 0.95;
        const double spacing = layer.spacing();
        const PointGrid lattice = layer.grid(spacing);
        const long points = std::lround(density*latticeDensity(spacing)*layer.surface().area());
        layer.surface().forEachRandomPoint(points, random, [&](const SurfacePoint& place)
        {
            const LayerParticle particle = layer.particleAt(place);
            if (!lattice.anyWithin(particle.position, 0.75*spacing) && layer.clear(particle))
            {
                layer.particles().push_back(particle);
            }
        });
    }
};

static const SeedMethodTable::Add<Bell> registered{"bell"};

}
