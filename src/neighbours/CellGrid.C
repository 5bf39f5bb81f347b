#include "neighbours/CellGrid.H"

#include "device/Algorithms.H"
#include "device/ForEach.H"

#include <algorithm>

namespace shizuku
{

namespace
{

struct AssignKeys
{
    CellGridView grid;
    Span<const Vec3> positions;
    Span<std::uint32_t> keys, order;

    HOST_DEVICE void operator()(int i) const
    {
        keys[i] = grid.key(positions[i]);
        order[i] = std::uint32_t(i);
    }
};

// By bisection, one cell a thread: between the occupied cells are gaps of whole layers, too long for a thread to close.
struct FindStarts
{
    Span<const std::uint32_t> keys;
    Span<std::uint32_t> start;

    HOST_DEVICE void operator()(int cell) const
    {
        int first = 0;
        for (int rest = keys.size; rest > 0;)
        {
            const int half = rest / 2;
            if (keys[first + half] < std::uint32_t(cell))
            {
                first += half + 1;
                rest -= half + 1;
            }
            else
            {
                rest = half;
            }
        }
        start[cell] = std::uint32_t(first);
    }
};

}

namespace
{

// Of as many cells as a search of that reach visits along an axis.
std::uint32_t bitsOfSearch(float reach, float cell)
{
    const std::uint32_t mostVisited = std::uint32_t(2.01f * reach / cell) + 2;
    std::uint32_t bits = 1;
    while ((1u << bits) < mostVisited) ++bits;
    return bits;
}

}

CellGrid::CellGrid(float cellSize, float reach)
:
    cellSize_(cellSize), leastBits_(bitsOfSearch(reach, cellSize)),
    leastBitsX_(bitsOfSearch(reach, cellSize / device::cellsInWidth))
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
    const float perCell = 1 / cellSize_;
    return {cellSize_, perCell, device::cellsInWidth * perCell, bitsX_, bitsY_, bitsZ_, start_.span()};
}

Buffer<std::uint32_t> CellGrid::build(Span<const Vec3> positions, int n)
{
    chooseSize(n);
    Buffer<std::uint32_t> keys(n), order(n);
    forEach(n, AssignKeys{view(), positions, keys.span(), order.span()});
    sortByKey(keys, order, int(bitsX_ + bitsY_ + bitsZ_));
    forEach(start_.size(), FindStarts{keys.span(), start_.span()});
    return order;
}

}
