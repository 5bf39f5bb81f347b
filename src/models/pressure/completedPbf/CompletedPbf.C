// SPDX-License-Identifier: GPL-3.0-or-later
// Position based fluids with the density completed where neighbours are missing: at the free surface and at walls.
//
// The density of Macklin and Mueller 2013 reads a particle at the free surface as diluted and packs it until the drop has
// lost a tenth of its volume. Here the density is compared with that of a planar surface at the particle's depth, and a
// wall holds the liquid's extension (freeSurface/ExtendedLiquid.H):
//
//     C_i  = rho_i/(rho0 E_i) - 1,   rho_i/rho0 = V sum_j W_ij / S + walls,   E_i = 1 - Psi(s_i)
//     p_i  : increased in each iteration by w C_i / (sum_j |V grad W_ij|^2 + |sum|^2 + epsilon) rho0/dt^2, kept >= -p_s
//     dx_i = -(dt^2/rho0) [ sum_j V (dp_j + dp_i) grad W_ij + 2 dp_i grad(walls) + e_i ]
//     e_i  = 2 dp_i (o sign(p_i) - 1) (G_i - g_i)
//
// with Psi(s) the kernel's integral over the half-space beyond distance s, s_i from FreeSurface.H, dp the increase of p.
// The multiplier is the pressure, p [Pa]: it begins each step at zero and may fall again within the step. It pulls no more
// than the surface can bear, p_s: what the tension allows, nothing without tension.
//
// G_i = sum_j V grad W_ij + grad(walls) of the neighbours as they lie, g_i what a planar surface at depth s_i has. Their
// difference is the particle's disorder, and e_i orders the particles: under suction, where the sum alone would let them clump,
// and o times as strongly as the sum alone under pressure (doc/notebook/theory/completedPbf.md). Ordering is internal: what all e_i of a
// step move and turn as a whole is taken back at its end (models/forces/RigidMotion.H). So is what walls of one contact angle give along themselves: liquid does not slide by
// itself where it wets alike everywhere. What an order of the particles would bear of shear is taken out once a step (OrderStress.H).
//
//     pressure    completedPbf;           // in constant/models
//
// Its controls stand in system/solution: shared/PressureControls.H, and
//
//     pressure
//     {
//         ordering        1.2;            // o, from 1 to 4
//         orderRemoved    1;              // r of OrderStress.H, from 0 to 1
//         coarseGrid      no;             // yes: takes compression out over the whole depth at once (CoarseCorrection.H)
//         alongSurfaces   no;             // yes: completes the pressure's gradient along surfaces and walls (TangentialGradient.H); where
//                                         // nothing is said it does with surfaceTension laplacePressure
//     }
//
// With coarseGrid the first half of the iterations that are allowed also correct on a grid; the others even out what it leaves.
//
// maxIterations is meant for steps up to the capillary one sqrt(rho d^3/(2 pi sigma)); a longer one, which moves particles
// farther, may make more towards the tolerance: of k capillary steps sqrt(k) as many, above 2.8 sqrt(k) k/2.8, so that the liquid keeps its volume.
// Trials: doc/notebook/theory/completedPbf.md.

