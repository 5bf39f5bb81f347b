// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/PlaneFit.H"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace shizuku
{

std::optional<PlaneFit> fitPlane(const std::vector<Vector3>& points)
{
    if (points.size() < 3) return std::nullopt;
    Vector3 mean;
    for (const Vector3& p : points) mean += p;
    mean *= 1.0/points.size();

    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Vector3& p : points)
    {
        const Vector3 d = p - mean;
        const Eigen::Vector3d column(d.x, d.y, d.z);
        covariance += column*column.transpose()/double(points.size());
    }

    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);      // values ascend
    const auto& values = eigen.eigenvalues();
    constexpr double onALine = 1e-12;           // second variance against the largest
    if (!(values[1] > onALine*values[2])) return std::nullopt;

    const auto normal = eigen.eigenvectors().col(0);
    return PlaneFit{{mean, normalized(Vector3(normal[0], normal[1], normal[2]))}, std::sqrt(std::max(0.0, values[0]))};
}

}
