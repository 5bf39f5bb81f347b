// SPDX-License-Identifier: GPL-3.0-or-later
// ply: binary, float x y z nx ny nz vx vy vz body, with the time in a comment.

#include "MovingFormat.H"

#include "core/fieldFile/AtomicFile.H"

#include <bit>
#include <cstdint>
#include <string>

namespace shizuku
{

static_assert(std::endian::native == std::endian::little, "binary PLY is written in the machine's byte order");

class MovingPly : public MovingFormat
{
public:
    void write(const std::filesystem::path& file, const MovingSurface& surface) const override;
};

static const MovingFormatTable::Add<MovingPly> registeredPly{"ply"};

void MovingPly::write(const std::filesystem::path& file, const MovingSurface& surface) const
{
    const TriangleMesh& mesh = surface.mesh;
    std::string bytes;
    const auto append = [&bytes](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    {
        for (const Vector3& v : {mesh.vertices[i], mesh.normals[i], surface.velocities[i]})
        {
            for (int c = 0; c < 3; ++c) append(float(v[c]));
        }
        append(float(surface.bodies[i]));
    }
    for (const auto& face : mesh.faces)
    {
        append(std::uint8_t(3));
        for (const int corner : face) append(std::int32_t(corner));
    }
    writeAtomically(file, [&](std::ostream& out)
    {
        out << "ply\nformat binary_little_endian 1.0\ncomment lengths in metres, velocities in m/s\ncomment time " << surface.time << " s\n"
            << "element vertex " << mesh.vertices.size() << '\n';
        for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "vx", "vy", "vz", "body"}) out << "property float " << name << '\n';
        out << "element face " << mesh.faces.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
        out.write(bytes.data(), std::streamsize(bytes.size()));
    });
}

}
