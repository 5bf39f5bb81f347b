// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/CrackClosing.H"

#include <CGAL/Polygon_mesh_processing/internal/Snapping/snap.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

namespace PMP = CGAL::Polygon_mesh_processing;
using Halfedge = RepairMesh::Halfedge_index;
using Tolerances = RepairMesh::Property_map<RepairMesh::Vertex_index, double>;

// A vertex that moves further could meet its neighbour.
constexpr double partOfEdge = 0.4;

// Hands the patch of a face on to the half that is cut off.
struct PatchKeeper : PMP::internal::Snapping_default_visitor<RepairMesh>
{
    void after_split_face(Halfedge one, Halfedge other, RepairMesh& mesh)
    {
        RepairPatches patches = patchesOf(mesh);
        const auto [old, added] = std::minmax({mesh.face(one), mesh.face(other)});
        patches[added] = patches[old];
    }
};

Tolerances tolerancesOf(RepairMesh& mesh, double width)
{
    Tolerances tolerance = mesh.add_property_map<RepairMesh::Vertex_index, double>("v:tolerance", width).first;
    for (const Halfedge h : mesh.halfedges())
    {
        if (!mesh.is_border(h)) continue;
        const auto from = mesh.source(h), to = mesh.target(h);
        const double reach = partOfEdge*std::sqrt(CGAL::squared_distance(mesh.point(from), mesh.point(to)));
        tolerance[from] = std::min(tolerance[from], reach);
        tolerance[to] = std::min(tolerance[to], reach);
    }
    return tolerance;
}

}

std::size_t closeCracks(RepairMesh& mesh, double width)
{
    if (!(width > 0) || CGAL::is_closed(mesh)) return 0;
    Tolerances tolerance = tolerancesOf(mesh, width);
    PatchKeeper keeper;
    PMP::experimental::snap_borders(mesh, tolerance, CGAL::parameters::visitor(keeper));
    mesh.remove_property_map(tolerance);
    const std::size_t joined = PMP::stitch_borders(mesh);
    mesh.collect_garbage();
    return joined;
}

}
