// SPDX-License-Identifier: GPL-3.0-or-later
// method bell: points at random on the triangles, as many as a lattice would have, which relaxation spreads evenly.
// N. Bell, Y. Yu, P. J. Mucha: Particle-based simulation of granular materials. Symposium on Computer Animation 2005;
// the repulsion is that of G. Turk: Re-tiling polygonal surfaces. SIGGRAPH 1992.

#include "device/HostThreads.H"
#include "sampling/RandomPlaces.H"
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
        RandomPlaces all(layer.surface(), points, random);
        for (auto places = all.next(); !places.empty(); places = all.next())
        {
            std::vector<LayerParticle> particles(places.size());
            std::vector<char> taken(places.size());
            forEachInParallel(places.size(), [&](std::size_t i)
            {
                particles[i] = layer.particleAt(places[i]);
                taken[i] = !lattice.anyWithin(particles[i].position, 0.75*spacing) && layer.clear(particles[i]);
            });
            for (std::size_t i = 0; i < places.size(); ++i)
            {
                if (taken[i]) layer.particles().push_back(particles[i]);
            }
        }
    }
};

static const SeedMethodTable::Add<Bell> registered{"bell"};

}
