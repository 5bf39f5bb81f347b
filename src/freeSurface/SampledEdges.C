// SPDX-License-Identifier: GPL-3.0-or-later
#include "freeSurface/SampledEdges.H"

#include "walls/Walls.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

constexpr double twoPi = 6.28318530717958648;

// The kernel's integral over the plane at distance s.
double overPlane(const KernelChoice& kernel, double s)
{
    constexpr int parts = 400;
    const double h = supportOf(kernel);
    double sum = 0;
    std::visit
    (
        [&](const auto& W)
        {
            for (int k = 0; k < parts; ++k)
            {
                const double y = h * (k + 0.5) / parts;
                sum += twoPi * y * W.W(scalar(std::sqrt(y * y + s * s))) * h / parts;
            }
        },
        kernel
    );
    return sum;
}

}

SampledEdges::SampledEdges(const KernelChoice& kernel, const KernelChoice& ofVolumes, scalar spacing) : reach_(supportOf(kernel) + 0.5f * spacing)
{
    constexpr int n = 256, nearest = n / 16;        // nearer than that no liquid comes
    const double inside = 0.5 * spacing, perVolume = overPlane(ofVolumes, 0);
    std::vector<LayerIntegrals> table(n + 1);
    for (int i = 0; i < n; ++i)
    {
        const double r = double(reach_) * std::max(i, nearest) / n, s = std::max(r - inside, 0.0);
        const double plane = overPlane(kernel, s), W = std::visit([&](const auto& kernel) { return double(kernel.W(scalar(s))); }, kernel);
        table[i] = {scalar(perVolume * plane / (twoPi * r)), scalar(-perVolume * (s * W + plane / (twoPi * r)) / (r * r))};
    }
    table_.upload(table);
}

void SampledEdges::follow(const WallPlanesView& planes, const KernelChoice& kernel, const Liquid& liquid)
{
    if (table_.size() == 0 && planes.edge.size > 0) *this = SampledEdges(kernel, liquid.kernel(), liquid.spacing());
}

}
