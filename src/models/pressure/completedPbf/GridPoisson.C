// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/pressure/completedPbf/GridPoisson.H"

#include "device/ForEach.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// The box of cells twice as wide.
GridBox coarser(const GridBox& box) { return {(box.x + 1) / 2, (box.y + 1) / 2, (box.z + 1) / 2}; }

// visit(node, weight) for the nodes of the finer level around a node, by full weighting.
template<class Visit>
HOST_DEVICE inline void forEachStoodFor(const GridBox& fine, GridBox::Place at, Visit visit)
{
    for (int c = -1; c <= 1; ++c)
    for (int b = -1; b <= 1; ++b)
    for (int a = -1; a <= 1; ++a)
    {
        const int x = 2 * at.x + a, y = 2 * at.y + b, z = 2 * at.z + c;
        if (x < 0 || y < 0 || z < 0 || x > fine.x || y > fine.y || z > fine.z) continue;
        visit(fine.node(x, y, z), (a ? 0.5f : 1) * (b ? 0.5f : 1) * (c ? 0.5f : 1));
    }
}

struct CoarsenFill
{
    GridBox fine, coarse;
    Span<const scalar> from;
    Span<scalar> to;

    HOST_DEVICE void operator()(int i) const
    {
        const GridBox::Place at = coarse.cellAt(i);
        scalar sum = 0;
        fine.forEachCellAround({2 * at.x + 1, 2 * at.y + 1, 2 * at.z + 1}, [&](int cell, int, int, int) { sum += from[cell]; });
        to[i] = 0.125f * sum;
    }
};

// Whether a node of a coarser level is open: one of those that it stands for is.
struct OpenCoarse
{
    GridBox fine, coarse;
    Span<const std::uint8_t> from;
    Span<std::uint8_t> to;

    HOST_DEVICE void operator()(int i) const
    {
        std::uint8_t open = 0;
        forEachStoodFor(fine, coarse.nodeAt(i), [&](int node, scalar) { open |= from[node]; });
        to[i] = open;
    }
};

// The edges of nodes, and what ties them to zero.
struct JoinNodes
{
    GridBox box, fine;
    Span<const std::uint8_t> open;
    Span<const scalar> fill, fineTie;       // fineTie: of the finer level, empty at the finest
    Span<NodeEdges> edges;
    Span<scalar> tie;

    HOST_DEVICE void operator()(int i) const
    {
        const GridBox::Place at = box.nodeAt(i);
        scalar along[6] = {}, all = 0;
        box.forEachCellAround(at, [&](int cell, int sx, int sy, int sz)
        {
            const scalar f = fill[cell];
            all += f;
            along[sx < 0 ? 0 : 1] += f;
            along[sy < 0 ? 2 : 3] += f;
            along[sz < 0 ? 4 : 5] += f;
        });
        constexpr scalar nothing = 1e-4f;
        scalar own = 0;
        if (fineTie.size > 0) forEachStoodFor(fine, at, [&](int node, scalar weight) { own += 0.5f * weight * fineTie[node]; });
        const bool isOpen = open[i] && all > nothing;
        edges[i] = {0.25f * along[0], 0.25f * along[2], 0.25f * along[4], isOpen ? 0.75f * all + own : 0};
        if (isOpen)
        {
            const int alongY = box.x + 1, alongZ = alongY * (box.y + 1);
            const auto closed = [&](int side, bool exists, int node) { if (exists && !open[node]) own += 0.25f * along[side]; };
            closed(0, at.x < box.x, i + 1);
            closed(1, at.x > 0, i - 1);
            closed(2, at.y < box.y, i + alongY);
            closed(3, at.y > 0, i - alongY);
            closed(4, at.z < box.z, i + alongZ);
            closed(5, at.z > 0, i - alongZ);
        }
        tie[i] = isOpen ? own : 0;
    }
};

// Of w q; the edges to the next nodes below are these nodes'.
template<class Values>
HOST_DEVICE inline scalar sumOfNeighbours(const GridBox& box, GridBox::Place at, int k, Span<const NodeEdges> edges, Values q)
{
    const int alongY = box.x + 1, alongZ = alongY * (box.y + 1);
    const NodeEdges own = edges[k];
    scalar sum = 0;
    if (at.x < box.x) sum += own.x * q[k + 1];
    if (at.y < box.y) sum += own.y * q[k + alongY];
    if (at.z < box.z) sum += own.z * q[k + alongZ];
    if (at.x > 0) sum += edges[k - 1].x * q[k - 1];
    if (at.y > 0) sum += edges[k - alongY].y * q[k - alongY];
    if (at.z > 0) sum += edges[k - alongZ].z * q[k - alongZ];
    return sum;
}

// Gauss and Seidel's, of the nodes of one colour, which have neighbours of the other alone.
struct Sweep
{
    GridBox box;
    int colour;
    Span<const NodeEdges> edges;
    Span<const scalar> source;
    Span<scalar> q;

    HOST_DEVICE static int inRow(const GridBox& box) { return box.x / 2 + 1; }

    HOST_DEVICE void operator()(int i) const
    {
        const int half = inRow(box), row = i / half, y = row % (box.y + 1), z = row / (box.y + 1);
        const int x = 2 * (i % half) + ((y + z + colour) & 1);
        if (x > box.x) return;
        const int k = box.node(x, y, z);
        const scalar sum = edges[k].sum;
        if (sum > 0) q[k] = (source[k] + sumOfNeighbours(box, {x, y, z}, k, edges, q)) / sum;
    }
};

