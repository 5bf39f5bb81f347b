// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/LiquidSurface.H"

#include "core/messages/Error.H"
#include "device/Algorithms.H"
#include "device/Gather.H"
#include "device/Reduce.H"
#include "maths/Lattice.H"
#include "surface/NodeRows.H"
#include "surface/NodeValues.H"
#include "surface/PlaceVertices.H"
#include "surface/WeighParticles.H"

namespace shizuku
{

namespace
{

constexpr scalar wideSupport = 1.75f;       // of the second smoothing, supports of the first
constexpr scalar meanSquares = 3.9f;        // of a triangle's sides, their sum, cells^2; by area, on a sphere

// V/S: scales the sum of W to 1 in liquid at rest.
scalar volumeOf(scalar spacing, const CubicSpline& W)
{
    const scalar sum = latticeSum(spacing, W.h, [&W](scalar r) { return W.W(r); });
    return spacing * spacing * spacing / sum;
}

// Of W, over a square lattice around one of its points.
scalar layerSum(scalar spacing, const CubicSpline& W)
{
    const int n = int(W.h / spacing) + 1;
    double sum = 0;
    for (int i = -n; i <= n; ++i)
        for (int j = -n; j <= n; ++j) sum += W.W(spacing * std::sqrt(scalar(i * i + j * j)));
    return scalar(sum);
}

struct CountCrossings
{
    RowView rows;
    Span<const MarchingCubesTable> table;
    Span<std::uint32_t> crossed;
    Span<std::uint64_t> counts;

    HOST_DEVICE void operator()(int row) const
    {
        const RowView::Cells cells = rows.cells(row);
        std::uint32_t edges = 0, triangles = 0;
        if (!cells.uncut())
        {
            edges = cells.crossed();
            for (int x = 0; x < BlockMapView::edge; ++x) triangles += table[0].triangles[cells.corners(x)];
        }
        crossed[row] = edges;
        counts[row] = RowCounts::pack(std::uint32_t(std::popcount(edges)), triangles);
    }
};

struct ListEdges
{
    VerticesView vertices;
    Span<std::uint32_t> edges;              // of each vertex: 3 node + axis

    HOST_DEVICE void operator()(int row) const
    {
        std::uint32_t vertex = RowCounts::vertices(vertices.first[row]);
        for (std::uint32_t rest = vertices.crossed[row]; rest != 0; rest &= rest - 1)
        {
            edges[int(vertex++)] = std::uint32_t(RowView::edges) * std::uint32_t(row) + RowView::lowestBit(rest);
        }
    }
};

// The lanes of a team share the corners of a row's triangles.
struct StoreTriangles
{
    RowView rows;
    VerticesView vertices;
    Span<const MarchingCubesTable> table;
    Span<std::uint32_t> triangles;

    HOST_DEVICE void operator()(int row, Team team) const
    {
        const std::uint32_t first = RowCounts::triangles(vertices.first[row]);
        const int all = int(RowCounts::triangles(vertices.first[row + 1]) - first);
        if (all == 0) return;
        const RowView::Cells cells = rows.cells(row);
        std::uint32_t counts = 0;               // four bits a cell
        for (int x = 0; x < BlockMapView::edge; ++x) counts |= std::uint32_t(table[0].triangles[cells.corners(x)]) << 4 * x;
        for (int k = team.lane; k < 3 * all; k += team.width)
        {
            int x = 0, edge = k;
            for (int of; edge >= (of = 3 * int(counts >> 4 * x & 15)); ++x) edge -= of;
            triangles[3 * int(first) + k] = corner(row * BlockMapView::edge + x, table[0].edges[cells.corners(x)][edge]);
        }
    }

    // The vertex on an edge of cell `node`: edge 4 axis + bits starts at the offsets of its bits along the two other axes, lower
    // axis first.
    HOST_DEVICE std::uint32_t corner(int node, int edge) const
    {
        const int axis = edge / 4, low = edge & 1, high = edge >> 1 & 1;
        const int owner = rows.map.neighbour(node, axis == 0 ? 0 : low, axis == 0 ? low : axis == 1 ? 0 : high, axis == 2 ? 0 : high);
        return vertices.on(owner, axis);
    }
};

// Particles where the liquid's indicator is below the surface's level.
struct CountOutside
{
    Indicator phi;

    HOST_DEVICE SurfaceSum operator()(int i) const { return {phi.value(phi.particles[i], Team{}) < Indicator::level ? 1.0 : 0.0}; }
};

// Of the tetrahedron of a triangle and the first vertex, negative where the triangle looks towards it: their sum over a closed mesh
// is what it encloses.
struct VolumeBelow
{
    Span<const Position> vertices;
    Span<const std::uint32_t> triangles;

    struct Corner
    {
        double x, y, z;
    };

