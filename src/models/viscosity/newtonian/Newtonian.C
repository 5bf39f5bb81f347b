// SPDX-License-Identifier: GPL-3.0-or-later
// The viscosity nu of constant/liquidProperties, as a Newtonian liquid has it: du/dt = div(2 nu D), with a free surface that bears no stress and walls that
// hold the liquid.
//
//     u + dt (A u + T u) = u*,        A: PairStress.H,     T: WallDrag.H
//
// u* is what pressure and forces have made. Implicit, so no step is too long for it, and the more viscous the liquid the more it moves as a rigid body.
// Solved by conjugate gradients from u* on, whose every iterate has the momentum and, without walls, the angular momentum of u*. They end when
// the residual has fallen by `tolerance`, or is what rounding leaves. nu may be zero: nothing is done then.
//
// The form that asks for one sum over the particles an iteration: Chronopoulos and Gear 1989. Trials: doc/notebook/theory/viscosity.md.
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
#include "models/viscosity/Viscosity.H"
#include "models/viscosity/newtonian/PairStress.H"
#include "models/viscosity/newtonian/WallDrag.H"

#include <cmath>

namespace shizuku
{

namespace
{

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

struct ResidualSums
{
    double squares = 0, energy = 0, velocities = 0;     // r.r, r.(matrix r), u.u

    HOST_DEVICE void add(const ResidualSums& more)
    {
        squares += more.squares;
        energy += more.energy;
        velocities += more.velocities;
    }
};

struct SumResidual
{
    Span<const Vec3> residual, product, velocity;

    HOST_DEVICE ResidualSums operator()(int i) const
    {
        return {squared(residual[i]), dot(residual[i], product[i]), squared(velocity[i])};
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
        plane_(tabulateHalfSpace(liquid.kernel()))
    {
        const auto refuseIf = [&](bool wrong, const std::string& entry, const std::string& expected)
        {
            if (wrong) throw FatalInputError(coeffs.where(entry), "Coefficient " + entry + " is out of range", expected);
        };
        refuseIf(!(slip_ >= 0), "slipLength", "a length of 0 m or more");
        refuseIf(!(tolerance_ > 0 && tolerance_ < 1), "tolerance", "above 0, below 1");
        refuseIf(maxIterations_ < 1, "maxIterations", "1 or more");
    }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt) override
    {
        if (nu_ == 0 || liquid.owned() == 0) return;
        for (Buffer<Vec3>* vector : {&residual_, &product_, &direction_, &ofDirection_}) vector->resizeDiscarding(liquid.all());
        inverse_.resizeDiscarding(liquid.all());
        stress_.resizeDiscarding(liquid.all());
        std::visit([&](const auto& W) { solve(W, liquid, near, walls, dt); }, liquid.kernel());
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

    template<class Kernel>
    void solve(const Kernel& W, Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt)
    {
        using Weight = SlopeWeight<Kernel>;
        const Weight k{W};
        const int n = liquid.owned();
        const scalar V = liquid.particleVolume();
        const Span<const Position> x = liquid.position.span();
        const bool held = noSlip_ && (walls.particles() > 0 || walls.surfaces() > 0);
        dragDiagonal_.resizeDiscarding(held ? liquid.all() : 0);
        dragOther_.resizeDiscarding(held ? liquid.all() : 0);
        if (held)
        {
            forEach(n, WallDrag<Kernel>
            {
                W, liquid.spacing(), nu_, slip_, dt, x, liquid.velocity.span(), walls.view(liquid), {plane_.span(), W.h},
                missing_ ? missing_->span() : Span<scalar>{}, dragDiagonal_.span(), dragOther_.span()
            });
        }
        forEachTeam(n, MeasureMoments<Weight>{k, V, x, near.view(), inverse_.view()});
        const auto multiply = [&](Buffer<Vec3>& vector, scalar own, Buffer<Vec3>& product)
        {
            forEachTeam(n, FindStress<Weight>{k, V, nu_, x, vector.span(), near.view(), inverse_.view(), stress_.view()});
            forEachTeam(n, Multiply<Weight>
            {
                k, V, dt, own, x, vector.span(), near.view(), stress_.seen(), dragDiagonal_.span(), dragOther_.span(), product.span()
            });
        };
        multiply(liquid.velocity, 0, residual_);
        forEach(n, Negate{residual_.span()});
        double before = 0, alpha = 0, enough = 0;
        for (int iteration = 0; iteration < maxIterations_; ++iteration)
        {
            multiply(residual_, 1, product_);
            const ResidualSums sums = reduce(n, SumResidual{residual_.span(), product_.span(), liquid.velocity.span()}, scratch_);
            // Roundings of velocities make a residual, too.
            constexpr double rounding = 4 * std::numeric_limits<scalar>::epsilon();
            if (iteration == 0) enough = std::max(tolerance_ * tolerance_ * sums.squares, rounding * rounding * sums.velocities);
            if (!(sums.squares > enough)) return;
            const double beta = iteration > 0 ? sums.squares / before : 0;
            alpha = sums.squares / (iteration > 0 ? sums.energy - beta * sums.squares / alpha : sums.energy);
            before = sums.squares;
            forEach(n, Advance
            {
                scalar(alpha), scalar(beta), iteration == 0, liquid.velocity.span(), residual_.span(), direction_.span(),
                ofDirection_.span(), product_.span()
            });
        }
    }

    bool noSlip_;
    Buffer<scalar>* missing_;                           // where it is wanted
    scalar slip_;                                       // scaled
    double tolerance_;
    int maxIterations_;
    scalar nu_;
    Buffer<HalfSpaceValues> plane_;
    InverseMoments inverse_;
    OwnedRows stress_;
    Buffer<Vec3> residual_, product_, direction_, ofDirection_;
    Buffer<Vec3> dragDiagonal_, dragOther_;
    Buffer<ResidualSums> scratch_;
};

const ViscosityTable::Add<Newtonian> registered{"newtonian", "Newtonian liquid of viscosity nu, its free surface without stress"};

}

}
