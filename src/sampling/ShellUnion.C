// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/ShellUnion.H"

#include "meshes/PointsInside.H"
#include "sampling/TouchingFaces.H"

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <iterator>
#include <utility>

namespace shizuku
{

namespace
{

namespace PMP = CGAL::Polygon_mesh_processing;
using Face = RepairMesh::Face_index;

// Every pair of shells is looked at.
constexpr std::size_t mostShells = 200;

// Hands the patch of a face on to the pieces that it is cut into, and to its copy in the united mesh.
class PatchKeeper : public PMP::Corefinement::Default_visitor<RepairMesh>
{
public:
    void before_subface_creations(Face cut, const RepairMesh& mesh) { patch_ = patchesIn(mesh)[cut]; }
    void after_subface_created(Face piece, const RepairMesh& mesh) { patchesIn(mesh)[piece] = patch_; }
    void after_face_copy(Face from, const RepairMesh& source, Face to, const RepairMesh& target)
    {
        patchesIn(target)[to] = patchesIn(source)[from];
    }

private:
    static RepairPatches patchesIn(const RepairMesh& mesh) { return mesh.property_map<Face, int>("f:patch").first; }

    int patch_ = 0;
};

RepairMesh copyOf(const RepairMesh& mesh)
{
    RepairMesh copy = mesh;
    copy.collect_garbage();
    return copy;
}

// The connected pieces, each a mesh with its patches.
std::vector<RepairMesh> split(RepairMesh& mesh)
{
    const auto piece = mesh.add_property_map<Face, std::size_t>("f:shell", 0).first;
    const std::size_t count = PMP::connected_components(mesh, piece);
    std::vector<RepairMesh> shells;
    for (std::size_t s = 0; s < count && count <= mostShells; ++s)
    {
        RepairMesh shell = mesh;
        PMP::keep_connected_components(shell, std::vector<std::size_t>{s}, shell.property_map<Face, std::size_t>("f:shell").first);
        shells.push_back(copyOf(shell));
    }
    return shells;
}

bool canBeUnited(const RepairMesh& shell)
{
    return CGAL::is_closed(shell) && touchingFaces(shell).empty() && PMP::does_bound_a_volume(shell);
}

// a becomes the union of a and b; false and no change where CGAL cannot do it.
bool unite(RepairMesh& a, const RepairMesh& b)
{
    RepairMesh first = a, second = b, both;
    patchesOf(both);
    if (!PMP::corefine_and_compute_union(first, second, both, PMP::parameters::visitor(PatchKeeper()))) return false;
    a = copyOf(both);
    return true;
}

// A triangle drawn together a little towards its centre: what it only touched it leaves.
RepairKernel::Triangle_3 core(const RepairMesh& mesh, Face face)
{
    constexpr double shrink = 1e-4;
    std::array<RepairKernel::Point_3, 3> corners;
    std::size_t k = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(face), mesh)) corners[k++] = mesh.point(v);
    const auto centre = CGAL::centroid(corners[0], corners[1], corners[2]);
    for (auto& corner : corners) corner = corner + shrink*(centre - corner);
    return {corners[0], corners[1], corners[2]};
}

