// SPDX-License-Identifier: GPL-3.0-or-later
// The viscosity nu of constant/liquidProperties, as a Newtonian liquid has it: du/dt = div(2 nu D), with a free surface that bears no stress and walls that
// hold the liquid. Besides, noise is taken out.
//
//     u + dt (A u + T u) = u*,        A: PairStress.H,     T: WallDrag.H
//
// u* is what pressure and forces have made. Where a step is short for the liquid's nu, as it is of water, A u* does for A u: where no eigenvalue of dt A is above a
// quarter, which are at most 8 nu dt sum_j V k_ij. Walls are implicit at all times. Else the system is solved, so that no step is too long: by conjugate gradients
// from u* on, whose every iterate has the momentum and, without walls, the angular momentum of u*. They end when the residual is `tolerance` of the velocities and
// of what it was, or is what rounding leaves. Particles then go by u: x += dt (u - u*). In a step forces move those of a thick liquid by many times what its stress
// lets them go. Without solving the two differ by a quarter of a particle's own jitter, and by some hundredths of what the spacing resolves.
//
// The form that asks for one sum over the particles an iteration: Chronopoulos and Gear 1989. Its sums are of whole quanta: parts of a liquid come to the bits of the whole.
//
// Noise is what no flow has that is linear around a particle. Of it a share of a step is taken out, whatever nu is: by the same forces, with nu' = nu + share/(2 dt sum_j
// V k_ij), and before a system is solved. Translation, rotation and strain pass untouched, and energy is only ever taken. nu may be zero: that is all that is done then.
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

#include "device/Copy.H"
#include "device/Reduce.H"
#include "maths/Simpson.H"
#include "maths/WholeSum.H"
#include "models/smoothing/SmoothingControls.H"
#include "models/viscosity/Viscosity.H"
#include "models/viscosity/newtonian/PairStress.H"
#include "models/viscosity/newtonian/SlipLength.H"
#include "models/viscosity/newtonian/WallDrag.H"

#include <cmath>
#include <utility>

namespace shizuku
{

namespace
{

// What walls take of a particle's velocity against the mean around it.
template<class Kernel>
struct NoiseAtWalls
{
    SlopeWeight<Kernel> k;
    scalar share;
    WallView walls;

    // The first lane gets it.
    HOST_DEVICE Vec3 operator()(int i, Span<const Position> x, Span<const Vec3> velocity, const NeighbourView& near, Team team) const
    {
        const scalar taken = share > 0 ? share * walls.density(i, x[i], k.W) : 0;
        if (!team.anyBeside(taken > 0)) return {};
        const Vec3 own = velocity[i];
        Team::Vector sum;
        Team::Scalar weights{};
        near.forEach(i, x[i], x, [&](auto j, auto r)
        {
            const auto weight = k(norm(r));
            sum += weight * (own - velocity[j]);
            weights += weight;
        }, team);
        const Vec3 apart = team.sum(sum);
        return taken / fmax(team.sum(weights), 1e-20f) * apart;
    }
};

// The step with A u*: u = (I + dt T)^-1 (u* - dt A u*).
template<class Kernel>
struct TakeOne
{
    static constexpr Holds holds = Holds::more;

