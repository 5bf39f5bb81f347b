#include "neighbours/CellGrid.H"

#include "device/Algorithms.H"
#include "device/ForEach.H"

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

CellGrid::CellGrid(float cellSize, float reach) : cellSize_(cellSize), leastBits_(1)
{
    const std::uint32_t mostVisited = std::uint32_t(2.01f * reach / cellSize) + 2;
    while ((1u << leastBits_) < mostVisited) ++leastBits_;
}

void CellGrid::chooseSize(int n)
{
    // About one cell a particle: a full cell holds eight or more, so liquid spread thinly still finds room.
    std::uint32_t bits = 3 * leastBits_;
    while (bits < 27 && (1u << bits) < std::uint32_t(n)) ++bits;
    bitsX_ = (bits + 2) / 3;
    bitsY_ = (bits + 1) / 3;
    bitsZ_ = bits / 3;
    start_.resizeDiscarding((1 << bits) + 1);
}

CellGridView CellGrid::view() const
{
    return {cellSize_, 1 / cellSize_, bitsX_, bitsY_, bitsZ_, start_.span()};
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
