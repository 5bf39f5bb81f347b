#include "surface/LiquidSurface.H"

#include "device/Algorithms.H"
#include "device/Gather.H"
#include "neighbours/CellGrid.H"
#include "surface/BlockMap.H"

namespace shizuku
{

namespace
{

constexpr float level = 0.5f;

// phi and its gradient.
struct Indicator
{
    SurfaceKernel W;
    float volume;
    CellGridView grid;
    Span<const Vec3> particles;

    HOST_DEVICE float value(Vec3 x) const
    {
        float sum = 0;
        const float support2 = W.h * W.h;
        grid.forEachCandidate(x, [&](int j)
        {
            const float r2 = squared(x - particles[j]);
            if (r2 < support2) sum += W.W(sqrtf(r2));
        });
        return volume * sum;
    }

    HOST_DEVICE float value(Vec3 x, Vec3& gradient) const
    {
        float sum = 0;
        Vec3 slope;
        grid.forEachCandidate(x, [&](int j)
        {
            const Vec3 r = x - particles[j];
            const float distance = norm(r);
            if (distance >= W.h) return;
            sum += W.W(distance);
            slope += W.g(distance) * r;
        });
        gradient = volume * slope;
        return volume * sum;
    }

    // Out of the liquid, by the smooth part alone: shading shows the pattern of the particles less.
    HOST_DEVICE Vec3 normal(Vec3 x) const
    {
        Vec3 slope;
        grid.forEachCandidate(x, [&](int j)
        {
            const Vec3 r = x - particles[j];
            slope += W.smooth.g(norm(r)) * r;
        });
        return (-1 / fmaxf(norm(slope), 1e-20f)) * slope;
    }
};

struct EvaluateNodes
{
    Indicator phi;
    BlockMapView map;
    Span<float> value;

    HOST_DEVICE void operator()(int i) const { value[i] = phi.value(map.position(map.node(i))); }
};

// Values at nodes, zero outside of active blocks.
struct NodeField
{
    BlockMapView map;
    Span<const float> value;

    HOST_DEVICE float operator()(int x, int y, int z) const
    {
        const int i = map.index(x, y, z);
        return i < 0 ? 0 : value[i];
    }

    HOST_DEVICE bool inside(int x, int y, int z) const { return (*this)(x, y, z) > level; }
};

// Node i owns the edges to the next node along x, y, z; crossed[3 i + axis] says whether the surface cuts it.
struct FindCrossings
{
    NodeField field;
    Span<std::uint32_t> crossed;

    HOST_DEVICE void operator()(int i) const
    {
        const auto n = field.map.node(i);
        const bool here = field.value[i] > level;
        crossed[3 * i] = here != field.inside(n.x + 1, n.y, n.z);
        crossed[3 * i + 1] = here != field.inside(n.x, n.y + 1, n.z);
        crossed[3 * i + 2] = here != field.inside(n.x, n.y, n.z + 1);
    }
};

// A vertex on each crossed edge: linear interpolation, then one Newton step along the edge on phi itself.
struct PlaceVertices
{
    NodeField field;
    Indicator phi;
    Span<const std::uint32_t> first;
    Span<Vec3> vertices, normals;

    HOST_DEVICE void operator()(int i) const
    {
        const auto n = field.map.node(i);
        const Vec3 origin = field.map.position(n);
        for (int axis = 0; axis < 3; ++axis)
        {
            const std::uint32_t vertex = first[3 * i + axis];
            if (first[3 * i + axis + 1] == vertex) continue;

            const float a = field.value[i];
            const float b = field(n.x + (axis == 0), n.y + (axis == 1), n.z + (axis == 2));
            const float cell = field.map.cell;
            const Vec3 along{axis == 0 ? cell : 0, axis == 1 ? cell : 0, axis == 2 ? cell : 0};
            float t = (level - a) / (b - a);
            Vec3 gradient;
            const float value = phi.value(origin + t * along, gradient);
            const float slope = dot(gradient, along);
            if (slope * (b - a) > 0) t += (level - value) / slope;
            // Away from the nodes: two vertices that fell together would make a triangle without area.
            t = fminf(fmaxf(t, 0.01f), 0.99f);
            const Vec3 p = origin + t * along;
            vertices[int(vertex)] = p;
            normals[int(vertex)] = phi.normal(p);
        }
    }
};

HOST_DEVICE int caseOf(const NodeField& field, BlockMapView::Node n)
{
    int inside = 0;
    for (int c = 0; c < 8; ++c)
    {
        if (field.inside(n.x + (c & 1), n.y + (c >> 1 & 1), n.z + (c >> 2 & 1))) inside |= 1 << c;
    }
    return inside;
}

struct CountTriangles
{
    NodeField field;
    Span<const MarchingCubesTable> table;
    Span<std::uint32_t> count;

