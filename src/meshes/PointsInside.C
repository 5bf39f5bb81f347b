// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/PointsInside.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// Twice the signed area of (from, to, p) seen from above. Evaluated from the lower vertex index to the higher one,
// so that both faces at an edge get the same number with opposite signs, rounding included; and relative to p, so
// that it is exactly zero at the edge's ends, fused multiply-add or not.
double sideOf(const TriangleMesh& mesh, int from, int to, const Vector3& p)
{
    const double sign = from < to ? 1 : -1;
    const Vector3 a = mesh.vertices[std::min(from, to)] - p;
    const Vector3 b = mesh.vertices[std::max(from, to)] - p;
    return sign*(a.x*b.y - a.y*b.x);
}

}

WindingNumber::WindingNumber(const TriangleMesh& mesh) : mesh_(mesh)
{
    if (mesh.faces.empty()) return;
    low_ = high_ = mesh.vertices.front();
    for (const Vector3& v : mesh.vertices)
    {
        low_ = {std::min(low_.x, v.x), std::min(low_.y, v.y), 0};
        high_ = {std::max(high_.x, v.x), std::max(high_.y, v.y), 0};
    }
    // About two faces a column; a mesh without extent gets one column.
    columns_ = std::max(1, int(std::sqrt(mesh.faces.size()/2.0)));
    faces_.resize(std::size_t(columns_)*columns_);
    for (int face = 0; face < int(mesh.faces.size()); ++face)
    {
        int first[2] = {columns_, columns_}, last[2] = {0, 0};
        for (const int corner : mesh.faces[face])
        {
            for (int axis = 0; axis < 2; ++axis)
            {
                const int at = column(mesh.vertices[corner], axis);
                first[axis] = std::min(first[axis], at);
                last[axis] = std::max(last[axis], at);
            }
        }
        for (int i = first[0]; i <= last[0]; ++i)
        {
            for (int j = first[1]; j <= last[1]; ++j) faces_[std::size_t(i)*columns_ + j].push_back(face);
        }
    }
}

int WindingNumber::operator()(const Vector3& p) const
{
    if (faces_.empty() || p.x < low_.x || p.x > high_.x || p.y < low_.y || p.y > high_.y) return 0;
    int winding = 0;
    for (const int face : faces_[std::size_t(column(p, 0))*columns_ + column(p, 1)]) winding += crossing(face, p);
    return winding;
}

int WindingNumber::column(const Vector3& p, int axis) const
{
    const double extent = high_[axis] - low_[axis];
    if (extent <= 0) return 0;
    return std::clamp(int((p[axis] - low_[axis])/extent*columns_), 0, columns_ - 1);
}

// +1 where the ray leaves through the face, -1 where it enters, else 0.
int WindingNumber::crossing(int face, const Vector3& p) const
{
    const auto& [i, j, k] = mesh_.faces[face];
    const double a = sideOf(mesh_, j, k, p), b = sideOf(mesh_, k, i, p), c = sideOf(mesh_, i, j, p);
    const bool inA = leftOf(a, j, k), inB = leftOf(b, k, i), inC = leftOf(c, i, j);
    if (inA != inB || inB != inC) return 0;
    const double z = (a*mesh_.vertices[i].z + b*mesh_.vertices[j].z + c*mesh_.vertices[k].z)/(a + b + c);
    return z > p.z ? (inA ? 1 : -1) : 0;
}

// A point on an edge is taken as displaced by (e, e^2), e being infinitely small: then it lies on one side.
bool WindingNumber::leftOf(double side, int from, int to) const
{
    if (side != 0) return side > 0;
    const Vector3 edge = mesh_.vertices[to] - mesh_.vertices[from];
    return edge.y < 0 || (edge.y == 0 && edge.x > 0);
}

std::vector<int> windingNumbers(const TriangleMesh& mesh, const std::vector<Vector3>& points)
{
    std::vector<int> result(points.size(), 0);
    const WindingNumber windingNumber(mesh);
    std::transform(points.begin(), points.end(), result.begin(), [&](const Vector3& p)
    {
        return windingNumber(p);
    });
    return result;
}

}
