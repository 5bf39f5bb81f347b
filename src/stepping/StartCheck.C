#include "stepping/StartCheck.H"

#include "device/Gather.H"
#include "device/Reduce.H"
#include "geometry/Vector3.H"
#include "neighbours/CellGrid.H"

#include <cmath>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr float crowdedDensity = 1.1f;

struct CrowdingSums
{
    double density = 0;
    float most = 0, nearest2 = 1e30f;
    int crowded = 0, densest = 0;

    HOST_DEVICE void add(const CrowdingSums& other)
    {
        density += other.density;
        crowded += other.crowded;
        nearest2 = fminf(nearest2, other.nearest2);
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
    float volume;                       // V/S
    CellGridView grid;
    Span<const Vec3> x;

    HOST_DEVICE CrowdingSums operator()(int i) const
    {
        const Vec3 xi = x[i];
        float sum = 0, nearest2 = 1e30f;
        grid.forEachCandidate(xi, W.h, [&](int j)
        {
            const float r2 = squared(xi - x[j]);
            sum += W.W(sqrtf(r2));
            if (j != i) nearest2 = fminf(nearest2, r2);
        });
        const float density = volume * sum;
        return {density, density, nearest2, density > crowdedDensity ? 1 : 0, i};
    }
};

}

Crowding measureCrowding(const Liquid& liquid)
{
    CellGrid grid(liquid.support());
    const Buffer<std::uint32_t>& order = grid.build(liquid.position.span(), liquid.owned());
    Buffer<Vec3> sorted;
    gather(liquid.position, order, sorted);
    Buffer<CrowdingSums> scratch;
    const CrowdingSums sums = std::visit
    (
        [&]<class Kernel>(const Kernel& W)
        {
            const float volume = liquid.particleVolume() / liquid.latticeSum();
            return reduce(liquid.owned(), CrowdingOf<Kernel>{W, volume, grid.view(), sorted.span()}, scratch);
        },
        liquid.kernel()
    );
    return
    {
        sums.density / liquid.owned(), sums.most, std::sqrt(double(sums.nearest2)) / liquid.spacing(), sums.crowded,
        int(order.download()[sums.densest])
    };
}

void refuseOverlap(const Liquid& liquid, const std::filesystem::path& folder)
{
    const Crowding crowding = measureCrowding(liquid);
    if (!crowding.overlaps()) return;

    const double spacing = liquid.properties().spacing, unit = liquid.units().length;
    const Vec3 x = liquid.position.download()[crowding.densest];
    std::ostringstream found, expected;
    found << "The liquid starts overlapping itself: " << crowding.crowded << " of its " << liquid.owned()
          << " particles are more than a tenth denser than at rest, the mean density is " << crowding.mean
          << " rest densities, the largest one " << crowding.most << ", at "
          << str(Vector3(x.x * unit, x.y * unit, x.z * unit)) << " m, and the smallest distance "
          << crowding.nearest << " spacings";
    expected << "liquid at rest density, a mean below " << Crowding::mostMean << " and nowhere " << Crowding::mostOfOne
             << ", of particles one spacing apart.\n    Run fillLiquid with the spacing of system/solution, " << spacing
             << " m; or give there the one that the liquid was filled with (a lattice of "
             << spacing / std::cbrt(crowding.most) << " m is that dense); and fill no place twice";
    throw FatalInputError({(folder / liquid.name() / "positions").string(), 0}, found.str(), expected.str());
}

}