    SlopeWeight<Kernel> k;
    scalar volume, dt, ofRest;
    Span<const Position> x;
    NeighbourView near;
    StressedVelocities<const Vec3> before;              // u*
    NoiseAtWalls<Kernel> noise;
    bool held;
    WallDrag<Kernel> drag;
    Span<Vec3> velocity;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const StressForce stress = stressForce(k, volume, ofRest, i, x, before, near, team);
        const Vec3 taken = noise(i, x, before.velocity, near, team);
        if (!team.first()) return;
        Vec3 u = before.velocity[i] - taken - dt * stress.force;
        if (held)
        {
            SymmTensor<Vec3> matrix = dt * drag(i, stress.slope);
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
    static constexpr Holds holds = Holds::more;

    SlopeWeight<Kernel> k;
    scalar volume;
    NeighbourView near;
    WallDrag<Kernel> drag;
    Span<Vec3> diagonal, other;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        Team::Vector sum;
        if (drag.line.unresolved > 0) near.forEach(i, drag.x[i], drag.x, [&](auto, auto r) { sum += k(norm(r)) * r; }, team);
        const Vec3 slope = volume * team.sum(sum);
        if (!team.first()) return;
        const SymmTensor<Vec3> matrix = drag(i, slope);
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
    scalar volume, dt, nu, own;                         // own: 1 or 0
    Span<const Position> x;
    NeighbourView near;
    StressedVelocities<const Vec3> vector;
    Span<const Vec3> dragDiagonal, dragOther;           // empty: no walls
    Span<Vec3> product;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        Vec3 force = stressForce(k, volume, nu, i, x, vector, near, team).force;
        if (!team.first()) return;
        const Vec3 v = vector.velocity[i];
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
        noise_(coeffs, liquid, {.c = 0.2, .perCapillaryStep = 0.98}, false), atWalls_(shareOf(coeffs, "atWalls", 1)),
        noSlip_(coeffs.lookupOr("noSlip", true)),
        missing_(missingField(coeffs.lookupOr("startedLayers", true) && noSlip_, liquid)),
        slip_(liquid.units().toScaled(coeffs.lookupDimensionedOr("slipLength", dimensions::length, usualSlipLength), dimensions::length)),
        tolerance_(coeffs.lookupOr("tolerance", 1e-3)),
        maxIterations_(coeffs.lookupOr("maxIterations", 200)),
        nu_(liquid.units().toScaled(liquid.properties().viscosity, dimensions::kinematicViscosity)),
        line_(lineDrag(liquid, slip_, nu_)),
        plane_(tabulateHalfSpace(liquid.kernel())),
        weights_(weightsOf(liquid.kernel()))
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
        const scalar share = noise_.share(dt);
        if (liquid.isEmpty() || (nu_ == 0 && share == 0)) return;
        stressed_.resizeDiscarding(liquid.all());
        placesAreGiven_ = false;
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                const Step<Kernel> step{W, liquid, std::as_const(liquid.position).span(), near.view(), walls, dt};
                const scalar ofNoise = share / (2 * dt * weights_);
                const scalar ofWalls = std::max(share - 2 * dt * weights_ * nu_, scalar(0));
                const bool atOnce = 8 * dt * nu_ * weights_ <= 0.25f;
                inverse_.resizeDiscarding(atOnce ? 0 : liquid.all());
                if (atOnce || share > 0) takeOne(step, atOnce ? Viscosities{nu_, nu_ + ofNoise} : Viscosities{0, ofNoise}, ofWalls, atOnce && nu_ > 0);
                if (!atOnce) solve(step, share > 0);
            },
            liquid.kernel()
        );
        giveMemoryToOthers();
    }

private:
    // Until the next step: the pressure wants as much.
    void giveMemoryToOthers()
    {
        inverse_ = {};
        stressed_ = {};
        for (Buffer<Vec3>* vector : {&residual_, &product_, &direction_, &ofDirection_, &dragDiagonal_, &dragOther_}) *vector = {};
    }

    // What the layers at walls lack, m.
    static Buffer<scalar>* missingField(bool wanted, Liquid& liquid)
    {
        if (!wanted) return nullptr;
        return &liquid.fields().require<scalar>
        ({
            .name = "wallLayer", .dimensions = dimensions::kinematicViscosity, .written = true, .restarted = true
        });
    }

    // sum_j V k_ij as an integral.
    static scalar weightsOf(const KernelChoice& kernel)
    {
        return std::visit([](const auto& W)
        {
            return scalar(integrate(0, W.h, [&](double r) { return 4 * kernels::pi * r * r * -W.g(scalar(r)); }));
        }, kernel);
    }

