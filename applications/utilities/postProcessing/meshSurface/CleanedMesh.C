// SPDX-License-Identifier: GPL-3.0-or-later
#include "CleanedMesh.H"

namespace shizuku
{

CleanedMesh::CleanedMesh(const std::filesystem::path& casePath, double spacing, double support)
: walls_(casePath, spacing), foot_(walls_, spacing, support)
{}

double CleanedMesh::clean(TriangleMesh& mesh, const TimeFolder& time, const std::vector<Vector3>& particles, double volume)
{
    if (walls_.any()) walls_.readTheta(time.value);
    return foot_.clean(mesh, particles, volume);
}

}
