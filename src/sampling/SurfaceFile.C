// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/SurfaceFile.H"

#include "core/messages/Error.H"
#include "meshes/ObjFile.H"
#include "meshes/PlyFile.H"
#include "meshes/PolygonTriangles.H"
#include "meshes/StlFile.H"

#include <CGAL/IO/OFF.h>
#include <CGAL/Simple_cartesian.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

namespace shizuku
{

namespace
{

using Point = CGAL::Simple_cartesian<double>::Point_3;

// What CGAL makes as long as the file says, before it has read that much: no longer than the file has room for.
template<class T>
struct LimitedVector : std::vector<T>
{
    std::size_t most = std::numeric_limits<std::size_t>::max();

    void resize(std::size_t size)
    {
        if (size > most) throw std::length_error("more than the file has room for");
        std::vector<T>::resize(size);
    }
};

struct Polygon : LimitedVector<std::size_t>
{
    Polygon() { most = 1'000'000; }
};

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& found, const std::string& expected = "")
{
    throw FatalInputError({file.string(), 0}, found, expected);
}

PatchedSurface readOff(const std::filesystem::path& file, const std::string& unnamed)
{
    LimitedVector<Point> points;
    LimitedVector<Polygon> polygons;
    points.most = polygons.most = std::filesystem::file_size(file)/2;       // a digit and a blank
    bool good = false;
    try { good = CGAL::IO::read_OFF(file.string(), points, polygons); }
    catch (const std::logic_error&) {}          // lengths beyond these, and what CGAL asserts
    catch (const std::bad_alloc&) {}
    if (!good || polygons.empty())
    {
        fail(file, "The file is no OFF surface, not all of one, or has no face",
            "a line OFF, a line of the numbers of vertices and faces, a line a vertex, a line a face");
    }

    PatchedSurface surface;
    surface.patches = {unnamed};
    for (const Point& p : points)
    {
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
        {
            fail(file, "The surface has a coordinate that is no finite number");
        }
        surface.mesh.vertices.emplace_back(p.x(), p.y(), p.z());
    }
    for (const auto& polygon : polygons)
    {
        if (polygon.size() < 3) continue;
        if (*std::max_element(polygon.begin(), polygon.end()) >= points.size())
        {
            fail(file, "A face of the surface names a vertex that is not there");
        }
        for (const auto& triangle : trianglesOf(surface.mesh.vertices, std::vector<int>(polygon.begin(), polygon.end())))
        {
            surface.mesh.faces.push_back(triangle);
        }
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
