// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/SphereFit.H"

#include "meshes/BallFit.H"

namespace shizuku
{

std::optional<SphereFit> fitSphere(const std::vector<Vector3>& points, const std::vector<double>& weights)
{
    std::vector<SmallVector<3>> cloud;
    for (const Vector3& p : points) cloud.push_back({p.x, p.y, p.z});
    const auto ball = fitBall<3>(cloud, weights.empty() ? std::vector<double>(points.size(), 1) : weights);
    if (!ball) return std::nullopt;
    return SphereFit{Vector3(ball->centre), ball->radius, ball->rms};
}

}
