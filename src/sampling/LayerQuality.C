// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/LayerQuality.H"

#include "device/HostThreads.H"
#include "sampling/RandomPlaces.H"

#include <algorithm>
#include <limits>
#include <optional>
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
    std::vector<double> gaps(layer.particles().size());
    forEachInParallel(gaps.size(), [&](std::size_t i)
    {
        double nearest2 = std::numeric_limits<double>::infinity();
        bool self = false;
        grid.forEachWithin(layer.particles()[i].position, reach, [&](int, double d2)
        {
            if (d2 == 0 && !self) self = true;      // the first of two particles at one place is this one
            else nearest2 = std::min(nearest2, d2);
        });
        gaps[i] = std::sqrt(nearest2);
    });
    double sum = 0;
    std::size_t paired = 0;
    quality.minGap = std::numeric_limits<double>::infinity();
    for (const double gap : gaps)
    {
        if (!std::isfinite(gap)) continue;
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
    std::vector<double> volume(layer.particles().size());
    forEachInParallel(volume.size(), [&](std::size_t i) { volume[i] = 1/sumOf(layer.particles()[i].position, [](int) { return 1.0; }); });
    for (const double one : volume) quality.meanVolume += one*d*d*d/double(volume.size());
    const auto [least, most] = std::minmax_element(volume.begin(), volume.end());
    quality.minVolume = *least*d*d*d;
    quality.maxVolume = *most*d*d*d;

    const PointGrid border = borderPoints(layer.surface(), 0.5*d, support);
    double sum = 0, sum2 = 0;
    std::size_t places = 0;
    std::mt19937_64 random(1);
    const long tries = std::clamp<long>(long(volume.size()), 1000, 100000);
    RandomPlaces all(layer.surface(), tries, random);
    for (auto some = all.next(); !some.empty(); some = all.next())
    {
        std::vector<std::optional<double>> density(some.size());
        forEachInParallel(some.size(), [&](std::size_t i)
        {
            if (border.anyWithin(some[i].position, support)) return;
            const Vector3 liquid = some[i].position + 0.5*d*layer.surface().normal(some[i]);
            density[i] = sumOf(liquid, [&](int k) { return volume[k]; });
        });
        for (const std::optional<double>& one : density)
        {
            if (!one) continue;
            sum += *one;
            sum2 += *one**one;
            ++places;
        }
    }
    if (places == 0) return;
    quality.wallDensity = sum/double(places);
    const double variance = sum2/double(places) - quality.wallDensity*quality.wallDensity;
    quality.densityVariation = std::sqrt(std::max(0.0, variance))/quality.wallDensity;
}

// The largest of some places of the layer, to half of the size of the smallest piece: those of the pieces that were searched.
class HoleSearch
{
public:
    HoleSearch(const ParticleLayer& layer, const PointGrid& grid) : layer_(layer), grid_(grid) {}

    double largest() const { return largest_; }

    void search(const SurfacePiece& piece)
    {
        searchPlaces(piece, [&](const LayerParticle& particle, double hole)
        {
            if (hole <= largest_) return hole;
            const bool clear = layer_.clear(particle);
            hole = layer_.holeAt(particle, clear, grid_, reach_);
            for (double further = 2*reach_; !std::isfinite(hole); further *= 2)
            {
                hole = layer_.holeAt(particle, clear, grid_, further);
            }
            largest_ = std::max(largest_, hole);
            return hole;
        });
    }

    // Whether search() might find a larger one, now or when it has found others.
    bool mightFindLarger(const SurfacePiece& piece) const
    {
        bool might = false;
        searchPlaces(piece, [&](const LayerParticle&, double hole)
        {
            might = might || hole > largest_;
            return hole;
        });
        return might;
    }

private:
    // holeAt(particle, distance of the nearest one) answers how large the hole around the place is.
    template<class HoleAt>
    void searchPlaces(const SurfacePiece& piece, const HoleAt& holeAt) const
    {
        searchPiece(piece, 0.1*layer_.spacing(), [&](const SurfacePoint& place, double pieceRadius)
        {
            if (pieceRadius >= 0.6*layer_.spacing()) return true;       // too large to be covered by one particle, as a rule
            const LayerParticle particle = layer_.particleAt(place);
            if (grid_.anyWithin(particle.position, largest_ - pieceRadius)) return false;
            return holeAt(particle, grid_.nearestDistance(particle.position, reach_)) + pieceRadius > largest_;
        });
    }

    const ParticleLayer& layer_;
    const PointGrid& grid_;
    double reach_ = 2*layer_.spacing();         // m
    double largest_ = 0;                        // m
};

// The largest of all places. Before some pieces are searched in their order, all threads look which of them might have a larger hole than those found before:
// hardly any, once a few were searched.
double findLargestHole(const ParticleLayer& layer, const PointGrid& grid)
{
    constexpr double size = 8;                  // spacings
    const std::vector<SurfacePiece> pieces = layer.surface().pieces(size*layer.spacing());
    std::vector<char> might(pieces.size());
    HoleSearch holes(layer, grid);
    for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end)
    {
        end = std::min(pieces.size(), 2*begin + 16);
        forEachInParallel(end - begin, [&](std::size_t i) { might[begin + i] = holes.mightFindLarger(pieces[begin + i]); }, 16);
        for (std::size_t i = begin; i < end; ++i)
        {
            if (might[i]) holes.search(pieces[i]);
        }
    }
    return holes.largest();
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
