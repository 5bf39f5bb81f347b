#include "geometry/liquidBodies/LiquidBody.H"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr double maxParticles = 1e8;

struct Cell
{
    Vector3 middle;             // m
    double inside = 0;          // the part of it that is inside of the body
    double lot = 0;             // 0 to 1: decides between cells that are equally far inside
    std::size_t index = 0;
};

class Lattice
{
public:
    Lattice(const LiquidBody& body, double spacing) : body_(body), frame_(body.frame()), edge_(body.cell(spacing)) {}

    // Those that have a part in the body, x running fastest.
    std::vector<Cell> cells() const
    {
        const Vector3 low = body_.low(), high = body_.high();
        std::vector<Cell> cells;
        for (double k = std::floor(low.z/edge_.z); k*edge_.z < high.z; ++k)
        for (double j = std::floor(low.y/edge_.y); j*edge_.y < high.y; ++j)
        for (double i = std::floor(low.x/edge_.x); i*edge_.x < high.x; ++i)
        {
            const double inside = partInside(i, j, k);
            if (inside == 0) continue;
            // Multiples of the golden ratio are spread evenly over 0 to 1, and so are the cells that they choose.
            const double lot = cells.size()/std::numbers::phi;
            cells.push_back({at(i + 0.5, j + 0.5, k + 0.5), inside, lot - std::floor(lot), cells.size()});
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
    double partInside(double i, double j, double k) const
    {
        constexpr int n = 6;
        const auto inside = [&](double a, double b, double c)
        {
            return int(body_.contains(at(i + (a + 0.5)/n, j + (b + 0.5)/n, k + (c + 0.5)/n)));
        };
        constexpr double middle = 0.5*(n - 1);
        int count = inside(middle, middle, middle);
        for (const int c : {0, n - 1}) for (const int b : {0, n - 1}) for (const int a : {0, n - 1}) count += inside(a, b, c);
        if (count == 0 || count == 9) return count/9;

        count = 0;
        for (int c = 0; c < n; ++c) for (int b = 0; b < n; ++b) for (int a = 0; a < n; ++a) count += inside(a, b, c);
        return count/double(n*n*n);
    }

    const LiquidBody& body_;
    BodyFrame frame_;
    Vector3 edge_;
};

}

BodyFrame BodyFrame::along(const Vector3& origin, const Vector3& z)
{
    const Vector3 x = perpendicular(z);
    return {origin, x, cross(z, x), z};
}

std::vector<Vector3> fillLattice(const LiquidBody& body, double spacing, const SourceLocation& where)
{
    const double exact = body.volume()/(spacing*spacing*spacing);
    if (exact > maxParticles)
    {
        std::ostringstream found;
        found << "The body has a volume of " << body.volume() << " m3, which is " << exact << " particles of spacing "
              << spacing << " m";
        throw FatalInputError(where, found.str(), "at most 1e8 particles: lengths in metres, a larger spacing");
    }

    std::vector<Cell> cells = Lattice(body, spacing).cells();
    const std::size_t count = std::min(cells.size(), std::size_t(std::round(exact)));
    if (count == 0)
    {
        std::ostringstream found;
        found << "The body is smaller than the particle spacing of " << spacing << " m: no particle is inside";
        throw FatalInputError(where, found.str(), "a larger body, or a smaller spacing in system/solution");
    }
    std::nth_element(cells.begin(), cells.begin() + (count - 1), cells.end(), [](const Cell& a, const Cell& b)
    {
        return a.inside != b.inside ? a.inside > b.inside : a.lot < b.lot;
    });
    cells.resize(count);
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.index < b.index; });

    std::vector<Vector3> points;
    points.reserve(count);
    for (const Cell& cell : cells) points.push_back(cell.middle);
    return points;
}

}
