// SPDX-License-Identifier: GPL-3.0-or-later
// type surface; file "drop.stl"; scale 0.001; translate (0 0 1e-3);
// The inside of a closed STL in constant/triSurface: coordinates times scale [m a unit of the file, default 1], and then
// moved by translate [m, default zero]. Faces may look inward or outward; a shell inside of another one is a bubble.

#include "liquidBodies/LiquidBody.H"
#include "meshes/Bounds.H"
#include "meshes/MeshTopology.H"
#include "meshes/PointsInside.H"
#include "meshes/StlFile.H"

#include <sstream>

namespace shizuku
{

namespace
{

TriangleMesh readClosedMesh(const Dictionary& dict, const std::filesystem::path& casePath)
{
    const std::filesystem::path file = casePath/"constant"/"triSurface"/dict.lookup<std::string>("file");
    TriangleMesh mesh = withSharedVertices(readStl(file, dict.name()).mesh);
    const MeshDefects defects = findDefects(mesh);
    if (!defects.none() || mesh.volume() == 0)
    {
        std::ostringstream found;
        found << "The surface " << file.string() << " encloses no body: " << defects.boundaryEdges << " open edges, "
              << defects.nonManifoldEdges << " edges of more than two triangles, " << defects.flippedEdges
              << " edges between triangles that are turned against each other, volume " << mesh.volume();
        throw FatalInputError(dict.where("file"), found.str(), "a closed surface, all of whose triangles look outward");
    }

    const double scale = dict.found("scale") ? dict.lookupPositive("scale", dimensions::none) : 1;
    Vector3 move;
    if (dict.found("translate")) move = dict.lookupDimensionedVector("translate", dimensions::length);
    for (Vector3& vertex : mesh.vertices) vertex = scale*vertex + move;
    return mesh;
}

}

class SurfaceBody : public LiquidShape<SurfaceBody>
{
public:
    SurfaceBody(const Dictionary& dict, const std::filesystem::path& casePath)
    :
        mesh_(readClosedMesh(dict, casePath)), windingNumber_(mesh_), bounds_(boundsOf(mesh_.vertices))
    {}

    BodyFrame frame() const override { return {bounds_.low}; }
    Vector3 low() const override { return {}; }
    Vector3 high() const override { return bounds_.size(); }
    bool contains(const Vector3& x) const override { return windingNumber_(x) != 0; }
    double volume() const override { return std::abs(mesh_.volume()); }

private:
    TriangleMesh mesh_;
    WindingNumber windingNumber_;       // refers to the mesh
    Bounds bounds_;                     // m
};

static const LiquidBodyTable::Add<SurfaceBody> registered{"surface"};

}
