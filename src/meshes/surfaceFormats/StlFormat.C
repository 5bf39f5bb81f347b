// SPDX-License-Identifier: GPL-3.0-or-later
// stl: binary, little-endian: 80 bytes of text, the number of facets, and for each its normal, three vertices and two bytes
// of no meaning. Vertices are repeated in every facet, their normals are lost.

#include "core/fieldFile/AtomicFile.H"
#include "meshes/surfaceFormats/SurfaceFormat.H"

#include <bit>
#include <cstdint>
#include <string>

namespace shizuku
{

static_assert(std::endian::native == std::endian::little, "binary STL is written in the machine's byte order");

namespace
{

template<class T>
void append(std::string& bytes, const T& value)
{
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append(std::string& bytes, const Vector3& v)
{
    for (int c = 0; c < 3; ++c) append(bytes, float(v[c]));
}

}

class StlSurface : public SurfaceFormat
{
public:
    void write(const std::filesystem::path& file, const TriangleMesh& mesh) const override
    {
        // Readers take a file that begins with "solid" for text.
        std::string bytes = "liquid surface, lengths in metres";
        bytes.resize(80, ' ');
        append(bytes, std::uint32_t(mesh.faces.size()));
        for (const auto& [i, j, k] : mesh.faces)
        {
            const Vector3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
            const Vector3 area = cross(b - a, c - a);
            append(bytes, length(area) > 0 ? area/length(area) : area);
            for (const Vector3& corner : {a, b, c}) append(bytes, corner);
            append(bytes, std::uint16_t(0));
        }
        writeAtomically(file, [&](std::ostream& out) { out.write(bytes.data(), std::streamsize(bytes.size())); });
    }
};

static const SurfaceFormatTable::Add<StlSurface> registered{"stl"};

}
