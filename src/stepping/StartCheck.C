// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/StartCheck.H"

#include "device/Gather.H"
#include "device/Reduce.H"
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
    int particles = 0, crowded = 0;
    Position densest{};

    HOST_DEVICE void add(const CrowdingSums& other)
    {
        density += other.density;
        compression2 += other.compression2;
        particles += other.particles;
        crowded += other.crowded;
        nearest2 = fmin(nearest2, other.nearest2);
        if (other.most <= most) return;
        most = other.most;
        densest = other.densest;
    }
};

// Of owned particles, among all in the order of their cells.
template<class Kernel>
struct CrowdingOf
{
    Kernel W;
    scalar volume;                      // V/S
    CellGridView grid;
    Span<const Position> x;
    Span<const std::uint32_t> order;
    int owned;

    HOST_DEVICE CrowdingSums operator()(int i) const
    {
        if (int(order[i]) >= owned) return {};
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
        return {density, above * above, density, nearest2, 1, density > crowdedDensity ? 1 : 0, xi};
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

Crowding measureCrowding(Liquid& liquid)
{
    liquid.ghosts().copy(liquid.position);
    CellGrid grid(liquid.support());
    const Buffer<std::uint32_t>& order = grid.build(liquid.position.span(), liquid.all());
    Buffer<Position> sorted;
    gather(liquid.position, order, sorted);
    Buffer<CrowdingSums> scratch;
    const CrowdingSums sums = liquid.parts().fold(std::visit
    (
        [&]<class Kernel>(const Kernel& W)
        {
            const scalar volume = liquid.particleVolume() / liquid.latticeSum();
            return reduce(liquid.all(), CrowdingOf<Kernel>{W, volume, grid.view(), sorted.span(), order.span(), liquid.owned()}, scratch);
        },
        liquid.kernel()
    ));
    const Place at = placeOf(sums.densest);
    return
    {
        sums.density / sums.particles, sums.most, std::sqrt(double(sums.nearest2)) / liquid.spacing(), sums.crowded,
        liquid.units().length * Vector3(quanta::lengthOf(at.x), quanta::lengthOf(at.y), quanta::lengthOf(at.z)), sums.particles,
        std::sqrt(sums.compression2 / sums.particles)
    };
}

void refuseOverlap(Liquid& liquid, const std::filesystem::path& folder, const StartLimits& limits)
{
    const Crowding crowding = measureCrowding(liquid);
    if (!crowding.overlaps(limits)) return;

    const double spacing = liquid.properties().spacing;
    std::ostringstream found, expected;
    found << "The liquid starts overlapping itself: " << crowding.crowded << " of its " << crowding.particles
          << " particles are more than a tenth denser than at rest, the mean density is " << crowding.mean
          << " rest densities, the largest one " << crowding.most << ", at "
          << str(crowding.densest) << " m, the compression (root mean square) "
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
    const auto overlaps = [&]
    {
        if (liquid.parts().parts() > 1)             // whoever is near by now is seen
        {
            predictPositions(liquid, 0);
            near.search(liquid, 0);
        }
        return measureCrowding(liquid).overlaps(limits);
    };
    if (!overlaps()) return 0;

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
        if (pressure->iterations() <= 1 && !overlaps()) return round;
    }
    throw FatalInputError
    (
        {}, "The liquid still overlaps itself after " + std::to_string(mostRounds) + " rounds of `overlaps relax`",
        "walls that leave room for it: less liquid, or a smaller spacing"
    );
}

}
