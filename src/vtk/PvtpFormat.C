// SPDX-License-Identifier: GPL-3.0-or-later
// pvtp: in pieces that the parts of a run write side by side, for meshes that no single process can hold (vtk/PvtpFile.H).

#include "meshes/surfaceFormats/SurfaceFormat.H"
#include "vtk/PvtpFile.H"

namespace shizuku
{

class PvtpSurface : public SurfaceFormat
{
public:
    void write(const std::filesystem::path& file, const TriangleMesh& mesh) const override { writePiece(file, mesh, Alone()); }

    bool takesPieces() const override { return true; }

    void writePiece(const std::filesystem::path& file, const TriangleMesh& piece, const Communicator& parts) const override
    {
        writePvtp(file, vtpOf(piece), VtkEncoding::binary, parts);
    }
};

static const SurfaceFormatTable::Add<PvtpSurface> registered{"pvtp"};

}
