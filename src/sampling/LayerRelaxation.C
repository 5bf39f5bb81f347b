// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/LayerRelaxation.H"

#include "device/HostThreads.H"

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

// Who is near each of some particles: of those that a thread works on together.
struct Neighbours
{
    std::size_t begin, end;             // in the list of those particles
    std::vector<std::size_t> first;     // into `index`, of each of them; one more at the end
    std::vector<int> index;
};

std::vector<Neighbours> listNeighbours(const ParticleLayer& layer, const std::vector<std::size_t>& ofWhom)
{
    constexpr std::size_t together = 1000;
    const double reach = listReach*layer.spacing();
    const PointGrid grid = layer.grid(reach);
    std::vector<Neighbours> lists((ofWhom.size() + together - 1)/together);
    forEachPart(lists.size(), [&](std::size_t part)
    {
        Neighbours& list = lists[part];
        list.begin = part*together;
        list.end = std::min(ofWhom.size(), list.begin + together);
        list.first.reserve(together + 1);
        list.index.reserve(20*together);
        for (std::size_t f = list.begin; f < list.end; ++f)
        {
            const std::size_t i = ofWhom[f];
            list.first.push_back(list.index.size());
            grid.forEachWithin(layer.particles()[i].position, reach, [&](int j, double)
            {
                if (std::size_t(j) != i) list.index.push_back(j);
            });
        }
        list.first.push_back(list.index.size());
    });
    return lists;
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

// fill(particle) for each place of the piece that fillHoles is to fill; where it answers true, the piece around the place is searched further.
template<class Fill>
void searchHoles(const ParticleLayer& layer, const PointGrid& grid, const SurfacePiece& piece, double hole, double cover, const Fill& fill)
{
    // Pieces this small miss a hole by no more than half of their size.
    const double resolution = 0.3*layer.spacing();
    const double reach = 2*layer.spacing();
    searchPiece(piece, resolution, [&](const SurfacePoint& place, double pieceRadius)
    {
        if (pieceRadius >= 0.6*hole) return true;      // too large to be covered by one particle, as a rule
        const LayerParticle particle = layer.particleAt(place);
        if (grid.anyWithin(particle.position, hole - pieceRadius)) return false;
        if (grid.anyWithin(particle.position, hole)) return true;
        const bool clear = layer.clear(particle);
        return clear || layer.holeAt(particle, clear, grid, reach) > cover ? fill(particle) : true;
    });
}

}

void relax(ParticleLayer& layer, int iterations, const std::function<void(double)>& report)
{
    const double spacing = layer.spacing(), radius = reach*spacing;
    std::vector<LayerParticle>& particles = layer.particles();

    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < particles.size(); ++i)
    {
        if (!particles[i].fixed) free.push_back(i);
    }
    if (free.empty()) return;

    std::vector<char> nearEdge(free.size());
    {
        const PointGrid grid = layer.grid(wideReach*spacing);
        forEachInParallel(free.size(), [&](std::size_t f) { nearEdge[f] = leastCosine(layer, grid, particles[free[f]]) < smoothCosine; });
    }

    std::vector<Vector3> position(particles.size()), step(free.size());     // position: close together in memory
    for (std::size_t i = 0; i < particles.size(); ++i) position[i] = particles[i].position;
    std::vector<Neighbours> lists;
    for (int iteration = 0; iteration < iterations; ++iteration)
    {
        if (iteration % listedFor == 0) lists = listNeighbours(layer, free);
        forEachPart(lists.size(), [&](std::size_t part)
        {
            const Neighbours& list = lists[part];
            for (std::size_t f = list.begin; f < list.end; ++f)
            {
                const Vector3& x = position[free[f]];
                Vector3 push;
                for (std::size_t n = list.first[f - list.begin]; n < list.first[f - list.begin + 1]; ++n)
                {
                    const Vector3 r = x - position[list.index[n]];
                    const double d2 = squaredLength(r);
                    if (d2 > 0 && d2 < radius*radius) push += (1/std::sqrt(d2) - 1/radius)*r;
                }
                step[f] = stiffness*spacing*push;
                const double l = length(step[f]);
                if (l > longestStep*spacing) step[f] *= longestStep*spacing/l;
            }
        });
        forEachInParallel(free.size(), [&](std::size_t f)
        {
            LayerParticle& particle = particles[free[f]];
            const LayerParticle moved = layer.particleAt(layer.surface().move(particle.foot, step[f]));
            if (nearEdge[f] && !layer.clear(moved)) return;
            particle = moved;
            position[free[f]] = moved.position;
        });
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
    PointGrid grid = layer.grid(cover);

    // Particles that are added leave no more room for others than there was. So all threads look before which pieces have room at all; these are then
    // filled in their order.
    constexpr double shared = 8, filled = 1.5;      // holes across; above 1.2 a piece is too large to be covered by one particle
    const std::vector<SurfacePiece> pieces = layer.surface().pieces(shared*hole);
    std::vector<std::vector<SurfacePiece>> open(pieces.size());
    forEachInParallel
    (
        pieces.size(),
        [&](std::size_t i)
        {
            for (const SurfacePiece& piece : pieces[i].cut(filled*hole))
            {
                bool hasRoom = false;
                searchHoles(layer, grid, piece, hole, cover, [&](const LayerParticle&)
                {
                    hasRoom = true;
                    return false;
                });
                if (hasRoom) open[i].push_back(piece);
            }
        },
        16
    );
    for (const std::vector<SurfacePiece>& group : open)
    {
        for (const SurfacePiece& piece : group)
        {
            searchHoles(layer, grid, piece, hole, cover, [&](const LayerParticle& particle)
            {
                grid.insert(particle.position);
                layer.particles().push_back(particle);
                return true;
            });
        }
    }
}

}
