// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/PolygonTriangles.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// Ears are cut off one by one: corners that look outward, with no other corner in their triangle, as seen along the
// polygon's area vector.
class EarClipping
{
public:
    EarClipping(const std::vector<Vector3>& points, const std::vector<int>& corners) : corners_(corners)
    {
        const Vector3 origin = points[corners[0]];
        Vector3 area;
        double extent = 0;
        for (std::size_t k = 0; k < corners.size(); ++k)
        {
            const Vector3 a = points[corners[k]] - origin, b = points[corners[(k + 1) % corners.size()]] - origin;
            area += cross(a, b);
            extent = std::max(extent, squaredLength(a));
        }
        const Vector3 normal = length(area) > 0 ? normalized(area) : Vector3(0, 0, 1);
        const Vector3 u = perpendicular(normal), v = cross(normal, u);
        for (const int corner : corners)
        {
            const Vector3 r = points[corner] - origin;
            places_.push_back({dot(r, u), dot(r, v)});
            left_.push_back(left_.size());
        }
        straight_ = 1e-12*extent;       // corners on a line, but for rounding
    }

    std::vector<std::array<int, 3>> triangles()
    {
        std::vector<std::array<int, 3>> result;
        while (left_.size() > 3)
        {
            const std::size_t ear = findEar();
            result.push_back(triangleAt(ear));
            left_.erase(left_.begin() + long(ear));
        }
        result.push_back({corners_[left_[0]], corners_[left_[1]], corners_[left_[2]]});
        return result;
    }

private:
    using Place = std::array<double, 2>;

    static double turn(const Place& a, const Place& b, const Place& c)
    {
        return (b[0] - a[0])*(c[1] - a[1]) - (b[1] - a[1])*(c[0] - a[0]);
    }

    std::size_t before(std::size_t k) const { return (k + left_.size() - 1) % left_.size(); }
    std::size_t behind(std::size_t k) const { return (k + 1) % left_.size(); }
    const Place& place(std::size_t k) const { return places_[left_[k]]; }
    double turnAt(std::size_t k) const { return turn(place(before(k)), place(k), place(behind(k))); }

    std::array<int, 3> triangleAt(std::size_t k) const
    {
        return {corners_[left_[before(k)]], corners_[left_[k]], corners_[left_[behind(k)]]};
    }

    // The first ear from the second corner on.
    std::size_t findEar() const
    {
        std::size_t widest = 1;
        for (std::size_t step = 1; step <= left_.size(); ++step)
        {
            const std::size_t k = step % left_.size();
            if (turnAt(k) > straight_ && isFree(k)) return k;
            if (turnAt(k) > turnAt(widest)) widest = k;
        }
        return widest;
    }

    bool isFree(std::size_t ear) const
    {
        const Place &a = place(before(ear)), &b = place(ear), &c = place(behind(ear));
        for (std::size_t k = 0; k < left_.size(); ++k)
        {
            const Place& p = place(k);
            if (p == a || p == b || p == c || turnAt(k) > straight_) continue;      // others that look outward cannot be first
            if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
        }
        return true;
    }

    const std::vector<int>& corners_;
    std::vector<Place> places_;             // of the corners, in the polygon's plane
    std::vector<std::size_t> left_;         // corners that are not cut off yet
    double straight_ = 0;
};

}

std::vector<std::array<int, 3>> trianglesOf(const std::vector<Vector3>& points, const std::vector<int>& corners)
{
    return EarClipping(points, corners).triangles();
}

}
