// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/SurfaceSampler.H"

#include "core/messages/Error.H"
#include "core/messages/Progress.H"
#include "sampling/EdgeRows.H"
#include "sampling/LayerRelaxation.H"
#include "sampling/PlanarLattice.H"
#include "sampling/SeedMethod.H"
#include "sampling/TipRings.H"

namespace shizuku
{

namespace
{
    constexpr double smallestGap = 0.75;    // spacings
    constexpr double seedHole = 0.8;        // spacings: seeds as dense as discs at random can be
    constexpr double hole = 0.85;           // spacings: a particle fits with room to spare
    constexpr double cover = 0.88;          // spacings: where the layer is cut off by edges or shared in a thin plate
    constexpr int rounds = 3;               // of relaxing and thinning out
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
    Progress progress(what);

    addTipRings(layer);
    addEdgeRows(layer);
    addPlanarLattices(layer);
    SeedMethodTable::New("method", parameters.method, {})->addSeeds(layer, random);
    fillHoles(layer, seedHole*spacing, cover*spacing);
    layer.sort();
    for (int round = 0; round < rounds; ++round)
    {
        relax(layer, parameters.iterations/rounds, [&](double part) { progress.update((round + part)/rounds); });
        thinOut(layer, smallestGap*spacing);
    }
    fillHoles(layer, hole*spacing, cover*spacing);

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