#include "device/Holds.H"
#include "freeSurface/FreeSurface.H"
#include "models/density/OrderStress.H"
#include "models/pressure/Pressure.H"
#include "models/pressure/completedPbf/CoarseCorrection.H"
#include "models/pressure/completedPbf/TangentialGradient.H"
#include "models/pressure/shared/PressureControls.H"
#include "models/pressure/shared/PressureField.H"
#include "models/pressure/shared/SteadyIterations.H"
#include "particles/NeighbourLoop.H"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shizuku
{

namespace
{

// The increase of the pressure, dt^2/rho0 dp, travels with the predicted position in the place of its block (device/Position.H): one access brings a neighbour's both.
HOST_DEVICE inline void setIncrease(Position& x, scalar increase) { x.w = wordOf(increase); }
HOST_DEVICE inline scalar increaseAt(Position x) { return numberOf(x.w); }
HOST_DEVICE inline auto increaseBehind(Vector auto difference) { return difference.w; }        // of the neighbour at the difference's end

template<class Kernel, class Stress, class Tangential>
struct RaisePressure
{
    static constexpr Holds holds = Holds::more;

    Kernel W;
    scalar volume, densityVolume;           // V, V/S
    scalar ordering;                        // o
    scalar relaxation, epsilon, perPressure; // perPressure: dt^2/rho0
    Span<Position> x;                       // gets its increase (setIncrease)
    NeighbourView near;
    WallContribution walls;
    FreeSurfaceView surface;
    HalfSpaceView plane;
    Span<const scalar> pressure;            // so far; of the first iteration that of the step before
    Span<scalar> density;
    Span<Position> push;                    // dt^2/rho0 (2 dp grad(walls) + e), as words
    Span<Vec3> order;                       // dt^2/rho0 e; may be empty
    Stress stress;
    Tangential tangential;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const auto wall = walls(i, x[i], surface.contactOf(i), team);
        typename Stress::Moments moments;
        const ConstraintSums sums = constraintSums(W, volume, i, x, near, team, moments);
        const SurfaceState own = surface(i);
        if constexpr (Stress::present)
        {
            stress.store(i, x[i], moments.over(team), pressure[i], own, plane, walls, wall.anyWall, team);
        }
        if (!team.first()) return;
        const HalfSpaceValues gas = plane(own.depth);
        const Vec3 gradient = sums.gradient + wall.gradient;
        density[i] = (densityVolume * sums.W + wall.value) / (1 - gas.density);
        if constexpr (Tangential::present) tangential.store(i, x[i], own, gas.density, walls.walls, W.h, wall.value);

        const scalar before = Stress::present ? 0 : pressure[i];
        const scalar step = relaxation * (density[i] - 1) / (sums.squares + squared(gradient) + epsilon);
        const scalar raised = fmax(before + step / perPressure, own.lowestPressure), increase = (raised - before) * perPressure;
        setIncrease(x[i], increase);

        const Vec3 disorder = gradient - gas.gradient / fmax(norm(own.gradient), 1e-20f) * own.gradient;
        const Vec3 e = 2 * increase * ((raised < 0 ? -ordering : ordering) - 1) * disorder;
        push[i] = wordsOf(2 * increase * wall.gradient + e);
        if (order.size > 0) order[i] = e;
    }
};

template<class Kernel, class Stress, class Tangential>
struct Displace
{
    static constexpr Holds holds = Stress::present ? Holds::more : Holds::few;

    Kernel W;
    scalar volume, perPressure;
    Span<const Position> x;                 // with their increases
    NeighbourView near;
    Span<Position> moved;                   // holds the push before (vectorIn), then where it brings the particle
    bool pushIsInternal;                    // all of the push should not move the liquid as a whole, or `order` of it
    Span<const Vec3> order;
    WallStop stop;
    Span<scalar> pressure;                  // of what has been displaced by: an increase that was only looked at is not in it
    Span<Vec3> total;                       // of what is internal; may be empty
    Stress stress;
    Tangential tangential;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const Position xi = x[i];
        const scalar own = increaseAt(xi);
        const Vec3 push = vectorIn(moved[i]);
        Team::Vector sum, ofStress;
        typename Tangential::Sum along;
        const auto ownStress = stress[i];
        near.forEach(i, xi, x, [&]([[maybe_unused]] auto j, auto r)
        {
            const auto slope = W.g(norm(r)) * r;
            const auto other = increaseBehind(r);
            sum += (other + own) * slope;
            along.add(slope, other - own);
            if constexpr (Stress::present) ofStress += (stress[j] + ownStress) * slope;
        }, team);
        Vec3 step = volume * team.sum(sum), more;
        if constexpr (Tangential::present) more = tangential.more(i, volume * team.sum(along.differences));
        if constexpr (Stress::present) more -= volume * team.sum(ofStress);         // which is not along r, so that it turns pairs
        step += more;
        const Position admitted = stop(i, xi - (step + push), team);
        if (!team.first()) return;
        if (total.size > 0) total[i] += (pushIsInternal ? push : order[i]) + more;
        moved[i] = admitted;
        pressure[i] = (Stress::present ? 0 : pressure[i]) + own / perPressure;
    }
};

class CompletedPbf : public Pressure
{
public:
    CompletedPbf(const Dictionary& controls, Liquid& liquid, const Walls&, FreeSurface& surface)
    :
        controls_(PressureControls::read(controls, liquid, usualOfCompletedPbf)),
        ordering_(scalar(controls.lookupOr("ordering", 1.2))),
        orderRemoved_(scalar(controls.lookupOr("orderRemoved", 1.0))),
        limits_(controls_),
        surface_(surface),
        plane_(tabulateHalfSpace(liquid.kernel())),
        pressure_(keptPressure(liquid)),
        capillaryStep_(liquid.units().toScaled(liquid.properties().capillaryStep(), dimensions::time)),
        steady_(liquid)
    {
        refuseIf(!(ordering_ >= 1 && ordering_ <= 4), controls, "ordering", "1 to 4");
        refuseIf(!(orderRemoved_ >= 0 && orderRemoved_ <= 1), controls, "orderRemoved", "0 to 1");
        const bool coarse = controls.lookupOr("coarseGrid", false);
        refuseIf(coarse && liquid.ghosts().images(), controls, "coarseGrid", "no: the grid does not go on across the sides of constant/boundary");
        if (coarse) coarse_.emplace(liquid);
        if (controls.found("alongSurfaces")) givenAlongSurfaces_ = controls.lookup<bool>("alongSurfaces");
        surface.agreed().ordering = ordering_;
        surface.agreed().orderRemoved = orderRemoved_;
        surface.requireUsual(liquid);
    }

