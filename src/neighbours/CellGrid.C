// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours/CellGrid.H"

#include "device/Algorithms.H"
#include "device/Atomic.H"
#include "device/ForEach.H"
#include "device/Sharing.H"

#include <algorithm>
#include <bit>
#include <cmath>

namespace shizuku
{

namespace
{

// Counts the points of each cell; a point's place among those of its cell is any.
struct CountInCells
{
    CellGridView grid;
    int owned;
    Span<const AtSides> across;                 // of ghosts, where some may be images
    Span<const Position> positions, start;
    Span<std::uint32_t> keys, places, count, wide;

    HOST_DEVICE void operator()(int i) const
    {
        const Position p = at(i);
        if (quanta::single && isFar(p, at(0))) put(wide[0], 1u);
        const std::uint32_t key = grid.key(p, firstKey(i));
        keys[i] = key;
        places[i] = increment(count[int(key)]);
    }

private:
    HOST_DEVICE std::uint32_t firstKey(int i) const
    {
        if (i < owned) return 0;
        return across.size > 0 && across[i - owned].bits != 0 ? grid.images : grid.ghosts;
    }

    HOST_DEVICE Position at(int i) const { return start.size > 0 ? withBlock(start[i], positions[i]) : positions[i]; }

    // Whether their quarters of blocks are not the same or next to each other: while all are near one of them, all lie within three quarters.
    HOST_DEVICE static bool isFar(Position a, Position b)
    {
        const Place p = placeOf(a), q = placeOf(b);
        return isFar(p.x, q.x) || isFar(p.y, q.y) || isFar(p.z, q.z);
    }

    HOST_DEVICE static bool isFar(std::int64_t a, std::int64_t b)
    {
        constexpr int quarter = quanta::lowBits - 2;
        const std::int64_t apart = (a >> quarter) - (b >> quarter);
        return apart > 1 || apart < -1;
    }
};

struct KeyOf
{
    CellGridView grid;
    Span<const Position> positions;
    Span<std::uint32_t> keys;

    HOST_DEVICE void operator()(int i) const { keys[i] = grid.key(positions[i]); }
};

// Puts the points into their cells.
struct PutInCells
{
    Span<const std::uint32_t> keys, places, start;
    Span<std::uint32_t> points;

    HOST_DEVICE void operator()(int i) const { points[int(start[int(keys[i])] + places[i])] = std::uint32_t(i); }
};

// Those of a cell in the order of their numbers, whichever came first: so it does not matter where in memory they were.
struct OrderInCells
{
    Span<const std::uint32_t> keys, start, points, id;
    Span<std::uint32_t> order;

