#include "geometry/sampling/LayerQuality.H"

#include "maths/Kernel.H"

#include <algorithm>

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

}

LayerQuality measureQuality(const ParticleLayer& layer)
{
    const double spacing = layer.spacing(), support = 2*spacing;
    const PointGrid grid = layer.grid(support);
    const PointGrid border = borderPoints(layer.surface(), 0.5*spacing, support);
    const CubicSpline kernel(static_cast<float>(2));    // lengths in spacings: no power of a small number overflows

    LayerQuality quality;
    quality.count = layer.particles().size();
    quality.minGap = std::numeric_limits<double>::infinity();
    double gaps = 0, sum = 0, sum2 = 0;
    std::size_t paired = 0, inner = 0;
    for (const LayerParticle& particle : layer.particles())
    {
        double density = 0, nearest2 = std::numeric_limits<double>::infinity();
        bool self = false;
        grid.forEachWithin(particle.position, support, [&](int, double d2)
        {
            density += kernel.W(static_cast<float>(std::sqrt(d2)/spacing));
            if (d2 == 0 && !self) self = true;      // the first of two particles at one place is this one
            else nearest2 = std::min(nearest2, d2);
        });
        if (std::isfinite(nearest2))
        {
            quality.minGap = std::min(quality.minGap, std::sqrt(nearest2));
            gaps += std::sqrt(nearest2);
            ++paired;
        }
        if (!border.anyWithin(particle.foot.position, support))
        {
            sum += density;
            sum2 += density*density;
            ++inner;
        }
    }
    if (paired > 0) quality.meanGap = gaps/paired;
    if (inner > 0)
    {
        const double mean = sum/inner;
        quality.densityVariation = std::sqrt(std::max(0.0, sum2/inner - mean*mean))/mean;
    }
    layer.surface().searchPieces(0.1*spacing, [&](const SurfacePoint& place, double pieceRadius)
    {
        if (pieceRadius >= 0.6*spacing) return true;   // too large to be covered by one particle, as a rule
        const LayerParticle particle = layer.particleAt(place);
        if (grid.anyWithin(particle.position, quality.largestHole - pieceRadius)) return false;
        double hole = grid.nearestDistance(particle.position, support);
        if (hole > quality.largestHole)
        {
            const bool clear = layer.clear(particle);
            hole = layer.holeAt(particle, clear, grid, support);
            for (double reach = 2*support; !std::isfinite(hole); reach *= 2)
            {
                hole = layer.holeAt(particle, clear, grid, reach);
            }
            quality.largestHole = std::max(quality.largestHole, hole);
        }
        return hole + pieceRadius > quality.largestHole;
    });
    return quality;
}

}
