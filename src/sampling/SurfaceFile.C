// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/SurfaceFile.H"

#include "core/messages/Error.H"
#include "meshes/ObjFile.H"
#include "meshes/PlyFile.H"
#include "meshes/PolygonTriangles.H"
#include "meshes/StlFile.H"

#include <CGAL/IO/OFF/File_scanner_OFF.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <cmath>
#include <fstream>
#include <vector>

namespace shizuku
{

namespace
{

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& found, const std::string& expected = "")
{
    throw FatalInputError({file.string(), 0}, found, expected);
}

// CGAL reads lines; what stands in them behind points and corners (colours, normals, textures) is left alone, which it would look for behind their ends.
PatchedSurface readOff(const std::filesystem::path& file, const std::string& unnamed)
{
    constexpr std::size_t mostCorners = 1'000'000;
    const auto refuse = [&]
    {
        fail(file, "The file is no OFF surface, not all of one, or has no face",
            "a line OFF, a line of the numbers of vertices and faces, a line a vertex, a line a face");
    };
    std::ifstream in(file, std::ios::binary);
    CGAL::File_scanner_OFF scanner(in);
    const std::size_t room = std::filesystem::file_size(file)/2;        // a digit and a blank for each
    if (!in || scanner.size_of_vertices() > room || scanner.size_of_facets() > room || scanner.size_of_facets() == 0) refuse();
    if (scanner.binary()) fail(file, "The OFF surface is binary", "numbers as text");

    PatchedSurface surface;
    surface.patches = {unnamed};
    for (std::size_t i = 0; i < scanner.size_of_vertices(); ++i)
    {
        double x = 0, y = 0, z = 0, w = 1;
        scanner.scan_vertex(x, y, z, w);
        if (!in) refuse();
        const Vector3 point{x/w, y/w, z/w};
        if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z))
        {
            fail(file, "The surface has a coordinate that is no finite number");
        }
        surface.mesh.vertices.push_back(point);
    }
    for (std::size_t i = 0; i < scanner.size_of_facets(); ++i)
    {
        std::size_t corners = 0;
        scanner.scan_facet(corners, i);
        if (!in || corners > mostCorners) refuse();
        std::vector<int> polygon;
        for (std::size_t k = 1; k <= corners; ++k)
        {
            std::size_t vertex = 0;
            scanner.scan_facet_vertex_index(vertex, k, i);
            if (!in) refuse();
            polygon.push_back(int(vertex));
        }
        if (polygon.size() < 3) continue;
        for (const auto& triangle : trianglesOf(surface.mesh.vertices, polygon)) surface.mesh.faces.push_back(triangle);
    }
    surface.patch.assign(surface.mesh.faces.size(), 0);
    return surface;
}

PatchedSurface readPlySurface(const std::filesystem::path& file, const std::string& unnamed)
{
    PatchedSurface surface;
    surface.mesh = readPly(file);
    surface.mesh.normals.clear();
    surface.patches = {unnamed};
    surface.patch.assign(surface.mesh.faces.size(), 0);
    if (surface.mesh.faces.empty()) fail(file, "The PLY surface has no face");
    return surface;
}

}

PatchedSurface readSurface(const std::filesystem::path& file, const std::string& unnamed)
{
    const std::string extension = boost::algorithm::to_lower_copy(file.extension().string());
    if (extension == ".stl") return readStl(file, unnamed);
    if (extension == ".obj") return readObj(file, unnamed);
    if (extension == ".gz")
    {
        throw FatalInputError({file.string(), 0}, "The surface file is packed", "the file that `gunzip -k` makes of it");
    }
    if (extension != ".ply" && extension != ".off")
    {
        throw FatalInputError
        (
            {file.string(), 0}, "Unknown surface format '" + extension + "'", "one of the extensions below",
            {".stl", ".obj", ".ply", ".off"}, extension
        );
    }
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    if (error) throw FatalInputError({file.string(), 0}, "Cannot read the surface file " + file.string());
    if (size == 0) throw FatalInputError({file.string(), 0}, "The surface file is empty", "a surface");
    return extension == ".ply" ? readPlySurface(file, unnamed) : readOff(file, unnamed);
}

}
