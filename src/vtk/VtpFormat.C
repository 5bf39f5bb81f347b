// SPDX-License-Identifier: GPL-3.0-or-later
// vtp: for ParaView and whatever else reads VTK's files (vtk/VtpFile.H).

#include "meshes/surfaceFormats/SurfaceFormat.H"
#include "vtk/VtpFile.H"

namespace shizuku
{

class VtpSurface : public SurfaceFormat
{
public:
    void write(const std::filesystem::path& file, const TriangleMesh& mesh) const override
    {
        writeVtp(file, vtpOf(mesh), VtkEncoding::binary);
    }
};

static const SurfaceFormatTable::Add<VtpSurface> registered{"vtp"};

}
