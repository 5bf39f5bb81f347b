// SPDX-License-Identifier: GPL-3.0-or-later
// ply: binary, vertices with normals (meshes/PlyFile.H). What probeAngle, shizukuToVTK and renderCase read.

#include "meshes/PlyFile.H"
#include "meshes/surfaceFormats/SurfaceFormat.H"

namespace shizuku
{

class PlySurface : public SurfaceFormat
{
public:
    void write(const std::filesystem::path& file, const TriangleMesh& mesh) const override { writePly(file, mesh); }
};

static const SurfaceFormatTable::Add<PlySurface> registered{"ply"};

}
