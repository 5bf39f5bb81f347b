// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/VolumeOffset.H"

#include <cmath>

namespace shizuku
{

double offsetToVolume(TriangleMesh& mesh, double volume, double most)
{
    return offsetToVolume(mesh, volume, most, [](const TriangleMesh& moved) { return MeshMeasure{moved.volume(), moved.area()}; });
}

double offsetToVolume(TriangleMesh& mesh, double volume, double most, const std::function<MeshMeasure(const TriangleMesh&)>& measure)
{
    TriangleMesh moved = mesh;
    double offset = 0;
    // Newton: the volume grows by the area times the offset.
    for (int step = 0; step < 10; ++step)
    {
        const MeshMeasure now = measure(moved);
        const double missing = volume - now.volume;
        if (std::abs(missing) <= 1e-4 * volume)
        {
            mesh = std::move(moved);
            return offset;
        }
        offset += missing / now.area;
        if (!(std::abs(offset) <= most)) break;
        for (std::size_t k = 0; k < mesh.vertices.size(); ++k)
        {
            moved.vertices[k] = mesh.vertices[k] + offset * mesh.normals[k];
        }
    }
    return std::nan("");
}

}
