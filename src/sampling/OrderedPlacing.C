// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/OrderedPlacing.H"

#include "device/HostThreads.H"

namespace shizuku
{

void addWhereRoomIs(ParticleLayer& layer, PointGrid& grid, double gap, const std::vector<SurfacePoint>& places, bool fixed)
{
    std::vector<LayerParticle> particles(places.size());
    std::vector<char> mayBe(places.size());
    forEachInParallel(places.size(), [&](std::size_t i)
    {
        particles[i] = layer.particleAt(places[i]);
        mayBe[i] = !grid.anyWithin(particles[i].position, gap) && layer.clear(particles[i]);
    });
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        if (!mayBe[i] || grid.anyWithin(particles[i].position, gap)) continue;      // of those before it
        particles[i].fixed = fixed;
        grid.insert(particles[i].position);
        layer.particles().push_back(particles[i]);
    }
}

}
