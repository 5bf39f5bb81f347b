// SPDX-License-Identifier: GPL-3.0-or-later
// The viscosity nu of constant/liquidProperties, as a Newtonian liquid has it: du/dt = div(2 nu D), with a free surface that bears no stress and walls that
// hold the liquid. Besides, noise is taken out.
//
//     u + dt (A u + T u) = u* + dt T w,        A: PairStress.H,     T: WallDrag.H, with the velocities w of walls (MovingWallDrag.H)
//
// u* is what pressure and forces have made. Where a step is short for the liquid's nu, A u* does for A u, as a whole or in two halves: where
// e = 8 nu dt sum_j V k_ij, which no eigenvalue of dt A exceeds in the bulk, is at most a quarter in each. Walls are implicit at all times.
// Else the system is solved, so that no step is too long: by conjugate gradients
// from u* on, whose every iterate has the momentum and, without walls, the angular momentum of u*. They end when the residual is `tolerance` of the velocities and
// of what it was, or is what rounding leaves. From e = 0.25 on, which water has in long steps, particles go by u (GoByVelocity.H).
//
// Noise is what no flow has that is linear around a particle. Of it a share of a step is taken out, whatever nu is: by the same forces, with nu' = nu + share/(2 dt sum_j
// V k_ij), and by themselves from e = 0.25 on. Translation, rotation and strain pass untouched, and energy is only ever taken. nu may be zero: that is all that is done then.
//
//     c: the share of a step; perCapillaryStep, p, that of the time t_c = sqrt(rho d^3/(2 pi sigma)): a step dt takes 1 - (1 - p)^(dt/t_c) where that is more
//     than c. Walls take -a (u_i - <u>_i) w of it, less what nu takes by itself; w: the kernel density of walls, <u>: the mean of neighbours by k, a: atWalls. So what
//     trembles on a wall comes to rest on it, and what runs along it is held by T alone. Without a surface tension p is 0 where nothing is said.
//
// Trials: doc/notebook/theory/viscosity.md.
//
//     viscosity        newtonian;
//     newtonianCoeffs
//     {
//         noSlip              yes;        // no: liquid slides along walls without friction
//         slipLength          1e-9;       // m, Navier's
//         startedLayers       yes;        // no: the velocity rises linearly from a wall to the particle at all times
//         tolerance           1e-3;
//         maxIterations       200;
//         c                   0.2;        // of noise
//         perCapillaryStep    0.98;
//         atWalls             1;
//     }

#include "maths/Simpson.H"
#include "models/smoothing/SmoothingControls.H"
#include "models/viscosity/Viscosity.H"
#include "models/viscosity/newtonian/Dissipation.H"
#include "models/viscosity/newtonian/ExplicitStep.H"
#include "models/viscosity/newtonian/FrictionOnBody.H"
#include "models/viscosity/newtonian/GoByVelocity.H"
#include "models/viscosity/newtonian/ImplicitStep.H"

#include <optional>
#include <utility>

namespace shizuku
{

namespace
{

// sum_j V k_ij as an integral.
scalar weightsOf(const KernelChoice& kernel)
{
    return std::visit([](const auto& W)
    {
        return scalar(integrate(0, W.h, [&](double r) { return 4 * kernels::pi * r * r * -W.g(scalar(r)); }));
    }, kernel);
}

ConjugateGradients::Controls solverControls(const Dictionary& coeffs)
{
    const ConjugateGradients::Controls controls{coeffs.lookupOr("tolerance", 1e-3), coeffs.lookupOr("maxIterations", 200)};
    const auto refuseIf = [&](bool wrong, const std::string& entry, const std::string& expected)
    {
        if (wrong) throw FatalInputError(coeffs.where(entry), "Coefficient " + entry + " is out of range", expected);
    };
    refuseIf(!(controls.tolerance > 0 && controls.tolerance < 1), "tolerance", "above 0, below 1");
    refuseIf(controls.maxIterations < 1, "maxIterations", "1 or more");
    return controls;
}

class Newtonian : public Viscosity
{
public:
    Newtonian(const Dictionary& coeffs, Liquid& liquid)
    :
        noise_(coeffs, liquid, {.c = 0.2, .perCapillaryStep = 0.98}, false), atWalls_(shareOf(coeffs, "atWalls", 1)),
        nu_(liquid.units().toScaled(liquid.properties().viscosity, dimensions::kinematicViscosity)),
        friction_(coeffs, liquid, nu_),
        solver_(solverControls(coeffs)),
        weights_(weightsOf(liquid.kernel()))
    {}

