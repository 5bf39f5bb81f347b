// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/CaseSurface.H"

#include "core/dictionary/Dictionary.H"
#include "meshes/surfaceFormats/SurfaceFormat.H"

namespace shizuku
{

namespace
{

Dictionary readSurfaceDict(const std::filesystem::path& casePath)
{
    const auto file = casePath / "system/meshSurfaceDict";
    return std::filesystem::exists(file) ? Dictionary::read(file) : Dictionary();
}

SurfaceFileControls fileControlsOf(const Dictionary& dict)
{
    return {dict.lookupOr("formats", std::vector<std::string>{"ply"}), dict.lookupOr("conserveVolume", false), dict.lookupOr("clean", true)};
}

}

SurfaceParameters readSurfaceParameters(const std::filesystem::path& casePath, scalar spacing)
{
    const Dictionary dict = readSurfaceDict(casePath);
    const double cell = dict.lookupOr("cell", 0.5), support = dict.lookupOr("support", 2.0);
    fileControlsOf(dict);
    dict.refuseUnused();
    if (!(cell >= 0.1 && cell <= 2)) throw FatalInputError(dict.where("cell"), "The cell is out of range", "0.1 to 2 spacings");
    if (!(support >= 1 && support <= 8))
    {
        throw FatalInputError(dict.where("support"), "The support is out of range", "1 to 8 spacings");
    }
    return {spacing, scalar(cell) * spacing, scalar(support) * spacing};
}

SurfaceFileControls readSurfaceFileControls(const std::filesystem::path& casePath)
{
    const Dictionary dict = readSurfaceDict(casePath);
    SurfaceFileControls controls = fileControlsOf(dict);
    for (const std::string& word : controls.formats) SurfaceFormatTable::New("surface format", word, dict.where("formats"));
    return controls;
}

TriangleMesh toTriangleMesh(const SurfaceMesh& mesh, double unit)
{
    TriangleMesh result;
    result.vertices.reserve(mesh.vertices.size());
    result.normals.reserve(mesh.normals.size());
    result.faces.reserve(mesh.triangles.size() / 3);
    for (const Vector3& p : mesh.vertices) result.vertices.push_back(unit * p);
    for (const Vec3& n : mesh.normals) result.normals.push_back({n.x, n.y, n.z});
    for (std::size_t k = 0; k < mesh.triangles.size(); k += 3)
    {
        result.faces.push_back({int(mesh.triangles[k]), int(mesh.triangles[k + 1]), int(mesh.triangles[k + 2])});
    }
    return result;
}

}
