// SPDX-License-Identifier: GPL-3.0-or-later
// The viscosity nu of constant/liquidProperties, as a Newtonian liquid has it: du/dt = div(2 nu D), with a free surface that bears no stress and walls that
// hold the liquid.
//
//     u + dt (A u + T u) = u*,        A: PairStress.H,     T: WallDrag.H
//
// u* is what pressure and forces have made. Implicit, so no step is too long for it, and the more viscous the liquid the more it moves as a rigid body.
// Solved by conjugate gradients from u* on, whose every iterate has the momentum and, without walls, the angular momentum of u*. They end when
// the residual is `tolerance` of the velocities and of what it was, or is what rounding leaves. nu may be zero: nothing is done then.
//
// Where a step is short for the liquid's nu, as it is of water, A u* does for A u: where no eigenvalue of dt A is above a quarter, which are at most 8 nu dt sum_j V k_ij.
// Walls are implicit at all times.
//
// Particles go by u: x += dt (u - u*). In a step forces move those of a thick liquid by many times what its stress lets them go.
//
// The form that asks for one sum over the particles an iteration: Chronopoulos and Gear 1989. Its sums are of whole quanta: parts of a liquid come to the bits of the whole.
// Trials: doc/notebook/theory/viscosity.md.
//
//     viscosity        newtonian;
//     newtonianCoeffs
//     {
//         noSlip          yes;        // no: liquid slides along walls without friction
//         slipLength      0;          // m, Navier's
//         startedLayers   yes;        // no: the velocity rises linearly from a wall to the particle at all times
//         tolerance       1e-3;
//         maxIterations   200;
//     }

#include "device/Reduce.H"
#include "maths/Simpson.H"
#include "maths/WholeSum.H"
#include "models/viscosity/Viscosity.H"
#include "models/viscosity/newtonian/PairStress.H"
#include "models/viscosity/newtonian/WallDrag.H"

#include <cmath>
#include <utility>

namespace shizuku
{

namespace
{

// The step with A u*: u = (I + dt T)^-1 (u* - dt A u*).
template<class Kernel>
struct TakeOne
{
    static constexpr Holds holds = Holds::more;

    SlopeWeight<Kernel> k;
    scalar volume, dt;
    Span<const Position> x;
    Span<const Vec3> before;                            // u*
    NeighbourView near;
    RowsField<const Vec3> stress;                       // of u*
    bool held;
    WallDrag<Kernel> drag;
    Span<Vec3> velocity;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const Vec3 force = stressForce(k, volume, i, x, before, near, stress, team);
        if (!team.first()) return;
        Vec3 u = before[i] - dt * force;
        if (held)
        {
            SymmTensor<Vec3> matrix = dt * drag(i);
            matrix.diagonal += Vec3{1, 1, 1};
            const SymmTensor<Vec3> adjoint = adjugate(matrix);
            u = 1 / determinant(matrix, adjoint) * (adjoint * u);
        }
        velocity[i] = u;
    }
};

template<class Kernel>
struct StoreDrag
{
    WallDrag<Kernel> drag;
    Span<Vec3> diagonal, other;

    HOST_DEVICE void operator()(int i) const
    {
        const SymmTensor<Vec3> matrix = drag(i);
        diagonal[i] = matrix.diagonal;
        other[i] = matrix.other;
    }
};

// The matrix I + dt (A + T), or dt (A + T) alone.
template<class Weight>
struct Multiply
{
    static constexpr Holds holds = Holds::more;

    Weight k;
    scalar volume, dt, own;                             // own: 1 or 0
    Span<const Position> x;
    Span<const Vec3> vector;
    NeighbourView near;
    RowsField<const Vec3> stress;                       // of `vector`
    Span<const Vec3> dragDiagonal, dragOther;           // empty: no walls
    Span<Vec3> product;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        Vec3 force = stressForce(k, volume, i, x, vector, near, stress, team);
        if (!team.first()) return;
        const Vec3 v = vector[i];
        if (dragDiagonal.size > 0) force += SymmTensor<Vec3>{dragDiagonal[i], dragOther[i]} * v;
        product[i] = own * v + dt * force;
    }
};

// In quanta of 2^-72, scaled: of long steps for thick liquids far above what wideQuanta() holds.
struct ResidualSums
{
    WideSum squares, energy, velocities;                // r.r, r.(matrix r), u.u

    HOST_DEVICE static WideSum quanta(scalar value) { return Int128(double(value) * quantaOfOne); }
    static double value(const WideSum& sum) { return double(Int128(sum)) / quantaOfOne; }

    HOST_DEVICE void add(const ResidualSums& more)
    {
        squares += more.squares;
        energy += more.energy;
        velocities += more.velocities;
    }

private:
    static constexpr double quantaOfOne = 0x1p72;
};

struct SumResidual
{
    Span<const Vec3> residual, product, velocity;