    HOST_DEVICE SurfaceSum operator()(int t) const
    {
        const Corner a = corner(3 * t), b = corner(3 * t + 1), c = corner(3 * t + 2);
        const double x = b.y * c.z - b.z * c.y, y = b.z * c.x - b.x * c.z, z = b.x * c.y - b.y * c.x;
        return {(a.x * x + a.y * y + a.z * z) / 6};
    }

    HOST_DEVICE Corner corner(int k) const
    {
        const Place at = placeOf(vertices[int(triangles[k])]), from = placeOf(vertices[0]);
        return {quanta::lengthOf(at.x - from.x), quanta::lengthOf(at.y - from.y), quanta::lengthOf(at.z - from.z)};
    }
};

}

LiquidSurface::LiquidSurface(const SurfaceParameters& parameters)
:
    kernel_(parameters.support), wideKernel_(wideSupport * parameters.support),
    volume_(volumeOf(parameters.spacing, kernel_)), wideVolume_(volumeOf(parameters.spacing, wideKernel_)),
    wideMoments_(momentsOf(wideKernel_)), layer_(volume_ * layerSum(parameters.spacing, kernel_)),
    refines_(4 * parameters.cell <= parameters.support),
    grid_(kernel_.h, 2 * kernel_.h),
    blocks_(parameters.cell, parameters.support + parameters.cell),
    table_(std::vector<MarchingCubesTable>{makeMarchingCubesTable()})
{}

void LiquidSurface::build(Span<const Position> positions)
{
    vertices_.resizeDiscarding(0);
    normals_.resizeDiscarding(0);
    triangles_.resizeDiscarding(0);
    particles_.resizeDiscarding(0);
    if (positions.size == 0) return;

    blocks_.collect(positions);
    gather(positions, grid_.build(positions, positions.size), particles_);
    weighParticles();
    blocks_.store(positions);
    evaluateNodes();
    countCrossings();
    placeVertices();
}

SurfaceMesh LiquidSurface::download() const
{
    SurfaceMesh mesh{{}, normals_.download(), triangles_.download()};
    for (const Position& vertex : vertices_.download())
    {
        const Place at = placeOf(vertex);
        mesh.vertices.emplace_back(quanta::lengthOf(at.x), quanta::lengthOf(at.y), quanta::lengthOf(at.z));
    }
    return mesh;
}

double LiquidSurface::volume()
{
    return reduce(triangles_.size() / 3, VolumeBelow{vertices_.span(), triangles_.span()}, scratch_).value;
}

int LiquidSurface::particlesOutside()
{
    return int(reduce(particles_.size(), CountOutside{indicator()}, scratch_).value);
}

void LiquidSurface::weighParticles()
{
    weight_.resizeDiscarding(particles_.size());
    forEachTeam(particles_.size(), WeighParticles{indicator(), layer_, weight_.span()});
}

void LiquidSurface::evaluateNodes()
{
    value_.resizeDiscarding(blocks_.blocks() * BlockMapView::nodes);
    inside_.resizeDiscarding(blocks_.blocks() * RowView::rows);
    const Indicator phi = indicator();
    forEachTeam(blocks_.blocks() * EvaluateCoarse::nodes, EvaluateCoarse{phi, blocks_.view(), value_.span()});
    forEachTeam(inside_.size(), EvaluateRow{phi, blocks_.view(), refines_, value_.span(), inside_.span()});
}

void LiquidSurface::countCrossings()
{
    crossed_.resizeDiscarding(inside_.size());
    counts_.resizeDiscarding(inside_.size());
    forEach
    (
        inside_.size(),
        CountCrossings{{blocks_.view(), inside_.span()}, table_.span(), crossed_.span(), counts_.span()}
    );
    const std::uint64_t all = exclusiveScan(counts_, first_);
    if (RowCounts::triangles(all) > 0x7fffffffu / 3)
    {
        throw FatalError
        (
            "The surface has " + std::to_string(RowCounts::triangles(all))
          + " triangles, more than fit into one list.\n    Use larger cells in system/meshSurfaceDict."
        );
    }
    vertices_.resizeDiscarding(int(RowCounts::vertices(all)));
    normals_.resizeDiscarding(vertices_.size());
    edges_.resizeDiscarding(vertices_.size());
    triangles_.resizeDiscarding(3 * int(RowCounts::triangles(all)));
}

void LiquidSurface::placeVertices()
{
    const VerticesView vertices{crossed_.span(), first_.span()};
    forEach(crossed_.size(), ListEdges{vertices, edges_.span()});
    forEachTeam
    (
        vertices_.size(),
        PlaceVertices
        {
            blocks_.view(), value_.span(), indicator(), wideKernel_, wideVolume_, wideMoments_,
            meanSquares / 24 * blocks_.view().cellLength() * blocks_.view().cellLength(),
            edges_.span(), vertices_.span(), normals_.span()
        }
    );
    forEachTeam
    (
        inside_.size(), StoreTriangles{{blocks_.view(), inside_.span()}, vertices, table_.span(), triangles_.span()}
    );
}

}
