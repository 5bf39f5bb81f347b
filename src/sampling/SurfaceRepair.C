// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/SurfaceRepair.H"

#include "core/messages/Error.H"
#include "meshes/Bounds.H"
#include "meshes/PointsInside.H"
#include "sampling/BodyUnion.H"
#include "sampling/CrackClosing.H"
#include "sampling/ShellUnion.H"
#include "sampling/SurfaceMesh.H"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
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

// The triangle soup with shared vertices, each triangle once, without walls between solids that touch.
class Cleaning
{
public:
    Cleaning(const PatchedSurface& input, double tolerance, std::vector<std::string>& report)
    {
        mergeVertices(input.mesh, tolerance);
        std::map<std::array<std::size_t, 3>, std::size_t> places;       // of the first copy of each triangle
        std::size_t degenerate = 0, duplicate = 0;
        for (std::size_t f = 0; f < input.mesh.faces.size(); ++f)
        {
            std::array<std::size_t, 3> face;
            for (int k = 0; k < 3; ++k) face[k] = vertex_[input.mesh.faces[f][k]];
            std::array<std::size_t, 3> sorted = face;
            std::sort(sorted.begin(), sorted.end());
            if (height(face) <= tolerance)
            {
                ++degenerate;
                continue;
            }
            const auto [place, isNew] = places.emplace(sorted, faces.size());
            if (isNew)
            {
                faces.push_back(face);
                patch.push_back(input.patch[f]);
                copies_.push_back(1);
            }
            else if (++copies_[place->second] > 2) ++duplicate;
        }
        const auto [left, pairs] = removeSharedWalls();
        duplicate += left;
        const std::size_t walls = 2*pairs + removeBetweenSolids(tolerance);
        if (degenerate > 0) report.push_back(count(degenerate, "degenerate triangle", "removed"));
        if (duplicate > 0) report.push_back(count(duplicate, "duplicate triangle", "removed"));
        if (walls > 0) report.push_back(count(walls, "triangle", "between solids that touch removed"));
        const std::size_t n = crowdedEdges();
        branches = n > 0;
        if (branches) report.push_back(count(n, "edge", "of more than two triangles cut apart"));
    }

    std::vector<Kernel::Point_3> points;
    std::vector<std::array<std::size_t, 3>> faces;
    std::vector<int> patch;
    bool branches = false;                  // edges belong to more than two triangles

private:
    // Cells are larger than the tolerance. A vertex near a cell's border looks for its like behind the border too.
    void mergeVertices(const TriangleMesh& mesh, double tolerance)
    {
        using Cell = std::array<long long, 3>;
        const double edge = 8*tolerance;
        std::map<Cell, std::vector<std::size_t>> places;
        for (const Vector3& v : mesh.vertices)
        {
            Cell low, high;
            for (int c = 0; c < 3; ++c)
            {
                low[c] = std::llround((v[c] - tolerance)/edge);
                high[c] = std::llround((v[c] + tolerance)/edge);
            }
            std::optional<std::size_t> same;
            for (long long i = low[0]; i <= high[0] && !same; ++i)
            for (long long j = low[1]; j <= high[1] && !same; ++j)
            for (long long k = low[2]; k <= high[2] && !same; ++k)
            {
                const auto cell = places.find({i, j, k});
                if (cell == places.end()) continue;
                for (const std::size_t point : cell->second) if (length(toVector(points[point]) - v) <= tolerance) same = point;
            }
            if (!same)
            {
                same = points.size();
                points.emplace_back(v.x, v.y, v.z);
                places[{std::llround(v.x/edge), std::llround(v.y/edge), std::llround(v.z/edge)}].push_back(*same);
            }
            vertex_.push_back(*same);
        }
    }

    // Pieces of triangles that are there twice. Around a wall that two solids share, each of them goes on, with a triangle of its
    // own: both copies are inside of the whole, and go. Elsewhere the surface goes on with one triangle, or ends: one copy stays.
    // How many triangles were left once, and how many went.
    std::pair<std::size_t, std::size_t> removeSharedWalls()
    {
        using Edge = std::pair<std::size_t, std::size_t>;
        struct Around { std::size_t once = 0; std::vector<std::size_t> twice; };
        std::map<Edge, Around> edges;
        const auto edgeOf = [&](std::size_t f, int k) -> Edge { return std::minmax(faces[f][k], faces[f][(k + 1) % 3]); };
        std::vector<std::size_t> doubled;
        for (std::size_t f = 0; f < faces.size(); ++f)
        {
            if (copies_[f] < 2) continue;
            doubled.push_back(f);
            for (int k = 0; k < 3; ++k) edges[edgeOf(f, k)].twice.push_back(f);
        }
        if (doubled.empty()) return {0, 0};
        for (std::size_t f = 0; f < faces.size(); ++f)
        {
            if (copies_[f] >= 2) continue;
            for (int k = 0; k < 3; ++k)
            {
                const auto edge = edges.find(edgeOf(f, k));
                if (edge != edges.end()) ++edge->second.once;
            }
        }

        std::vector<bool> seen(faces.size(), false), inside(faces.size(), false);
        for (const std::size_t first : doubled)
        {
            if (seen[first]) continue;
            std::vector<std::size_t> piece{first};
            seen[first] = true;
            bool even = true, bordered = false;
            for (std::size_t at = 0; at < piece.size(); ++at)
            {
                for (int k = 0; k < 3; ++k)
                {
                    const Around& around = edges[edgeOf(piece[at], k)];
                    even = even && around.once % 2 == 0;
                    bordered = bordered || around.once > 0;
                    if (around.once > 0) continue;          // walls that meet in an edge are judged each for itself
                    for (const std::size_t next : around.twice)
                    {
                        if (seen[next]) continue;
                        seen[next] = true;
                        piece.push_back(next);
                    }
                }
            }
            if (even && bordered) for (const std::size_t f : piece) inside[f] = true;
        }
        const std::size_t removed = remove(inside);
        return {doubled.size() - removed, removed};
    }