    HOST_DEVICE void operator()(int i) const
    {
        const int key = int(keys[i]), first = int(start[key]), end = int(start[key + 1]);
        const std::uint32_t own = rank(i);
        int before = 0;
        for (int k = first; k < end; ++k) before += rank(int(points[k])) < own;
        order[first + before] = std::uint32_t(i);
    }

private:
    HOST_DEVICE std::uint32_t rank(int i) const { return id.size > 0 ? id[i] : std::uint32_t(i); }
};

// What sorting needs for a while, as large as a vector: it takes the memory of a field of these.
struct WordsOfPoint
{
    std::uint32_t word[sizeof(Position) / sizeof(std::uint32_t)];
};

// Of as many cells as a search of that reach visits along an axis, around points that are so many cells apart.
std::uint32_t bitsOfSearch(scalar reach, scalar cell, int apart)
{
    const std::uint32_t mostVisited = std::uint32_t(2.01f * reach / cell) + 2 + std::uint32_t(apart);
    std::uint32_t bits = 1;
    while ((1u << bits) < mostVisited) ++bits;
    return bits;
}

// In coarse quanta, as many as can be cut into short cells; no power of two, whose reciprocal would have one bit too many.
std::uint32_t widthOf(scalar cellSize)
{
    constexpr std::uint32_t parts = device::cellsInWidth;
    const auto least = std::uint32_t(std::ceil(std::ldexp(double(cellSize), quanta::fractionBits - CellGridView::coarseBits)));
    const std::uint32_t width = (least + parts - 1) / parts * parts;
    return std::has_single_bit(width) ? width + parts : width;
}

}

CellGrid::CellGrid(scalar cellSize, scalar reach)
:
    width_(widthOf(cellSize)), leastBits_(bitsOfSearch(reach, cellSize, 0)),
    leastBitsX_(bitsOfSearch(reach, cellSize / device::cellsInWidth, CellGridView::mostApart))
{}

CellGrid::Bits CellGrid::bitsFor(int n) const
{
    // About one cell a particle: a full cell holds several, so liquid spread thinly still finds room. As far along each axis.
    constexpr std::uint32_t moreAlongX = device::cellsInWidth - 1;
    std::uint32_t bits = 2 * leastBits_ + leastBitsX_;
    while (bits < 27 && (1u << bits) < std::uint32_t(n)) ++bits;
    const std::uint32_t x = std::max((bits - moreAlongX + 2) / 3 + moreAlongX, leastBitsX_), y = (bits - x + 1) / 2;
    return {x, y, bits - x - y};
}

// A sixteenth of the cells of all. Ghosts lie around a part, and in a plane most of them: it has room in any direction where copies along y follow each other
// along z.
CellGrid::Bits CellGrid::bitsOfGhosts() const
{
    if (sharesAsWhole()) return bits_;          // the same candidates in any parts
    constexpr std::uint32_t fewer = 4;
    return {bits_.x, leastBits_, std::max(leastBits_, bits_.y + bits_.z - std::min(bits_.y + bits_.z, leastBits_ + fewer))};
}

void CellGrid::chooseSize(int n)
{
    bits_ = bitsFor(sharedAs(n));
    const int beside = 1 << bitsOfGhosts().all();
    start_.resizeDiscarding((1 << bits_.all()) + (withGhosts_ ? beside : 0) + (withImages_ ? beside : 0) + 1);
}

CellGridView CellGrid::view() const
{
    const scalar cellSize = scalar(std::ldexp(double(width_), CellGridView::coarseBits - quanta::fractionBits)), perCell = 1 / cellSize;
    const std::uint32_t shifts = std::uint32_t(std::bit_width(width_)) - 1;
    const auto perWidth = std::uint32_t((std::uint64_t(1) << (32 + shifts)) / width_ + 1);
    const Bits ofGhosts = bitsOfGhosts();
    const std::uint32_t behindOwned = 1u << bits_.all(), behindGhosts = behindOwned + (withGhosts_ ? 1u << ofGhosts.all() : 0);
    return
    {
        cellSize, perCell, device::cellsInWidth * perCell, width_, perWidth, shifts, bits_.x, bits_.y, bits_.z, start_.span(),
        withGhosts_ ? behindOwned : 0, withImages_ ? behindGhosts : 0, ofGhosts.y, ofGhosts.z, wide_.span().data, own_
    };
}

Buffer<std::uint32_t> CellGrid::keys(Span<const Position> positions, int n, int all) const
{
    CellGridView grid = view();
    const Bits bits = bitsFor(all);
    grid.bitsX = bits.x, grid.bitsY = bits.y, grid.bitsZ = bits.z;
    Buffer<std::uint32_t> keys(n);
    forEach(n, KeyOf{grid, positions, keys.span()});
    return keys;
}

int CellGrid::cellsWithin(scalar reach) const
{
    const CellGridView grid = view();
    return int(std::ceil(grid.widened(reach) * grid.perCell));
}

Buffer<std::uint32_t> CellGrid::build
(
    Span<const Position> positions, int n, Span<const std::uint32_t> id, Span<const Position> start, const std::optional<Owned>& owned
)
{
    const int mine = owned ? owned->points : n;
    own_ = owned ? owned->rows : RowRectangle();
    withImages_ = owned && owned->across && mine < n;
    withGhosts_ = mine < n;
    chooseSize(withImages_ ? mine : n);         // where space repeats the order is that of any parts, whose keys are of the particles
    start_.setZero();
    wide_.setZero();
    Buffer<WordsOfPoint> words(n);
    std::uint32_t* const first = reinterpret_cast<std::uint32_t*>(words.span().data);
    const auto part = [&](std::size_t k) { return Span<std::uint32_t>{first + k * n, n}; };
    const Span<std::uint32_t> keys = part(0), places = part(1), points = part(2);
    forEach(n, CountInCells{view(), mine, withImages_ ? *owned->across : Span<const AtSides>{}, positions, start, keys, places, start_.span(), wide_.span()});
    sumBefore(start_);
    forEach(n, PutInCells{keys, places, start_.span(), points});
    Buffer<std::uint32_t> order(n);
    forEach(n, OrderInCells{keys, start_.span(), points, id, order.span()});
    return order;
}

}