    HOST_DEVICE ResidualSums operator()(int i) const
    {
        return
        {
            ResidualSums::quanta(squared(residual[i])), ResidualSums::quanta(dot(residual[i], product[i])),
            ResidualSums::quanta(squared(velocity[i]))
        };
    }
};

struct Copy
{
    Span<const Vec3> from;
    Span<Vec3> to;

    HOST_DEVICE void operator()(int i) const { to[i] = from[i]; }
};

// Particles are where their velocities bring them.
struct MoveOn
{
    scalar dt;
    Span<const Vec3> before, velocity;
    Span<Position> position;

    HOST_DEVICE void operator()(int i) const
    {
        const Position from = position[i];
        position[i] = withBlock(from, from + dt * (velocity[i] - before[i]));
    }
};

struct Negate
{
    Span<Vec3> vector;

    HOST_DEVICE void operator()(int i) const { vector[i] = -vector[i]; }
};

struct Advance
{
    scalar alpha, beta;
    bool first;
    Span<Vec3> velocity, residual, direction, ofDirection;      // ofDirection: the matrix times it
    Span<const Vec3> product;

    HOST_DEVICE void operator()(int i) const
    {
        const Vec3 p = first ? residual[i] : residual[i] + beta * direction[i];
        const Vec3 s = first ? product[i] : product[i] + beta * ofDirection[i];
        velocity[i] += alpha * p;
        residual[i] -= alpha * s;
        direction[i] = p;
        ofDirection[i] = s;
    }
};

class Newtonian : public Viscosity
{
public:
    Newtonian(const Dictionary& coeffs, Liquid& liquid)
    :
        noSlip_(coeffs.lookupOr("noSlip", true)),
        missing_(missingField(coeffs.lookupOr("startedLayers", true) && noSlip_, liquid)),
        slip_(liquid.units().toScaled(coeffs.lookupDimensionedOr("slipLength", dimensions::length, 0), dimensions::length)),
        tolerance_(coeffs.lookupOr("tolerance", 1e-3)),
        maxIterations_(coeffs.lookupOr("maxIterations", 200)),
        nu_(liquid.units().toScaled(liquid.properties().viscosity, dimensions::kinematicViscosity)),
        plane_(tabulateHalfSpace(liquid.kernel())),
        stiffest_(stiffestOf(liquid.kernel()))
    {
        const auto refuseIf = [&](bool wrong, const std::string& entry, const std::string& expected)
        {
            if (wrong) throw FatalInputError(coeffs.where(entry), "Coefficient " + entry + " is out of range", expected);
        };
        refuseIf(!(slip_ >= 0), "slipLength", "a length of 0 m or more");
        refuseIf(!(tolerance_ > 0 && tolerance_ < 1), "tolerance", "above 0, below 1");
        refuseIf(maxIterations_ < 1, "maxIterations", "1 or more");
    }

    bool seesGhosts() const override { return true; }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt) override
    {
        if (nu_ == 0 || liquid.isEmpty()) return;
        liquid.ghosts().copy(liquid.position);
        liquid.ghosts().copy(liquid.velocity);
        stress_.resizeDiscarding(liquid.all());
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                const Step<Kernel> step{W, liquid, std::as_const(liquid.position).span(), near.view(), walls, dt};
                const Buffer<Vec3> before = dt * nu_ * stiffest_ <= 0.25f ? takeOne(step) : solve(step);
                forEach(liquid.owned(), MoveOn{dt, before.span(), std::as_const(liquid.velocity).span(), liquid.position.span()});
            },
            liquid.kernel()
        );
    }

