// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/PlaneFit.H"

#include "maths/LinearSolve.H"

#include <algorithm>

namespace shizuku
{

namespace
{

struct Eigen
{
    SmallVector<3> values;
    SmallMatrix<3> vectors;     // one a column
};

// Jacobi's rotations: each makes one off-diagonal element zero; a few sweeps reach rounding.
Eigen eigenOf(SmallMatrix<3> a)
{
    SmallMatrix<3> v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    constexpr int sweeps = 12;
    for (int sweep = 0; sweep < sweeps; ++sweep)
    {
        for (const auto& [p, q] : {std::pair{0, 1}, {0, 2}, {1, 2}})
        {
            if (a[p][q] == 0) continue;
            const double angle = 0.5*std::atan2(2*a[p][q], a[q][q] - a[p][p]);
            const double c = std::cos(angle), s = std::sin(angle);
            const auto rotate = [c, s](double& left, double& right)
            {
                const double old = left;
                left = c*old - s*right;
                right = s*old + c*right;
            };
            for (int k = 0; k < 3; ++k) rotate(a[k][p], a[k][q]);
            for (int k = 0; k < 3; ++k) rotate(a[p][k], a[q][k]);
            for (int k = 0; k < 3; ++k) rotate(v[k][p], v[k][q]);
        }
    }
    return {{a[0][0], a[1][1], a[2][2]}, v};
}

}

std::optional<PlaneFit> fitPlane(const std::vector<Vector3>& points)
{
    if (points.size() < 3) return std::nullopt;
    Vector3 mean;
    for (const Vector3& p : points) mean += p;
    mean *= 1.0/points.size();

    SmallMatrix<3> covariance{};
    for (const Vector3& p : points)
    {
        const Vector3 d = p - mean;
        for (int i = 0; i < 3; ++i)
        {
            for (int j = 0; j < 3; ++j) covariance[i][j] += d[i]*d[j]/points.size();
        }
    }

    const Eigen eigen = eigenOf(covariance);
    SmallVector<3> sorted = eigen.values;
    std::sort(sorted.begin(), sorted.end());
    constexpr double onALine = 1e-12;           // second variance against the largest
    if (!(sorted[1] > onALine*sorted[2])) return std::nullopt;

    const auto smallest = std::min_element(eigen.values.begin(), eigen.values.end()) - eigen.values.begin();
    const Vector3 normal(eigen.vectors[0][smallest], eigen.vectors[1][smallest], eigen.vectors[2][smallest]);
    return PlaneFit{{mean, normalized(normal)}, std::sqrt(std::max(0.0, sorted[0]))};
}

}
