// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/SurfaceRepair.H"

#include "core/messages/Error.H"
#include "meshes/Bounds.H"
#include "sampling/CrackClosing.H"
#include "sampling/ShellUnion.H"
#include "sampling/SurfaceMesh.H"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

namespace shizuku
{

namespace
{

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = RepairKernel;
using Mesh = RepairMesh;
using Face = Mesh::Face_index;

// Vertices nearer than this part of the surface's extent are one: single precision, as in a binary STL, cannot tell them
// apart.
constexpr double mergeTolerance = 1e-7;

// Borders nearer than this part of the widest hole that is closed are the two sides of a crack: a tenth of a spacing, where
// holes of four spacings are closed.
constexpr double crackWidth = 0.025;

Vector3 toVector(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

std::string count(std::size_t n, const std::string& what, const std::string& done)
{
    return std::to_string(n) + " " + what + (n == 1 ? " " : "s ") + done;
}

// The diagonal of the box around some points, m.
double extentOf(const std::vector<Vector3>& points) { return length(boundsOf(points).size()); }

// The triangle soup with shared vertices, each triangle once.
class Cleaning
{
public:
    Cleaning(const PatchedSurface& input, double tolerance, std::vector<std::string>& report)
    {
        mergeVertices(input.mesh, tolerance);
        std::set<std::array<std::size_t, 3>> seen;
        std::size_t degenerate = 0, duplicate = 0;
        for (std::size_t f = 0; f < input.mesh.faces.size(); ++f)
        {
            std::array<std::size_t, 3> face;
            for (int k = 0; k < 3; ++k) face[k] = vertex_[input.mesh.faces[f][k]];
            std::array<std::size_t, 3> sorted = face;
            std::sort(sorted.begin(), sorted.end());
            if (height(face) <= tolerance) ++degenerate;
            else if (!seen.insert(sorted).second) ++duplicate;
            else
            {
                faces.push_back(face);
                patch.push_back(input.patch[f]);
            }
        }
        if (degenerate > 0) report.push_back(count(degenerate, "degenerate triangle", "removed"));
        if (duplicate > 0) report.push_back(count(duplicate, "duplicate triangle", "removed"));
        if (const std::size_t n = crowdedEdges()) report.push_back(count(n, "edge", "of more than two triangles cut apart"));
    }

    std::vector<Kernel::Point_3> points;
    std::vector<std::array<std::size_t, 3>> faces;
    std::vector<int> patch;

private:
    void mergeVertices(const TriangleMesh& mesh, double tolerance)
    {
        std::map<std::array<long long, 3>, std::size_t> places;
        for (const Vector3& v : mesh.vertices)
        {
            std::array<long long, 3> cell;
            for (int c = 0; c < 3; ++c) cell[c] = std::llround(v[c]/tolerance);
            const auto [place, isNew] = places.emplace(cell, points.size());
            if (isNew) points.emplace_back(v.x, v.y, v.z);
            vertex_.push_back(place->second);
        }
    }

    // How many edges belong to more than two triangles.
    std::size_t crowdedEdges() const
    {
        std::vector<std::pair<std::size_t, std::size_t>> edges;
        for (const auto& face : faces)
        {
            for (int k = 0; k < 3; ++k) edges.push_back(std::minmax(face[k], face[(k + 1) % 3]));
        }
        std::sort(edges.begin(), edges.end());
        std::size_t crowded = 0;
        for (std::size_t i = 0, j = 0; i < edges.size(); i = j)
        {
            while (j < edges.size() && edges[j] == edges[i]) ++j;
            if (j - i > 2) ++crowded;
        }
        return crowded;
    }

    // The smallest height of a triangle: zero also where all corners are on a line.
    double height(const std::array<std::size_t, 3>& face) const
    {
        const Vector3 a = toVector(points[face[0]]), b = toVector(points[face[1]]), c = toVector(points[face[2]]);
        const double longest = std::sqrt(std::max({squaredLength(b - a), squaredLength(c - b), squaredLength(a - c)}));
        return longest > 0 ? length(cross(b - a, c - a))/longest : 0;
    }

    std::vector<std::size_t> vertex_;   // of each vertex of the input
};

Vector3 areaVector(const std::vector<Kernel::Point_3>& points, const std::array<std::size_t, 3>& face)
{
    const Vector3 a = toVector(points[face[0]]), b = toVector(points[face[1]]), c = toVector(points[face[2]]);
    return 0.5*cross(b - a, c - a);
}

// A mesh whose triangles agree, turned as most of the area of each piece was. Its faces have the order of soup.faces.
Mesh orient(Cleaning& soup, std::vector<std::string>& report)
{
    std::vector<Vector3> before;
    for (const auto& face : soup.faces) before.push_back(areaVector(soup.points, face));
    const bool cut = !PMP::orient_polygon_soup(soup.points, soup.faces);
    const auto isCrowded = [](const std::string& line) { return line.find("of more than two") != line.npos; };
    if (cut && std::none_of(report.begin(), report.end(), isCrowded))
    {
        report.push_back("pieces that touch in a vertex, or that cannot agree on a side, cut apart");
    }
    Mesh mesh;
    PMP::polygon_soup_to_polygon_mesh(soup.points, soup.faces, mesh);

    auto piece = mesh.add_property_map<Face, std::size_t>("f:piece", 0).first;
    const std::size_t pieces = PMP::connected_components(mesh, piece);
    std::vector<double> kept(pieces, 0), turned(pieces, 0);
    std::vector<std::size_t> keptFaces(pieces, 0), turnedFaces(pieces, 0);
    for (const Face face : mesh.faces())
    {
        const Vector3 now = areaVector(soup.points, soup.faces[face]);
        const bool same = dot(now, before[face]) > 0;
        (same ? kept : turned)[piece[face]] += length(now);
        ++(same ? keptFaces : turnedFaces)[piece[face]];
    }
    std::size_t flipped = 0;
    std::vector<Face> toReverse;
    for (std::size_t p = 0; p < pieces; ++p) flipped += turned[p] > kept[p] ? keptFaces[p] : turnedFaces[p];
    for (const Face face : mesh.faces())
    {
        if (turned[piece[face]] > kept[piece[face]]) toReverse.push_back(face);
    }
    PMP::reverse_face_orientations(toReverse, mesh);
    if (flipped > 0) report.push_back(count(flipped, "flipped triangle", "turned to agree with the others"));
    return mesh;
}

// How wide the hole is that a border goes around, m.
double widthOf(const Mesh& mesh, Mesh::Halfedge_index border)
{
    std::vector<Vector3> points;
    for (const auto h : CGAL::halfedges_around_face(border, mesh)) points.push_back(toVector(mesh.point(mesh.target(h))));
    return extentOf(points);
}

// Closes the small holes; the new triangles belong to the patch of a neighbour.
void closeHoles(Mesh& mesh, RepairPatches& patch, double largest, std::vector<std::string>& report)
{
    std::vector<Mesh::Halfedge_index> borders;
    PMP::extract_boundary_cycles(mesh, std::back_inserter(borders));
    std::size_t closed = 0, open = 0;
    double widest = 0;
    for (const auto border : borders)
    {
        std::vector<Face> added;
        const double width = widthOf(mesh, border);
        if (width < largest)
        {
            const int neighbourPatch = patch[mesh.face(mesh.opposite(border))];
            PMP::triangulate_hole(mesh, border, std::back_inserter(added));
            for (const Face face : added) patch[face] = neighbourPatch;
        }
        ++(added.empty() ? open : closed);
        if (added.empty()) widest = std::max(widest, width);
    }
    if (closed > 0) report.push_back(count(closed, "small hole", "closed"));
    if (open == 0) return;
    std::ostringstream done;
    done << "left open" << (open > 1 ? ", the widest " : ", ") << widest << " m wide";
    report.push_back(count(open, "open border", done.str()));
}

PatchedSurface collect(const Mesh& mesh, const RepairPatches& patch, std::vector<std::string> patches)
{
    PatchedSurface surface;
    surface.patches = std::move(patches);
    for (const auto vertex : mesh.vertices()) surface.mesh.vertices.push_back(toVector(mesh.point(vertex)));
    for (const Face face : mesh.faces())
    {
        std::array<int, 3> corners;
        int k = 0;
        for (const auto vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh)) corners[k++] = vertex.idx();
        surface.mesh.faces.push_back(corners);
        surface.patch.push_back(patch[face]);
    }
    return surface;
}

}

RepairedSurface repairSurface(const PatchedSurface& input, double largestHole, const std::string& file)
{
    RepairedSurface result;
    const double extent = extentOf(input.mesh.vertices);
    std::vector<std::string>& report = result.report;
    if (!(extent > 0)) throw FatalInputError({file, 0}, "All vertices of the surface are one point");

    Cleaning soup(input, mergeTolerance*extent, report);
    if (soup.faces.empty()) throw FatalInputError({file, 0}, "Every triangle of the surface is degenerate");

    Mesh mesh = orient(soup, report);
    RepairPatches patch = patchesOf(mesh);
    for (const Face face : mesh.faces()) patch[face] = soup.patch[face];
    const std::size_t joined = closeCracks(mesh, crackWidth*largestHole);
    if (joined > 0) report.push_back(count(joined, "edge", "along cracks joined"));
    closeHoles(mesh, patch, std::min(largestHole, 0.5*extent), report);
    uniteShells(mesh, report);
    result.surface = collect(mesh, patchesOf(mesh), input.patches);
    auto shell = mesh.add_property_map<Face, std::size_t>("f:shell", 0).first;
    result.shells = PMP::connected_components(mesh, shell);
    result.closed = CGAL::is_closed(mesh);
    return result;
}

}
