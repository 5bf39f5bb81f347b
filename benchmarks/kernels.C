// SPDX-License-Identifier: GPL-3.0-or-later
// The kernels that a step on the CPU spends its time in, one at a time, by Google Benchmark: benchmarks/kernels.
//
// Liquid in a cube of `edge` particles, a lattice disturbed by a tenth of a spacing, with the default kernel. Times are of
// all threads that OpenMP has.

#include "device/Algorithms.H"
#include "models/density/ConstraintSums.H"
#include "models/density/Density.H"
#include "support/PointSets.H"

#include <benchmark/benchmark.h>

using namespace shizuku;

namespace
{

class Block
{
public:
    explicit Block(const benchmark::State& state)
    :
        liquid
        (
            LiquidProperties::read(Dictionary::parse("spacing 1e-3;"), Dictionary::parse("rho 998; nu 1e-6; sigma 0.073;")),
            Dictionary::parse("type cubicSpline; support 2;")
        ),
        near(liquid)
    {
        const int edge = int(state.range(0));
        test::RandomNumbers random(1);
        for (const Vec3 p : test::latticeBlock(edge, edge, edge, 1))
        {
            const Vec3 x = liquid.spacing() * (p + random(Vec3{-0.1f, -0.1f, -0.1f}, Vec3{0.1f, 0.1f, 0.1f}));
            positions.push_back(positionAt(x.x, x.y, x.z));
        }
        liquid.resize(int(positions.size()));
        liquid.position.upload(positions);
        liquid.predicted.upload(positions);
        near.update(liquid);
    }

    const CubicSpline& kernel() const { return std::get<CubicSpline>(liquid.kernel()); }

    // Seconds a particle, shown with the prefix that suits them.
    void report(benchmark::State& state) const
    {
        using benchmark::Counter;
        state.counters["s/particle"] = Counter(liquid.owned(), Counter::kIsIterationInvariantRate | Counter::kInvert);
    }

    Liquid liquid;
    Walls walls;
    Neighbourhood near;
    std::vector<Position> positions;    // as in the lattice
};

void densitySum(benchmark::State& state)
{
    Block block(state);
    for (auto _ : state) computeDensity(block.liquid, block.near, block.walls);
    block.report(state);
}

// Density and gradients, as the pressure's constraint needs them.
struct StoreConstraint
{
    CubicSpline W;
    scalar volume;
    Span<const Position> x;
    NeighbourView near;
    Span<scalar> constraint;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const ConstraintSums sums = constraintSums(W, volume, i, x, near, team);
        constraint[i] = sums.W / (sums.squares + squared(sums.gradient));
    }
};

void gradientSum(benchmark::State& state)
{
    Block block(state);
    const Liquid& liquid = block.liquid;
    Buffer<scalar> constraint(liquid.owned());
    for (auto _ : state)
    {
        forEachTeam(liquid.owned(), StoreConstraint
        {
            block.kernel(), liquid.particleVolume(), liquid.predicted.span(), block.near.view(), constraint.span()
        });
    }
    block.report(state);
}

// Over twice the kernel's support, by searching.
struct StoreWideSum
{
    WendlandC2 W;
    NeighbourSearch wide;
    Span<scalar> sum;

    HOST_DEVICE void operator()(Group particles, Team team) const
    {
        GroupOfParticles group{{}, particles.members()};
        for (int p = 0; p < Group::most; ++p) group.index[p] = particles[p];
        Team::Scalar values[Group::most] = {};
        wide.forEach(group, [](auto) { return 0; }, [&](int p, int, auto r) { values[p] += W.W(norm(r)); }, team);
        const scalar found = team.sums(values);
        if (team.lane < particles.size) sum[particles.first + team.lane] = found;
    }
};

void wideSum(benchmark::State& state)
{
    Block block(state);
    Liquid& liquid = block.liquid;
    const WendlandC2 W(2 * liquid.support());
    block.near.update(liquid, W.h);
    Buffer<scalar> sum(liquid.owned());
    for (auto _ : state) forEachGroup(liquid.owned(), StoreWideSum{W, block.near.wide(liquid), sum.span()});
    block.report(state);
}

// Sorts the particles and all their fields into cells, where they are already, and lists their neighbours.
void neighbourBuild(benchmark::State& state)
{
    Block block(state);
    for (auto _ : state) block.near.update(block.liquid);
    block.report(state);
}

// Finds the order of particles that are sorted already.
void sort(benchmark::State& state)
{
    Block block(state);
    CellGrid grid(block.liquid.support());
    for (auto _ : state) grid.build(block.liquid.position.span(), block.liquid.owned());
    block.report(state);
}

BENCHMARK(densitySum)->Arg(20)->Arg(46);
BENCHMARK(gradientSum)->Arg(20)->Arg(46);
BENCHMARK(wideSum)->Arg(20)->Arg(46);
BENCHMARK(neighbourBuild)->Arg(20)->Arg(46);
BENCHMARK(sort)->Arg(20)->Arg(46);

}

BENCHMARK_MAIN();
