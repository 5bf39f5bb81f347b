// SPDX-License-Identifier: GPL-3.0-or-later
// Divergence-free SPH: Bender and Koschier 2015, Divergence-free smoothed particle hydrodynamics.
//
//     alpha_i  = rho_i / ( |sum_j m grad W_ij|^2 + sum_j |m grad W_ij|^2 )                       (9)
//     kappa_i  = (rho*_i - rho0) alpha_i/dt^2,    rho*_i = rho_i + dt Drho_i/Dt                  (12), (11)
//     kappav_i = (Drho_i/Dt) alpha_i/dt,    Drho_i/Dt = sum_j m (u_i - u_j) . grad W_ij          (8), (5)
//     u_i     -= dt sum_j m (kappa_i/rho_i + kappa_j/rho_j) grad W_ij                            algorithms 2 and 3
//
// kappa holds the density while positions are predicted, dt u being the way from the step's beginning, where all gradients are
// taken; kappav the divergence after they have moved (correctVelocities). Both begin with what the last step came to (warm
// start, 3.4); a restarted run begins without. Negative pressures are clamped, as in the paper; since a warm start may be too
// much, the clamp is of the sum that a step applies, not of each iteration's part. Divergence is left alone where it is
// negative, and where particles have fewer than 0.6 of a full neighbourhood's neighbours (20 of 32): the surface may open.
// The walls' share in rho is (8) of doc/notebook/theory/pbf.md; they push with the particle's own kappa (Akinci et al. 2012).
//
//     pressure    DFSPH;                  // in constant/models
//     pressure                            // in system/solution
//     {
//         minIterations   2;   maxIterations   100;   tolerance   1e-3;   // average compression
//         divergence      { minIterations 1; maxIterations 100; tolerance 1e-3; }   // average of dt (Drho/Dt)/rho0
//         warmStart       yes;
//     }

#include "models/density/ConstraintSums.H"
#include "models/density/Density.H"
#include "models/pressure/Pressure.H"
#include "models/pressure/shared/AverageCompression.H"
#include "models/pressure/shared/IterationControls.H"
#include "models/pressure/shared/PressureField.H"
#include "models/pressure/shared/PushApart.H"
#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

// All particles are corrected at once, out of the values of the last iteration. On a lattice that diverges with whole steps.
constexpr scalar relaxation = 0.5f;

// What stays the same during an iteration: alpha_i rho0^2/rho_i, zero where a particle is alone.
template<class Kernel>
struct Factor
{
    Kernel W;
    scalar volume;
    Span<const Position> at;
    NeighbourView near;
    WallView walls;
    Span<scalar> factor;

    HOST_DEVICE void operator()(int i) const
    {
        const ConstraintSums sums = constraintSums(W, volume, i, at, near);
        const scalar all = sums.squares + squared(sums.gradient + walls.gradient(i, at[i], W));
        factor[i] = all > 1e-6f ? 1 / all : 0;
    }
};

// sum_j V (u_i - u_j) . grad W_ij + u_i . grad(walls): of the way made, the change of rho/rho0 (11), which begins with walls where they are at the step's end; of
// velocities its rate, with those of walls.
template<class Kernel>
struct Convergence
{
    Kernel W;
    scalar volume;
    Span<const Position> at;
    NeighbourView near;
    WallView walls;

    template<class Motion>
    HOST_DEVICE scalar operator()(int i, const Motion& u) const
    {
        const Position xi = at[i];
        const Vec3 ui = u(i);
        scalar sum = dot(ui, walls.gradient(i, xi, W));
        if constexpr (Motion::wallsMove) sum -= walls.flux(i, xi, W);
        near.forEach(i, [&](int j)
        {
            const Vec3 r = xi - at[j];
            sum += volume * W.g(norm(r)) * dot(ui - u(j), r);
        });
        return sum;
    }
};

struct WayMade
{
    static constexpr bool wallsMove = false;

    Span<const Position> predicted, position;

    HOST_DEVICE Vec3 operator()(int i) const { return predicted[i] - position[i]; }
};

struct VelocityOf
{
    static constexpr bool wallsMove = true;

