// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/pressure/completedPbf/CoarseCorrection.H"

#include "core/messages/Error.H"
#include "device/ForEach.H"
#include "device/Reduce.H"
#include "maths/WholeSum.H"

#include <cmath>
#include <utility>

namespace shizuku
{

namespace
{

constexpr scalar spacings = 2;              // a cell's width
constexpr scalar mostError = 0.3f;          // of C_i: what one particle counts at most, be it spray or pressed against a wall
constexpr scalar tolerated = 0.003f;        // of the mean around a node: noise that would make calm liquid boil
constexpr scalar farthest = 0.2f;           // spacings in an iteration: more throws splashes against walls
constexpr scalar spray = 0.7f;              // density below which a particle is on its own
constexpr scalar atSurface = 0.75f;         // spacings below the surface, of those who tell where it is: its outermost layer
constexpr scalar closedBelow = 0.3f;        // cells below the surface: more than half a spacing, so that every surface has closed nodes
constexpr int shapeBits = 18, errorBits = 22;       // of quanta that sums of cells are made of

// Which cell a particle lies in, counted from a box's first.
struct CellOf
{
    CellGridView grid;
    WallView walls;
    Span<const Position> x;
    CoarseBox box = {};

    HOST_DEVICE CellBounds operator()(int i) const
    {
        const CellPlace at = grid.cellPlace(positionAt(walls.place(i, x[i])));
        const int cell[3] = {at.x - box.lowX, at.y - box.lowY, at.z - box.lowZ};
        return {{cell[0], cell[1], cell[2]}, {cell[0], cell[1], cell[2]}};
    }
};

// The same of those deep inside.
struct DeepInside
{
    FreeSurfaceView surface;
    CellOf cell;

    HOST_DEVICE CellBounds operator()(int i) const { return surface.isInside(i) ? cell(i) : CellBounds{}; }
};

// The particles of one of the cells of the box that a part has a share in: visit(j, r) for each of them, r from the cell's centre on. Others that share its
// place in the grid are far away.
struct ParticlesOfCell
{
    CellGridView grid;
    CoarseBox box;
    CellsOfBox cells;
    Span<const std::uint32_t> order;        // as they lie in the grid
    Span<const Position> x, start;

    template<class Visit>
    HOST_DEVICE void forEach(int cell, Visit visit) const
    {
        const GridBox::Place at = cells.inBox(cell);
        const Vec3 centre = box.width * Vec3{scalar(at.x) + 0.5f, scalar(at.y) + 0.5f, scalar(at.z) + 0.5f};
        const scalar far = 2.5f * box.width;            // they may have moved since they were sorted
        grid.forEachRangeOfCell(at.x + box.lowX, at.y + box.lowY, at.z + box.lowZ, [&](int first, int end)
        {
            for (int k = first; k < end; ++k)
            {
                const int j = int(order[k]);
                const Vec3 r = x[j] - box.corner - centre;
                if (squared(r) < far * far && isSameImage(box.corner, withBlock(start[j], x[j]))) visit(j, r);
            }
        });
    }
};

struct SumShape
{
    ParticlesOfCell particles;
    scalar spacing;
    FreeSurfaceView surface;
    Span<const scalar> density;
    Span<CellShape> shape;

    HOST_DEVICE void operator()(int cell) const
    {
        const scalar perWidth = 1 / particles.box.width;
        std::int64_t all = 0, known = 0, depth = 0, into[3] = {};
        particles.forEach(cell, [&](int j, Vec3 r)
        {
            ++all;
            if (density[j] < spray)
            {
                ++known;
                depth -= wholeQuanta(1, shapeBits);
                return;
            }
            const SurfaceState state = surface(j);
            if (state.depth >= atSurface * spacing) return;
            const Vec3 m = 1 / fmax(norm(state.gradient), 1e-20f) * state.gradient;
            ++known;
            depth += wholeQuanta(perWidth * (state.depth - dot(r, m)), shapeBits);
            into[0] += wholeQuanta(m.x, shapeBits);
            into[1] += wholeQuanta(m.y, shapeBits);
            into[2] += wholeQuanta(m.z, shapeBits);
        });
        shape[cell] = {bounded(all), bounded(known), bounded(depth), {bounded(into[0]), bounded(into[1]), bounded(into[2])}};
    }
};

struct FillOfCells
{
    scalar part;                            // of a cell that a particle fills
    Span<const CellShape> shape;
    Span<scalar> fill;

    HOST_DEVICE void operator()(int cell) const { fill[cell] = part * scalar(shape[cell].particles); }
};

struct OpenNodes
{
    GridBox box;
    Span<const CellShape> shape;
    Span<std::uint8_t> open;