    HOST_DEVICE void operator()(int i) const
    {
        count[i] = table[0].triangles[caseOf(field, field.map.node(i))];
    }
};

struct StoreTriangles
{
    NodeField field;
    Span<const MarchingCubesTable> table;
    Span<const std::uint32_t> firstTriangle, firstVertex;
    Span<std::uint32_t> triangles;

    HOST_DEVICE void operator()(int i) const
    {
        const std::uint32_t first = firstTriangle[i], count = firstTriangle[i + 1] - first;
        if (count == 0) return;
        const auto n = field.map.node(i);
        const auto& edges = table[0].edges[caseOf(field, n)];
        for (std::uint32_t k = 0; k < 3 * count; ++k)
        {
            // Edge 4 axis + bits starts at the offsets of its bits along the two other axes, lower axis first.
            const int edge = edges[k], axis = edge / 4, low = edge & 1, high = edge >> 1 & 1;
            const int owner = field.map.index
            (
                n.x + (axis == 0 ? 0 : low), n.y + (axis == 0 ? low : axis == 1 ? 0 : high), n.z + (axis == 2 ? 0 : high)
            );
            triangles[int(3 * first + k)] = firstVertex[3 * owner + axis];
        }
    }
};

}

LiquidSurface::LiquidSurface(const SurfaceParameters& parameters)
:
    parameters_(parameters),
    kernel_(parameters.support),
    volume_(parameters.spacing * parameters.spacing * parameters.spacing),
    table_(std::vector<MarchingCubesTable>{makeMarchingCubesTable()})
{}

SurfaceMesh LiquidSurface::extract(const std::vector<Vec3>& positions)
{
    const Buffer<Vec3> given(positions);
    return extract(given.span());
}

SurfaceMesh LiquidSurface::extract(Span<const Vec3> positions)
{
    SurfaceMesh mesh;
    if (positions.size == 0) return mesh;

    Buffer<Vec3> particles;
    CellGrid grid(parameters_.support);
    gather(positions, grid.build(positions, positions.size), particles);
    const Indicator phi{kernel_, volume_, grid.view(), particles.span()};

    const BlockMap blocks(particles.span(), parameters_.cell, parameters_.support + parameters_.cell);
    const int nodes = blocks.activeNodes();
    Buffer<float> value(nodes);
    forEach(nodes, EvaluateNodes{phi, blocks.view(), value.span()});
    const NodeField field{blocks.view(), value.span()};

    Buffer<std::uint32_t> flags(3 * nodes), firstVertex, firstTriangle;
    forEach(nodes, FindCrossings{field, flags.span()});
    const int vertexCount = int(exclusiveScan(flags, firstVertex, "vertices of the surface"));
    Buffer<Vec3> vertices(vertexCount), normals(vertexCount);
    forEach(nodes, PlaceVertices{field, phi, firstVertex.span(), vertices.span(), normals.span()});

    flags.resize(nodes);
    forEach(nodes, CountTriangles{field, table_.span(), flags.span()});
    Buffer<std::uint32_t> triangles(3 * int(exclusiveScan(flags, firstTriangle, "triangles of the surface")));
    forEach(nodes, StoreTriangles{field, table_.span(), firstTriangle.span(), firstVertex.span(), triangles.span()});

    mesh.vertices = vertices.download();
    mesh.normals = normals.download();
    mesh.triangles = triangles.download();
    return mesh;
}

}
