// SPDX-License-Identifier: GPL-3.0-or-later
#include "freeSurface/SemiImplicitTension.H"

#include "device/ForEach.H"
#include "device/Holds.H"
#include "particles/NeighbourLoop.H"

#include <algorithm>
#include <cmath>
#include <variant>

namespace shizuku
{

namespace
{

// 2 g of a particle stands beside its normal: one access brings both. Zero: deep below the surface.
HOST_DEVICE inline Vec3 withSlope(Vec3 normal, scalar slope)
{
    normal.w = slope;
    return normal;
}
HOST_DEVICE inline scalar slopeBeside(Vec3 normal) { return normal.w; }

// The first direction is f itself: what differs along the surface by nothing is right from there on.
struct Begin
{
    FreeSurfaceView surface;
    HalfSpaceView plane;
    Span<const Vec3> normals;
    Span<scalar> jump;                      // f, then zero: the sum of all directions to come. Deep below the surface there is no force, and f stays
    Span<Vec3> normal;
    Span<scalar> residual, direction;

    HOST_DEVICE void operator()(int i) const
    {
        const int k = int(surface.place[i]);
        const Vec3 n = normals[k];
        const scalar slope = squared(n) > 0 ? 2 * plane(surface.depthOf(k)).gradient : 0;
        normal[k] = withSlope(n, slope);
        const scalar f = jump[k];
        residual[k] = f;
        direction[k] = f;
        jump[k] = slope > 0 ? 0 : f;
    }
};

// J += d, r -= (1 + K) d, and the next d.
template<class Kernel>
struct Iterate
{
    static constexpr Holds holds = Holds::more;

    Kernel W;
    scalar stiffness;                       // dt^2/4 sigma/rho0 V
    scalar ofDirection, ofResidual;         // in the next direction
    Span<const Position> x;
    NeighbourView near;
    FreeSurfaceView surface;
    Span<const Vec3> normal;
    Span<const scalar> direction;
    Span<scalar> residual, next;
    Span<scalar> jump;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const int k = int(surface.place[i]);
        const Position xi = x[i];
        const Vec3 ni = normal[k];
        const scalar di = direction[k];
        if (slopeBeside(ni) == 0) return;
        scalar sum = 0;
        near.forEach(i, [&](int j)
        {
            if (surface.isInside(j)) return;
            const int l = int(surface.place[j]);
            const Vec3 nj = normal[l];
            if (slopeBeside(nj) == 0 || !(dot(ni, nj) >= 0)) return;           // the other side of a film
            sum += W.g(norm(xi - x[j])) * (slopeBeside(ni) + slopeBeside(nj)) * (direction[l] - di);
        }, team);
        sum = team.sum(sum);
        if (!team.first()) return;
        const scalar r = residual[k] - di - stiffness * sum;
        residual[k] = r;
        jump[k] += di;
        next[k] = ofDirection * di + ofResidual * r;
    }
};

}

SemiImplicitTension::SemiImplicitTension(const Liquid& liquid)
:
    capillaryStep_(liquid.units().toScaled(liquid.properties().capillaryStep(), dimensions::time)),
    perArea_(liquid.units().toScaled(liquid.properties().surfaceTension, dimensions::surfaceTension) / liquid.restDensity())
{
    const std::vector<HalfSpaceValues> plane = tabulateHalfSpace(liquid.kernel());
    // At a surface there are half of the neighbours. The outermost layer lies half a spacing deep, where g is largest.
    const scalar h = std::visit([](const auto& W) { return W.h; }, liquid.kernel());
    const scalar weights = 0.5f * plane.front().drag;           // sum_j V k_ij, all around
    const HalfSpaceView view{{plane.data(), int(plane.size())}, h};
    largest_ = 2 * 0.5f * weights * 4 * view(0.5f * liquid.spacing()).gradient;
}

scalar SemiImplicitTension::largestEigenvalue(scalar dt) const { return 1 + stiffness(dt) * largest_; }

int SemiImplicitTension::iterations(scalar dt) const
{
    constexpr double left = 0.02;
    const double root = std::sqrt(double(largestEigenvalue(dt))), rate = (root + 1) / (root - 1);
    return int(std::ceil(std::log(2 / left) / std::log(rate)));
}

int SemiImplicitTension::parts(scalar dt) const
{
    constexpr scalar longest = 2, ofRest = 2.8f;
    const scalar steps = dt / capillaryStep_, finer = std::clamp(steps * steps / (ofRest * ofRest), scalar(1), scalar(2));
    return std::max(1, int(std::ceil(finer * steps * steps / (longest * longest))));
}

void SemiImplicitTension::smooth
(
    const Liquid& liquid, const Neighbourhood& near, const FreeSurface& surface, scalar dt, const Buffer<Vec3>& normals, Buffer<scalar>& jump
)
{
    if (plane_.size() == 0) plane_.upload(tabulateHalfSpace(liquid.kernel()));
    const int room = surface.particles().indices.size();
    normal_.resizeDiscarding(room);
    for (Buffer<scalar>* vector : {&residual_, &direction_, &next_}) vector->resizeDiscarding(room);
    const FreeSurfaceView view = surface.view();
    const scalar largest = largestEigenvalue(dt), centre = 0.5f * (largest + 1), radius = 0.5f * (largest - 1);
    scalar before = 0;
    std::visit
    (
        [&]<class Kernel>(const Kernel& W)
        {
            forEach(surface.particles(), Begin
            {
                view, {plane_.span(), W.h}, normals.span(), jump.span(), normal_.span(), residual_.span(), direction_.span()
            });
            for (int made = 0; made <= iterations(dt); ++made)
            {
                const scalar now = made == 0 ? radius / centre : 1 / (2 * centre / radius - before);
                const Column normals = valuesOf(surface.particles(), normal_), direction = valuesOf(surface.particles(), direction_);
                NeighbourLoop(liquid, {direction, when(made == 0, normals)}, {placesOf(liquid.predicted), normals}).forEachTeam(surface.particles(), Iterate<Kernel>
                {
                    W, stiffness(dt) * liquid.particleVolume(), now * before, (made == 0 ? 1 : 2) * now / radius, liquid.predicted.span(), near.view(), view,
                    std::as_const(normal_).span(), std::as_const(direction_).span(), residual_.span(), next_.span(), jump.span()
                });
                direction_.swap(next_);
                before = now;
            }
        },
        liquid.kernel()
    );
    normal_ = {};
    for (Buffer<scalar>* vector : {&residual_, &direction_, &next_}) *vector = {};
}

}
