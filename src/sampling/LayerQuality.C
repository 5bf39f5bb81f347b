// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/LayerQuality.H"

#include <algorithm>
#include <limits>
#include <random>

namespace shizuku
{

namespace
{

// Points on the open borders of a surface, at most `distance` apart.
PointGrid borderPoints(const SurfaceGeometry& surface, double distance, double cellSize)
{
    PointGrid points(cellSize);
    for (int face = 0; face < surface.faces(); ++face)
    {
        const auto corners = surface.corners(face);
        for (int k = 0; k < 3; ++k)
        {
            if (surface.neighbour(face, k) >= 0) continue;
            const Vector3 edge = corners[(k + 1) % 3] - corners[k];
            const int parts = 1 + static_cast<int>(length(edge)/distance);
            for (int i = 0; i <= parts; ++i) points.insert(corners[k] + double(i)/parts*edge);
        }
    }
    return points;
}

// Gaps between nearest neighbours.
void measureGaps(const ParticleLayer& layer, const PointGrid& grid, LayerQuality& quality)
{
    const double reach = 2*layer.spacing();
    double sum = 0;
    std::size_t paired = 0;
    quality.minGap = std::numeric_limits<double>::infinity();
    for (const LayerParticle& particle : layer.particles())
    {
        double nearest2 = std::numeric_limits<double>::infinity();
        bool self = false;
        grid.forEachWithin(particle.position, reach, [&](int, double d2)
        {
            if (d2 == 0 && !self) self = true;      // the first of two particles at one place is this one
            else nearest2 = std::min(nearest2, d2);
        });
        if (!std::isfinite(nearest2)) continue;
        const double gap = std::sqrt(nearest2);
        quality.minGap = std::min(quality.minGap, gap);
        quality.maxGap = std::max(quality.maxGap, gap);
        sum += gap;
        ++paired;
    }
    if (paired > 0) quality.meanGap = sum/double(paired);
}

// Virtual volumes, and the density that they give to the liquid. Lengths in spacings: no power of a small number overflows.
void measureDensity(const ParticleLayer& layer, const PointGrid& grid, const KernelChoice& kernel, LayerQuality& quality)
{
    const double d = layer.spacing(), support = supportOf(kernel)*d;
    const auto sumOf = [&](const Vector3& x, auto&& weight)
    {
        double sum = 0;
        std::visit([&](const auto& W)
        {
            grid.forEachWithin(x, support, [&](int k, double d2) { sum += weight(k)*W.W(float(std::sqrt(d2)/d)); });
        }, kernel);
        return sum;
    };
    std::vector<double> volume;
    for (const LayerParticle& particle : layer.particles())
    {
        volume.push_back(1/sumOf(particle.position, [](int) { return 1.0; }));
        quality.meanVolume += volume.back()*d*d*d/double(layer.particles().size());
    }
    const auto [least, most] = std::minmax_element(volume.begin(), volume.end());
    quality.minVolume = *least*d*d*d;
    quality.maxVolume = *most*d*d*d;

    const PointGrid border = borderPoints(layer.surface(), 0.5*d, support);
    double sum = 0, sum2 = 0;
    std::size_t places = 0;
    std::mt19937_64 random(1);
    const long tries = std::clamp<long>(long(volume.size()), 1000, 100000);
    layer.surface().forEachRandomPoint(tries, random, [&](const SurfacePoint& place)
    {
        if (border.anyWithin(place.position, support)) return;
        const Vector3 liquid = place.position + 0.5*d*layer.surface().normal(place);
        const double density = sumOf(liquid, [&](int k) { return volume[k]; });
        sum += density;
        sum2 += density*density;
        ++places;
    });
    if (places == 0) return;
    quality.wallDensity = sum/double(places);
    const double variance = sum2/double(places) - quality.wallDensity*quality.wallDensity;
    quality.densityVariation = std::sqrt(std::max(0.0, variance))/quality.wallDensity;
}

// The largest of all places of the layer, to half of the size of the smallest piece.
double findLargestHole(const ParticleLayer& layer, const PointGrid& grid)
{
    const double spacing = layer.spacing(), reach = 2*spacing;
    double largest = 0;
    layer.surface().searchPieces(0.1*spacing, [&](const SurfacePoint& place, double pieceRadius)
    {
        if (pieceRadius >= 0.6*spacing) return true;    // too large to be covered by one particle, as a rule
        const LayerParticle particle = layer.particleAt(place);
        if (grid.anyWithin(particle.position, largest - pieceRadius)) return false;
        double hole = grid.nearestDistance(particle.position, reach);
        if (hole > largest)
        {
            const bool clear = layer.clear(particle);
            hole = layer.holeAt(particle, clear, grid, reach);
            for (double further = 2*reach; !std::isfinite(hole); further *= 2)
            {
                hole = layer.holeAt(particle, clear, grid, further);
            }
            largest = std::max(largest, hole);
        }
        return hole + pieceRadius > largest;
    });
    return largest;
}

}

LayerQuality measureQuality(const ParticleLayer& layer, const KernelChoice& kernel)
{
    LayerQuality quality;
    quality.count = layer.particles().size();
    const PointGrid grid = layer.grid(2*layer.spacing());
    measureGaps(layer, grid, quality);
    measureDensity(layer, grid, kernel, quality);
    quality.largestHole = findLargestHole(layer, grid);
    return quality;
}

}
