// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/Creases.H"

#include "core/angles/Degrees.H"

#include <cmath>
#include <utility>

namespace shizuku
{

namespace
{

// The corners of a mesh's faces by their vertex. A corner is three times its face and its place in it.
struct Corners
{
    std::vector<int> first, corners;            // of each vertex, and the end

    explicit Corners(const TriangleMesh& mesh) : first(mesh.vertices.size() + 1, 0), corners(3*mesh.faces.size())
    {
        for (const auto& face : mesh.faces) for (const int v : face) ++first[v + 1];
        for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
        std::vector<int> next(first.begin(), first.end() - 1);
        for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        {
            for (int k = 0; k < 3; ++k) corners[next[mesh.faces[f][k]]++] = int(3*f) + k;
        }
    }
};

std::vector<Vector3> unitNormals(const TriangleMesh& mesh)
{
    std::vector<Vector3> normals;
    for (const auto& [i, j, k] : mesh.faces)
    {
        const Vector3 area = cross(mesh.vertices[j] - mesh.vertices[i], mesh.vertices[k] - mesh.vertices[i]);
        normals.push_back(squaredLength(area) > 0 ? normalized(area) : area);
    }
    return normals;
}

// Whether two faces at a vertex share one of its edges: another vertex.
bool shareEdge(const std::array<int, 3>& a, const std::array<int, 3>& b, int vertex)
{
    for (const int i : a)
    {
        for (const int j : b) if (i == j && i != vertex) return true;
    }
    return false;
}

}

TriangleMesh splitCreases(const TriangleMesh& mesh, double angle)
{
    TriangleMesh split{mesh.vertices, {}, mesh.faces};
    const double least = std::cos(radians(angle));
    const Corners all(mesh);
    const std::vector<Vector3> normals = unitNormals(mesh);
    std::vector<int> open, side;
    for (int v = 0; v < int(mesh.vertices.size()); ++v)
    {
        // Sides one after the other: the first keeps the vertex.
        open.assign(all.corners.begin() + all.first[v], all.corners.begin() + all.first[v + 1]);
        for (bool isFirst = true; !open.empty(); isFirst = false)
        {
            side.assign(1, open.back());
            open.pop_back();
            for (std::size_t s = 0; s < side.size(); ++s)
            {
                const int face = side[s]/3;
                for (std::size_t o = 0; o < open.size();)
                {
                    const int other = open[o]/3;
                    const bool isSame = shareEdge(mesh.faces[face], mesh.faces[other], v) && dot(normals[face], normals[other]) >= least;
                    if (!isSame)
                    {
                        ++o;
                        continue;
                    }
                    side.push_back(open[o]);
                    std::swap(open[o], open.back());
                    open.pop_back();
                }
            }
            if (isFirst) continue;
            for (const int corner : side) split.faces[corner/3][corner % 3] = int(split.vertices.size());
            split.vertices.push_back(mesh.vertices[v]);
        }
    }
    return split;
}

}