    void requireIterations(int least) override
    {
        if (controls_.tolerance > 0) least_ = least;
    }

    void begin(scalar dt) override
    {
        iterations_ = 0;
        const scalar steps = controls_.tolerance > 0 ? std::max(scalar(1), capillarySteps(dt)) : 1;
        const scalar more = std::sqrt(steps) * std::max(scalar(1), steps / 2.8f);
        limits_.minIterations = std::max(controls_.minIterations, least_);
        limits_.maxIterations = std::max(int(std::lround(controls_.maxIterations * more)), least_);
        steady_.begin(limits_);
        dt_ = dt;
        alongSurfaces_ = givenAlongSurfaces_.value_or(surface_.agreed().pressureJump);
    }

    bool converged(Liquid& liquid, const Neighbourhood& near, const Walls& walls) override
    {
        if (steady_.enough(iterations_) || liquid.isEmpty()) return true;
        if (!extended_)
        {
            extended_.emplace(liquid.kernel(), walls.contactAngles(surface_.support()));
            oneAngle_ = walls.oneContactAngle();
        }
        edges_.follow(walls.view(liquid).planes, liquid.kernel(), liquid);
        push_.resizeDiscarding(liquid.all());
        const int sliding = walls.constraints().all() ? 0 : liquid.owned();
        order_.resizeDiscarding(oneAngle_ ? 0 : sliding);
        if (iterations_ == 0)
        {
            total_.resizeDiscarding(sliding);
            total_.setZero();
        }
        if (iterations_ == 0)
        {
            stress_.resizeDiscarding(liquid.all());
            surfacePlanes_.resizeDiscarding(alongSurfaces_ ? surface_.particles().indices.size() + 1 : 0);
            wallPlanes_.resizeDiscarding(alongSurfaces_ ? liquid.all() : 0);
            if (alongSurfaces_) raisePressure(liquid, near, walls, stress(liquid), tangential());
            else raisePressure(liquid, near, walls, stress(liquid), NoTangentialGradient{});
        }
        else raisePressure(liquid, near, walls, NoOrderStress{}, NoTangentialGradient{});
        return !steady_.another(liquid, limits_, iterations_);
    }

    void correct(Liquid& liquid, const Neighbourhood& near, const Walls& walls) override
    {
        ++iterations_;
        if (coarse_ && iterations_ == 1) coarse_->begin(liquid, walls, surface_);
        if (usesCoarseGrid()) coarse_->apply(liquid);
        if (alongSurfaces_) displaceFirstOrOther(liquid, near, walls, tangential());
        else displaceFirstOrOther(liquid, near, walls, NoTangentialGradient{});
    }

    bool stopsAtWalls() const override { return true; }

    InternalDisplacement displacement() const override
    {
        if (iterations_ == 0) return {};
        return {total_.span(), -1};
    }

    // The memory is others' until the next step.
    void commit() override
    {
        push_ = {};
        for (Buffer<Vec3>* buffer : {&order_, &total_}) *buffer = {};
        for (Buffer<BoundingPlane>* buffer : {&surfacePlanes_, &wallPlanes_}) *buffer = {};
    }

    bool settles() const override { return true; }

    void forget() override
    {
        commit();
        steady_.forget();
        pressure_.setZero();
    }

    void complete() override { steady_.complete(); }

    // From the first correction on displace() gives ghosts their places.
    std::optional<Columns> readsOfNeighbours(Liquid& liquid) const override
    {
        return iterations_ == 0 ? Columns{placesOf(liquid.predicted)} : Columns{};
    }
    int iterations() const override { return iterations_; }
    const Buffer<scalar>* keepPressure() override { return &pressure_; }

private:
    // In this iteration, beside the pressure.
    bool usesCoarseGrid() const { return coarse_ && iterations_ <= (limits_.maxIterations + 1) / 2; }

