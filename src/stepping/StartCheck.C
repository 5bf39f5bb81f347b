// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/StartCheck.H"

#include "device/Gather.H"
#include "device/Reduce.H"
#include "meshes/Vector3.H"
#include "motion/Motion.H"
#include "stepping/PressureIterations.H"

#include <cmath>
#include <limits>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr scalar crowdedDensity = 1.1f;

struct CrowdingSums
{
    double density = 0, compression2 = 0;
    scalar most = 0, nearest2 = 1e30f;
    int crowded = 0, densest = 0;

    HOST_DEVICE void add(const CrowdingSums& other)
    {
        density += other.density;
        compression2 += other.compression2;
        crowded += other.crowded;
        nearest2 = fmin(nearest2, other.nearest2);
        if (other.most <= most) return;
        most = other.most;
        densest = other.densest;
    }
};

// Of particles in the order of their cells.
template<class Kernel>
struct CrowdingOf
{
    Kernel W;
    scalar volume;                      // V/S
    CellGridView grid;
    Span<const Position> x;

    HOST_DEVICE CrowdingSums operator()(int i) const
    {
        const Position xi = x[i];
        scalar sum = 0, nearest2 = 1e30f;
        grid.forEachCandidate(AroundPoint{xi, W.h}, [&](int j)
        {
            const scalar r2 = squared(xi - x[j]);
            if (r2 >= W.h * W.h || !isSameImage(xi, x[j])) return;
            sum += W.W(sqrt(r2));
            if (j != i) nearest2 = fmin(nearest2, r2);
        });
        const scalar density = volume * sum, above = fmax(density - 1, 0);
        return {density, above * above, density, nearest2, density > crowdedDensity ? 1 : 0, i};
    }
};

// Each particle by its own random way, up to `most` along each axis: bits of its number, mixed by Knuth's multiplier.
struct Stir
{
    scalar most;
    Span<const std::uint32_t> id;
    Span<Position> position;

    HOST_DEVICE void operator()(int i) const
    {
        const std::uint32_t bits = (id[i] + 1) * 2654435761u;
        const auto part = [&](int shift) { return most * (scalar(bits >> shift & 1023u) / 511.5f - 1); };
        const Position from = position[i];
        position[i] = withBlock(from, from + Vec3{part(0), part(10), part(20)});
    }
};

}

Crowding measureCrowding(const Liquid& liquid)
{
    CellGrid grid(liquid.support());
    const Buffer<std::uint32_t>& order = grid.build(liquid.position.span(), liquid.owned());
    Buffer<Position> sorted;
    gather(liquid.position, order, sorted);
    Buffer<CrowdingSums> scratch;
    const CrowdingSums sums = std::visit
    (
        [&]<class Kernel>(const Kernel& W)
        {
            const scalar volume = liquid.particleVolume() / liquid.latticeSum();
            return reduce(liquid.owned(), CrowdingOf<Kernel>{W, volume, grid.view(), sorted.span()}, scratch);
        },
        liquid.kernel()
    );
    return
    {
        sums.density / liquid.owned(), sums.most, std::sqrt(double(sums.nearest2)) / liquid.spacing(), sums.crowded,
        int(order.download()[sums.densest]), liquid.owned(), std::sqrt(sums.compression2 / liquid.owned())
    };
}

void refuseOverlap(const Liquid& liquid, const std::filesystem::path& folder, const StartLimits& limits)
{
    const Crowding crowding = measureCrowding(liquid);
    if (!crowding.overlaps(limits)) return;

    const double spacing = liquid.properties().spacing;
    std::ostringstream found, expected;
    found << "The liquid starts overlapping itself: " << crowding.crowded << " of its " << liquid.owned()
          << " particles are more than a tenth denser than at rest, the mean density is " << crowding.mean
          << " rest densities, the largest one " << crowding.most << ", at "
          << str(liquid.positions()[crowding.densest]) << " m, the compression (root mean square) "
          << crowding.compression << ", and the smallest distance " << std::round(1e5 * crowding.nearest) / 1e5 << " spacings";
    expected << "liquid at rest density, a mean below " << Crowding::mostMean << " and nowhere " << Crowding::mostOfOne
             << ", of particles one spacing apart";
    if (limits.crowded < 1) expected << "; at a first start at most " << limits.crowded << " of them more than a tenth denser";
    if (std::isfinite(limits.compression))
    {
        expected << ", and a compression of at most " << limits.compression
                 << ", beyond which this pressure model drives the liquid apart";
    }
    expected << ".\n    Run fillLiquid with the spacing of system/solution, " << spacing
             << " m; or give there the one that the liquid was filled with (a lattice of "
             << spacing / std::cbrt(crowding.most) << " m is that dense); and fill no place twice.\n    `overlaps relax;` in system/solution moves the particles apart before the first step";
    throw FatalInputError({(folder / liquid.name() / "positions").string(), 0}, found.str(), expected.str());
}

bool relaxesOverlap(const Dictionary& solution)
{
    return solution.lookupChoiceOr("overlaps", {"refuse", "relax"}, "refuse") == "relax";
}

int relaxOverlap(Liquid& liquid, Neighbourhood& near, Walls& walls, const StartLimits& limits)
{
    if (!measureCrowding(liquid).overlaps(limits)) return 0;

    constexpr int mostRounds = 200;
    FreeSurface unused;
    const auto pressure = Pressure::New
    (
        Dictionary::parse("pressure pbf;"),
        Dictionary::parse("pressure { relaxation 0.3; minIterations 1; maxIterations 5; tolerance 5e-3; }"), liquid, walls, unused
    );
    forEach(liquid.owned(), Stir{0.25f * liquid.spacing(), liquid.id.span(), liquid.position.span()});
    for (int round = 1; round <= mostRounds; ++round)
    {
        predictPositions(liquid, 0);
        near.update(liquid);
        walls.update(liquid);
        iterate(liquid, near, walls, *pressure, 1, [] { return false; });
        takePredicted(liquid);
        if (pressure->iterations() <= 1 && !measureCrowding(liquid).overlaps(limits)) return round;
    }
    throw FatalInputError
    (
        {}, "The liquid still overlaps itself after " + std::to_string(mostRounds) + " rounds of `overlaps relax`",
        "walls that leave room for it: less liquid, or a smaller spacing"
    );
}

}
