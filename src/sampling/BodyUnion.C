// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/BodyUnion.H"

#include "core/messages/Error.H"
#include "meshes/Bounds.H"
#include "meshes/PointsInside.H"
#include "sampling/ShellUnion.H"

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace shizuku
{

namespace
{

namespace PMP = CGAL::Polygon_mesh_processing;
using Face = RepairMesh::Face_index;

// A connected piece of the surface.
struct Shell
{
    TriangleMesh mesh;
    std::vector<int> patch;             // of each face
    bool outward = true;

    void reverse()
    {
        for (auto& face : mesh.faces) std::swap(face[0], face[1]);
    }
};

// Shells that cross each other, or one by itself.
struct Group
{
    std::vector<std::size_t> shells;
    std::vector<std::size_t> around;    // shells of other groups that it lies in
    bool crosses = false;               // has faces that cross each other
    bool isLiquid = true;               // inside, next to its surface
    bool isKept = true;                 // its surface bounds the liquid
};

TriangleMesh meshOf(const RepairMesh& mesh)
{
    TriangleMesh result;
    for (const auto v : mesh.vertices())
    {
        const auto& p = mesh.point(v);
        result.vertices.push_back({p.x(), p.y(), p.z()});
    }
    for (const Face face : mesh.faces())
    {
        int k = 0;
        result.faces.emplace_back();
        for (const auto v : CGAL::vertices_around_face(mesh.halfedge(face), mesh)) result.faces.back()[k++] = int(v.idx());
    }
    return result;
}

// Meshes of their own, in the order of their first faces. shellOf: of each face of the mesh.
std::vector<Shell> shellsOf(RepairMesh& mesh, std::vector<std::size_t>& shellOf)
{
    const auto piece = mesh.add_property_map<Face, std::size_t>("f:body", 0).first;
    std::vector<Shell> shells(PMP::connected_components(mesh, piece));
    const RepairPatches patches = patchesOf(mesh);
    const TriangleMesh all = meshOf(mesh);
    std::vector<int> index(all.vertices.size(), -1);
    for (const Face face : mesh.faces())
    {
        shellOf.push_back(piece[face]);
        Shell& shell = shells[piece[face]];
        shell.patch.push_back(patches[face]);
        auto corners = all.faces[face];
        for (int& corner : corners)
        {
            int& own = index[corner];
            if (own < 0)
            {
                own = int(shell.mesh.vertices.size());
                shell.mesh.vertices.push_back(all.vertices[corner]);
            }
            corner = own;
        }
        shell.mesh.faces.push_back(corners);
    }
    for (Shell& shell : shells) shell.outward = shell.mesh.volume() >= 0;
    return shells;
}

std::vector<Group> groupsOf(const RepairMesh& mesh, const std::vector<std::size_t>& shellOf, std::size_t shells)
{
    const auto crossing = crossingFaces(mesh);
    boost::disjoint_sets_with_storage<> sets(shells);
    for (const auto& [a, b] : crossing) sets.union_set(shellOf[a], shellOf[b]);
    std::map<std::size_t, Group> groups;
    for (std::size_t s = 0; s < shells; ++s) groups[sets.find_set(s)].shells.push_back(s);
    for (const auto& [a, b] : crossing) groups[sets.find_set(shellOf[a])].crosses = true;
    std::vector<Group> result;
    for (auto& [root, group] : groups) result.push_back(std::move(group));
    return result;
}

// Which shells lie in which.
class Nesting
{
public:
    explicit Nesting(const std::vector<Shell>& shells)
    {
        for (const Shell& shell : shells)
        {
            windings_.emplace_back(shell.mesh);
            boxes_.push_back(boundsOf(shell.mesh.vertices));
            centres_.emplace_back();
            const auto& [vertices, normals, faces] = shell.mesh;
            const std::size_t every = std::max<std::size_t>(1, faces.size()/most);
            for (std::size_t f = 0; f < faces.size(); f += every)
            {
                centres_.back().push_back((vertices[faces[f][0]] + vertices[faces[f][1]] + vertices[faces[f][2]])/3);
            }
        }
    }

    // Of shells that do not cross. By most of some faces: single ones may lie on the other shell.
    bool isIn(std::size_t inner, std::size_t outer) const
    {
        const Bounds &a = boxes_[inner], &b = boxes_[outer];
        for (int c = 0; c < 3; ++c) if (a.low[c] < b.low[c] || a.high[c] > b.high[c]) return false;
        const auto& centres = centres_[inner];
        const auto inside = std::count_if(centres.begin(), centres.end(), [&](const Vector3& x) { return windings_[outer](x) != 0; });
        return 2*std::size_t(inside) > centres.size();
    }

private:
    static constexpr std::size_t most = 15;         // faces that are looked at

    std::vector<WindingNumber> windings_;
    std::vector<Bounds> boxes_;
    std::vector<std::vector<Vector3>> centres_;
};

void findNesting(std::vector<Group>& groups, const std::vector<Shell>& shells)
{
    const Nesting nesting(shells);
    std::vector<std::size_t> groupOf(shells.size());
    for (std::size_t g = 0; g < groups.size(); ++g) for (const std::size_t s : groups[g].shells) groupOf[s] = g;
    for (std::size_t g = 0; g < groups.size(); ++g)
    {
        for (std::size_t outer = 0; outer < shells.size(); ++outer)
        {
            if (groupOf[outer] != g && nesting.isIn(groups[g].shells.front(), outer)) groups[g].around.push_back(outer);
        }
    }
    // The outermost first.
    std::sort(groups.begin(), groups.end(), [](const Group& a, const Group& b)
    {
        return std::pair(a.around.size(), a.shells) < std::pair(b.around.size(), b.shells);
    });
}

// Decides what is inside of each group, the outermost ones first.
void findLiquid(std::vector<Group>& groups, const std::vector<Shell>& shells, const std::string& file)
{
    std::vector<const Group*> groupOf(shells.size());
    for (Group& group : groups)
    {
        for (const std::size_t s : group.shells) groupOf[s] = &group;
        if (group.around.empty()) continue;
        const auto outer = std::find_if(group.around.begin(), group.around.end(), [&](std::size_t s) { return groupOf[s]->around.empty(); });
        const auto isLiquid = [&](std::size_t s) { return shells[s].outward == shells[*outer].outward; };
        group.isLiquid = isLiquid(group.shells.front());
        const Group* next = nullptr;            // the innermost that bounds liquid
        for (const std::size_t s : group.around)
        {
            if (groupOf[s]->isKept && (!next || groupOf[s]->around.size() > next->around.size())) next = groupOf[s];
        }
        group.isKept = group.isLiquid != next->isLiquid;
        if (std::all_of(group.shells.begin(), group.shells.end(), [&](std::size_t s) { return isLiquid(s) == group.isLiquid; })) continue;
        throw FatalInputError
        (
            {file, 0}, "The surface has a bubble and a body of liquid, both inside of another shell, whose faces cross each other",
            "shells that are apart, inside of each other, or all of which look the same way"
        );
    }
}

class Soup
{
public:
    void add(const TriangleMesh& mesh, const std::vector<int>& patch)
    {
        const std::size_t offset = points_.size();
        for (const Vector3& v : mesh.vertices) points_.emplace_back(v.x, v.y, v.z);
        for (const auto& [i, j, k] : mesh.faces) faces_.push_back({offset + i, offset + j, offset + k});
        patch_.insert(patch_.end(), patch.begin(), patch.end());
    }

    RepairMesh mesh() const
    {
        RepairMesh result;
        PMP::polygon_soup_to_polygon_mesh(points_, faces_, result);
        const RepairPatches patches = patchesOf(result);
        for (const Face face : result.faces()) patches[face] = patch_[face];
        return result;
    }

private:
    std::vector<RepairKernel::Point_3> points_;
    std::vector<std::array<std::size_t, 3>> faces_;
    std::vector<int> patch_;
};

// The surface of the group's union, all of it looking outward.
Shell united(const Group& group, const std::vector<Shell>& shells, std::vector<std::string>& report, const std::string& file)
{
    if (group.shells.size() == 1 && !group.crosses) return shells[group.shells.front()];
    Soup soup;
    for (const std::size_t s : group.shells) soup.add(shells[s].mesh, shells[s].patch);
    RepairMesh mesh = soup.mesh();
    uniteShells(mesh, report);
    if (!CGAL::is_closed(mesh) || !crossingFaces(mesh).empty())
    {
        throw FatalInputError
        (
            {file, 0}, "Shells of the surface cross each other, and their union cannot be made: " + report.back(),
            "one closed shell a body, as a program for solids makes of them (union, boolean add)"
        );
    }
    mesh.collect_garbage();
    Shell result{meshOf(mesh), {}};
    for (const Face face : mesh.faces()) result.patch.push_back(patchesOf(mesh)[face]);
    return result;
}

std::string counted(std::size_t n, const std::string& what)
{
    return std::to_string(n) + (n == 1 ? " shell " : " shells ") + what;
}

}

void uniteBodies(RepairMesh& mesh, std::vector<std::string>& report, const std::string& file)
{
    mesh.collect_garbage();
    std::vector<std::size_t> shellOf;
    std::vector<Shell> shells = shellsOf(mesh, shellOf);
    std::vector<Group> groups = groupsOf(mesh, shellOf, shells.size());
    findNesting(groups, shells);
    findLiquid(groups, shells, file);

    std::size_t outermost = 0, inward = 0, left = 0;
    for (const Group& group : groups)
    {
        if (!group.isKept) left += group.shells.size();
        if (!group.around.empty()) continue;
        outermost += group.shells.size();
        for (const std::size_t s : group.shells) inward += !shells[s].outward;
    }
    if (inward > 0 && inward < outermost) report.push_back(counted(inward, "turned to look outward as the others"));
    if (left > 0) report.push_back(counted(left, "inside of the liquid, or of a bubble, left out"));

    for (Shell& shell : shells) if (!shell.outward) shell.reverse();
    Soup soup;
    for (const Group& group : groups)
    {
        if (!group.isKept) continue;
        Shell shell = united(group, shells, report, file);
        if (!group.isLiquid) shell.reverse();
        soup.add(shell.mesh, shell.patch);
    }
    mesh = soup.mesh();
}

}
