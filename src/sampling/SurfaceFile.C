#include "sampling/SurfaceFile.H"

#include "core/messages/Error.H"
#include "meshes/ObjFile.H"
#include "meshes/StlFile.H"

#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/Simple_cartesian.h>

#include <boost/algorithm/string/case_conv.hpp>

namespace shizuku
{

namespace
{

using Point = CGAL::Simple_cartesian<double>::Point_3;

PatchedSurface readPolygons(const std::filesystem::path& file, const std::string& extension, const std::string& unnamed)
{
    std::vector<Point> points;
    std::vector<std::vector<std::size_t>> polygons;
    const std::string name = file.string(), format = extension == ".ply" ? "PLY" : "OFF";
    const bool good =
        extension == ".ply" ? CGAL::IO::read_PLY(name, points, polygons)
      : CGAL::IO::read_OFF(name, points, polygons);
    if (!good || polygons.empty())
    {
        throw FatalInputError({name, 0}, "The file is no " + format + " surface, not all of one, or has no face");
    }

    PatchedSurface surface;
    surface.patches = {unnamed};
    for (const Point& p : points)
    {
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
        {
            throw FatalInputError({name, 0}, "The surface has a coordinate that is no finite number");
        }
        surface.mesh.vertices.emplace_back(p.x(), p.y(), p.z());
    }
    for (const auto& polygon : polygons)
    {
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
        {
            const std::array<std::size_t, 3> corners{polygon[0], polygon[k], polygon[k + 1]};
            if (*std::max_element(corners.begin(), corners.end()) >= points.size())
            {
                throw FatalInputError({name, 0}, "A face of the surface names a vertex that is not there");
            }
            surface.mesh.faces.push_back({int(corners[0]), int(corners[1]), int(corners[2])});
            surface.patch.push_back(0);
        }
    }
    return surface;
}

}

PatchedSurface readSurface(const std::filesystem::path& file, const std::string& unnamed)
{
    const std::string extension = boost::algorithm::to_lower_copy(file.extension().string());
    if (extension == ".stl") return readStl(file, unnamed);
    if (extension == ".obj") return readObj(file, unnamed);
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
    return readPolygons(file, extension, unnamed);
}

}
