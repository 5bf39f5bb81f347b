// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/LayerRelaxation.H"

#include <algorithm>

namespace shizuku
{

namespace
{

constexpr double reach = 1.6;           // of the repulsion, in spacings: between the first and the second neighbours
constexpr double listReach = 2;         // of the lists of neighbours, in spacings
constexpr int listedFor = 10;           // iterations; who comes nearer in between is missed until the next list
constexpr double stiffness = 0.35;      // step over repulsion, in spacings
constexpr double longestStep = 0.15;    // in spacings
constexpr double wideReach = 2;         // in spacings; sharp edges are seen from this far
constexpr double smoothCosine = 0.866;  // normals that deviate by more than 30 degrees tell of a sharp edge

// Who is near each of some particles.
struct Neighbours
{
    std::vector<std::size_t> first;     // into `index`; one more than there are particles
    std::vector<int> index;
};

Neighbours listNeighbours(const ParticleLayer& layer, const std::vector<std::size_t>& ofWhom)
{
    const double reach = listReach*layer.spacing();
    const PointGrid grid = layer.grid(reach);
    Neighbours neighbours;
    neighbours.first.reserve(ofWhom.size() + 1);
    neighbours.index.reserve(20*ofWhom.size());
    for (const std::size_t i : ofWhom)
    {
        neighbours.first.push_back(neighbours.index.size());
        grid.forEachWithin(layer.particles()[i].position, reach, [&](int j, double)
        {
            if (std::size_t(j) != i) neighbours.index.push_back(j);
        });
    }
    neighbours.first.push_back(neighbours.index.size());
    return neighbours;
}

// The least cosine between a particle's normal and those of the particles around it.
double leastCosine(const ParticleLayer& layer, const PointGrid& grid, const LayerParticle& particle)
{
    double least = 1;
    grid.forEachWithin(particle.position, wideReach*layer.spacing(), [&](int j, double)
    {
        least = std::min(least, dot(particle.normal, layer.particles()[j].normal));
    });
    return least;
}

}

void relax(ParticleLayer& layer, int iterations, const std::function<void(double)>& report)
{
    const double spacing = layer.spacing(), radius = reach*spacing;
    std::vector<LayerParticle>& particles = layer.particles();

    std::vector<std::size_t> free;
    std::vector<bool> nearEdge;
    {
        const PointGrid grid = layer.grid(wideReach*spacing);
        for (std::size_t i = 0; i < particles.size(); ++i)
        {
            if (particles[i].fixed) continue;
            free.push_back(i);
            nearEdge.push_back(leastCosine(layer, grid, particles[i]) < smoothCosine);
        }
    }
    if (free.empty()) return;

    std::vector<Vector3> position(particles.size()), step(free.size());     // position: close together in memory
    for (std::size_t i = 0; i < particles.size(); ++i) position[i] = particles[i].position;
    Neighbours neighbours;
    for (int iteration = 0; iteration < iterations; ++iteration)
    {
        if (iteration % listedFor == 0) neighbours = listNeighbours(layer, free);
        for (std::size_t f = 0; f < free.size(); ++f)
        {
            const Vector3& x = position[free[f]];
            Vector3 push;
            for (std::size_t n = neighbours.first[f]; n < neighbours.first[f + 1]; ++n)
            {
                const Vector3 r = x - position[neighbours.index[n]];
                const double d2 = squaredLength(r);
                if (d2 > 0 && d2 < radius*radius) push += (1/std::sqrt(d2) - 1/radius)*r;
            }
            step[f] = stiffness*spacing*push;
            const double l = length(step[f]);
            if (l > longestStep*spacing) step[f] *= longestStep*spacing/l;
        }
        for (std::size_t f = 0; f < free.size(); ++f)
        {
            LayerParticle& particle = particles[free[f]];
            const LayerParticle moved = layer.particleAt(layer.surface().move(particle.foot, step[f]));
            if (nearEdge[f] && !layer.clear(moved)) continue;
            particle = moved;
            position[free[f]] = moved.position;
        }
        report(double(iteration + 1)/iterations);
    }
}

void thinOut(ParticleLayer& layer, double gap)
{
    std::vector<LayerParticle>& particles = layer.particles();
    std::stable_partition(particles.begin(), particles.end(), [](const LayerParticle& p) { return p.fixed; });
    std::vector<LayerParticle> kept;
    PointGrid grid(gap);
    for (const LayerParticle& particle : particles)
    {
        if (!particle.fixed && grid.anyWithin(particle.position, gap)) continue;
        grid.insert(particle.position);
        kept.push_back(particle);
    }
    particles = std::move(kept);
}

void fillHoles(ParticleLayer& layer, double hole, double cover)
{
    // Pieces this small miss a hole by no more than half of their size.
    const double resolution = 0.3*layer.spacing();
    const double reach = 2*layer.spacing();
    PointGrid grid = layer.grid(cover);
    layer.surface().searchPieces(resolution, [&](const SurfacePoint& place, double pieceRadius)
    {
        if (pieceRadius >= 0.6*hole) return true;      // too large to be covered by one particle, as a rule
        const LayerParticle particle = layer.particleAt(place);
        if (grid.anyWithin(particle.position, hole - pieceRadius)) return false;
        if (!grid.anyWithin(particle.position, hole))
        {
            const bool clear = layer.clear(particle);
            if (clear || layer.holeAt(particle, clear, grid, reach) > cover)
            {
                grid.insert(particle.position);
                layer.particles().push_back(particle);
            }
        }
        return true;
    });
}

}
