// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/SurfaceSampler.H"

#include "core/messages/Error.H"
#include "core/messages/Progress.H"
#include "sampling/EdgeRows.H"
#include "sampling/LayerRelaxation.H"
#include "sampling/PlanarLattice.H"
#include "sampling/SeedMethod.H"
#include "sampling/TipRings.H"

#include <algorithm>
#include <string>

namespace shizuku
{

namespace
{
    constexpr double smallestGap = 0.75;    // spacings
    constexpr double seedHole = 0.8;        // spacings: seeds as dense as discs at random can be
    constexpr double hole = 0.85;           // spacings: a particle fits with room to spare
    constexpr double cover = 0.88;          // spacings: where the layer is cut off by edges or shared in a thin plate
    constexpr int rounds = 3;               // of relaxing and thinning out

    // What each phase takes, in seconds for a million particles on two cores, measured on a street and on hills; relaxing, of those that are free. Only
    // their proportions count.
    constexpr double edges = 1.8, lattices = 0.7, seeds = 2, firstHoles = 3, relaxing = 6, lastHoles = 1.6, quality = 2.4;
    constexpr double others = edges + lattices + seeds + firstHoles + lastHoles + quality;

    // Progress of phases that follow each other.
    class Phases
    {
    public:
        Phases(const std::string& what, double all) : progress_(what), all_(all) {}

        void expect(double all) { all_ = all; }
        void during(double phase, double part) { progress_.update((done_ + part*phase)/all_); }
        void ended(double phase)
        {
            done_ += phase;
            during(0, 0);
        }

    private:
        Progress progress_;
        double all_, done_ = 0;
    };

    double freeShare(const ParticleLayer& layer)
    {
        const auto& all = layer.particles();
        const auto free = std::count_if(all.begin(), all.end(), [](const LayerParticle& particle) { return !particle.fixed; });
        return double(free)/double(std::max(all.size(), std::size_t(1)));
    }
}

SampledSurface sampleSurface
(
    const PatchedSurface& surface, const SamplingParameters& parameters, const std::string& what
)
{
    const SurfaceGeometry geometry(surface);
    const SurfaceDistance distance(surface.mesh);
    const double spacing = parameters.spacing;
    ParticleLayer layer(geometry, distance, spacing, parameters.offset*spacing);
    std::mt19937_64 random(1);
    Phases phases(what, others + relaxing);

    addTipRings(layer);
    addEdgeRows(layer);
    phases.ended(edges);
    addPlanarLattices(layer);
    phases.ended(lattices);
    SeedMethodTable::New("method", parameters.method, {})->addSeeds(layer, random);
    phases.ended(seeds);
    fillHoles(layer, seedHole*spacing, cover*spacing);
    layer.sort();
    const double relaxation = relaxing*freeShare(layer);
    phases.expect(others + relaxation);
    phases.ended(firstHoles);
    for (int round = 0; round < rounds; ++round)
    {
        relax(layer, parameters.iterations/rounds, [&](double part) { phases.during(relaxation, (round + part)/rounds); });
        thinOut(layer, smallestGap*spacing);
    }
    phases.ended(relaxation);
    fillHoles(layer, hole*spacing, cover*spacing);
    phases.ended(lastHoles);

    if (layer.particles().empty())
    {
        throw FatalError(what + ": there is no room for a particle half a spacing inside of the surface; it is too small, or too thin");
    }
    SampledSurface result;
    result.quality = measureQuality(layer, parameters.kernel);
    result.particles.patches = surface.patches;
    for (const LayerParticle& particle : layer.particles())
    {
        result.particles.positions.push_back(particle.position);
        result.particles.normals.push_back(particle.normal);
        result.particles.patch.push_back(surface.patch[particle.foot.face]);
    }
    return result;
}

}