    // Of a slip length shorter than the spacing.
    static ContactLineDrag lineDrag(const Liquid& liquid, scalar slip, scalar nu)
    {
        const scalar ofPlane = std::visit([](const auto& W)         // the gradient of a half-space at its plane
        {
            return scalar(integrate(0, W.h, [&](double r) { return -kernels::pi * (r * r) * W.g(scalar(r)) * r; }));
        }, liquid.kernel());
        return {nu, slip > 0 && slip < liquid.spacing() ? std::log(liquid.spacing() / slip) : 0, ofPlane};
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
            {plane_.span(), at.W.h}, line_, missing_ ? missing_->span() : Span<scalar>{}
        };
    }

    // P of the vectors, of ghosts too, which are given theirs.
    template<bool momentsAreKnown, class Kernel>
    void findStress(const Step<Kernel>& at, Buffer<Vec3>& vectors, Viscosities viscosities)
    {
        Columns read{valuesOf(vectors)};
        if (!placesAreGiven_) read.push_back(valuesOf(at.liquid.position));
        placesAreGiven_ = true;
        at.liquid.ghosts().forEachTeam(at.liquid.owned(), FindStress<SlopeWeight<Kernel>, momentsAreKnown>
        {
            {at.W}, at.liquid.particleVolume(), viscosities, at.x, std::as_const(vectors).span(), at.near, inverse_.view(), stressed_.view()
        }, read, {valuesOf(stressed_.velocity), valuesOf(stressed_.stress)});
    }

    template<class Kernel>
    void takeOne(const Step<Kernel>& at, Viscosities viscosities, scalar ofWalls, bool wallsHold)
    {
        findStress<false>(at, at.liquid.velocity, viscosities);
        forEachTeam(at.liquid.owned(), TakeOne<Kernel>
        {
            {at.W}, at.liquid.particleVolume(), at.dt, viscosities.ofRest, at.x, at.near, stressed_.seen(),
            {{at.W}, ofWalls * atWalls_, at.walls.view(at.liquid)}, wallsHold && isHeld(at.walls), drag(at), at.liquid.velocity.span()
        });
    }

    template<class Kernel>
    void solve(const Step<Kernel>& at, bool momentsAreKnown)
    {
        Liquid& liquid = at.liquid;
        Buffer<Vec3> start(liquid.all());
        copyFirst(liquid.owned(), std::as_const(liquid.velocity).span(), start);
        for (Buffer<Vec3>* vector : {&residual_, &product_, &direction_, &ofDirection_}) vector->resizeDiscarding(liquid.all());
        const int n = liquid.owned(), held = isHeld(at.walls) ? liquid.all() : 0;
        dragDiagonal_.resizeDiscarding(held);
        dragOther_.resizeDiscarding(held);
        if (held)
        {
            forEachTeam(n, StoreDrag<Kernel>
            {
                {at.W}, liquid.particleVolume(), at.near, drag(at), dragDiagonal_.span(), dragOther_.span()
            });
        }
        const auto multiply = [&](Buffer<Vec3>& vector, scalar own, Buffer<Vec3>& product)
        {
            if (momentsAreKnown) findStress<true>(at, vector, {nu_, nu_});
            else findStress<false>(at, vector, {nu_, nu_});
            momentsAreKnown = true;
            forEachTeam(n, Multiply<SlopeWeight<Kernel>>
            {
                {at.W}, liquid.particleVolume(), at.dt, nu_, own, at.x, at.near, stressed_.seen(), dragDiagonal_.span(), dragOther_.span(),
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
        forEach(n, MoveOn{at.dt, start.span(), std::as_const(liquid.velocity).span(), liquid.position.span()});
    }

    // Of all particles.
    struct OwnedStress
    {
        Buffer<Vec3> velocity, stress;

        void resizeDiscarding(int n)
        {
            velocity.resizeDiscarding(n);
            stress.resizeDiscarding(n);
        }
        StressedVelocities<Vec3> view() { return {velocity.span(), stress.span()}; }
        StressedVelocities<const Vec3> seen() { return {velocity.span(), stress.span()}; }
    };

    SmoothingControls noise_;
    scalar atWalls_;
    bool noSlip_;
    Buffer<scalar>* missing_;                           // where it is wanted
    scalar slip_;                                       // scaled
    double tolerance_;
    int maxIterations_;
    scalar nu_;
    ContactLineDrag line_;
    Buffer<HalfSpaceValues> plane_;
    scalar weights_;
    InverseMoments inverse_;
    OwnedStress stressed_;
    bool placesAreGiven_ = false;           // of ghosts, in this step
    Buffer<Vec3> residual_, product_, direction_, ofDirection_;
    Buffer<Vec3> dragDiagonal_, dragOther_;
    Buffer<ResidualSums> scratch_;
};

const ViscosityTable::Add<Newtonian> registered{"newtonian", "Newtonian liquid of viscosity nu, its free surface without stress"};

}

}