    HOST_DEVICE void operator()(int i) const
    {
        std::int64_t known = 0, twiceDepth = 0;             // as the node sees it, half a cell from the middle of each along all axes
        box.forEachCellAround(box.nodeAt(i), [&](int cell, int sx, int sy, int sz)
        {
            const CellShape own = shape[cell];
            known += own.known;
            twiceDepth += 2 * std::int64_t(own.depth) + std::int64_t(sx) * own.into[0] + std::int64_t(sy) * own.into[1] + std::int64_t(sz) * own.into[2];
        });
        constexpr scalar quantum = 1.0f / (1 << shapeBits);
        open[i] = known == 0 || 0.5f * quantum * scalar(twiceDepth) > closedBelow * scalar(known);
    }
};

struct SumError
{
    ParticlesOfCell particles;
    Span<const scalar> density;
    Span<CellError> error;

    HOST_DEVICE void operator()(int cell) const
    {
        std::int64_t sum = 0;
        particles.forEach(cell, [&](int j, Vec3) { sum += wholeQuanta(fmin(fmax(density[j] - 1, -mostError), mostError), errorBits); });
        error[cell] = {bounded(sum)};
    }
};

struct SourceOfNodes
{
    CoarseBox box;
    scalar part;                            // of a cell that a particle fills
    Span<const CellError> error;
    Span<const scalar> fill;
    Span<const std::uint8_t> open;
    Span<scalar> source;

    HOST_DEVICE void operator()(int i) const
    {
        std::int64_t quanta = 0;
        scalar filled = 0;
        box.forEachCellAround(box.nodeAt(i), [&](int cell, int, int, int)
        {
            quanta += error[cell].sum;
            filled += fill[cell];
        });
        constexpr scalar quantum = 1.0f / (1 << errorBits);
        const scalar sum = part * quantum * scalar(quanta);
        const scalar borne = tolerated * filled, beyond = sum > borne ? sum - borne : fmin(sum + borne, 0);
        source[i] = open[i] ? 0.125f * box.width * box.width * beyond : 0;
    }
};

struct GradientOfCells
{
    CoarseBox box;
    Span<const scalar> q;
    Span<Vec3> gradient;

    HOST_DEVICE void operator()(int cell) const
    {
        const GridBox::Place at = box.cellAt(cell);
        Vec3 sum;
        for (int c = 0; c < 2; ++c)
        for (int b = 0; b < 2; ++b)
        for (int a = 0; a < 2; ++a)
        {
            sum += q[box.node(at.x + a, at.y + b, at.z + c)] * Vec3{scalar(2 * a - 1), scalar(2 * b - 1), scalar(2 * c - 1)};
        }
        gradient[cell] = 0.25f / box.width * sum;
    }
};

// Of the liquid around each node, and whether there is any.
struct GradientOfNodes
{
    CoarseBox box;
    Span<const scalar> fill;
    Span<const Vec3> ofCells;
    Span<Vec3> gradient;
    Span<scalar> known;

    HOST_DEVICE void operator()(int i) const
    {
        scalar weight = 0;
        Vec3 sum;
        box.forEachCellAround(box.nodeAt(i), [&](int cell, int, int, int)
        {
            weight += fill[cell];
            sum += fill[cell] * ofCells[cell];
        });
        gradient[i] = weight > 0 ? 1 / weight * sum : Vec3{};
        known[i] = weight > 0 ? 1 : 0;
    }
};

// Particles that have left the cells with liquid, or the box, move as the nodes do that are next to them.
struct MoveApart
{
    CoarseBox box;
    scalar most;
    Span<const Vec3> gradient;
    Span<const scalar> known;
    Span<Position> predicted;

