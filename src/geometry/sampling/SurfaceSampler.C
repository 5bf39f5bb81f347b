#include "geometry/sampling/SurfaceSampler.H"

#include "core/messages/Progress.H"
#include "geometry/sampling/LayerRelaxation.H"
#include "geometry/sampling/PlanarLattice.H"
#include "geometry/sampling/SeedMethod.H"

namespace shizuku
{

namespace
{
    constexpr double smallestGap = 0.75;    // spacings
    constexpr double hole = 0.85;           // spacings: a particle fits with room to spare
    constexpr double cover = 0.9;           // spacings: a particle is put there, come what may
    constexpr int settlingIterations = 5;   // after particles were taken out and added
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

    addPlanarLattices(layer);
    SeedMethodTable::New("method", parameters.method, {})->addSeeds(layer, random);
    fillHoles(layer, hole*spacing, cover*spacing);
    fixLatticeInterior(layer);

    relax(layer, parameters.iterations, [&](double fraction) { progress.update(0.9*fraction); });
    thinOut(layer, smallestGap*spacing);
    fillHoles(layer, hole*spacing, cover*spacing);
    relax(layer, settlingIterations, [&](double fraction) { progress.update(0.9 + 0.1*fraction); });
    thinOut(layer, smallestGap*spacing);
    fillHoles(layer, hole*spacing, cover*spacing);

    SampledSurface result;
    result.quality = measureQuality(layer);
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
