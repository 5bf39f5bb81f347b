// SPDX-License-Identifier: GPL-3.0-or-later
// type surface; file "drop.stl"; scale 0.001; translate (0 0 1e-3);
// The inside of a closed surface in constant/triSurface (STL, OBJ, PLY, OFF): coordinates times scale [m a unit of the file, default 1], and then
// moved by translate [m, default zero]. Seams are welded as those of walls are. Shells that cross are united, whichever way their faces look; a
// shell inside of another one is a bubble where it looks the other way (sampling/BodyUnion.H).

#include "liquidBodies/LiquidBody.H"
#include "meshes/Bounds.H"
#include "meshes/MeshTopology.H"
#include "meshes/PointsInside.H"
#include "sampling/SurfaceFile.H"
#include "sampling/SurfaceRepair.H"

#include <sstream>

namespace shizuku
{

namespace
{

// Of the surface's extent: wider than what the roundings of files leave between triangles, narrower than a hole.
constexpr double widestGap = 1e-4;

RepairedSurface readClosedSurface(const Dictionary& dict, const std::filesystem::path& casePath)
{
    const std::filesystem::path file = casePath/"constant"/"triSurface"/dict.lookup<std::string>("file");
    const PatchedSurface raw = readSurface(file, dict.name());
    RepairedSurface repaired = repairSurface(raw, widestGap*length(boundsOf(raw.mesh.vertices).size()), file.string(), Shells::bodies);
    TriangleMesh& mesh = repaired.surface.mesh;
    if (!repaired.closed || !(mesh.volume() > 0))
    {
        std::ostringstream found;
        found << "The surface " << file.string() << " encloses no body: " << findDefects(mesh).boundaryEdges << " open edges, volume "
              << mesh.volume();
        throw FatalInputError(dict.where("file"), found.str(), "a closed surface");
    }

    const double scale = dict.found("scale") ? dict.lookupPositive("scale", dimensions::none) : 1;
    Vector3 move;
    if (dict.found("translate")) move = dict.lookupDimensionedVector("translate", dimensions::length);
    for (Vector3& vertex : mesh.vertices) vertex = scale*vertex + move;
    return repaired;
}

}

class SurfaceBody : public LiquidShape<SurfaceBody>
{
public:
    SurfaceBody(const Dictionary& dict, const std::filesystem::path& casePath)
    :
        surface_(readClosedSurface(dict, casePath)), windingNumber_(mesh()), bounds_(boundsOf(mesh().vertices))
    {}

    BodyFrame frame() const override { return {bounds_.low}; }
    Vector3 low() const override { return {}; }
    Vector3 high() const override { return bounds_.size(); }
    bool contains(const Vector3& x) const override { return windingNumber_(x) > 0; }
    double volume() const override { return mesh().volume(); }

    std::string describe() const override
    {
        std::string text;
        for (const std::string& line : surface_.report) text += (text.empty() ? "surface: " : "; ") + line;
        return text;
    }

private:
    const TriangleMesh& mesh() const { return surface_.surface.mesh; }

    RepairedSurface surface_;
    WindingNumber windingNumber_;       // refers to the mesh
    Bounds bounds_;                     // m
};

static const LiquidBodyTable::Add<SurfaceBody> registered{"surface"};

}