    Span<const Vec3> velocity;

    HOST_DEVICE Vec3 operator()(int i) const { return velocity[i]; }
};

// kappa dt^2/rho0 of the step may grow and fall, and stays positive.
HOST_DEVICE inline scalar raise(scalar& total, scalar by)
{
    const scalar before = total;
    total = fmax(before + by, 0);
    return total - before;
}

template<class Kernel>
struct DensityStep
{
    Convergence<Kernel> convergence;
    WayMade way;
    scalar perPressure;                 // dt^2/rho0
    Span<const scalar> start, factor;
    Span<scalar> density, pressure, increase;

    HOST_DEVICE void operator()(int i) const
    {
        density[i] = start[i] + convergence(i, way);
        scalar total = perPressure * pressure[i];
        increase[i] = raise(total, relaxation * factor[i] * (density[i] - 1));
        pressure[i] = total / perPressure;
    }
};

template<class Kernel>
struct DivergenceStep
{
    Convergence<Kernel> convergence;
    VelocityOf velocity;
    scalar fullCount, perVolume;        // neighbours of a full neighbourhood; particles in the volume of a support
    scalar dt;
    Span<const scalar> factor;
    Span<scalar> change, total, increase;       // change: of rho/rho0 in a step

    HOST_DEVICE void operator()(int i) const
    {
        const WallView& walls = convergence.walls;
        const Position xi = convergence.at[i];
        int count = int(convergence.near.count[i]);
        walls.particles.near.forEach(i, [&](int k)
        {
            if (norm(xi - walls.particles.position[k]) < convergence.W.h) ++count;
        });
        const bool few = scalar(count) + perVolume * walls.ofSurfaces(i, xi).value < 0.6f * fullCount;
        const scalar now = convergence(i, velocity);
        change[i] = few ? 0 : dt * now;
        increase[i] = few ? raise(total[i], -total[i]) : raise(total[i], relaxation * factor[i] * now);
    }
};

// What the last step came to is the first correction of this one.
struct WarmStart
{
    scalar factor;                      // zero: none
    Span<scalar> total, increase;

    HOST_DEVICE void operator()(int i) const
    {
        increase[i] = factor * total[i];
        if (factor == 0) total[i] = 0;
    }
};

class DFSPH : public Pressure
{
public:
    DFSPH(const Dictionary& dict, Liquid& liquid, const Walls&, FreeSurface&)
    :
        controls_(IterationControls::read(dict, {2, 100, 1e-3})),
        divergenceControls_(IterationControls::read(dict.subDictOrEmpty("divergence"), {1, 100, 1e-3})),
        warmStart_(dict.lookupOr("warmStart", true)),
        pressure_(keptPressure(liquid)),
        velocityPotential_(liquid.fields().require<scalar>
        ({
            .name = "velocityPotential", .dimensions = dimensions::kinematicViscosity, .written = true, .restarted = true,
            .exchanged = true
        }))
    {}

    void begin(scalar dt) override
    {
        iterations_ = 0;
        dt_ = dt;
    }

