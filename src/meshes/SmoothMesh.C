// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/SmoothMesh.H"

#include "meshes/VertexNeighbours.H"

#include <algorithm>

namespace shizuku
{

namespace
{

constexpr double shrink = 0.5, inflate = -0.53;

// Towards the mean of the neighbours by that part of the way.
void relax(TriangleMesh& mesh, const VertexNeighbours& neighbours, double part)
{
    const std::vector<Vector3> ways = neighbours.waysToMean(mesh.vertices);
    for (std::size_t i = 0; i < ways.size(); ++i) mesh.vertices[i] += part*ways[i];
}

std::vector<Vector3> faceNormals(const TriangleMesh& mesh)
{
    std::vector<Vector3> normals(mesh.vertices.size());
    for (const auto& [i, j, k] : mesh.faces)
    {
        const Vector3& a = mesh.vertices[i];
        const Vector3 area = cross(mesh.vertices[j] - a, mesh.vertices[k] - a);
        for (const int v : {i, j, k}) normals[v] += area;
    }
    for (Vector3& n : normals) if (squaredLength(n) > 0) n = normalized(n);
    return normals;
}

void averageNormals(TriangleMesh& mesh)
{
    std::vector<Vector3> sum = mesh.normals;
    for (const auto& face : mesh.faces)
    {
        for (int corner = 0; corner < 3; ++corner)
        {
            const int i = face[corner];
            for (const int j : {face[(corner + 1) % 3], face[(corner + 2) % 3]})
            {
                const double cosine = std::max(0.0, dot(mesh.normals[i], mesh.normals[j]));
                sum[i] += cosine*mesh.normals[j];
            }
        }
    }
    for (std::size_t i = 0; i < sum.size(); ++i) if (squaredLength(sum[i]) > 0) mesh.normals[i] = normalized(sum[i]);
}

}

TriangleMesh smoothMesh(const TriangleMesh& mesh, int positionPasses, int normalPasses)
{
    TriangleMesh smooth = mesh;
    const VertexNeighbours neighbours(mesh);
    for (int pass = 0; pass < positionPasses; ++pass)
    {
        relax(smooth, neighbours, shrink);
        relax(smooth, neighbours, inflate);
    }
    smooth.normals = faceNormals(smooth);
    for (int pass = 0; pass < normalPasses; ++pass) averageNormals(smooth);
    return smooth;
}

}