    std::optional<Columns> readsOfNeighbours(Liquid& liquid) const override { return Columns{valuesOf(liquid.position), valuesOf(liquid.velocity)}; }
    bool holdsAtWalls() const override { return friction_.holds(); }

    const Buffer<Vec3>* keepFriction(const std::string& wall) override
    {
        if (!friction_.holds()) return nullptr;
        if (!onBody_) onBody_.emplace(wall);
        return &onBody_->loss();
    }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt) override
    {
        if (onBody_) onBody_->clear(liquid);
        const scalar share = noise_.share(dt);
        if (liquid.isEmpty() || (nu_ == 0 && share == 0)) return;
        const scalar ofNoise = share / (2 * dt * weights_), ofWalls = std::max(share - 2 * dt * weights_ * nu_, scalar(0));
        const scalar stiffest = 8 * dt * nu_ * weights_;
        const bool atOnce = stiffest <= 0.25f, solved = stiffest > 0.5f;
        const Viscosities first = atOnce ? Viscosities{nu_, nu_ + ofNoise} : Viscosities{0, ofNoise};
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                const ViscousStep<Kernel> step{W, liquid, std::as_const(liquid.position).span(), near.view(), walls, dt};
                StressOfStep stress(liquid, !atOnce);
                const bool holds = nu_ > 0 && friction_.acts(walls);
                const auto take = [&](const ViscousStep<Kernel>& at, bool held, const auto& change)
                {
                    if (onBody_ && held) onBody_->addOf(at, friction_, change);
                    else change();
                };
                const auto explicitly = [&](const ViscousStep<Kernel>& at, Viscosities viscosities, scalar noiseAtWalls, bool held)
                {
                    take(at, held, [&] { stepExplicitly(at, stress, viscosities, noiseAtWalls, held, friction_); });
                };
                if (atOnce || share > 0) explicitly(step, first, ofWalls * atWalls_, atOnce && holds);
                if (atOnce) return;
                goByVelocity(liquid, dt, [&]
                {
                    if (solved) return take(step, holds, [&] { stepImplicitly(step, stress, nu_, friction_, solver_); });
                    ViscousStep<Kernel> half = step;
                    half.dt = dt / 2;
                    for (int n = 0; n < 2; ++n) explicitly(half, {nu_, nu_}, 0, holds);
                });
            },
            liquid.kernel()
        );
    }

    // What is not of nu is noise.
    std::optional<Buffer<scalar>> dissipation(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt) const override
    {
        if (noise_.share(dt) == 0) return std::nullopt;
        if (liquid.isEmpty()) return Buffer<scalar>();
        return std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                return shizuku::dissipation(ViscousStep<Kernel>{W, liquid, std::as_const(liquid.position).span(), near.view(), walls, dt}, nu_, friction_);
            },
            liquid.kernel()
        );
    }

private:
    SmoothingControls noise_;
    scalar atWalls_;
    scalar nu_;                                         // scaled
    WallFriction friction_;
    std::optional<FrictionOnBody> onBody_;              // where it is asked for
    ConjugateGradients solver_;
    scalar weights_;
};

const ViscosityTable::Add<Newtonian> registered{"newtonian", "Newtonian liquid of viscosity nu, its free surface without stress"};

}

}