    // dt over the capillary one; 0 without a tension, which leaves a surface that bears no suction.
    scalar capillarySteps(scalar dt) const { return surface_.suction() > 0 ? dt / capillaryStep_ : 0; }

    // The increase of the pressure at the predicted positions. Ghosts have these from the corrections before, but for the first.
    template<class Stress, class Tangential>
    void raisePressure
    (
        Liquid& liquid, const Neighbourhood& near, const Walls& walls, const Stress& stress, const Tangential& tangential
    )
    {
        Columns made{numbersOf(liquid.predicted)};
        if (Stress::present) made.push_back(valuesOf(stress_, Column::Kind::deviators));
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                const scalar V = liquid.particleVolume();
                NeighbourLoop(liquid, {}, {placesOf(liquid.predicted)}).forEachTeam(RaisePressure<Kernel, Stress, Tangential>
                {
                    .W = W, .volume = V, .densityVolume = V / liquid.latticeSum(), .ordering = ordering_, .relaxation = controls_.relaxation,
                    .epsilon = controls_.epsilon, .perPressure = dt_ * dt_ / liquid.restDensity(), .x = liquid.predicted.span(), .near = near.view(),
                    .walls = {extended_->view(), W.h, walls.view(liquid), edges_.view()}, .surface = surface_.view(), .plane = {plane_.span(), W.h},
                    .pressure = std::as_const(pressure_).span(), .density = liquid.density.span(), .push = push_.span(), .order = order_.span(),
                    .stress = stress, .tangential = tangential
                }, made);
            },
            liquid.kernel()
        );
    }

    template<class Tangential>
    void displaceFirstOrOther(Liquid& liquid, const Neighbourhood& near, const Walls& walls, const Tangential& tangential)
    {
        if (iterations_ > 1) return displace(liquid, near, walls, NoOrderStress{}, tangential);
        displace(liquid, near, walls, stress(liquid), tangential);
        stress_ = {};
    }

    // What it moves the predicted positions by.
    template<class Stress, class Tangential>
    void displace
    (
        Liquid& liquid, const Neighbourhood& near, const Walls& walls, const Stress& stress, const Tangential& tangential
    )
    {
        Columns made;
        if (!steady_.enough(iterations_)) made.push_back(placesOf(push_));
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                NeighbourLoop(liquid, {when(usesCoarseGrid(), placesOf(liquid.predicted))}, {placesOf(liquid.predicted)}).forEachTeam(Displace<Kernel, Stress, Tangential>
                {
                    .W = W, .volume = liquid.particleVolume(), .perPressure = dt_ * dt_ / liquid.restDensity(), .x = std::as_const(liquid.predicted).span(),
                    .near = near.view(), .moved = push_.span(), .pushIsInternal = oneAngle_, .order = std::as_const(order_).span(),
                    .stop = walls.stop(liquid), .pressure = pressure_.span(), .total = total_.span(), .stress = stress, .tangential = tangential
                }, made);
            },
            liquid.kernel()
        );
        liquid.predicted.swap(push_);
    }

    KeptOrderStress stress(const Liquid& liquid)
    {
        return {{orderRemoved_, 0.5f * liquid.spacing()}, dt_ * dt_ / liquid.restDensity(), stress_.span()};
    }

    TangentialGradient tangential() { return {surface_.view(), surfacePlanes_.span(), wallPlanes_.span()}; }

    PressureControls controls_;
    scalar ordering_, orderRemoved_;        // o, r
    IterationControls limits_;              // of the step
    FreeSurface& surface_;
    Buffer<HalfSpaceValues> plane_;
    Buffer<scalar>& pressure_;
    scalar capillaryStep_;
    scalar dt_ = 0;
    int least_ = 0;                         // iterations, that forces require
    int iterations_ = 0;
    std::optional<ExtendedLiquid> extended_;
    SampledEdges edges_;
    bool oneAngle_ = false;
    std::optional<bool> givenAlongSurfaces_;
    bool alongSurfaces_ = false;            // in this step
    Buffer<Vec3> stress_;                   // of the first iteration
    Buffer<BoundingPlane> surfacePlanes_, wallPlanes_;  // with alongSurfaces: of the particles near the surface, and of all, from walls
    Buffer<Position> push_;                 // shares its memory with the predicted positions to come
    Buffer<Vec3> order_, total_;            // empty: order_ with one contact angle, both where walls hold in all directions
    SteadyIterations steady_;
    std::optional<CoarseCorrection> coarse_;
};

const PressureTable::Add<CompletedPbf> registered{"completedPbf", "position based fluids, the density completed at the free surface and at walls"};

}

}
