// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/density/Density.H"

#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

template<class Kernel>
struct StoreDensity
{
    DensityOf<Kernel> densityOf;
    Span<scalar> density;

    HOST_DEVICE void operator()(int i) const { density[i] = densityOf(i); }
};

void store(const Liquid& liquid, Buffer<Position>& at, const Neighbourhood& near, const Walls& walls, Buffer<scalar>& density)
{
    std::visit
    (
        [&]<class Kernel>(const Kernel& W)
        {
            const DensityOf<Kernel> densityOf
            {
                W, liquid.particleVolume() / liquid.latticeSum(), std::as_const(at).span(), near.view(), walls.view(liquid)
            };
            NeighbourLoop(liquid, {}, {placesOf(at)}).forEach(StoreDensity<Kernel>{densityOf, density.span()});
        },
        liquid.kernel()
    );
}

}

void computeDensity(Liquid& liquid, const Neighbourhood& near, const Walls& walls)
{
    computeDensity(liquid, liquid.predicted, near, walls);
}

void computeDensity(Liquid& liquid, Buffer<Position>& at, const Neighbourhood& near, const Walls& walls)
{
    store(liquid, at, near, walls, liquid.density);
}

Buffer<scalar>& requirePredictedDensity(Liquid& liquid)
{
    return liquid.fields().require<scalar>({.name = "predictedDensity", .dimensions = dimensions::none, .sorted = false});
}

void computePredictedDensity(const Liquid& liquid, const Neighbourhood& near, const Walls& walls, Buffer<scalar>& density)
{
    store(liquid, liquid.predicted, near, walls, density);
}

}