    HOST_DEVICE void operator()(int i) const
    {
        constexpr scalar left = 2;              // cells outside of the box
        const Vec3 place = 1 / box.width * (predicted[i] - box.corner);
        const Vec3 in{fmin(fmax(place.x, 0), scalar(box.x)), fmin(fmax(place.y, 0), scalar(box.y)), fmin(fmax(place.z, 0), scalar(box.z))};
        if (!(squared(place - in) < left * left)) return;
        const auto cellOf = [](scalar at, int cells) { const int cell = int(at); return cell < cells ? cell : cells - 1; };
        const int x = cellOf(in.x, box.x), y = cellOf(in.y, box.y), z = cellOf(in.z, box.z);
        const Vec3 high = in - Vec3{scalar(x), scalar(y), scalar(z)};
        scalar weights = 0;
        Vec3 sum;
        for (int c = 0; c < 2; ++c)
        for (int b = 0; b < 2; ++b)
        for (int a = 0; a < 2; ++a)
        {
            const int node = box.node(x + a, y + b, z + c);
            const scalar weight = known[node] * (a ? high.x : 1 - high.x) * (b ? high.y : 1 - high.y) * (c ? high.z : 1 - high.z);
            weights += weight;
            sum += weight * gradient[node];
        }
        if (weights == 0) return;
        sum = 1 / weights * sum;
        const scalar far = norm(sum);
        predicted[i] -= (far > most ? most / far : 1) * sum;
    }
};

}

CoarseCorrection::CoarseCorrection(const Liquid& liquid) : grid_(spacings * liquid.spacing()) {}

void CoarseCorrection::begin(const Liquid& liquid, const Walls& walls, const FreeSurface& surface)
{
    box_ = {};
    const Span<const Position> x = liquid.predicted.span();
    const FreeSurfaceView view = surface.view();
    const CellGridView cells = grid_.view();
    CellOf cellOf{cells, walls.view(liquid), x};
    const CellBounds bounds = liquid.parts().fold(reduce(liquid.owned(), DeepInside{view, cellOf}, scratch_));
    if (bounds.isEmpty()) return;

    // Those deep inside see the surface from one support away, or from as far as the next layer then is. The nodes around it belong to the box:
    // without closed ones nothing could give way.
    const scalar width = cells.cellSize;
    const int around = int(std::ceil(liquid.support() / width)) + 1;
    CoarseBox box;
    box.width = width;
    box.lowX = bounds.low[0] - around;
    box.lowY = bounds.low[1] - around;
    box.lowZ = bounds.low[2] - around;
    box.corner = cells.corner(box.lowX, box.lowY, box.lowZ);
    box.x = bounds.high[0] + around - box.lowX + 1;
    box.y = bounds.high[1] + around - box.lowY + 1;
    box.z = bounds.high[2] + around - box.lowZ + 1;
    constexpr double most = 1 << 26;        // cells
    const double all = double(box.x) * box.y * box.z;
    if (all > most)
    {
        if (!tooWide_)
        {
            warning
            (
                "The coarse grid around the liquid would have " + std::to_string(std::int64_t(all)) +
                " cells, more than 2^26: it is left out while the liquid lies so far apart"
            );
        }
        tooWide_ = true;
        return;
    }
    box_ = box;
    order_ = grid_.build(x, liquid.owned(), {}, liquid.position.span());

    CellBounds own{{0, 0, 0}, {box.x - 1, box.y - 1, box.z - 1}};
    cellOf.box = box;
    if (liquid.parts().parts() > 1) own = reduce(liquid.owned(), cellOf, scratch_);
    shares_.set(liquid.ghosts(), box, own);
    filledBy_ = liquid.particleVolume() / (width * width * width);

    Buffer<CellShape> share(shares_.own().cells()), shape;
    forEach(share.size(), SumShape
    {
        {grid_.view(), box, shares_.own(), order_.span(), x, liquid.position.span()}, liquid.spacing(), view, liquid.density.span(), share.span()
    });
    shares_.addUp(liquid.ghosts(), share, shape);
    fill_.resizeDiscarding(box.cells());
    open_.resizeDiscarding(box.nodes());
    forEach(box.cells(), FillOfCells{filledBy_, std::as_const(shape).span(), fill_.span()});
    forEach(box.nodes(), OpenNodes{box, std::as_const(shape).span(), open_.span()});
    poisson_.begin(box, fill_, open_);
}

void CoarseCorrection::apply(Liquid& liquid)
{
    if (box_.cells() == 0) return;
    constexpr int cycles = 2;
    errorShare_.resizeDiscarding(shares_.own().cells());
    ofCells_.resizeDiscarding(box_.cells());
    ofNodes_.resizeDiscarding(box_.nodes());
    known_.resizeDiscarding(box_.nodes());
    forEach(errorShare_.size(), SumError
    {
        {grid_.view(), box_, shares_.own(), order_.span(), liquid.predicted.span(), liquid.position.span()}, liquid.density.span(), errorShare_.span()
    });
    shares_.addUp(liquid.ghosts(), errorShare_, error_);
    forEach(box_.nodes(), SourceOfNodes{box_, filledBy_, std::as_const(error_).span(), fill_.span(), open_.span(), poisson_.source()});
    poisson_.solve(cycles);
    forEach(box_.cells(), GradientOfCells{box_, poisson_.solution(), ofCells_.span()});
    forEach(box_.nodes(), GradientOfNodes{box_, fill_.span(), ofCells_.span(), ofNodes_.span(), known_.span()});
    forEach(liquid.owned(), MoveApart{box_, farthest * liquid.spacing(), ofNodes_.span(), known_.span(), liquid.predicted.span()});
}

}
