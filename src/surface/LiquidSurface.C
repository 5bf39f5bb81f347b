#include "surface/LiquidSurface.H"

#include "device/Algorithms.H"
#include "device/Gather.H"
#include "device/Reduce.H"
#include "maths/Lattice.H"
#include "neighbours/CellGrid.H"

#include <numbers>

namespace shizuku
{

namespace
{

constexpr float level = 0.5f;
constexpr float wideSupport = 1.75f;        // of the second smoothing, supports of the first
constexpr float meanSquares = 3.9f;         // of a triangle's sides, their sum, cells^2; by area, on a sphere

// Of a kernel smoothing the half space below a plane: phi's slope on the plane, and s^2, half the mean square radius of W
// in the plane. Where the plane bends to a sphere of radius R, the level 1/2 moves inwards by s^2/R (doc/theory/surface.md).
struct PlaneMoments
{
    float slope;                // 1/length
    float s2;                   // length^2
};

PlaneMoments planeMoments(const CubicSpline& W)
{
    constexpr int intervals = 2000;
    const double dr = double(W.h) / intervals;
    double first = 0, third = 0;
    for (int k = 0; k < intervals; ++k)
    {
        const double r = (k + 0.5) * dr, ring = W.W(float(r)) * r * dr;
        first += ring;
        third += ring * r * r;
    }
    return {float(2 * std::numbers::pi * first), float(0.5 * third / first)};
}

// V/S: scales the sum of W to 1 in liquid at rest.
float volumeOf(float spacing, const CubicSpline& W)
{
    const float sum = latticeSum(spacing, W.h, [&W](float r) { return W.W(r); });
    return spacing * spacing * spacing / sum;
}

// phi and its gradient.
struct Indicator
{
    CubicSpline W;
    float volume;
    CellGridView grid;
    Span<const Vec3> particles;

    HOST_DEVICE float value(Vec3 x) const
    {
        float sum = 0;
        const float support2 = W.h * W.h;
        grid.forEachCandidate(x, W.h, [&](int j)
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
        const float support2 = W.h * W.h;
        grid.forEachCandidate(x, W.h, [&](int j)
        {
            const Vec3 r = x - particles[j];
            const float r2 = squared(r);
            if (r2 >= support2) return;
            const float distance = sqrtf(r2);
            sum += W.W(distance);
            slope += W.g(distance) * r;
        });
        gradient = volume * slope;
        return volume * sum;
    }
};

struct EvaluateNodes
{
    Indicator phi;
    BlockMapView map;
    Span<float> value;

    HOST_DEVICE void operator()(int i) const { value[i] = phi.value(map.position(i)); }
};

// Values at nodes, zero where none is stored.
struct NodeField
{
    BlockMapView map;
    Span<const float> value;

    // Node i moved by 0 or 1 along each axis.
    HOST_DEVICE float at(int i, int dx, int dy, int dz) const
    {
        const int n = map.neighbour(i, dx, dy, dz);
        return n < 0 ? 0 : value[n];
    }

    HOST_DEVICE bool inside(int i, int dx, int dy, int dz) const { return at(i, dx, dy, dz) > level; }

    // Of the cell whose lowest corner is node i: its corners inside as bits.
    HOST_DEVICE int caseOf(int i) const
    {
        int corners = 0;
        for (int c = 0; c < 8; ++c) corners |= inside(i, c & 1, c >> 1 & 1, c >> 2 & 1) ? 1 << c : 0;
        return corners;
    }
};

// Node i owns the edges to the next node along x, y, z; crossed[3 i + axis] says whether the surface cuts it.
struct FindCrossings
{
    NodeField field;
    Span<std::uint32_t> crossed;

    HOST_DEVICE void operator()(int i) const
    {
        const bool here = field.value[i] > level;
        crossed[3 * i] = here != field.inside(i, 1, 0, 0);
        crossed[3 * i + 1] = here != field.inside(i, 0, 1, 0);
        crossed[3 * i + 2] = here != field.inside(i, 0, 0, 1);
    }
};

struct ListEdges
{
    Span<const std::uint32_t> firstVertex;
    Span<std::uint32_t> edges;              // of each vertex: 3 node + axis