struct Residual
{
    GridBox box;
    Span<const NodeEdges> edges;
    Span<const scalar> source, q;
    Span<scalar> residual;

    HOST_DEVICE void operator()(int k) const
    {
        const scalar sum = edges[k].sum;
        residual[k] = sum > 0 ? source[k] + sumOfNeighbours(box, box.nodeAt(k), k, edges, q) - sum * q[k] : 0;
    }
};

// Full weighting, times four for the square of the width.
struct Restrict
{
    GridBox fine, coarse;
    Span<const NodeEdges> edges;            // coarse
    Span<const scalar> residual;
    Span<scalar> source, q;

    HOST_DEVICE void operator()(int i) const
    {
        q[i] = 0;
        source[i] = 0;
        if (edges[i].sum == 0) return;
        scalar sum = 0;
        forEachStoodFor(fine, coarse.nodeAt(i), [&](int node, scalar weight) { sum += weight * residual[node]; });
        source[i] = 0.5f * sum;
    }
};

struct Prolong
{
    GridBox fine, coarse;
    Span<const NodeEdges> edges;            // fine
    Span<const scalar> correction;
    Span<scalar> q;

    HOST_DEVICE void operator()(int i) const
    {
        if (edges[i].sum == 0) return;
        const GridBox::Place at = fine.nodeAt(i);
        scalar sum = 0;
        for (int c = at.z / 2; c <= (at.z + 1) / 2; ++c)
        for (int b = at.y / 2; b <= (at.y + 1) / 2; ++b)
        for (int a = at.x / 2; a <= (at.x + 1) / 2; ++a) sum += correction[coarse.node(a, b, c)];
        const auto part = [](int even) { return even & 1 ? 0.5f : 1.0f; };
        q[i] += part(at.x) * part(at.y) * part(at.z) * sum;
    }
};

struct AtLeastZero
{
    Span<scalar> q;

    HOST_DEVICE void operator()(int i) const { q[i] = fmax(q[i], 0); }
};

}

void GridPoisson::addLevel(std::size_t level, const GridBox& box)
{
    if (levels_.size() <= level) levels_.emplace_back();
    Level& l = levels_[level];
    l.box = box;
    l.edges.resizeDiscarding(box.nodes());
    l.source.resizeDiscarding(box.nodes());
    l.solution.resizeDiscarding(box.nodes());
    l.residual.resizeDiscarding(box.nodes());
    l.tie.resizeDiscarding(box.nodes());
}

void GridPoisson::begin(const GridBox& box, const Buffer<scalar>& fill, const Buffer<std::uint8_t>& open)
{
    addLevel(0, box);
    forEach(box.nodes(), JoinNodes{box, {}, open.span(), fill.span(), {}, levels_[0].edges.span(), levels_[0].tie.span()});
    constexpr int coarsest = 6;             // cells along the longest axis
    used_ = 1;
    while (std::max({levels_[used_ - 1].box.x, levels_[used_ - 1].box.y, levels_[used_ - 1].box.z}) > coarsest)
    {
        const GridBox coarse = coarser(levels_[used_ - 1].box);
        addLevel(used_, coarse);
        const Level& fine = levels_[used_ - 1];
        Level& l = levels_[used_];
        l.fill.resizeDiscarding(coarse.cells());
        l.open.resizeDiscarding(coarse.nodes());
        const bool first = used_ == 1;
        forEach(coarse.cells(), CoarsenFill{fine.box, coarse, first ? fill.span() : fine.fill.span(), l.fill.span()});
        forEach(coarse.nodes(), OpenCoarse{fine.box, coarse, first ? open.span() : fine.open.span(), l.open.span()});
        forEach(coarse.nodes(), JoinNodes
        {
            coarse, fine.box, l.open.span(), l.fill.span(), fine.tie.span(), l.edges.span(), l.tie.span()
        });
        ++used_;
    }
}

void GridPoisson::sweep(Level& l, int colour)
{
    const int half = Sweep::inRow(l.box) * (l.box.y + 1) * (l.box.z + 1);
    forEach(half, Sweep{l.box, colour, l.edges.span(), l.source.span(), l.solution.span()});
}

void GridPoisson::cycle(std::size_t level)
{
    Level& l = levels_[level];
    if (level + 1 == used_)
    {
        constexpr int sweeps = 6;
        for (int k = 0; k < 2 * sweeps; ++k) sweep(l, k % 2);
        return;
    }
    Level& coarse = levels_[level + 1];
    sweep(l, 0);
    sweep(l, 1);
    forEach(l.box.nodes(), Residual{l.box, l.edges.span(), l.source.span(), l.solution.span(), l.residual.span()});
    forEach(coarse.box.nodes(), Restrict
    {
        l.box, coarse.box, coarse.edges.span(), l.residual.span(), coarse.source.span(), coarse.solution.span()
    });
    cycle(level + 1);
    forEach(l.box.nodes(), Prolong{l.box, coarse.box, l.edges.span(), coarse.solution.span(), l.solution.span()});
    sweep(l, 1);
    sweep(l, 0);
}

void GridPoisson::solve(int cycles)
{
    Level& finest = levels_[0];
    finest.solution.setZero();
    for (int k = 0; k < cycles; ++k) cycle(0);
    forEach(finest.box.nodes(), AtLeastZero{finest.solution.span()});
}

}