Vector3 toVector(const RepairKernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

// Of a closed mesh that crosses itself: cuts the triangles along the crossings, and drops those that have the solid on both
// sides, by the winding number in front of them and behind. False and no change where CGAL cannot do it.
bool removeInside(RepairMesh& mesh)
{
    RepairMesh cut = mesh;
    try
    {
        PMP::experimental::autorefine(cut, PMP::parameters::visitor(PatchKeeper()));
    }
    catch (const std::exception&)       // crossings of crossings that rounding tears apart
    {
        return false;
    }
    cut = copyOf(cut);

    TriangleMesh all;
    for (const auto v : cut.vertices()) all.vertices.push_back(toVector(cut.point(v)));
    for (const Face face : cut.faces())
    {
        int k = 0;
        all.faces.emplace_back();
        for (const auto v : CGAL::vertices_around_face(cut.halfedge(face), cut)) all.faces.back()[k++] = int(v.idx());
    }
    constexpr double step = 1e-7;       // of the extent: as near as vertices are told apart
    const double distance = step*std::cbrt(std::abs(all.volume()));
    const int inside = all.volume() > 0 ? 1 : -1;
    const WindingNumber winding(all);
    const auto isInside = [&](const Vector3& x) { return inside*winding(x) >= 1; };

    std::vector<RepairKernel::Point_3> points(cut.points().begin(), cut.points().end());
    std::vector<std::vector<std::size_t>> faces;
    std::vector<int> patch;
    const RepairPatches patches = patchesOf(cut);
    for (const Face face : cut.faces())
    {
        const auto& [i, j, k] = all.faces[face];
        const Vector3 &a = all.vertices[i], &b = all.vertices[j], &c = all.vertices[k];
        const Vector3 normal = cross(b - a, c - a), centre = (a + b + c)/3;
        if (!(length(normal) > 0)) continue;
        const Vector3 aside = distance/length(normal)*normal;
        if (isInside(centre + aside) == isInside(centre - aside)) continue;
        faces.push_back({std::size_t(i), std::size_t(j), std::size_t(k)});
        patch.push_back(patches[face]);
    }
    PMP::merge_duplicate_points_in_polygon_soup(points, faces);
    PMP::orient_polygon_soup(points, faces);
    RepairMesh outside;
    PMP::polygon_soup_to_polygon_mesh(points, faces, outside);
    if (!CGAL::is_closed(outside) || !crossingFaces(outside).empty()) return false;
    const RepairPatches kept = patchesOf(outside);
    for (const Face face : outside.faces()) kept[face] = patch[face];
    mesh = std::move(outside);
    return true;
}

RepairMesh join(const std::vector<RepairMesh>& shells)
{
    RepairMesh all;
    const RepairPatches patches = patchesOf(all);
    for (const RepairMesh& shell : shells)
    {
        const auto from = shell.property_map<Face, int>("f:patch").first;
        std::vector<std::pair<Face, Face>> faces;
        CGAL::copy_face_graph(shell, all, CGAL::parameters::face_to_face_output_iterator(std::back_inserter(faces)));
        for (const auto& [old, copy] : faces) patches[copy] = from[old];
    }
    return all;
}

}

std::vector<std::pair<Face, Face>> crossingFaces(const RepairMesh& mesh)
{
    std::vector<std::pair<Face, Face>> touching = touchingFaces(mesh);
    std::erase_if(touching, [&](const std::pair<Face, Face>& pair)
    {
        return !CGAL::do_intersect(core(mesh, pair.first), core(mesh, pair.second));
    });
    return touching;
}

void uniteShells(RepairMesh& mesh, std::vector<std::string>& report)
{
    if (touchingFaces(mesh).empty()) return;

    std::vector<RepairMesh> shells = split(mesh);
    std::vector<bool> usable;
    for (const RepairMesh& shell : shells) usable.push_back(canBeUnited(shell));
    std::size_t united = 0;
    for (std::size_t a = 0; a < shells.size(); ++a)
    {
        for (std::size_t b = a + 1; b < shells.size();)
        {
            const bool done = usable[a] && usable[b] && PMP::do_intersect(shells[a], shells[b]) && unite(shells[a], shells[b]);
            if (!done)
            {
                ++b;
                continue;
            }
            ++united;
            shells.erase(shells.begin() + long(b));
            usable.erase(usable.begin() + long(b));
            b = a + 1;      // the larger shell may reach those that were passed
        }
    }
    if (united > 0)
    {
        mesh = join(shells);
        report.push_back(std::to_string(united + 1) + " shells that cross each other united");
    }

    const std::size_t pairs = crossingFaces(mesh).size();
    if (pairs == 0) return;
    const std::string found = std::to_string(pairs) + (pairs == 1 ? " pair" : " pairs") + " of triangles that cross each other";
    if (CGAL::is_closed(mesh) && removeInside(mesh)) report.push_back(found + " cut, and what lay inside of the solid removed");
    else report.push_back(found + " left: what lies inside of the solid is sampled too");
}

}