    bool converged(Liquid& liquid, const Neighbourhood& near, const Walls& walls) override
    {
        if (iterations_ >= controls_.maxIterations || liquid.isEmpty()) return true;
        const scalar perPressure = dt_ * dt_ / liquid.restDensity();
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                if (iterations_ == 0)
                {
                    prepare(W, {}, liquid, near, walls);
                    computeDensity(liquid, liquid.position, near, walls);
                    start_.resizeDiscarding(liquid.all());
                    start_.swap(liquid.density);
                    forEach(liquid.owned(), WarmStart{warmStart_ ? perPressure : 0, pressure_.span(), increase_.span()});
                    if (warmStart_) push(W, liquid, near, walls, liquid.predicted);
                }
                NeighbourLoop(liquid, {placesOf(liquid.predicted)}, {valuesOf(liquid.position)}).forEach(DensityStep<Kernel>
                {
                    {W, liquid.particleVolume(), liquid.position.span(), near.view(), walls.view(liquid)},
                    {liquid.predicted.span(), liquid.position.span()}, perPressure, start_.span(), factor_.span(),
                    liquid.density.span(), pressure_.span(), increase_.span()
                });
            },
            liquid.kernel()
        );
        return !compression_.wantsAnother(liquid, controls_, iterations_);
    }

    void correct(Liquid& liquid, const Neighbourhood& near, const Walls& walls) override
    {
        ++iterations_;
        std::visit([&](const auto& W) { push(W, liquid, near, walls, liquid.predicted); }, liquid.kernel());
    }

    void correctVelocities(Liquid& liquid, const Neighbourhood& near, const Walls& walls) override
    {
        if (liquid.isEmpty()) return;
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                prepare(W, {valuesOf(liquid.position)}, liquid, near, walls);
                change_.resizeDiscarding(liquid.owned());
                forEach(liquid.owned(), WarmStart{warmStart_ ? 1.0f : 0.0f, velocityPotential_.span(), increase_.span()});
                if (warmStart_) push(W, liquid, near, walls, liquid.velocity);
                const scalar inSupport = 4 * kernels::pi / 3 * W.h * W.h * W.h / liquid.particleVolume();
                for (int made = 0; made < divergenceControls_.maxIterations; ++made)
                {
                    NeighbourLoop(liquid, {valuesOf(liquid.velocity)}, {valuesOf(liquid.position)}).forEach(DivergenceStep<Kernel>
                    {
                        {W, liquid.particleVolume(), liquid.position.span(), near.view(), walls.view(liquid)},
                        {liquid.velocity.span()}, inSupport - 1, inSupport, dt_, factor_.span(), change_.span(),
                        velocityPotential_.span(), increase_.span()
                    });
                    const bool looks = made >= divergenceControls_.minIterations && divergenceControls_.tolerance > 0;
                    if (looks && averageChange(liquid) <= divergenceControls_.tolerance) break;
                    push(W, liquid, near, walls, liquid.velocity);
                }
            },
            liquid.kernel()
        );
    }

    std::optional<Columns> readsOfNeighbours(Liquid& liquid) const override
    {
        return iterations_ == 0 ? Columns{valuesOf(liquid.position)} : Columns{};
    }
    int iterations() const override { return iterations_; }
    double mostCompression() const override { return mostTakenOutAtOnce; }
    const Buffer<scalar>* keepPressure() override { return &pressure_; }

private:
    // moved: positions, where they are not declared of the verb.
    template<class Kernel>
    void prepare(const Kernel& W, NeighbourLoop::Reads moved, const Liquid& liquid, const Neighbourhood& near, const Walls& walls)
    {
        factor_.resizeDiscarding(liquid.all());
        increase_.resizeDiscarding(liquid.all());
        NeighbourLoop(liquid, moved).forEach(Factor<Kernel>
        {
            W, liquid.particleVolume(), liquid.position.span(), near.view(), walls.view(liquid), factor_.span()
        });
    }

    template<class Kernel, class Moved>
    void push(const Kernel& W, const Liquid& liquid, const Neighbourhood& near, const Walls& walls, Buffer<Moved>& moved)
    {
        NeighbourLoop(liquid, {valuesOf(increase_)}, {valuesOf(liquid.position)}).forEach(PushApart<Kernel, SumOfBoth, Moved>
        {
            W, liquid.particleVolume(), {increase_.span()}, liquid.position.span(), near.view(), walls.view(liquid), moved.span()
        });
    }

    double averageChange(const Liquid& liquid)
    {
        averageChange_.ask(liquid, change_.span(), 0);
        return averageChange_.take();
    }

    IterationControls controls_, divergenceControls_;
    bool warmStart_;
    scalar dt_ = 0;
    int iterations_ = 0;
    Buffer<scalar>& pressure_;          // rho0 kappa/rho, of the step that was made
    Buffer<scalar>& velocityPotential_;  // dt kappav/rho
    Buffer<scalar> start_, factor_, increase_, change_;
    AverageCompression compression_;
    AverageExcess averageChange_;
};

const PressureTable::Add<DFSPH> registered{"DFSPH", "divergence-free SPH (Bender and Koschier 2015)"};

}

}
