// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/FieldsAt.H"

#include "device/HostThreads.H"
#include "meshes/NearestPoint.H"
#include "meshes/PointGrid.H"

namespace shizuku
{

namespace
{

// What a place takes of particles.
struct Share
{
    std::vector<std::pair<int, double>> weights;        // that add up to 1
    int nearest = 0;
};

Share shareAt(const Vector3& place, const PointGrid& grid, const NearestPoint& nearest, double reach)
{
    Share share;
    double sum = 0, closest = reach*reach;
    grid.forEachWithin(place, reach, [&](int particle, double squared)
    {
        const double weight = std::pow(1 - squared/(reach*reach), 2);
        share.weights.emplace_back(particle, weight);
        sum += weight;
        if (squared >= closest) return;
        closest = squared;
        share.nearest = particle;
    });
    if (sum > 0)
    {
        for (auto& [particle, weight] : share.weights) weight /= sum;
        return share;
    }
    share.nearest = int(nearest(place));
    share.weights = {{share.nearest, 1}};
    return share;
}

}

std::vector<FieldData> fieldsAt
(
    const std::vector<Vector3>& places, const std::vector<Vector3>& particles, const std::vector<FieldData>& fields, double spacing
)
{
    std::vector<FieldData> result;
    if (particles.empty()) return result;
    for (const FieldData& field : fields)
    {
        result.push_back(field);
        if (!field.uniform) result.back().values.assign(places.size()*componentsOf(field.type), 0);
    }
    const double reach = 2.5*spacing;
    const PointGrid grid(reach, particles);
    const NearestPoint nearest(particles);
    forEachInParallel(places.size(), [&](std::size_t i)
    {
        const Share share = shareAt(places[i], grid, nearest, reach);
        for (std::size_t f = 0; f < fields.size(); ++f)
        {
            if (fields[f].uniform) continue;
            const int components = componentsOf(fields[f].type);
            for (int c = 0; c < components; ++c)
            {
                double& value = result[f].values[i*components + c];
                if (fields[f].type == FieldType::label) value = fields[f](share.nearest, c);
                else for (const auto& [particle, weight] : share.weights) value += weight*fields[f](particle, c);
            }
        }
    });
    return result;
}

}
