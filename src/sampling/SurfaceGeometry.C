// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/SurfaceGeometry.H"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

namespace shizuku
{

namespace
{

// Faces that meet at more than this stay two surfaces with a sharp edge in between: cos(30 degrees).
const double creaseCosine = std::sqrt(0.75);

// A walk over more edges than this has been caught by slivers and ends where it is.
constexpr int maxCrossings = 200;

double angleAt(const std::array<Vector3, 3>& corners, int k)
{
    const Vector3 a = corners[(k + 1) % 3] - corners[k], b = corners[(k + 2) % 3] - corners[k];
    return std::atan2(length(cross(a, b)), dot(a, b));
}

void cutInto(std::vector<SurfacePiece>& pieces, const SurfacePiece& piece, double size)
{
    const int longest = piece.longestEdge();
    if (piece.squaredEdge(longest) <= size*size)
    {
        pieces.push_back(piece);
        return;
    }
    for (const SurfacePiece& half : piece.halves(longest)) cutInto(pieces, half, size);
}

}

std::vector<SurfacePiece> SurfacePiece::cut(double size) const
{
    std::vector<SurfacePiece> pieces;
    cutInto(pieces, *this, size);
    return pieces;
}

int SurfacePiece::longestEdge() const
{
    int longest = 0;
    for (int k = 1; k < 3; ++k)
    {
        if (squaredEdge(k) > squaredEdge(longest)) longest = k;
    }
    return longest;
}

std::array<SurfacePiece, 2> SurfacePiece::halves(int edge) const
{
    const Vector3& a = corners[edge];
    const Vector3& b = corners[(edge + 1) % 3];
    const Vector3& c = corners[(edge + 2) % 3];
    const Vector3 middle = 0.5*(a + b);
    return {{{face, {a, middle, c}}, {face, {middle, b, c}}}};
}

SurfaceGeometry::SurfaceGeometry(const PatchedSurface& surface) : surface_(surface)
{
    double sum = 0;
    for (const auto& face : surface.mesh.faces)
    {
        const auto& v = surface.mesh.vertices;
        const Vector3 twice = cross(v[face[1]] - v[face[0]], v[face[2]] - v[face[0]]);
        normals_.push_back(normalized(twice));
        cumulativeArea_.push_back(sum += 0.5*length(twice));
    }
    findNeighbours();
    findCornerNormals();
}

double SurfaceGeometry::area(int face) const
{
    return cumulativeArea_[face] - (face > 0 ? cumulativeArea_[face - 1] : 0);
}

std::array<Vector3, 3> SurfaceGeometry::corners(int face) const
{
    const auto& v = surface_.mesh.vertices;
    const auto& f = surface_.mesh.faces[face];
    return {v[f[0]], v[f[1]], v[f[2]]};
}

void SurfaceGeometry::findNeighbours()
{
    const auto& faces = surface_.mesh.faces;
    std::unordered_map<std::uint64_t, std::pair<int, int>> halfEdges;
    halfEdges.reserve(3*faces.size());
    const auto key = [](int a, int b) { return std::uint64_t(a) << 32 | std::uint32_t(b); };
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    {
        for (int k = 0; k < 3; ++k) halfEdges[key(faces[f][k], faces[f][(k + 1) % 3])] = {f, k};
    }
    neighbours_.assign(faces.size(), {-1, -1, -1});
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    {
        for (int k = 0; k < 3; ++k)
        {
            const auto opposite = halfEdges.find(key(faces[f][(k + 1) % 3], faces[f][k]));
            if (opposite != halfEdges.end()) neighbours_[f][k] = opposite->second.first;
        }
    }
}

void SurfaceGeometry::findCornerNormals()
{
    const auto& faces = surface_.mesh.faces;
    std::vector<std::vector<std::pair<int, double>>> around(surface_.mesh.vertices.size());     // face, angle
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    {
        for (int k = 0; k < 3; ++k) around[faces[f][k]].emplace_back(f, angleAt(corners(f), k));
    }
    cornerNormals_.resize(faces.size());
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    {
        for (int k = 0; k < 3; ++k)
        {
            Vector3 sum;
            for (const auto& [g, angle] : around[faces[f][k]])
            {
                if (dot(normals_[f], normals_[g]) > creaseCosine) sum += angle*normals_[g];
            }
            cornerNormals_[f][k] = squaredLength(sum) > 0 ? normalized(sum) : normals_[f];
        }
    }
}

std::array<double, 3> SurfaceGeometry::barycentric(int face, const Vector3& x) const
{
    const auto corner = corners(face);
    std::array<double, 3> weights;
    for (int k = 0; k < 3; ++k)
    {
        const Vector3& a = corner[(k + 1) % 3];
        weights[k] = std::max(0.0, dot(cross(corner[(k + 2) % 3] - a, x - a), normals_[face]));
    }
    const double sum = weights[0] + weights[1] + weights[2];
    for (double& weight : weights) weight /= sum;
    return weights;
}

Vector3 SurfaceGeometry::normal(const SurfacePoint& point) const
{
    const auto weights = barycentric(point.face, point.position);
    const auto& n = cornerNormals_[point.face];
    return normalized(weights[0]*n[0] + weights[1]*n[1] + weights[2]*n[2]);
}

std::vector<SurfacePiece> SurfaceGeometry::pieces(double size) const
{
    std::vector<SurfacePiece> pieces;
    for (int face = 0; face < faces(); ++face) cutInto(pieces, {face, corners(face)}, size);
    return pieces;
}

SurfacePoint SurfaceGeometry::move(SurfacePoint point, const Vector3& displacement) const
{
    Vector3 rest = displacement - dot(displacement, normals_[point.face])*normals_[point.face];
    for (int crossing = 0; crossing < maxCrossings; ++crossing)
    {
        const auto corner = corners(point.face);
        const Vector3 target = point.position + rest;

        // The first edge on the way: `part` of the way is left before it.
        int exit = -1;
        double part = 1;
        for (int k = 0; k < 3; ++k)
        {
            const Vector3 inward = cross(normals_[point.face], corner[(k + 1) % 3] - corner[k]);
            const double here = std::max(0.0, dot(inward, point.position - corner[k]));
            const double there = dot(inward, target - corner[k]);
            if (there < 0 && dot(inward, rest) < 0 && here/(here - there) <= part)
            {
                part = here/(here - there);
                exit = k;
            }
        }
        if (exit < 0)
        {
            point.position = target;
            return point;
        }

        point.position += part*rest;
        rest *= 1 - part;
        const Vector3 along = normalized(corner[(exit + 1) % 3] - corner[exit]);
        const double across = -dot(rest, cross(normals_[point.face], along));   // outwards, positive
        const int next = neighbours_[point.face][exit];
        rest = dot(rest, along)*along;
        if (next >= 0)
        {
            // In the next face the edge runs the other way, and its inward direction lies on the left of that.
            rest += across*cross(normals_[next], -along);
            point.face = next;
        }
    }
    return point;
}

}
