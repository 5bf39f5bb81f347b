// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquidBodies/CloseBoxes.H"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <utility>

namespace shizuku
{

namespace
{
    namespace bg = boost::geometry;
    using Point = bg::model::point<double, 3, bg::cs::cartesian>;
    using Box = bg::model::box<Point>;
    using Entry = std::pair<Box, std::size_t>;

    Point point(const Vector3& x) { return {x.x, x.y, x.z}; }
}

std::vector<std::vector<std::size_t>> earlierBoxesThatMeet(const std::vector<Bounds>& boxes)
{
    std::vector<Entry> entries;
    for (const Bounds& box : boxes) entries.emplace_back(Box(point(box.low), point(box.high)), entries.size());
    const bg::index::rtree<Entry, bg::index::linear<8>> tree(entries);

    std::vector<std::vector<std::size_t>> result(boxes.size());
    for (const auto& [box, index] : entries)
    {
        for (auto met = tree.qbegin(bg::index::intersects(box)); met != tree.qend(); ++met)
        {
            if (met->second < index) result[index].push_back(met->second);
        }
        std::sort(result[index].begin(), result[index].end());
    }
    return result;
}

}