    HOST_DEVICE void operator()(int edge) const
    {
        const std::uint32_t vertex = firstVertex[edge];
        if (firstVertex[edge + 1] > vertex) edges[int(vertex)] = std::uint32_t(edge);
    }
};

// A vertex on its edge: linear interpolation, then one Newton step along the edge on phi itself.
struct PlaceVertices
{
    NodeField field;
    Indicator phi;
    Span<const std::uint32_t> edges;
    Span<Vec3> vertices, normals;

    HOST_DEVICE void operator()(int v) const
    {
        const int i = int(edges[v] / 3), axis = int(edges[v] % 3);
        const float a = field.value[i], b = field.at(i, axis == 0, axis == 1, axis == 2);
        const float cell = field.map.cell;
        const Vec3 origin = field.map.position(i);
        const Vec3 along{axis == 0 ? cell : 0, axis == 1 ? cell : 0, axis == 2 ? cell : 0};
        float t = (level - a) / (b - a);
        Vec3 gradient;
        const float value = phi.value(origin + t * along, gradient);
        const float slope = dot(gradient, along);
        if (slope * (b - a) > 0) t += (level - value) / slope;
        // Away from the nodes: two vertices that fell together would make a triangle without area.
        t = fminf(fmaxf(t, 0.01f), 0.99f);
        const Vec3 p = origin + t * along;
        phi.value(p, gradient);
        vertices[v] = p;
        normals[v] = (-1 / fmaxf(norm(gradient), 1e-20f)) * gradient;
    }
};

// Moves a vertex from the level along its normal to the dividing surface, which leaves no excess of liquid on either side
// (doc/theory/surface.md). Where the liquid is not deep enough for that, at edges and in films, only what the smoothing moved
// the level by on a bent surface is taken back. The curvature is told by a wider smoothing, whose level lies further in.
struct MoveToDividingSurface
{
    static constexpr int inward = 5, outward = 3;       // points of the sum along the normal
    static constexpr float spacing = 0.25f;             // of these, supports
    static constexpr float bulk = 0.98f, edge = 0.9f;   // phi of the two innermost: deep enough, not at all

    Indicator phi, wide;
    PlaneMoments moments, wideMoments;
    float chord;                            // times the curvature: how far the middle of triangles lies below their corners
    Span<const Vec3> normals;
    Span<Vec3> vertices;

    HOST_DEVICE void operator()(int v) const
    {
        const Vec3 x = vertices[v], n = normals[v];
        const float wideLevel = (wide.value(x) - level) / wideMoments.slope;
        const float step = spacing * phi.W.h;
        // The sum by the midpoint rule is too large where the integrand's slope jumps by 1, at t = 0.
        float excess = 0, moment = -step * step / 24, deep = bulk;
        for (int k = -inward; k < outward; ++k)
        {
            const float t = (float(k) + 0.5f) * step;
            const float value = phi.value(x + t * n), extra = (value - (k < 0 ? 1.0f : 0.0f)) * step;
            excess += extra;
            moment += extra * t;
            if (k < 2 - inward) deep = fminf(deep, value);
        }
        const float curvature = (excess - wideLevel) / fmaxf(wideMoments.s2 - 2 * moment, 0.5f * wideMoments.s2);
        const float whole = excess + (2 * moment + chord) * curvature;
        const float bent = -wideLevel * moments.s2 / (wideMoments.s2 - moments.s2);
        const float part = fmaxf((deep - edge) / (bulk - edge), 0.0f);
        const float shift = part * whole + (1 - part) * bent;
        const float most = moments.s2 / phi.W.h;        // that of a sphere of radius h, the smallest that is resolved
        vertices[v] += fminf(fmaxf(shift, -most), most) * n;
    }
};

struct CountTriangles
{
    NodeField field;
    Span<const MarchingCubesTable> table;
    Span<std::uint32_t> count;

    HOST_DEVICE void operator()(int i) const
    {
        count[i] = table[0].triangles[field.caseOf(i)];
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
        const auto& edges = table[0].edges[field.caseOf(i)];
        for (std::uint32_t k = 0; k < 3 * count; ++k)
        {
            // Edge 4 axis + bits starts at the offsets of its bits along the two other axes, lower axis first.
            const int edge = edges[k], axis = edge / 4, low = edge & 1, high = edge >> 1 & 1;
            const int owner = field.map.neighbour
            (
                i, axis == 0 ? 0 : low, axis == 0 ? low : axis == 1 ? 0 : high, axis == 2 ? 0 : high
            );
            triangles[int(3 * first + k)] = firstVertex[3 * owner + axis];
        }
    }
};

// Of the tetrahedron of a triangle and the origin, negative where the triangle looks towards it: their sum over a closed mesh
// is what it encloses.
struct VolumeBelow
{
    Span<const Vec3> vertices;
    Span<const std::uint32_t> triangles;

