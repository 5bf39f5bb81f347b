// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/TriangleMesh.H"

namespace shizuku
{

namespace
{

// Sums over the tetrahedra between each face and one common point.
template<class Sum> void overTetrahedra(const TriangleMesh& mesh, const Vector3& apex, Sum sum)
{
    for (const auto& [i, j, k] : mesh.faces)
    {
        const Vector3 a = mesh.vertices[i] - apex, b = mesh.vertices[j] - apex, c = mesh.vertices[k] - apex;
        sum(dot(a, cross(b, c))/6, (a + b + c)/4);
    }
}

// A vertex of the mesh, so that a small mesh far from the origin loses no digits.
Vector3 apexOf(const TriangleMesh& mesh) { return mesh.vertices.empty() ? Vector3() : mesh.vertices.front(); }

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

double TriangleMesh::volume() const { return volumeFrom(apexOf(*this)); }

double TriangleMesh::volumeFrom(const Vector3& apex) const
{
    double total = 0;
    overTetrahedra(*this, apex, [&](double volume, const Vector3&) { total += volume; });
    return total;
}

Vector3 TriangleMesh::centroid() const
{
    double total = 0;
    Vector3 moment;
    overTetrahedra(*this, apexOf(*this), [&](double volume, const Vector3& centre)
    {
        total += volume;
        moment += volume*centre;
    });
    return vertices.front() + moment/total;
}

}
