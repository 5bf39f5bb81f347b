// SPDX-License-Identifier: GPL-3.0-or-later
// Takes out of each pair's difference of velocities what a flow that is linear around both does not have.
//
//     u_i += c sum_j V W_ij [ (f_i + f_j)/2 (u_j - u_i) - (f_i B_i + f_j B_j)/2 (x_j - x_i) ]
//
// B: the gradient by least squares with the weights W (velocityGradient/LeastSquaresGradient.H), f: 1, and less for neighbours in a plane or along a line.
// Whatever is linear in the positions, all rotation and strain, passes untouched; momentum and angular momentum stay; and since
//
//     -sum_i u_i . du_i = c/2 sum_i f_i sum_j V W_ij |u_j - u_i - B_i (x_j - x_i)|^2
//
// it only ever takes energy. nu does not enter. With `passes 2` what it takes is filtered once more before it is taken, so that flows which bend over a few
// spacings keep theirs, too.
//
// c: the share of a step; perCapillaryStep, p, that of the time t_c = sqrt(rho d^3/(2 pi sigma)): a step dt takes 1 - (1 - p)^(dt/t_c) where that is more
// than c. atWalls: the share of c with which walls at rest take part, by their kernel density, as in XSPH.
//
//     velocityFilter  affine;
//     affineCoeffs    { c 0.2; perCapillaryStep 0.7; passes 1; atWalls 0.3; slipAbove 0; }

#include "models/smoothing/SmoothingControls.H"
#include "models/velocityFilter/VelocityFilter.H"
#include "models/velocityGradient/LeastSquaresGradient.H"

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
    InverseMomentsView inverse;
    RowsField<Vec3> gradient;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const scalar full = inverse.full(i);
        Rows B = full * leastSquaresGradient(k, volume, i, x, velocity, near, inverse[i], team);
        if (!team.first()) return;
        B.x.w = full;
        gradient.store(i, B);
    }
};

// What is left of the differences from the neighbours.
template<class Kernel>
struct SumRemainders
{
    static constexpr Holds holds = Holds::more;

    KernelWeight<Kernel> k;
    scalar volume;
    Span<const Position> x;
    Span<const Vec3> velocity;
    NeighbourView near;
    RowsField<const Vec3> gradient;
    Span<Vec3> remainder;

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
        const Vec3 total = volume * team.sum(sum);
        if (team.first()) remainder[i] = total;
    }
};

struct TakeOut
{
    scalar share;
    Span<const Vec3> remainder;
    Span<Vec3> velocity;

    HOST_DEVICE void operator()(int i) const { velocity[i] += share * remainder[i]; }
};

template<class Kernel>
struct HoldBack
{
    Kernel W;
    scalar share, slipAbove;
    Span<const Position> x;
    WallView walls;
    Span<Vec3> velocity;

    HOST_DEVICE void operator()(int i) const
    {
        const Vec3 u = velocity[i];
        velocity[i] -= share * walls.density(i, x[i], W) * fmin(slipAbove / fmax(norm(u), 1e-20f), 1) * u;
    }
};

class Affine : public VelocityFilter
{
public:
    Affine(const Dictionary& coeffs, Liquid& liquid)
    :
        controls_(coeffs, liquid, 0.2), atWalls_(shareOf(coeffs, "atWalls", 0.3)), passes_(coeffs.lookupOr("passes", 1))
    {
        if (passes_ != 1 && passes_ != 2) throw FatalInputError(coeffs.where("passes"), "Coefficient passes is out of range", "1 or 2");
    }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt) override
    {
        inverse_.resizeDiscarding(liquid.all());
        gradient_.resizeDiscarding(liquid.all());
        remainder_.resizeDiscarding(liquid.all());
        const scalar share = controls_.share(dt);
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                const KernelWeight<Kernel> k{W};
                const scalar V = liquid.particleVolume();
                forEachTeam(liquid.owned(), MeasureMoments<KernelWeight<Kernel>>{k, V, liquid.position.span(), near.view(), inverse_.view()});
                findRemainders(k, liquid, near, liquid.velocity);
                if (passes_ == 2)
                {
                    again_.resizeDiscarding(liquid.all());
                    again_.swap(remainder_);
                    findRemainders(k, liquid, near, again_);
                }
                // A remainder of a remainder has the sign of what is left, not of what is to be added.
                forEach(liquid.owned(), TakeOut{passes_ == 2 ? -share : share, remainder_.span(), liquid.velocity.span()});
                if (atWalls_ == 0 || (walls.particles() == 0 && walls.surfaces() == 0)) return;
                forEach(liquid.owned(), HoldBack<Kernel>
                {
                    W, atWalls_ * share, controls_.slipAbove(), liquid.position.span(), walls.view(liquid), liquid.velocity.span()
                });
            },
            liquid.kernel()
        );
    }

private:
    // Of the velocities u into remainder_.
    template<class Kernel>
    void findRemainders(const KernelWeight<Kernel>& k, const Liquid& liquid, const Neighbourhood& near, const Buffer<Vec3>& u)
    {
        const scalar V = liquid.particleVolume();
        const Span<const Position> x = std::as_const(liquid.position).span();
        forEachTeam(liquid.owned(), FitGradient<Kernel>{k, V, x, u.span(), near.view(), inverse_.view(), gradient_.view()});
        forEachTeam(liquid.owned(), SumRemainders<Kernel>{k, V, x, u.span(), near.view(), gradient_.seen(), remainder_.span()});
    }

    SmoothingControls controls_;
    scalar atWalls_;
    int passes_;
    InverseMoments inverse_;
    OwnedRows gradient_;
    Buffer<Vec3> remainder_, again_;
};

const VelocityFilterTable::Add<Affine> registered{"affine", "takes out what is not linear in space around two particles"};

}

}