    // Walls between solids that touch where either cut them into other triangles: of closed solids that all look outwards, or all
    // inwards, a triangle with solid on both sides is inside of the whole. How many went.
    std::size_t removeBetweenSolids(double tolerance)
    {
        if (crowdedEdges() == 0 || !isBalanced()) return 0;
        TriangleMesh mesh;
        for (const auto& point : points) mesh.vertices.push_back(toVector(point));
        for (const auto& face : faces) mesh.faces.push_back({int(face[0]), int(face[1]), int(face[2])});
        const int solid = mesh.volume() > 0 ? 1 : -1;
        const WindingNumber winding(mesh);
        std::vector<bool> inside(faces.size(), false);
        for (std::size_t f = 0; f < faces.size(); ++f)
        {
            const auto& [i, j, k] = mesh.faces[f];
            const Vector3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
            const Vector3 centre = (a + b + c)/3, aside = tolerance*normalized(cross(b - a, c - a));
            const int before = solid*winding(centre + aside), behind = solid*winding(centre - aside);
            if (std::min(before, behind) < 0 || std::max(before, behind) > 1) return 0;     // solids in each other, or turned
            inside[f] = before == behind;
        }
        return remove(inside);
    }

    // Whether every edge is run through as often one way as the other.
    bool isBalanced() const
    {
        std::map<std::pair<std::size_t, std::size_t>, int> surplus;
        for (const auto& face : faces)
        {
            for (int k = 0; k < 3; ++k)
            {
                const std::size_t from = face[k], to = face[(k + 1) % 3];
                surplus[std::minmax(from, to)] += from < to ? 1 : -1;
            }
        }
        return std::all_of(surplus.begin(), surplus.end(), [](const auto& edge) { return edge.second == 0; });
    }

    // Of the faces those that are marked. How many they are.
    std::size_t remove(const std::vector<bool>& marked)
    {
        std::size_t kept = 0;
        for (std::size_t f = 0; f < faces.size(); ++f)
        {
            if (marked[f]) continue;
            faces[kept] = faces[f];
            patch[kept++] = patch[f];
        }
        const std::size_t removed = faces.size() - kept;
        faces.resize(kept);
        patch.resize(kept);
        return removed;
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
    std::vector<int> copies_;           // of each triangle, before any is removed
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

// Whether a border is a flat sheet's own outline, and no hole in it: it goes around as much area as the sheet has.
bool isOutline(const Mesh& mesh, Mesh::Halfedge_index border)
{
    std::vector<Vector3> points;
    for (const auto h : CGAL::halfedges_around_face(border, mesh)) points.push_back(toVector(mesh.point(mesh.target(h))));
    Vector3 around;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) around += 0.5*cross(points[i] - points[0], points[i + 1] - points[0]);
    std::vector<Face> sheet;
    PMP::connected_component(mesh.face(mesh.opposite(border)), mesh, std::back_inserter(sheet));
    return PMP::area(sheet, mesh) < (1 + 1e-3)*length(around);
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
        if (width < largest && !isOutline(mesh, border))
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

// Without triangles that joining borders has left no area.
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
        const auto at = [&](int corner) -> const Vector3& { return surface.mesh.vertices[corners[corner]]; };
        if (length(cross(at(1) - at(0), at(2) - at(0))) == 0) continue;
        surface.mesh.faces.push_back(corners);
        surface.patch.push_back(patch[face]);
    }
    return surface;
}

}

RepairedSurface repairSurface(const PatchedSurface& input, double largestHole, const std::string& file, Shells shells)
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
    if (shells == Shells::solids) uniteShells(mesh, report);
    else if (CGAL::is_closed(mesh)) uniteBodies(mesh, report, file);
    result.surface = collect(mesh, patchesOf(mesh), input.patches);
    if (result.surface.mesh.faces.empty()) throw FatalInputError({file, 0}, "Every triangle of the surface is degenerate");
    auto shell = mesh.add_property_map<Face, std::size_t>("f:shell", 0).first;
    result.shells = PMP::connected_components(mesh, shell);
    result.closed = CGAL::is_closed(mesh);
    result.branches = soup.branches;
    return result;
}

}