    HOST_DEVICE EnclosedVolume operator()(int t) const
    {
        const Vec3 a = corner(3 * t), b = corner(3 * t + 1), c = corner(3 * t + 2);
        const double x = double(b.y) * c.z - double(b.z) * c.y;
        const double y = double(b.z) * c.x - double(b.x) * c.z;
        const double z = double(b.x) * c.y - double(b.y) * c.x;
        return {(a.x * x + a.y * y + a.z * z) / 6};
    }

    HOST_DEVICE Vec3 corner(int k) const { return vertices[int(triangles[k])]; }
};

}

LiquidSurface::LiquidSurface(const SurfaceParameters& parameters)
:
    kernel_(parameters.support), wideKernel_(wideSupport * parameters.support),
    volume_(volumeOf(parameters.spacing, kernel_)), wideVolume_(volumeOf(parameters.spacing, wideKernel_)),
    grid_(kernel_.h, wideKernel_.h),
    blocks_(parameters.cell, parameters.support + parameters.cell),
    table_(std::vector<MarchingCubesTable>{makeMarchingCubesTable()})
{}

void LiquidSurface::build(Span<const Vec3> positions)
{
    vertices_.resizeDiscarding(0);
    normals_.resizeDiscarding(0);
    triangles_.resizeDiscarding(0);
    if (positions.size == 0) return;

    gather(positions, grid_.build(positions, positions.size), particles_);
    evaluateNodes();
    placeVertices();
    placeTriangles();
}

SurfaceMesh LiquidSurface::download() const
{
    return {vertices_.download(), normals_.download(), triangles_.download()};
}

double LiquidSurface::volume()
{
    return reduce(triangles_.size() / 3, VolumeBelow{vertices_.span(), triangles_.span()}, scratch_).value;
}

SurfaceMesh LiquidSurface::extract(const std::vector<Vec3>& positions)
{
    given_.upload(positions);
    build(given_.span());
    return download();
}

void LiquidSurface::evaluateNodes()
{
    blocks_.cover(particles_.span());
    value_.resizeDiscarding(blocks_.nodes());
    const Indicator phi{kernel_, volume_, grid_.view(), particles_.span()};
    forEach(value_.size(), EvaluateNodes{phi, blocks_.view(), value_.span()});
}

void LiquidSurface::placeVertices()
{
    const NodeField field{blocks_.view(), value_.span()};
    flags_.resizeDiscarding(3 * value_.size());
    forEach(value_.size(), FindCrossings{field, flags_.span()});
    const int count = int(exclusiveScan(flags_, firstVertex_, "vertices of the surface"));
    edges_.resizeDiscarding(count);
    forEach(flags_.size(), ListEdges{firstVertex_.span(), edges_.span()});

    vertices_.resizeDiscarding(count);
    normals_.resizeDiscarding(count);
    const Indicator phi{kernel_, volume_, grid_.view(), particles_.span()};
    forEach(count, PlaceVertices{field, phi, edges_.span(), vertices_.span(), normals_.span()});

    const Indicator wide{wideKernel_, wideVolume_, grid_.view(), particles_.span()};
    const float chord = meanSquares / 24 * blocks_.view().cell * blocks_.view().cell;
    forEach
    (
        count,
        MoveToDividingSurface
        {
            phi, wide, planeMoments(kernel_), planeMoments(wideKernel_), chord, normals_.span(), vertices_.span()
        }
    );
}

void LiquidSurface::placeTriangles()
{
    const NodeField field{blocks_.view(), value_.span()};
    flags_.resizeDiscarding(value_.size());
    forEach(value_.size(), CountTriangles{field, table_.span(), flags_.span()});
    triangles_.resizeDiscarding(3 * int(exclusiveScan(flags_, firstTriangle_, "triangles of the surface")));
    forEach
    (
        value_.size(),
        StoreTriangles{field, table_.span(), firstTriangle_.span(), firstVertex_.span(), triangles_.span()}
    );
}

}
