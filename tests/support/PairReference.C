// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/PairReference.H"

namespace shizuku::test
{

using std::numbers::pi;

double PairSystem::cohesion(double r) const
{
    const double cubes = std::pow((h - r) * r, 3);
    return r <= 0 || r > h ? 0 : 32 / (pi * std::pow(h, 9)) * (r > h / 2 ? cubes : 2 * cubes - std::pow(h, 6) / 64);
}

double PairSystem::overFloor(double s, const std::function<double(double)>& f) const
{
    return s >= h ? 0 : integrate(s, h, 400, [&](double r) { return 2 * pi * r * (r - s) * f(r); });
}

double PairSystem::towardsFloor(double s, const std::function<double(double)>& f) const
{
    return s >= h ? 0 : integrate(s, h, 400, [&](double r) { return pi * (r * r - s * s) * f(r); });
}

void PairSystem::prepare()
{
    const double particleVolume = spacing * spacing * spacing;
    double latticeSum = 0;
    const int reach = int(h / spacing) + 1;
    for (int i = -reach; i <= reach; ++i)
        for (int j = -reach; j <= reach; ++j)
            for (int k = -reach; k <= reach; ++k)
            {
                latticeSum += particleVolume * W(spacing * std::sqrt(i * i + j * j + k * k));
            }

    volume.clear();
    for (const Vector3& k : solid)
    {
        double sum = 0;
        for (const Vector3& l : solid) sum += W(length(k - l));
        volume.push_back(1 / sum);
    }
    density.clear();
    for (const Vector3& x : liquid)
    {
        double sum = 0, share = 0;
        for (const Vector3& y : liquid) sum += W(length(x - y));
        for (std::size_t k = 0; k < solid.size(); ++k) share += volume[k] * W(length(x - solid[k]));
        if (floor) share += overFloor(x.z, W);
        density.push_back(particleVolume * sum / latticeSum + share);
    }
    normal.clear();
    for (const Vector3& x : liquid)
    {
        Vector3 sum;
        for (std::size_t j = 0; j < liquid.size(); ++j)
        {
            const Vector3 r = x - liquid[j];
            if (squaredLength(r) > 0) sum += particleVolume / density[j] * slope(length(r)) * normalized(r);
        }
        if (wallNormals)
        {
            for (std::size_t k = 0; k < solid.size(); ++k)
            {
                const Vector3 r = x - solid[k];
                sum += (1 + solidCosTheta) * volume[k] * slope(length(r)) * normalized(r);
            }
            if (floor) sum += (1 + floorCosTheta) * towardsFloor(x.z, slope) * Vector3(0, 0, 1);
        }
        normal.push_back(h * sum);
    }
}

std::vector<Vector3> PairSystem::tension() const
{
    const double mass = restDensity * spacing * spacing * spacing;
    std::vector<Vector3> result;
    for (std::size_t i = 0; i < liquid.size(); ++i)
    {
        Vector3 sum;
        for (std::size_t j = 0; j < liquid.size(); ++j)
        {
            const Vector3 r = liquid[i] - liquid[j];
            if (j == i || length(r) >= h) continue;
            const double K = 2 / (density[i] + density[j]);
            sum -= K * gamma * mass * cohesion(length(r)) * normalized(r);
            sum -= K * gamma * areaDensity * (normal[i] - normal[j]);
        }
        result.push_back(sum);
    }
    return result;
}

Vector3 PairSystem::normalAt(const Vector3& place) const
{
    if (!liquidNormals) return solidNormal;
    Vector3 sum;
    for (std::size_t j = 0; j < liquid.size(); ++j)
    {
        const Vector3 r = place - liquid[j];
        if (length(r) < h) sum += spacing * spacing * spacing / density[j] * slope(length(r)) * normalized(r);
    }
    return h * sum;
}

std::vector<Vector3> PairSystem::wetting() const
{
    std::vector<Vector3> result;
    for (std::size_t i = 0; i < liquid.size(); ++i)
    {
        Vector3 sum;
        for (std::size_t k = 0; k < solid.size(); ++k)
        {
            const Vector3 r = liquid[i] - solid[k];
            if (length(r) >= h) continue;
            const double share = gamma * (1 + solidCosTheta) / 2;
            sum -= share * restDensity * volume[k] * cohesion(length(r)) * normalized(r);
            sum -= share * areaDensity * (normal[i] - normalAt(solid[k]));
        }
        const double s = liquid[i].z;
        if (floor && s < h)
        {
            const double share = gamma * (1 + floorCosTheta) / 2, depth = s + spacing / 2;
            const double layer = pi * std::max(h * h - depth * depth, 0.0) / (spacing * spacing);
            sum -= share * restDensity * towardsFloor(s, [&](double r) { return cohesion(r); }) * Vector3(0, 0, 1);
            sum -= share * areaDensity * layer * (normal[i] - normalAt(liquid[i] - depth * Vector3(0, 0, 1)));
        }
        result.push_back(2 / (density[i] + 1) * sum);
    }
    return result;
}

testing::AssertionResult agree
(
    const std::vector<Vec3>& scaled, const Units& units, const std::vector<Vector3>& expected, double tolerance
)
{
    double largest = 0, worst = 0;
    std::size_t where = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
        const double unit = units.of(dimensions::acceleration);
        const Vector3 found(scaled[i].x * unit, scaled[i].y * unit, scaled[i].z * unit);
        const double difference = length(found - expected[i]);
        largest = std::max(largest, length(expected[i]));
        if (!(difference <= worst))
        {
            worst = difference;
            where = i;
        }
    }
    if (largest > 0 && worst <= tolerance * largest) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "particle " << where << " is off by " << worst << " m/s2, the largest of "
                                       << expected.size() << " accelerations is " << largest;
}

}
