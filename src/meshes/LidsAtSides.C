// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/LidsAtSides.H"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace shizuku
{

namespace
{

constexpr double near = 0.75, outward = 0.7;    // spacings; cosine

// Faces that may be a lid of one pair of sides.
class Candidates
{
public:
    Candidates(const TriangleMesh& mesh, const RepeatedSides& sides, double spacing) : mesh_(mesh), sides_(sides), spacing_(spacing), side_(mesh.faces.size(), open)
    {
        for (std::size_t i = 0; i < mesh.faces.size(); ++i)
        {
            side_[i] = sideOf(mesh.faces[i]);
            if (side_[i] != open) there_[side_[i]].insert(squareOf(mesh.faces[i]));
        }
    }

    bool isLid(std::size_t face) const
    {
        if (side_[face] == open) return false;
        const auto& opposite = there_[1 - side_[face]];
        const auto [a, b] = squareOf(mesh_.faces[face]);
        for (long i = a - 1; i <= a + 1; ++i)
        {
            for (long j = b - 1; j <= b + 1; ++j)
            {
                if (opposite.count({i, j})) return true;
            }
        }
        return false;
    }

    double placeOf(std::size_t face) const { return side_[face] == 0 ? sides_.lower : sides_.upper; }

private:
    static constexpr int open = -1;

    // 0: the lower side, 1: the upper one.
    int sideOf(const std::array<int, 3>& face) const
    {
        const Vector3 &a = mesh_.vertices[face[0]], &b = mesh_.vertices[face[1]], &c = mesh_.vertices[face[2]];
        const Vector3 normal = cross(b - a, c - a);
        const int side = normal[sides_.axis] > 0;
        if (!(std::abs(normal[sides_.axis]) > outward*length(normal))) return open;
        const double at = side ? sides_.upper : sides_.lower;
        for (const Vector3* vertex : {&a, &b, &c})
        {
            if (std::abs((*vertex)[sides_.axis] - at) > near*spacing_) return open;
        }
        return side;
    }

    // Of a spacing, across the axis.
    std::pair<long, long> squareOf(const std::array<int, 3>& face) const
    {
        const Vector3 middle = (mesh_.vertices[face[0]] + mesh_.vertices[face[1]] + mesh_.vertices[face[2]])/3;
        const auto along = [&](int axis) { return long(std::floor(middle[axis]/spacing_)); };
        return {along((sides_.axis + 1)%3), along((sides_.axis + 2)%3)};
    }

    const TriangleMesh& mesh_;
    const RepeatedSides& sides_;
    double spacing_;
    std::vector<int> side_;
    std::set<std::pair<long, long>> there_[2];
};

// Vertices that no face has go.
TriangleMesh compacted(TriangleMesh mesh)
{
    std::vector<int> number(mesh.vertices.size(), -1);
    for (const auto& face : mesh.faces)
    {
        for (const int v : face) number[v] = 0;
    }
    const bool hasNormals = !mesh.normals.empty();
    int used = 0;
    for (std::size_t v = 0; v < number.size(); ++v)
    {
        if (number[v] < 0) continue;
        mesh.vertices[used] = mesh.vertices[v];
        if (hasNormals) mesh.normals[used] = mesh.normals[v];
        number[v] = used++;
    }
    mesh.vertices.resize(used);
    if (hasNormals) mesh.normals.resize(used);
    for (auto& face : mesh.faces)
    {
        for (int& v : face) v = number[v];
    }
    return mesh;
}

// Takes out the lids of one pair of sides, and brings what was fixed to them to the side, with a normal along it.
void open(TriangleMesh& mesh, const RepeatedSides& sides, double spacing)
{
    std::vector<std::array<int, 3>> remaining;
    std::vector<std::pair<int, double>> rim;
    {
        const Candidates candidates(mesh, sides, spacing);
        for (std::size_t i = 0; i < mesh.faces.size(); ++i)
        {
            if (!candidates.isLid(i)) remaining.push_back(mesh.faces[i]);
            else for (const int v : mesh.faces[i]) rim.emplace_back(v, candidates.placeOf(i));
        }
    }
    for (const auto& [v, place] : rim)
    {
        mesh.vertices[v][sides.axis] = place;
        if (mesh.normals.empty()) continue;
        Vector3 flat = mesh.normals[v];
        flat[sides.axis] = 0;
        if (length(flat) > 0) mesh.normals[v] = flat/length(flat);
    }
    mesh.faces = std::move(remaining);
}

}

TriangleMesh withoutLids(TriangleMesh mesh, const std::vector<RepeatedSides>& sides, double spacing)
{
    for (const RepeatedSides& each : sides) open(mesh, each, spacing);
    return compacted(std::move(mesh));
}

}
