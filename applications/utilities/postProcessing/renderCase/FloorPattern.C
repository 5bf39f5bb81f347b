// SPDX-License-Identifier: GPL-3.0-or-later
#include "FloorPattern.H"

#include "caseFiles/SolidParticles.H"
#include "thetaModels/ThetaField.H"

#include <algorithm>

namespace shizuku
{

void addFloorPattern(PictureScene& scene, const std::filesystem::path& casePath, const TimeFolder& time)
{
    if (!scene.floor || !haveSolidParticles(casePath)) return;
    const auto folder = findInstance(casePath, time.value, "solid/theta");
    if (folder.empty()) return;
    const SolidParticles solid = readSolidParticles(casePath);
    const std::vector<double> theta = readTheta(folder, solid.positions.size());
    const Vector3& n = scene.floor->normal;
    for (std::size_t i = 0; i < theta.size(); ++i)
    {
        const double height = dot(solid.positions[i] - scene.floor->point, n);
        if (std::abs(height) > scene.spacing || dot(solid.normals[i], n) < 0.9) continue;
        const double above = 0.02*scene.spacing;            // so that the floor does not hide it
        scene.pattern.push_back(solid.positions[i] + (above - height)*n);
        scene.theta.push_back(theta[i]);
    }
    if (std::adjacent_find(scene.theta.begin(), scene.theta.end(), std::not_equal_to<>()) == scene.theta.end())
    {
        scene.pattern.clear();
        scene.theta.clear();
    }
}

}
