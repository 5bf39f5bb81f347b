// SPDX-License-Identifier: GPL-3.0-or-later
// XSPH: velocities drift towards their neighbours' mean (Monaghan 1989; Macklin and Mueller 2013, equation (17)).
//
//     u_i += c [ sum_j V (u_j - u_i) W_ij - v_i (walls) ],      v_i = u_i - w
//
// Not a physical viscosity: nu does not enter. c is the share of a step; with it alone the damping of a second depends on the step.
// perCapillaryStep, p, is the share of the time t_c = sqrt(rho d^3/(2 pi sigma)): a step dt takes 1 - (1 - p)^(dt/t_c) where that is
// more than c. Liquid in long steps is damped as much as in shorter ones, and the noise of short ones by c. It needs a sigma.
// With noSlip the walls take part by their kernel density, with w, the mean of their velocities. slipAbove, s, is the speed up to which they do wholly, in spacings
// a capillary step t_c: what is faster is braked as at that speed. A share of u reaches a support into the liquid, which is right for noise, and for
// flows whose boundary layer is as thick. It needs a sigma; 0 is no limit.
//
//     u_i -= c min(1, s d/(t_c |v_i|)) v_i (walls)
//
//     viscosity   XSPH;
//     XSPHCoeffs  { c 0.2; perCapillaryStep 0.7; noSlip yes; slipAbove 0.1; }
//
// Without a surface tension perCapillaryStep and slipAbove are 0 where nothing is said.

#include "models/smoothing/SmoothingControls.H"
#include "models/viscosity/Viscosity.H"
#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

template<class Kernel>
struct Smooth
{
    Kernel W;
    scalar c, volume;
    Span<const Position> x;
    Span<const Vec3> velocity;
    NeighbourView near;
    bool noSlip;
    scalar slipAbove;
    WallView walls;
    Span<Vec3> smoothed;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const Position xi = x[i];
        const Vec3 ui = velocity[i];
        Team::Vector sum;
        near.forEach(i, xi, x, [&](auto j, auto r) { sum += W.W(norm(r)) * (velocity[j] - ui); }, team);
        Vec3 change = volume * team.sum(sum);
        if (!team.first()) return;
        if (noSlip)
        {
            const Vec3 over = ui - walls.meanVelocity(i, xi, W);
            change -= walls.density(i, xi, W) * fmin(slipAbove / norm(over), 1) * over;
        }
        smoothed[i] = ui + c * change;
    }
};

class XSPH : public Viscosity
{
public:
    XSPH(const Dictionary& coeffs, Liquid& liquid)
    :
        noSlip_(coeffs.lookupOr("noSlip", true)), controls_(coeffs, liquid, defaultsOfXSPH, noSlip_)
    {}

    std::optional<Columns> readsOfNeighbours(Liquid& liquid) const override { return Columns{valuesOf(liquid.position), valuesOf(liquid.velocity)}; }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt) override
    {
        Buffer<Vec3> smoothed(liquid.all());
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                NeighbourLoop(liquid).forEachTeam(Smooth<Kernel>
                {
                    W, controls_.share(dt), liquid.particleVolume(), liquid.position.span(), liquid.velocity.span(), near.view(), noSlip_,
                    controls_.slipAbove(), walls.view(liquid), smoothed.span()
                });
            },
            liquid.kernel()
        );
        liquid.velocity.swap(smoothed);
    }

    // nu does not enter: all of it is a filter.
    std::optional<Buffer<scalar>> dissipation(Liquid& liquid, const Neighbourhood&, const Walls&, scalar) const override
    {
        Buffer<scalar> none(liquid.owned());
        none.setZero();
        return none;
    }

private:
    bool noSlip_;
    SmoothingControls controls_;
};

const ViscosityTable::Add<XSPH> registered{"XSPH", "velocities drift towards their neighbours' mean (Monaghan 1989); nu does not enter"};

}

}
