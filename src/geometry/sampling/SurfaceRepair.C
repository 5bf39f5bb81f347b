#include "geometry/sampling/SurfaceRepair.H"

#include "core/messages/Error.H"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace shizuku
{

namespace
{

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Face = Mesh::Face_index;

// Vertices nearer than this part of the surface's extent are one: single precision, as in a binary STL, cannot tell them
// apart.
constexpr double mergeTolerance = 1e-7;

Vector3 toVector(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

std::string count(std::size_t n, const std::string& what, const std::string& done)
{
    return std::to_string(n) + " " + what + (n == 1 ? " " : "s ") + done;
}

double extentOf(const TriangleMesh& mesh)
{
    Vector3 low = mesh.vertices.front(), high = low;
    for (const Vector3& v : mesh.vertices)
    {
        for (int c = 0; c < 3; ++c)
        {
            low[c] = std::min(low[c], v[c]);
            high[c] = std::max(high[c], v[c]);
        }
    }
    return length(high - low);
}

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
    if (!PMP::orient_polygon_soup(soup.points, soup.faces))
    {
        report.push_back("edges of more than two triangles cut");
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

double borderLength(const Mesh& mesh, Mesh::Halfedge_index start)
{
    double sum = 0;
    for (const auto h : CGAL::halfedges_around_face(start, mesh))
    {
        sum += length(toVector(mesh.point(mesh.target(h))) - toVector(mesh.point(mesh.source(h))));
    }
    return sum;
}

// Closes the small holes; the new triangles belong to the patch of a neighbour.
void closeHoles(Mesh& mesh, Mesh::Property_map<Face, int>& patch, double largest, std::vector<std::string>& report)
{
    std::vector<Mesh::Halfedge_index> borders;
    PMP::extract_boundary_cycles(mesh, std::back_inserter(borders));
    std::size_t closed = 0, open = 0;
    for (const auto border : borders)
    {
        std::vector<Face> added;
        if (borderLength(mesh, border) < largest)
        {
            const int neighbourPatch = patch[mesh.face(mesh.opposite(border))];
            PMP::triangulate_hole(mesh, border, std::back_inserter(added));
            for (const Face face : added) patch[face] = neighbourPatch;
        }
        ++(added.empty() ? open : closed);
    }
    if (closed > 0) report.push_back(count(closed, "small hole", "closed"));
    if (open > 0) report.push_back(count(open, "open border", "left open"));
}

PatchedSurface collect(const Mesh& mesh, const Mesh::Property_map<Face, int>& patch, std::vector<std::string> patches)
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
    const double extent = extentOf(input.mesh);
    std::vector<std::string>& report = result.report;
    if (!(extent > 0)) throw FatalInputError({file, 0}, "All vertices of the surface are one point");

    Cleaning soup(input, mergeTolerance*extent, report);
    if (soup.faces.empty()) throw FatalInputError({file, 0}, "Every triangle of the surface is degenerate");

    Mesh mesh = orient(soup, report);
    auto patch = mesh.add_property_map<Face, int>("f:patch", 0).first;
    for (const Face face : mesh.faces()) patch[face] = soup.patch[face];
    closeHoles(mesh, patch, std::min(largestHole, 0.5*extent), report);
    result.surface = collect(mesh, patch, input.patches);
    return result;
}

}
