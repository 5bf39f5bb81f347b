// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/NearestPoint.H"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <utility>

namespace shizuku
{

namespace
{
    namespace bg = boost::geometry;
    using Point = bg::model::point<double, 3, bg::cs::cartesian>;
    using Entry = std::pair<Point, std::size_t>;

    std::vector<Entry> entries(const std::vector<Vector3>& points)
    {
        std::vector<Entry> result;
        result.reserve(points.size());
        for (const Vector3& p : points) result.emplace_back(Point(p.x, p.y, p.z), result.size());
        return result;
    }
}

struct NearestPoint::Tree
{
    bg::index::rtree<Entry, bg::index::linear<8>> points;
};

NearestPoint::NearestPoint(const std::vector<Vector3>& points) : tree_(new Tree{decltype(Tree::points)(entries(points))})
{}

NearestPoint::~NearestPoint() = default;

std::size_t NearestPoint::operator()(const Vector3& x) const
{
    return tree_->points.qbegin(bg::index::nearest(Point(x.x, x.y, x.z), 1))->second;
}

std::optional<std::size_t> NearestPoint::within(const Vector3& x, double reach) const
{
    const bg::model::box<Point> around(Point(x.x - reach, x.y - reach, x.z - reach), Point(x.x + reach, x.y + reach, x.z + reach));
    const Point centre(x.x, x.y, x.z);
    const auto found = tree_->points.qbegin(bg::index::intersects(around) && bg::index::nearest(centre, 1));
    if (found == tree_->points.qend() || bg::comparable_distance(found->first, centre) > reach*reach) return {};
    return found->second;
}

std::vector<std::size_t> NearestPoint::operator()(const Vector3& x, std::size_t count) const
{
    std::vector<std::size_t> result;
    for
    (
        auto found = tree_->points.qbegin(bg::index::nearest(Point(x.x, x.y, x.z), unsigned(count)));
        found != tree_->points.qend(); ++found
    )
    {
        result.push_back(found->second);
    }
    return result;
}

}
