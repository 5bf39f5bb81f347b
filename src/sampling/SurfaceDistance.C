// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/SurfaceDistance.H"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <iterator>
#include <vector>

namespace shizuku
{

namespace
{
    using Kernel = CGAL::Simple_cartesian<double>;
    using Triangles = std::vector<Kernel::Triangle_3>;
    using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
    using AabbTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
}

struct SurfaceDistance::Tree
{
    Triangles triangles;
    AabbTree tree;
};

SurfaceDistance::SurfaceDistance(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>())
{
    const auto point = [&](int v) -> Kernel::Point_3
    {
        const Vector3& x = mesh.vertices[v];
        return {x.x, x.y, x.z};
    };
    for (const auto& f : mesh.faces) tree_->triangles.emplace_back(point(f[0]), point(f[1]), point(f[2]));
    tree_->tree.insert(tree_->triangles.cbegin(), tree_->triangles.cend());
    tree_->tree.build();
    tree_->tree.accelerate_distance_queries();
}

SurfaceDistance::~SurfaceDistance() = default;

SurfaceDistance::Nearest SurfaceDistance::operator()(const Vector3& x) const
{
    const auto [at, triangle] = tree_->tree.closest_point_and_primitive({x.x, x.y, x.z});
    const Vector3 point(at.x(), at.y(), at.z());
    return {length(x - point), point, int(triangle - tree_->triangles.cbegin())};
}

std::optional<SurfaceDistance::Hit> SurfaceDistance::behind
(
    const Vector3& x, const Vector3& direction, double least, double most
) const
{
    const Vector3 start = x + least*direction, end = x + most*direction;
    const Kernel::Segment_3 way({start.x, start.y, start.z}, {end.x, end.y, end.z});
    std::vector<AabbTree::Intersection_and_primitive_id<Kernel::Segment_3>::Type> met;
    tree_->tree.all_intersections(way, std::back_inserter(met));
    std::optional<Hit> first;
    for (const auto& [at, triangle] : met)
    {
        const auto* point = boost::get<Kernel::Point_3>(&at);
        if (!point) continue;                   // the way lies in the face
        const double distance = least + std::sqrt(CGAL::squared_distance(way.source(), *point));
        if (!first || distance < first->distance) first = Hit{distance, int(triangle - tree_->triangles.cbegin())};
    }
    return first;
}

}
