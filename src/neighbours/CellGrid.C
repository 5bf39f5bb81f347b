#include "neighbours/CellGrid.H"

#include "device/Algorithms.H"
#include "device/Atomic.H"
#include "device/ForEach.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// Counts the points of each cell; a point's place among those of its cell is any.
struct CountInCells
{
    CellGridView grid;
    Span<const Vec3> positions;
    Span<std::uint32_t> keys, places, count;

    HOST_DEVICE void operator()(int i) const
    {
        const std::uint32_t key = grid.key(positions[i]);
        keys[i] = key;
        places[i] = increment(count[int(key)]);
    }
};

// Puts the points into their cells.
struct PutInCells
{
    Span<const std::uint32_t> keys, places, start;
    Span<std::uint32_t> points;

    HOST_DEVICE void operator()(int i) const { points[int(start[int(keys[i])] + places[i])] = std::uint32_t(i); }
};

// Those of a cell in the order of their numbers, whichever came first.
struct OrderInCells
{
    Span<const std::uint32_t> keys, start, points;
    Span<std::uint32_t> order;

    HOST_DEVICE void operator()(int i) const
    {
        const int key = int(keys[i]), first = int(start[key]), end = int(start[key + 1]);
        int before = 0;
        for (int k = first; k < end; ++k) before += points[k] < std::uint32_t(i);
        order[first + before] = std::uint32_t(i);
    }
};

// What sorting needs for a while, as large as a vector: it takes the memory of a field of these.
struct WordsOfPoint
{
    std::uint32_t word[sizeof(Vec3) / sizeof(std::uint32_t)];
};

// Of as many cells as a search of that reach visits along an axis, around points that are so many cells apart.
std::uint32_t bitsOfSearch(scalar reach, scalar cell, int apart)
{
    const std::uint32_t mostVisited = std::uint32_t(2.01f * reach / cell) + 2 + std::uint32_t(apart);
    std::uint32_t bits = 1;
    while ((1u << bits) < mostVisited) ++bits;
    return bits;
}

}

CellGrid::CellGrid(scalar cellSize, scalar reach)
:
    cellSize_(cellSize), leastBits_(bitsOfSearch(reach, cellSize, 0)),
    leastBitsX_(bitsOfSearch(reach, cellSize / device::cellsInWidth, CellGridView::mostApart))
{}

void CellGrid::chooseSize(int n)
{
    // About one cell a particle: a full cell holds several, so liquid spread thinly still finds room. As far along each axis.
    constexpr std::uint32_t moreAlongX = device::cellsInWidth - 1;
    std::uint32_t bits = 2 * leastBits_ + leastBitsX_;
    while (bits < 27 && (1u << bits) < std::uint32_t(n)) ++bits;
    bitsX_ = std::max((bits - moreAlongX + 2) / 3 + moreAlongX, leastBitsX_);
    bitsY_ = (bits - bitsX_ + 1) / 2;
    bitsZ_ = bits - bitsX_ - bitsY_;
    start_.resizeDiscarding((1 << bits) + 1);
}

CellGridView CellGrid::view() const
{
    const scalar perCell = 1 / cellSize_;
    return {cellSize_, perCell, device::cellsInWidth * perCell, bitsX_, bitsY_, bitsZ_, start_.span()};
}

Buffer<std::uint32_t> CellGrid::build(Span<const Vec3> positions, int n)
{
    chooseSize(n);
    start_.setZero();
    Buffer<WordsOfPoint> words(n);
    std::uint32_t* const first = reinterpret_cast<std::uint32_t*>(words.span().data);
    const auto part = [&](std::size_t k) { return Span<std::uint32_t>{first + k * n, n}; };
    const Span<std::uint32_t> keys = part(0), places = part(1), points = part(2);
    forEach(n, CountInCells{view(), positions, keys, places, start_.span()});
    sumBefore(start_);
    forEach(n, PutInCells{keys, places, start_.span(), points});
    Buffer<std::uint32_t> order(n);
    forEach(n, OrderInCells{keys, start_.span(), points, order.span()});
    return order;
}

}
