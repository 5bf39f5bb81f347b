// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/MeshCurvature.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// What a triangle gives to its corners: along each edge the cotangent of the angle opposite to it, and the part of its area that is nearest to them. In an obtuse one
// half of the area is that of the corner there.
struct CurvatureShare
{
    std::array<double, 3> cotangent{}, area{};

    explicit CurvatureShare(const std::array<Vector3, 3>& x)
    {
        const double doubled = length(cross(x[1] - x[0], x[2] - x[0]));
        if (!(doubled > 0)) return;
        for (int k = 0; k < 3; ++k) cotangent[k] = dot(x[(k + 1)%3] - x[k], x[(k + 2)%3] - x[k])/doubled;
        const auto obtuse = std::find_if(cotangent.begin(), cotangent.end(), [](double c) { return c < 0; });
        for (int k = 0; k < 3; ++k)
        {
            const int i = (k + 1)%3, j = (k + 2)%3;
            if (obtuse != cotangent.end()) area[k] = doubled/(obtuse - cotangent.begin() == k ? 4 : 8);
            else area[k] = (cotangent[i]*squaredLength(x[j] - x[k]) + cotangent[j]*squaredLength(x[i] - x[k]))/8;
        }
    }
};

}

std::vector<double> meanCurvature(const TriangleMesh& mesh)
{
    std::vector<Vector3> pull(mesh.vertices.size()), normals(mesh.vertices.size());
    std::vector<double> areas(mesh.vertices.size(), 0), curvature(mesh.vertices.size(), 0);
    for (const auto& face : mesh.faces)
    {
        const std::array<Vector3, 3> x{mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]};
        const CurvatureShare share(x);
        for (int k = 0; k < 3; ++k)
        {
            const int i = (k + 1)%3, j = (k + 2)%3;
            pull[face[i]] += share.cotangent[k]*(x[i] - x[j]);
            pull[face[j]] += share.cotangent[k]*(x[j] - x[i]);
            areas[face[k]] += share.area[k];
            normals[face[k]] += cross(x[1] - x[0], x[2] - x[0]);
        }
    }
    for (std::size_t v = 0; v < curvature.size(); ++v)
    {
        if (areas[v] > 0 && squaredLength(normals[v]) > 0) curvature[v] = dot(pull[v], normalized(normals[v]))/(4*areas[v]);
    }
    return curvature;
}

}
