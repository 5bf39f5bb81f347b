// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/AnalyticMesh.H"

#include <cmath>
#include <numbers>
#include <utility>

namespace shizuku
{

namespace
{

constexpr int around = 64;              // parts of a circle

// Points in rows, each row around a closed circle or not: triangles between neighbouring rows, counter-clockwise from where the third axis of (column, row) points.
void addGrid(TriangleMesh& mesh, int rows, int columns, bool isClosed)
{
    const int cells = isClosed ? columns : columns - 1;
    for (int row = 0; row + 1 < rows; ++row)
    {
        for (int column = 0; column < cells; ++column)
        {
            const int a = row*columns + column, b = row*columns + (column + 1) % columns, c = a + columns, e = b + columns;
            mesh.faces.push_back({a, b, e});
            mesh.faces.push_back({a, e, c});
        }
    }
}

// A right-handed frame with n.
std::pair<Vector3, Vector3> across(const Vector3& n)
{
    const Vector3 u = perpendicular(n);
    return {u, cross(n, u)};
}

TriangleMesh square(const AnalyticSurface& plane, const Vector3& middle, double reach)
{
    const Vector3 foot = middle - dot(middle - plane.point, plane.direction)*plane.direction;
    const auto [u, v] = across(plane.direction);
    TriangleMesh mesh;
    for (const double y : {-reach, reach}) for (const double x : {-reach, reach}) mesh.vertices.push_back(foot + x*u + y*v);
    addGrid(mesh, 2, 2, false);
    return mesh;
}

TriangleMesh tube(const AnalyticSurface& cylinder, const Vector3& middle, double reach)
{
    const Vector3 foot = cylinder.point + dot(middle - cylinder.point, cylinder.direction)*cylinder.direction;
    const auto [u, v] = across(cylinder.direction);
    TriangleMesh mesh;
    for (const double z : {-reach, reach})
    {
        for (int k = 0; k < around; ++k)
        {
            const double a = 2*std::numbers::pi*k/around;
            mesh.vertices.push_back(foot + z*cylinder.direction + cylinder.radius*(std::cos(a)*u + std::sin(a)*v));
        }
    }
    addGrid(mesh, 2, around, true);
    return mesh;
}

// By longitude and latitude; at the poles triangles of no area stand for a fan.
TriangleMesh globe(const AnalyticSurface& sphere)
{
    constexpr int rows = around/2 + 1;
    TriangleMesh mesh;
    for (int row = 0; row < rows; ++row)
    {
        const double polar = std::numbers::pi*(1 - double(row)/(rows - 1));
        for (int k = 0; k < around; ++k)
        {
            const double a = 2*std::numbers::pi*k/around;
            mesh.vertices.push_back(sphere.point + sphere.radius*Vector3(std::sin(polar)*std::cos(a), std::sin(polar)*std::sin(a), std::cos(polar)));
        }
    }
    addGrid(mesh, rows, around, true);
    return mesh;
}

// Six squares, whose corners are their own: its edges stay sharp.
TriangleMesh boxMesh(const AnalyticSurface& box)
{
    TriangleMesh mesh;
    for (int axis = 0; axis < 3; ++axis)
    {
        for (const bool isHigh : {false, true})
        {
            const int first = int(mesh.vertices.size()), p = (axis + 1) % 3, q = (axis + 2) % 3;
            for (int corner = 0; corner < 4; ++corner)
            {
                Vector3 x;
                x[axis] = isHigh ? box.max[axis] : box.min[axis];
                x[p] = corner & 1 ? box.max[p] : box.min[p];
                x[q] = corner & 2 ? box.max[q] : box.min[q];
                mesh.vertices.push_back(x);
            }
            if (isHigh) mesh.faces.insert(mesh.faces.end(), {{first, first + 3, first + 1}, {first, first + 2, first + 3}});
            else mesh.faces.insert(mesh.faces.end(), {{first, first + 1, first + 3}, {first, first + 3, first + 2}});
        }
    }
    return mesh;
}

}

TriangleMesh meshOf(const AnalyticSurface& surface, const Bounds& about)
{
    const Vector3 middle = 0.5*(about.low + about.high);
    const double reach = length(about.size());
    TriangleMesh mesh;
    switch (surface.type)
    {
        case AnalyticSurface::Type::plane: return square(surface, middle, reach);
        case AnalyticSurface::Type::box: return boxMesh(surface);
        case AnalyticSurface::Type::cylinder: mesh = tube(surface, middle, reach); break;
        case AnalyticSurface::Type::sphere: mesh = globe(surface); break;
    }
    if (surface.liquidInside) for (auto& face : mesh.faces) std::swap(face[1], face[2]);
    return mesh;
}

void addMesh(TriangleMesh& to, const AnalyticSurface& surface, const Bounds& about)
{
    const TriangleMesh own = meshOf(surface, about);
    const int first = int(to.vertices.size());
    to.vertices.insert(to.vertices.end(), own.vertices.begin(), own.vertices.end());
    for (const auto& [a, b, c] : own.faces) to.faces.push_back({first + a, first + b, first + c});
}

}
