// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquidBodies/LiquidBody.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <sstream>
#include <utility>

#include <unistd.h>

namespace shizuku
{

namespace
{

constexpr double bytesPerParticle = 64;                 // while they are placed: cells of positions and parts, and what is kept of them
constexpr int n = 6;                    // parts of a cell's edge; n^3 of them tell how far it is inside

// Cells that have a part in the body, x running fastest.
struct Cells
{
    std::vector<Vector3> middle;            // m
    std::vector<std::uint8_t> inside;       // of n^3 parts
};

class Lattice
{
public:
    Lattice(const LiquidBody& body, double spacing)
    : body_(body), frame_(body.frame()), edge_(body.cell(spacing))
    {
        const auto part = [&](double a, double b, double c)
        {
            return at((a + 0.5)/n, (b + 0.5)/n, (c + 0.5)/n) - frame_.origin;
        };
        for (int c = 0; c < n; ++c) for (int b = 0; b < n; ++b) for (int a = 0; a < n; ++a) parts_.push_back(part(a, b, c));
        constexpr double middle = 0.5*(n - 1);
        probes_ = {part(middle, middle, middle)};
        for (const int c : {0, n - 1}) for (const int b : {0, n - 1}) for (const int a : {0, n - 1}) probes_.push_back(part(a, b, c));
    }

    Cells cells() const
    {
        const Vector3 low = body_.low(), high = body_.high();
        Cells cells;
        const double wholeCells = body_.volume()/(edge_.x*edge_.y*edge_.z);
        cells.middle.reserve(std::size_t(1.01*wholeCells));
        cells.inside.reserve(std::size_t(1.01*wholeCells));
        for (double k = std::floor(low.z/edge_.z); k*edge_.z < high.z; ++k)
        for (double j = std::floor(low.y/edge_.y); j*edge_.y < high.y; ++j)
        for (double i = std::floor(low.x/edge_.x); i*edge_.x < high.x; ++i)
        {
            const int inside = partsInside(i, j, k);
            if (inside == 0) continue;
            cells.middle.push_back(at(i + 0.5, j + 0.5, k + 0.5));
            cells.inside.push_back(std::uint8_t(inside));
        }
        return cells;
    }

private:
    Vector3 at(double i, double j, double k) const
    {
        return frame_.origin + i*edge_.x*frame_.x + j*edge_.y*frame_.y + k*edge_.z*frame_.z;
    }

    // Counted on the middles of n^3 parts of the cell; on those at its corners and its middle first, which tell most
    // cells that the surface does not cut.
    int partsInside(double i, double j, double k) const
    {
        const Vector3 place = at(i, j, k);
        const int count = body_.countInside(place, probes_);
        if (count == 0 || count == int(probes_.size())) return count == 0 ? 0 : n*n*n;
        return body_.countInside(place, parts_);
    }

    const LiquidBody& body_;
    BodyFrame frame_;
    Vector3 edge_;
    std::vector<Vector3> parts_, probes_;       // middles of parts, from the corner of a cell
};

// 0 to 1: decides between cells that are equally far inside. Multiples of the golden ratio are spread evenly, and so are the
// cells that they choose.
double lot(std::size_t cell)
{
    const double x = cell/std::numbers::phi;
    return x - std::floor(x);
}

// The `count` cells that are farthest inside, in their order.
std::vector<Vector3> farthestInside(Cells cells, std::size_t count)
{
    std::array<std::size_t, n*n*n + 1> number{};        // of cells with so many parts inside
    for (const std::uint8_t inside : cells.inside) ++number[inside];
    int last = n*n*n;                                   // of these cells some are taken, of those farther inside all
    std::size_t rest = count;
    for (; number[last] < rest; --last) rest -= number[last];

    std::vector<std::size_t> drawn;
    if (rest < number[last])
    {
        for (std::size_t c = 0; c < cells.inside.size(); ++c) if (cells.inside[c] == last) drawn.push_back(c);
        const auto earlier = [](std::size_t a, std::size_t b) { return lot(a) < lot(b); };
        std::nth_element(drawn.begin(), drawn.begin() + rest, drawn.end(), earlier);
        for (auto lost = drawn.begin() + rest; lost != drawn.end(); ++lost) cells.inside[*lost] = 0;
    }
    std::size_t taken = 0;
    for (std::size_t c = 0; c < cells.inside.size(); ++c)
    {
        if (cells.inside[c] >= last) cells.middle[taken++] = cells.middle[c];
    }
    cells.middle.resize(taken);
    return std::move(cells.middle);
}

}

BodyFrame BodyFrame::along(const Vector3& origin, const Vector3& z)
{
    const Vector3 x = perpendicular(z);
    return {origin, x, cross(z, x), z};
}

std::vector<Vector3> LiquidBody::fill(double spacing, const SourceLocation& where) const
{
    return fillLattice(*this, spacing, where);
}

void refuseTooMany(const LiquidBody& body, double spacing, const SourceLocation& where)
{
    constexpr double most = 2e9;            // what numbers of 32 bits count
    const double count = body.volume()/(spacing*spacing*spacing);
    if (count <= most) return;
    std::ostringstream found, expected;
    found << "The body of liquid has " << body.volume() << " m3, " << count << " particles at the spacing of " << spacing << " m";
    expected << "up to " << most << " particles: a smaller body, in metres, or a spacing from " << std::cbrt(body.volume()/most)
             << " m in system/solution";
    throw FatalInputError(where, found.str(), expected.str());
}

std::vector<Vector3> fillLattice(const LiquidBody& body, double spacing, const SourceLocation& where)
{
    refuseTooMany(body, spacing, where);
    const double exact = body.volume()/(spacing*spacing*spacing);
    const double needed = exact*bytesPerParticle, there = double(sysconf(_SC_PHYS_PAGES))*double(sysconf(_SC_PAGE_SIZE));
    if (needed > there)
    {
        constexpr double giga = 1e9;
        std::ostringstream found;
        found << "The body would be " << exact << " particles of spacing " << spacing << " m, which take " << needed/giga
              << " GB of memory to place; this machine has " << there/giga << " GB";
        throw FatalInputError(where, found.str(), "a smaller body, or a larger spacing in system/solution");
    }

    Cells cells = Lattice(body, spacing).cells();
    const std::size_t count = std::min(cells.middle.size(), std::size_t(std::round(exact)));
    if (count == 0)
    {
        std::ostringstream found;
        found << "The body is smaller than the particle spacing of " << spacing << " m: no particle is inside";
        throw FatalInputError(where, found.str(), "a larger body, or a smaller spacing in system/solution");
    }
    return farthestInside(std::move(cells), count);
}

}
