// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/TriangleMesh.H"

namespace shizuku
{

namespace
{

// Sums over the tetrahedra between each face and one common point. That point is a vertex of the mesh,
// so that a small mesh far from the origin loses no digits.
template<class Sum> void overTetrahedra(const TriangleMesh& mesh, Sum sum)
{
    if (mesh.vertices.empty()) return;
    const Vector3 apex = mesh.vertices.front();
    for (const auto& [i, j, k] : mesh.faces)
    {
        const Vector3 a = mesh.vertices[i] - apex, b = mesh.vertices[j] - apex, c = mesh.vertices[k] - apex;
        sum(dot(a, cross(b, c))/6, (a + b + c)/4);
    }
}

}

double TriangleMesh::area() const
{
    double total = 0;
    for (const auto& [i, j, k] : faces)
    {
        total += length(cross(vertices[j] - vertices[i], vertices[k] - vertices[i]))/2;
    }
    return total;
}

std::vector<double> TriangleMesh::vertexAreas() const
{
    std::vector<double> areas(vertices.size(), 0);
    for (const auto& face : faces)
    {
        const auto& [i, j, k] = face;
        const double area = length(cross(vertices[j] - vertices[i], vertices[k] - vertices[i]))/2;
        for (const int corner : face) areas[corner] += area/3;
    }
    return areas;
}

double TriangleMesh::volume() const
{
    double total = 0;
    overTetrahedra(*this, [&](double volume, const Vector3&) { total += volume; });
    return total;
}

Vector3 TriangleMesh::centroid() const
{
    double total = 0;
    Vector3 moment;
    overTetrahedra(*this, [&](double volume, const Vector3& centre)
    {
        total += volume;
        moment += volume*centre;
    });
    return vertices.front() + moment/total;
}

}
