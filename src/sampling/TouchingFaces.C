// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/TouchingFaces.H"

#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace shizuku
{

namespace
{

using Face = RepairMesh::Face_index;
using Vertex = RepairMesh::Vertex_index;
using Point = RepairKernel::Point_3;
using Vector = RepairKernel::Vector_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Face>;

// Triangles round a vertex from which on the vertex is crowded. All boxes of triangles round it overlap: boxes of what is seen from it tell
// more, but cost some for each.
constexpr std::size_t crowd = 30;

std::array<Vertex, 3> cornersOf(const RepairMesh& mesh, Face face)
{
    const auto h = mesh.halfedge(face);
    return {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
}

std::size_t trianglesRound(const RepairMesh& mesh, Vertex v)
{
    std::size_t count = 0;
    for (const Face face : CGAL::faces_around_target(mesh.halfedge(v), mesh)) count += face != RepairMesh::null_face();
    return count;
}

// a's corners with those that are b's too first; how many they are.
std::size_t sharedFirst(std::array<Vertex, 3>& a, const std::array<Vertex, 3>& b)
{
    const auto shared = [&](Vertex v) { return std::find(b.begin(), b.end(), v) != b.end(); };
    return std::size_t(std::stable_partition(a.begin(), a.end(), shared) - a.begin());
}

bool touch(const RepairMesh& mesh, Face first, Face second)
{
    std::array<Vertex, 3> a = cornersOf(mesh, first), b = cornersOf(mesh, second);
    const std::size_t shared = sharedFirst(a, b);
    sharedFirst(b, a);
    const auto at = [&](Vertex v) -> const Point& { return mesh.point(v); };
    const RepairKernel::Triangle_3 s(at(a[0]), at(a[1]), at(a[2])), t(at(b[0]), at(b[1]), at(b[2]));
    switch (shared)
    {
        case 0: return CGAL::do_intersect(s, t);
        case 1: return CGAL::do_intersect(s, RepairKernel::Segment_3(at(b[1]), at(b[2])))
            || CGAL::do_intersect(t, RepairKernel::Segment_3(at(a[1]), at(a[2])));
        case 2: return CGAL::coplanar(at(a[0]), at(a[1]), at(a[2]), at(b[2]))
            && CGAL::coplanar_orientation(at(a[0]), at(a[1]), at(a[2]), at(b[2])) == CGAL::POSITIVE;
        default: return true;
    }
}

// The arc of a triangle as it is seen from one of its corners, on a ball of radius 1. Triangles that have that corner in common meet
// beside it where their arcs do.
CGAL::Bbox_3 arcOf(const RepairMesh& mesh, Face face, Vertex from)
{
    std::array<Vector, 2> ways;
    std::size_t k = 0;
    for (const Vertex v : cornersOf(mesh, face))
    {
        if (v == from) continue;
        const Vector way = mesh.point(v) - mesh.point(from);
        ways[k++] = way/std::sqrt(way.squared_length());
    }
    // No point of the arc is farther from its chord than its middle is; and rounding.
    const double squaredHalf = (ways[1] - ways[0]).squared_length()/4, margin = 1 - std::sqrt(std::max(0.0, 1 - squaredHalf)) + 1e-12;
    if (!(margin <= 2)) return {-2, -2, -2, 2, 2, 2};      // a side without a length
    const auto low = [&](int i) { return std::min(ways[0][i], ways[1][i]) - margin; };
    const auto high = [&](int i) { return std::max(ways[0][i], ways[1][i]) + margin; };
    return {low(0), low(1), low(2), high(0), high(1), high(2)};
}

}

std::vector<std::pair<Face, Face>> touchingFaces(const RepairMesh& mesh)
{
    std::vector<std::pair<Face, Face>> found;
    const auto note = [&](Face a, Face b)
    {
        if (touch(mesh, a, b)) found.emplace_back(a, b);
    };

    std::vector<bool> crowded(mesh.num_vertices() + mesh.number_of_removed_vertices());
    std::vector<Box> arcs;
    for (const Vertex v : mesh.vertices())
    {
        if (mesh.is_isolated(v) || trianglesRound(mesh, v) < crowd) continue;
        crowded[v] = true;
        arcs.clear();
        for (const Face face : CGAL::faces_around_target(mesh.halfedge(v), mesh))
        {
            if (face != RepairMesh::null_face()) arcs.emplace_back(arcOf(mesh, face, v), face);
        }
        // What shares two crowded vertices is the first one's.
        CGAL::box_self_intersection_d(arcs.begin(), arcs.end(), [&](const Box& a, const Box& b)
        {
            const auto others = cornersOf(mesh, b.info());
            const auto isFirst = [&](Vertex w)
            {
                return w < v && crowded[w] && std::find(others.begin(), others.end(), w) != others.end();
            };
            const auto corners = cornersOf(mesh, a.info());
            if (std::none_of(corners.begin(), corners.end(), isFirst)) note(a.info(), b.info());
        });
    }

    std::vector<Box> boxes;
    boxes.reserve(mesh.number_of_faces());
    for (const Face face : mesh.faces())
    {
        CGAL::Bbox_3 box;
        for (const Vertex v : cornersOf(mesh, face)) box += mesh.point(v).bbox();
        boxes.emplace_back(box, face);
    }
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b)
    {
        const auto corners = cornersOf(mesh, a.info()), others = cornersOf(mesh, b.info());
        const auto isDone = [&](Vertex v) { return crowded[v] && std::find(others.begin(), others.end(), v) != others.end(); };
        if (std::none_of(corners.begin(), corners.end(), isDone)) note(a.info(), b.info());
    });
    return found;
}

}
