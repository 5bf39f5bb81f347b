// SPDX-License-Identifier: GPL-3.0-or-later
// obj: Wavefront's text format, vertices (v) and their normals (vn), counted from 1.

#include "core/fieldFile/AtomicFile.H"
#include "meshes/surfaceFormats/SurfaceFormat.H"

#include <limits>

namespace shizuku
{

class ObjSurface : public SurfaceFormat
{
public:
    void write(const std::filesystem::path& file, const TriangleMesh& mesh) const override
    {
        writeAtomically(file, [&](std::ostream& out)
        {
            out << "# lengths in metres\n";
            out.precision(std::numeric_limits<double>::max_digits10);
            for (const Vector3& v : mesh.vertices) out << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
            out.precision(std::numeric_limits<float>::max_digits10);
            for (const Vector3& n : mesh.normals) out << "vn " << float(n.x) << ' ' << float(n.y) << ' ' << float(n.z) << '\n';
            for (const auto& face : mesh.faces)
            {
                out << 'f';
                for (const int corner : face)
                {
                    out << ' ' << corner + 1;
                    if (!mesh.normals.empty()) out << "//" << corner + 1;
                }
                out << '\n';
            }
        });
    }
};

static const SurfaceFormatTable::Add<ObjSurface> registered{"obj"};

}
