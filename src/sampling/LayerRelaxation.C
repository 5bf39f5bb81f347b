// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/LayerRelaxation.H"

#include "device/HostThreads.H"

#include <algorithm>

namespace shizuku
{

namespace
{

constexpr double reach = 1.6;           // of the repulsion, in spacings: between the first and the second neighbours
constexpr double listReach = 2;         // of the lists of neighbours, in spacings; sharp edges are seen from this far too
constexpr int listedFor = 10;           // iterations; who comes nearer in between is missed until the next list
constexpr double stiffness = 0.35;      // step over repulsion, in spacings
constexpr double longestStep = 0.15;    // in spacings
constexpr double smoothCosine = 0.866;  // normals that deviate by more than 30 degrees tell of a sharp edge

// Who is near each of some particles: of those that a thread works on together.
struct Neighbours
{
    std::size_t begin, end;             // in the list of those particles
    std::vector<std::size_t> first;     // into `index`, of each of them; one more at the end
    std::vector<int> index;
};

// Some particles of a layer in a grid, which knows them by their order.
struct GridOfSome
{
    std::vector<std::size_t> particles;
    PointGrid grid;
};

// Whether each particle of the layer is one of the free ones, or within `reach` [m] of one.
std::vector<char> aroundFree(const ParticleLayer& layer, const std::vector<std::size_t>& free, double reach)
{
    const std::vector<LayerParticle>& all = layer.particles();
    std::vector<char> around(all.size(), 1);
    if (free.size() == all.size()) return around;
    PointGrid grid(reach);
    for (const std::size_t i : free) grid.insert(all[i].position);
    forEachInParallel(all.size(), [&](std::size_t i) { around[i] = !all[i].fixed || grid.anyWithin(all[i].position, (1 + 1e-9)*reach); });
    return around;
}

GridOfSome gridAroundFree(const ParticleLayer& layer, const std::vector<std::size_t>& free, double reach)
{
    const std::vector<char> around = aroundFree(layer, free, reach);
    GridOfSome some{{}, PointGrid(reach)};
    for (std::size_t i = 0; i < around.size(); ++i)
    {
        if (!around[i]) continue;
        some.particles.push_back(i);
        some.grid.insert(layer.particles()[i].position);
    }
    return some;
}

std::vector<std::size_t> freeOnes(const ParticleLayer& layer)
{
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < layer.particles().size(); ++i)
    {
        if (!layer.particles()[i].fixed) free.push_back(i);
    }
    return free;
}

std::vector<Neighbours> listNeighbours(const ParticleLayer& layer, const std::vector<std::size_t>& ofWhom, const GridOfSome& near)
{
    constexpr std::size_t together = 1000;
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
            near.grid.forEachWithin(layer.particles()[i].position, listReach*layer.spacing(), [&](int j, double)
            {
                if (near.particles[j] != i) list.index.push_back(int(near.particles[j]));
            });
        }
        list.first.push_back(list.index.size());
    });
    return lists;
}

// The least cosine between a particle's normal and those of the particles around it.
double leastCosine(const ParticleLayer& layer, const GridOfSome& near, const LayerParticle& particle)
{
    double least = 1;
    near.grid.forEachWithin(particle.position, listReach*layer.spacing(), [&](int j, double)
    {
        least = std::min(least, dot(particle.normal, layer.particles()[near.particles[j]].normal));
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

    const std::vector<std::size_t> free = freeOnes(layer);
    if (free.empty()) return;

    GridOfSome near = gridAroundFree(layer, free, listReach*spacing);
    std::vector<char> nearEdge(free.size());
    forEachInParallel(free.size(), [&](std::size_t f) { nearEdge[f] = leastCosine(layer, near, particles[free[f]]) < smoothCosine; });

    std::vector<Vector3> position(particles.size()), step(free.size());     // position: close together in memory
    for (std::size_t i = 0; i < particles.size(); ++i) position[i] = particles[i].position;
    std::vector<Neighbours> lists;
    for (int iteration = 0; iteration < iterations; ++iteration)
    {
        if (iteration % listedFor == 0)
        {
            if (iteration > 0) near = gridAroundFree(layer, free, listReach*spacing);
            lists = listNeighbours(layer, free, near);
        }
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
    // Fixed ones stay, and matter where free ones are near.
    std::vector<LayerParticle>& particles = layer.particles();
    std::stable_partition(particles.begin(), particles.end(), [](const LayerParticle& p) { return p.fixed; });
    const std::vector<std::size_t> free = freeOnes(layer);
    PointGrid grid(gap);
    const std::vector<char> around = aroundFree(layer, free, gap);
    for (std::size_t i = 0; i < particles.size(); ++i)
    {
        if (around[i] && particles[i].fixed) grid.insert(particles[i].position);
    }
    std::size_t kept = particles.size() - free.size();
    for (const std::size_t i : free)
    {
        if (grid.anyWithin(particles[i].position, gap)) continue;
        grid.insert(particles[i].position);
        particles[kept++] = particles[i];
    }
    particles.resize(kept);
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
