// SPDX-License-Identifier: GPL-3.0-or-later
// Takes out of each pair's difference of velocities what a flow that is linear around both does not have.
//
//     u_i += c { sum_j V W_ij [ (f_i + f_j)/2 (u_j - u_i) - (f_i B_i + f_j B_j)/2 (x_j - x_i) ] - a min(1, s d/(t_c |u_i|)) u_i w }
//
// B: the gradient by least squares with the weights W (velocityGradient/LeastSquaresGradient.H), f: 1, and less for neighbours in a plane or along a line.
// Whatever is linear in the positions, all rotation and strain, passes untouched; momentum and angular momentum stay; and since
//
//     -sum_i u_i . du_i = c/2 sum_i f_i sum_j V W_ij |u_j - u_i - B_i (x_j - x_i)|^2
//
// it only ever takes energy. nu does not enter.
//
// c: the share of a step; perCapillaryStep, p, that of the time t_c = sqrt(rho d^3/(2 pi sigma)): a step dt takes 1 - (1 - p)^(dt/t_c) where that is more
// than c. w: the kernel density of walls, which are at rest; a, atWalls, is their share, slipAbove, s, the speed up to which they have it wholly: what trembles on a wall
// comes to rest on it. Without a surface tension p and s are 0 where nothing is said.
//
// With keepsTurns what forces lose of a turn is given back before (TurningForces.H).
//
//     velocityFilter  affine;
//     affineCoeffs    { c 0.2; perCapillaryStep 0.98; atWalls 1; slipAbove 0.1; keepsTurns no; }

#include "models/smoothing/SmoothingControls.H"
#include "models/velocityFilter/VelocityFilter.H"
#include "models/velocityFilter/affine/TurningForces.H"
#include "models/velocityGradient/LeastSquaresGradient.H"

#include <optional>
#include <utility>

namespace shizuku
{

namespace
{

template<class Kernel>
struct KernelWeight
{
    Kernel W;

    HOST_DEVICE auto operator()(auto distance) const { return W.W(distance); }
};

// f B, with w = f.
template<class Kernel>
struct FitGradient
{
    static constexpr Holds holds = Holds::more;

    KernelWeight<Kernel> k;
    scalar volume;
    Span<const Position> x;
    Span<const Vec3> velocity;
    NeighbourView near;
    RowsField<Vec3> gradient;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const MeasuredGradient own = measureGradient(k, volume, i, x, velocity, near, team);
        if (!team.first()) return;
        const scalar full = own.inverse.diagonal.w;
        Rows B = full * own.gradient;
        B.x.w = full;
        gradient.store(i, B);
    }
};

template<class Kernel>
struct TakeOut
{
    static constexpr Holds holds = Holds::more;

    KernelWeight<Kernel> k;
    scalar volume, share, atWalls, slipAbove;
    Span<const Position> x;
    Span<const Vec3> velocity;
    NeighbourView near;
    RowsField<const Vec3> gradient;
    WallView walls;
    Span<Vec3> filtered;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const Position xi = x[i];
        const Vec3 ui = velocity[i];
        const Rows own = gradient[i];
        Team::Vector sum;
        near.forEach(i, xi, x, [&](auto j, auto r)
        {
            const auto half = 0.5f * k(norm(r));
            const auto first = gradient.x[j];
            const auto du = velocity[j] - ui;
            const auto full = first.w + own.x.w;
            sum += half * vector
            (
                full * du.x + dot(first + own.x, r), full * du.y + dot(gradient.y[j] + own.y, r),
                full * du.z + dot(gradient.z[j] + own.z, r)
            );
        }, team);
        Vec3 change = volume * team.sum(sum);
        if (!team.first()) return;
        if (atWalls > 0) change -= atWalls * walls.density(i, xi, k.W) * fmin(slipAbove / fmax(norm(ui), 1e-20f), 1) * ui;
        filtered[i] = ui + share * change;
    }
};

class Affine : public VelocityFilter
{
public:
    Affine(const Dictionary& coeffs, Liquid& liquid)
    :
        controls_(coeffs, liquid, {.c = 0.2, .perCapillaryStep = 0.98, .slipAbove = 0.1}), atWalls_(shareOf(coeffs, "atWalls", 1))
    {
        if (coeffs.lookupOr("keepsTurns", false)) turning_.emplace(liquid);
    }

    bool seesGhosts() const override { return true; }

    void begin(const Liquid& liquid) override
    {
        if (turning_) turning_->begin(liquid);
    }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt) override
    {
        liquid.ghosts().copy(liquid.position);
        if (turning_) turning_->apply(liquid, near, dt);
        liquid.ghosts().copy(liquid.velocity);
        gradient_.resizeDiscarding(liquid.all());
        Buffer<Vec3> filtered(liquid.all());
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                const KernelWeight<Kernel> k{W};
                const scalar V = liquid.particleVolume();
                const Span<const Position> x = std::as_const(liquid.position).span();
                const Span<const Vec3> u = std::as_const(liquid.velocity).span();
                forEachTeam(liquid.owned(), FitGradient<Kernel>{k, V, x, u, near.view(), gradient_.view()});
                for (Buffer<Vec3>* row : {&gradient_.x, &gradient_.y, &gradient_.z}) liquid.ghosts().copy(*row);
                forEachTeam(liquid.owned(), TakeOut<Kernel>
                {
                    k, V, controls_.share(dt), atWalls_, controls_.slipAbove(), x, u, near.view(), gradient_.seen(), walls.view(liquid),
                    filtered.span()
                });
            },
            liquid.kernel()
        );
        liquid.velocity.swap(filtered);
    }

private:
    SmoothingControls controls_;
    scalar atWalls_;
    std::optional<TurningForces> turning_;
    OwnedRows gradient_;
};

const VelocityFilterTable::Add<Affine> registered{"affine", "takes out what is not linear in space around two particles"};

}

}