private:
    // What the layers at walls lack, m.
    static Buffer<scalar>* missingField(bool wanted, Liquid& liquid)
    {
        if (!wanted) return nullptr;
        return &liquid.fields().require<scalar>
        ({
            .name = "wallLayer", .dimensions = dimensions::kinematicViscosity, .written = true, .restarted = true, .exchanged = true
        });
    }

    // The largest eigenvalue of A over nu, at most: 8 sum_j V k_ij, as an integral.
    static scalar stiffestOf(const KernelChoice& kernel)
    {
        return std::visit([](const auto& W)
        {
            return scalar(8 * integrate(0, W.h, [&](double r) { return 4 * kernels::pi * r * r * -W.g(scalar(r)); }));
        }, kernel);
    }

    bool isHeld(const Walls& walls) const { return noSlip_ && (walls.particles() > 0 || walls.surfaces() > 0); }

    // Where and between whom the stress acts.
    template<class Kernel>
    struct Step
    {
        const Kernel& W;
        Liquid& liquid;
        Span<const Position> x;
        NeighbourView near;
        const Walls& walls;
        scalar dt;
    };

    template<class Kernel>
    WallDrag<Kernel> drag(const Step<Kernel>& at)
    {
        return
        {
            at.W, at.liquid.spacing(), nu_, slip_, at.dt, at.x, std::as_const(at.liquid.velocity).span(), at.walls.view(at.liquid),
            {plane_.span(), at.W.h}, missing_ ? missing_->span() : Span<scalar>{}
        };
    }

    // P of the vectors, of ghosts too, which have theirs. The first of a step measures the moments.
    template<template<class> class Find, class Kernel>
    void findStress(const Step<Kernel>& at, const Buffer<Vec3>& vectors)
    {
        forEachTeam(at.liquid.owned(), Find<SlopeWeight<Kernel>>
        {
            {at.W}, at.liquid.particleVolume(), nu_, at.x, vectors.span(), at.near, inverse_.view(), stress_.view()
        });
        for (Buffer<Vec3>* row : {&stress_.x, &stress_.y, &stress_.z}) at.liquid.ghosts().copy(*row);
    }

    // Either makes the velocities, and returns those before.
    template<class Kernel>
    Buffer<Vec3> takeOne(const Step<Kernel>& at)
    {
        inverse_.resizeDiscarding(0);
        findStress<FindFirstStress>(at, at.liquid.velocity);
        Buffer<Vec3> velocity(at.liquid.all());
        forEachTeam(at.liquid.owned(), TakeOne<Kernel>
        {
            {at.W}, at.liquid.particleVolume(), at.dt, at.x, std::as_const(at.liquid.velocity).span(), at.near, stress_.seen(), isHeld(at.walls),
            drag(at), velocity.span()
        });
        at.liquid.velocity.swap(velocity);
        return velocity;
    }

    template<class Kernel>
    Buffer<Vec3> solve(const Step<Kernel>& at)
    {
        Liquid& liquid = at.liquid;
        Buffer<Vec3> start(liquid.all());
        forEach(liquid.owned(), Copy{std::as_const(liquid.velocity).span(), start.span()});
        for (Buffer<Vec3>* vector : {&residual_, &product_, &direction_, &ofDirection_}) vector->resizeDiscarding(liquid.all());
        const int n = liquid.owned(), held = isHeld(at.walls) ? liquid.all() : 0;
        inverse_.resizeDiscarding(liquid.all());
        dragDiagonal_.resizeDiscarding(held);
        dragOther_.resizeDiscarding(held);
        if (held) forEach(n, StoreDrag<Kernel>{drag(at), dragDiagonal_.span(), dragOther_.span()});
        const auto multiply = [&](Buffer<Vec3>& vector, scalar own, Buffer<Vec3>& product)
        {
            liquid.ghosts().copy(vector);
            if (&vector == &liquid.velocity) findStress<FindFirstStress>(at, vector);
            else findStress<FindStress>(at, vector);
            forEachTeam(n, Multiply<SlopeWeight<Kernel>>
            {
                {at.W}, liquid.particleVolume(), at.dt, own, at.x, vector.span(), at.near, stress_.seen(), dragDiagonal_.span(), dragOther_.span(),
                product.span()
            });
        };
        multiply(liquid.velocity, 0, residual_);
        forEach(n, Negate{residual_.span()});
        double before = 0, alpha = 0, enough = 0;
        for (int iteration = 0; iteration < maxIterations_; ++iteration)
        {
            multiply(residual_, 1, product_);
            const ResidualSums whole = liquid.parts().fold
            (
                reduce(n, SumResidual{residual_.span(), product_.span(), liquid.velocity.span()}, scratch_)
            );
            const double squares = ResidualSums::value(whole.squares), energy = ResidualSums::value(whole.energy);
            // No eigenvalue is below one: velocities are as near to the solution as the residual is small. That of the beginning is no measure, which noise makes as
            // large as steps are too long for it. Roundings of velocities make one, too.
            constexpr double rounding = 4 * std::numeric_limits<scalar>::epsilon();
            const double ofVelocities = ResidualSums::value(whole.velocities);
            if (iteration == 0) enough = std::max(tolerance_ * tolerance_ * std::min(squares, ofVelocities), rounding * rounding * ofVelocities);
            if (!(squares > enough)) break;
            const double beta = iteration > 0 ? squares / before : 0;
            alpha = squares / (iteration > 0 ? energy - beta * squares / alpha : energy);
            before = squares;
            forEach(n, Advance
            {
                scalar(alpha), scalar(beta), iteration == 0, liquid.velocity.span(), residual_.span(), direction_.span(),
                ofDirection_.span(), product_.span()
            });
        }
        return start;
    }

    bool noSlip_;
    Buffer<scalar>* missing_;                           // where it is wanted
    scalar slip_;                                       // scaled
    double tolerance_;
    int maxIterations_;
    scalar nu_;
    Buffer<HalfSpaceValues> plane_;
    scalar stiffest_;
    InverseMoments inverse_;
    OwnedRows stress_;
    Buffer<Vec3> residual_, product_, direction_, ofDirection_;
    Buffer<Vec3> dragDiagonal_, dragOther_;
    Buffer<ResidualSums> scratch_;
};

const ViscosityTable::Add<Newtonian> registered{"newtonian", "Newtonian liquid of viscosity nu, its free surface without stress"};

}

}
