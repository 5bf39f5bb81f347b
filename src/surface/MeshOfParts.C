// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/MeshOfParts.H"

#include "core/messages/Error.H"
#include "parallel/AllParts.H"
#include "surface/CaseSurface.H"

#include <limits>
#include <string>

namespace shizuku
{

namespace
{

struct Counts
{
    std::int64_t triangles = 0, vertices = 0;
    void add(const Counts& other) { triangles += other.triangles, vertices += other.vertices; }
};

struct Measures
{
    MeshMeasure sum{0, 0};
    void add(const Measures& other) { sum.volume += other.sum.volume, sum.area += other.sum.area; }
};

// That of the first part that has one.
struct FirstVertex
{
    bool is = false;
    Vector3 x;
    void add(const FirstVertex& other)
    {
        if (!is) *this = other;
    }
};

}

MeshOfParts::MeshOfParts(const LiquidSurface& surface, double unit, const SurfaceCut& cut)
: parts_(cut.parts), piece_(toTriangleMesh(surface.download(), unit)), numbers_(surface.numbers())
{
    if (parts_.parts() > 1) takeVerticesOfOthers(cut);
    const Counts all = parts_.fold(Counts{std::int64_t(piece_.faces.size()), numbers_.own});
    triangles_ = all.triangles;
    vertices_ = all.vertices;
    apex_ = parts_.fold(piece_.vertices.empty() ? FirstVertex{} : FirstVertex{true, piece_.vertices.front()}).x;
}

// Where the next part has them: its own sums may be rounded otherwise, and pieces shall meet to the bit.
void MeshOfParts::takeVerticesOfOthers(const SurfaceCut& cut)
{
    const std::optional<int> above = cut.above();
    std::vector<Bytes> to(parts_.parts());
    if (above) to[*above] = bytesOf(numbers_.others);
    std::vector<Bytes> answers;
    for (const Bytes& asked : parts_.exchange(std::move(to)))
    {
        std::vector<std::int64_t> numbers;
        appendTo(numbers, asked);
        std::vector<Vector3> found;
        for (const std::int64_t number : numbers)
        {
            const std::size_t own = number - numbers_.first;
            found.insert(found.end(), {piece_.vertices[own], piece_.normals[own]});
        }
        answers.push_back(bytesOf(found));
    }
    std::vector<Vector3> found;
    for (const Bytes& answer : parts_.exchange(std::move(answers))) appendTo(found, answer);
    for (std::size_t k = 0; k < numbers_.others.size(); ++k)
    {
        piece_.vertices[numbers_.own + k] = found[2 * k];
        piece_.normals[numbers_.own + k] = found[2 * k + 1];
    }
}

MeshMeasure MeshOfParts::measure(const TriangleMesh& piece) const
{
    return parts_.fold(Measures{{piece.volumeFrom(apex_), piece.area()}}).sum;
}

double MeshOfParts::offsetPieces(double volume, double most)
{
    return offsetToVolume(piece_, volume, most, [&](const TriangleMesh& moved) { return measure(moved); });
}

TriangleMesh MeshOfParts::whole() const
{
    if (parts_.parts() == 1) return piece_;
    if (vertices_ > std::numeric_limits<int>::max())
    {
        throw FatalError("The mesh has " + std::to_string(vertices_) + " vertices, more than one file may have.\n    Write it in pieces: -formats pvtp");
    }
    const auto own = [&](const std::vector<Vector3>& list) { return std::vector<Vector3>(list.begin(), list.begin() + numbers_.own); };
    TriangleMesh mesh;
    mesh.vertices = gatherListsAtFirst(parts_, own(piece_.vertices));
    mesh.normals = gatherListsAtFirst(parts_, own(piece_.normals));
    std::vector<std::array<int, 3>> faces = piece_.faces;
    for (std::array<int, 3>& face : faces)
    {
        for (int& corner : face) corner = int(corner < numbers_.own ? numbers_.first + corner : numbers_.others[corner - numbers_.own]);
    }
    mesh.faces = gatherListsAtFirst(parts_, faces);
    return mesh;
}

}
