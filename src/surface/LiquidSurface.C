// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/LiquidSurface.H"

#include "core/messages/Error.H"
#include "device/Algorithms.H"
#include "device/Gather.H"
#include "device/Reduce.H"
#include "maths/Lattice.H"
#include "parallel/AllParts.H"
#include "surface/NodeRows.H"
#include "surface/NodeValues.H"
#include "surface/PlaceVertices.H"
#include "surface/WeighParticles.H"

#include <algorithm>

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
    int own;                                // rows; those behind have vertices along x and y alone, and no triangles

    HOST_DEVICE void operator()(int row) const
    {
        const RowView::Cells cells = rows.cells(row);
        std::uint32_t edges = 0, triangles = 0;
        if (!cells.uncut())
        {
            edges = row < own ? cells.crossed() : cells.crossed() & RowView::alongXAndY;
            for (int x = 0; row < own && x < BlockMapView::edge; ++x) triangles += table[0].triangles[cells.corners(x)];
        }
        crossed[row] = edges;
        counts[row] = RowCounts::pack(std::uint32_t(std::popcount(edges)), triangles);
    }
};

// What a part tells the one below of a block of its lowest layer: which of the lowest nodes are inside, by rows; and their vertices.
struct InsideOfBlock
{
    std::uint64_t key = 0;
    std::uint8_t inside[BlockMapView::edge] = {};

    InsideOfBlock() = default;
    InsideOfBlock(std::uint64_t of, const std::uint8_t* rows) : key(of) { std::copy_n(rows, BlockMapView::edge, inside); }
};

struct VerticesOfBlock
{
    std::uint64_t key = 0;
    std::uint32_t first[BlockMapView::edge] = {}, crossed[BlockMapView::edge] = {};

    VerticesOfBlock() = default;
    VerticesOfBlock(std::uint64_t of, const std::uint64_t* counts, const std::uint32_t* edges) : key(of)
    {
        std::transform(counts, counts + BlockMapView::edge, first, RowCounts::vertices);
        std::copy_n(edges, BlockMapView::edge, crossed);
    }

    // Of those along x and y.
    void addNumbers(int row, std::vector<std::int64_t>& numbers) const
    {
        std::int64_t number = first[row];
        for (int edge = 0; edge < RowView::edges; ++edge)
        {
            if ((crossed[row] >> edge & 1) == 0) continue;
            if (RowView::alongXAndY >> edge & 1) numbers.push_back(number);
            ++number;
        }
    }
};

// By keys that ascend.
template<class T>
auto ofBlock(const std::vector<T>& blocks, std::uint64_t key)
{
    const auto found = std::lower_bound(blocks.begin(), blocks.end(), key, [](const T& block, std::uint64_t other) { return block.key < other; });
    return found != blocks.end() && found->key == key ? found : blocks.end();
}

struct ListEdges
{
    VerticesView vertices;
    Span<std::uint64_t> edges;              // of each vertex: 3 node + axis

