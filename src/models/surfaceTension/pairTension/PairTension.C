// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/surfaceTension/pairTension/PairTension.H"

#include "maths/CohesionSpline.H"
#include "models/density/Density.H"
#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

constexpr Dimensions cohesionDimensions{{-1, 4, -2, 0, 0, 0, 0}};

template<class Kernel>
struct Normal
{
    Kernel W;
    scalar volume;
    bool wallShare;
    Span<const Position> x;
    Span<const scalar> density;
    NeighbourView near;
    WallView walls;
    Span<Vec3> normal;

    HOST_DEVICE void operator()(int i) const
    {
        const Position xi = x[i];
        Vec3 sum;
        near.forEach(i, [&](int j)
        {
            const Vec3 r = xi - x[j];
            sum += volume / density[j] * W.g(norm(r)) * r;
        });
        if (wallShare)
        {
            walls.particles.near.forEach(i, [&](int k)
            {
                const Vec3 r = xi - walls.particles.position[k];
                sum += (1 + walls.particles.cosTheta[k]) * walls.particles.volume[k] * W.g(norm(r)) * r;
            });
            walls.forEachSurface(i, xi, [&](const WallSurface& surface, const WallSurface::Nearest& nearest, const HalfSpaceValues& values)
            {
                sum -= (1 + surface.cosTheta) * values.gradient * nearest.normal;
            });
        }
        normal[i] = W.h * sum;
    }
};

struct AddPairTension
{
    CohesionSpline C;
    scalar cohesion, area;              // gamma m, gamma rho_A
    Span<const Position> x;
    Span<const Vec3> normal;
    Span<const scalar> density;
    NeighbourView near;
    Span<Vec3> acceleration;

    HOST_DEVICE void operator()(int i) const
    {
        const Position xi = x[i];
        const Vec3 ni = normal[i];
        const scalar densityI = density[i];
        Vec3 sum;
        near.forEach(i, [&](int j)
        {
            const Vec3 r = xi - x[j];
            const scalar distance = norm(r), K = 2 / (densityI + density[j]);
            if (distance > 0) sum -= K * cohesion * C(distance) / distance * r;
            sum -= K * area * (ni - normal[j]);
        });
        acceleration[i] += sum;
    }
};

}

PairCoefficients readPairCoefficients(const Dictionary& coeffs, const Liquid& liquid)
{
    const LiquidProperties& p = liquid.properties();
    const double h = liquid.units().toSI(liquid.support(), dimensions::length);
    const double gamma = coeffs.lookupDimensionedOr
    (
        "gamma", cohesionDimensions, cohesionCoefficient(p.surfaceTension, p.density, h)
    );
    const double areaWeight = coeffs.lookupOr("areaWeight", 1e-3);
    if (!(gamma >= 0)) throw FatalInputError(coeffs.where("gamma"), "A negative coefficient gamma", "0 or more");
    if (!(areaWeight >= 0)) throw FatalInputError(coeffs.where("areaWeight"), "A negative areaWeight", "0 or more");
    return
    {
        liquid.units().toScaled(gamma, cohesionDimensions),
        liquid.units().toScaled(gamma * areaWeight * p.density, dimensions::acceleration)
    };
}

PairTension::PairTension(const Dictionary& coeffs, Liquid& liquid, WallNormals wallNormals)
:
    coefficients_(readPairCoefficients(coeffs, liquid)),
    wallNormals_(wallNormals),
    normal_(liquid.fields().require<Vec3>
    ({
        .name = "normal", .dimensions = dimensions::none, .sorted = false
    })),
    density_(requirePredictedDensity(liquid))
{}

void PairTension::apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, Buffer<Vec3>& acceleration)
{
    computePredictedDensity(liquid, near, walls, density_);
    std::visit
    (
        [&]<class Kernel>(const Kernel& W)
        {
            NeighbourLoop(liquid, {valuesOf(density_)}, {placesOf(liquid.predicted)}).forEach(Normal<Kernel>
            {
                W, liquid.particleVolume(), wallNormals_ == WallNormals::yes, liquid.predicted.span(),
                density_.span(), near.view(), walls.view(liquid), normal_.span()
            });
        },
        liquid.kernel()
    );
    NeighbourLoop(liquid, {valuesOf(normal_)}, {placesOf(liquid.predicted), valuesOf(density_)}).forEach(AddPairTension
    {
        {liquid.support()}, coefficients_.cohesion * liquid.particleMass(), coefficients_.area,
        liquid.predicted.span(), normal_.span(), density_.span(), near.view(), acceleration.span()
    });
}

}
