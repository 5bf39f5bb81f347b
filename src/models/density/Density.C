#include "models/density/Density.H"

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

}

void computeDensity(Liquid& liquid, const Neighbourhood& near, const Walls& walls)
{
    computeDensity(liquid, liquid.predicted, near, walls);
}

void computeDensity(Liquid& liquid, const Buffer<Vec3>& at, const Neighbourhood& near, const Walls& walls)
{
    std::visit
    (
        [&]<class Kernel>(const Kernel& W)
        {
            const DensityOf<Kernel> densityOf
            {
                W, liquid.particleVolume() / liquid.latticeSum(), at.span(), near.view(), walls.view()
            };
            forEach(liquid.owned(), StoreDensity<Kernel>{densityOf, liquid.density.span()});
        },
        liquid.kernel()
    );
}

}