    HOST_DEVICE void operator()(int row) const
    {
        std::uint32_t vertex = RowCounts::vertices(vertices.first[row]);
        for (std::uint32_t rest = vertices.crossed[row]; rest != 0; rest &= rest - 1)
        {
            edges[int(vertex++)] = std::uint64_t(RowView::edges) * std::uint64_t(row) + RowView::lowestBit(rest);
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

// Particles in these layers where the liquid's indicator is below the surface's level.
struct CountOutside
{
    Indicator phi;
    BlockMapView map;
    BlockLayers layers;

    HOST_DEVICE SurfaceSum operator()(int i) const
    {
        const Position x = phi.particles[i];
        const std::int64_t z = map.blockAt(placeOf(x).z);
        const bool isOwn = z >= layers.low && z < layers.high;
        return {isOwn && phi.value(x, Team{}) < Indicator::level ? 1.0 : 0.0};
    }
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
    const Alone alone;
    build(positions, {alone, {}});
}

void LiquidSurface::build(Span<const Position> positions, const SurfaceCut& cut)
{
    const bool isCut = cut.parts.parts() > 1;
    vertices_.resizeDiscarding(0);
    normals_.resizeDiscarding(0);
    triangles_.resizeDiscarding(0);
    particles_.resizeDiscarding(0);
    numbers_ = {};
    layers_ = cut.own();
    if (positions.size == 0 && !isCut) return;

    blocks_.collect(positions, layers_);
    gather(positions, grid_.build(positions, positions.size), particles_);
    weighParticles();
    blocks_.store(positions);
    evaluateNodes();
    if (isCut) takeInsideOfLayerAbove(cut);
    countCrossings(isCut ? RowView::rows * blocks_.layer(cut.own().high).before : inside_.size());
    if (isCut) numberVertices(cut);
    else numbers_ = {vertices_.size(), 0, {}};
    placeVertices();
}

std::pair<SurfaceCut, std::vector<Position>> LiquidSurface::particlesOfLayers(const std::vector<Position>& share, const Communicator& parts) const
{
    const SurfaceCut cut = cutSurface(share, blocks_.view(), parts);
    return {cut, bringToLayers(share, cut, blocks_.view(), halo())};
}

SurfaceMesh LiquidSurface::download() const
{
    SurfaceMesh mesh{{}, normals_.download(), triangles_.download()};
    mesh.vertices.reserve(vertices_.size());
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
    return int(reduce(particles_.size(), CountOutside{indicator(), blocks_.view(), layers_}, scratch_).value);
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

// Which nodes are inside of the liquid is for one part to say: where phi is as good as the level, roundings may differ from part to part.
void LiquidSurface::takeInsideOfLayerAbove(const SurfaceCut& cut)
{
    const BlockMap::Layer lowest = blocks_.layer(cut.own().low), above = blocks_.layer(cut.own().high);
    std::vector<Bytes> to(cut.parts.parts());
    if (const auto below = cut.below())
    {
        std::vector<std::uint8_t> inside(lowest.keys.size() * RowView::rows);
        inside_.download(inside.data(), int(inside.size()));
        std::vector<InsideOfBlock> own;
        for (std::size_t k = 0; k < lowest.keys.size(); ++k) own.emplace_back(lowest.keys[k], &inside[k * RowView::rows]);
        to[*below] = bytesOf(own);
    }
    const std::vector<Bytes> from = cut.parts.exchange(std::move(to));
    std::vector<InsideOfBlock> theirs;
    if (const auto next = cut.above()) appendTo(theirs, from[*next]);
    std::vector<std::uint8_t> inside(above.keys.size() * RowView::rows, 0);
    for (std::size_t k = 0; k < above.keys.size(); ++k)
    {
        const auto found = ofBlock(theirs, above.keys[k]);
        if (found != theirs.end()) std::copy_n(found->inside, BlockMapView::edge, &inside[k * RowView::rows]);
    }
    inside_.upload(inside, above.before * RowView::rows);
}

// Those of the layer above are the next part's, along the edges that it has there as well.
void LiquidSurface::numberVertices(const SurfaceCut& cut)
{
    const BlockMap::Layer lowest = blocks_.layer(cut.own().low), above = blocks_.layer(cut.own().high);
    const int rows = int(lowest.keys.size()) * RowView::rows;
    std::vector<std::uint64_t> first(rows);
    std::vector<std::uint32_t> crossed(rows);
    first_.download(first.data(), rows);
    crossed_.download(crossed.data(), rows);
    std::vector<VerticesOfBlock> own;
    for (std::size_t k = 0; k < lowest.keys.size(); ++k) own.emplace_back(lowest.keys[k], &first[k * RowView::rows], &crossed[k * RowView::rows]);
    std::vector<Bytes> to(cut.parts.parts());
    if (const auto below = cut.below()) to[*below] = bytesOf(own);
    const std::vector<Bytes> from = cut.parts.exchange(std::move(to));
    std::vector<VerticesOfBlock> theirs;
    if (const auto next = cut.above()) appendTo(theirs, from[*next]);

    for (const std::uint64_t key : above.keys)
    {
        const auto found = ofBlock(theirs, key);
        for (int row = 0; found != theirs.end() && row < BlockMapView::edge; ++row) found->addNumbers(row, numbers_.others);
    }
    numbers_.own = vertices_.size() - int(numbers_.others.size());
    const std::vector<std::int64_t> counts = cut.parts.gather(std::int64_t(numbers_.own));
    for (int part = 0; part < cut.parts.part(); ++part) numbers_.first += counts[part];
    for (std::int64_t& number : numbers_.others) number += numbers_.first + numbers_.own;
}

void LiquidSurface::countCrossings(int ownRows)
{
    crossed_.resizeDiscarding(inside_.size());
    counts_.resizeDiscarding(inside_.size());
    forEach
    (
        inside_.size(),
        CountCrossings{{blocks_.view(), inside_.span()}, table_.span(), crossed_.span(), counts_.span(), ownRows}
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
