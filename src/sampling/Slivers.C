// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/Slivers.H"

#include "core/messages/Error.H"
#include "meshes/Bounds.H"

#include <numeric>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr double leastWidth = 0.25;     // spacings
constexpr double blemish = 0.1;         // of the area

// For each face the piece that it belongs to, by the piece's first vertex.
std::vector<int> piecesOf(const TriangleMesh& mesh)
{
    std::vector<int> first(mesh.vertices.size());
    std::iota(first.begin(), first.end(), 0);
    const auto find = [&](int v)
    {
        while (first[v] != v) v = first[v] = first[first[v]];
        return v;
    };
    for (const auto& face : mesh.faces)
    {
        for (const int v : {face[1], face[2]})
        {
            const int a = find(face[0]), b = find(v);
            first[std::max(a, b)] = std::min(a, b);
        }
    }
    std::vector<int> pieces;
    for (const auto& face : mesh.faces) pieces.push_back(find(face[0]));
    return pieces;
}

struct Piece
{
    double area = 0;
    std::vector<Vector3> corners;

    bool isNarrow(double spacing) const { return area < leastWidth*spacing*length(boundsOf(corners).size()); }
};

}

void leaveOutSlivers(PatchedSurface& surface, double spacing, const std::string& file, std::vector<std::string>& report)
{
    const TriangleMesh& mesh = surface.mesh;
    const std::vector<int> pieceOf = piecesOf(mesh);
    std::vector<Piece> pieces(mesh.vertices.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    {
        const auto& [i, j, k] = mesh.faces[f];
        Piece& piece = pieces[pieceOf[f]];
        piece.area += 0.5*length(cross(mesh.vertices[j] - mesh.vertices[i], mesh.vertices[k] - mesh.vertices[i]));
        for (const int v : {i, j, k}) piece.corners.push_back(mesh.vertices[v]);
    }
    const Piece whole{mesh.area(), mesh.vertices};
    if (whole.isNarrow(spacing))
    {
        std::ostringstream expected;
        expected << "a surface of at least that, " << leastWidth*spacing << " m, or a smaller spacing in system/solution";
        throw FatalInputError({file, 0}, "The surface is narrower than a quarter of the particle spacing", expected.str());
    }

    double area = 0;
    std::size_t count = 0;
    const Piece* first = nullptr;
    std::vector<bool> narrow(pieces.size(), false);
    for (std::size_t p = 0; p < pieces.size(); ++p)
    {
        if (pieces[p].corners.empty() || !pieces[p].isNarrow(spacing)) continue;
        narrow[p] = true;
        if (count++ == 0) first = &pieces[p];
        area += pieces[p].area;
    }
    if (count == 0 || area > blemish*whole.area) return;

    PatchedSurface kept;
    kept.patches = surface.patches;
    std::vector<int> place(mesh.vertices.size(), -1);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    {
        if (narrow[pieceOf[f]]) continue;
        std::array<int, 3> face = mesh.faces[f];
        for (int& v : face)
        {
            if (place[v] < 0)
            {
                place[v] = int(kept.mesh.vertices.size());
                kept.mesh.vertices.push_back(mesh.vertices[v]);
            }
            v = place[v];
        }
        kept.mesh.faces.push_back(face);
        kept.patch.push_back(surface.patch[f]);
    }
    std::ostringstream said;
    said << count << (count == 1 ? " sliver" : " slivers") << " narrower than a quarter of a spacing left out, "
         << (count == 1 ? "at " : "the first at ") << str(first->corners.front()) << " m";
    report.push_back(said.str());
    surface = std::move(kept);
}

}
