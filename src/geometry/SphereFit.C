#include "geometry/SphereFit.H"

#include "geometry/LinearSolve.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// Normal equations of a linear least-squares problem with four unknowns.
struct NormalEquations
{
    SmallMatrix<4> matrix{};
    SmallVector<4> right{};

    void add(const SmallVector<4>& row, double value)
    {
        for (int i = 0; i < 4; ++i)
        {
            for (int j = 0; j < 4; ++j) matrix[i][j] += row[i]*row[j];
            right[i] += row[i]*value;
        }
    }
    std::optional<SmallVector<4>> solve() const { return solveSymmetric(matrix, right); }
};

std::optional<SphereFit> algebraicFit(const std::vector<Vector3>& points)
{
    NormalEquations equations;
    for (const Vector3& p : points) equations.add({2*p.x, 2*p.y, 2*p.z, 1}, dot(p, p));
    const auto solution = equations.solve();
    if (!solution) return std::nullopt;
    const auto& [x, y, z, rest] = *solution;
    const Vector3 centre(x, y, z);
    return SphereFit{centre, std::sqrt(std::max(0.0, rest + dot(centre, centre))), 0};
}

double rmsDistance(const SphereFit& sphere, const std::vector<Vector3>& points)
{
    double sum = 0;
    for (const Vector3& p : points)
    {
        const double distance = length(p - sphere.centre) - sphere.radius;
        sum += distance*distance;
    }
    return std::sqrt(sum/points.size());
}

// Gauss-Newton on the geometric distance; keeps the best sphere it met.
SphereFit refine(SphereFit best, const std::vector<Vector3>& points)
{
    constexpr int maxSteps = 50;
    constexpr double smallestStep = 1e-12;      // of the radius
    best.rms = rmsDistance(best, points);
    for (int step = 0; step < maxSteps; ++step)
    {
        NormalEquations equations;
        for (const Vector3& p : points)
        {
            const Vector3 fromCentre = p - best.centre;
            const double distance = length(fromCentre);
            if (distance == 0) continue;        // a point in the centre has no direction
            const Vector3 u = fromCentre/distance;
            equations.add({u.x, u.y, u.z, 1}, distance - best.radius);
        }
        const auto change = equations.solve();
        if (!change) break;
        const auto& [dx, dy, dz, dRadius] = *change;
        SphereFit next{best.centre + Vector3(dx, dy, dz), best.radius + dRadius, 0};
        next.rms = rmsDistance(next, points);
        if (!(next.rms < best.rms)) break;
        best = next;
        if (std::abs(dRadius) + length({dx, dy, dz}) < smallestStep*best.radius) break;
    }
    return best;
}

}

std::optional<SphereFit> fitSphere(const std::vector<Vector3>& points)
{
    if (points.size() < 4) return std::nullopt;

    // In units of the cloud's size about its mean, so that the normal equations are well scaled.
    Vector3 mean;
    for (const Vector3& p : points) mean += p;
    mean *= 1.0/points.size();
    double size = 0;
    for (const Vector3& p : points) size = std::max(size, length(p - mean));
    if (size == 0) return std::nullopt;

    std::vector<Vector3> scaled;
    scaled.reserve(points.size());
    for (const Vector3& p : points) scaled.push_back((p - mean)/size);

    const auto start = algebraicFit(scaled);
    if (!start) return std::nullopt;
    SphereFit fit = refine(*start, scaled);
    fit.centre = mean + size*fit.centre;
    fit.radius *= size;
    fit.rms *= size;
    return fit;
}

}
