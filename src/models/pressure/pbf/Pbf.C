// SPDX-License-Identifier: GPL-3.0-or-later
// Position based fluids: Macklin and Mueller 2013 with solid particles as in Fujisawa et al. 2014.
//
//     C_i  = rho_i/rho0 - 1                                                                          (4)
//     s_i  = C_i / (sum_j |V grad W_ij|^2 + sum_k |V_k grad W_ik|^2 [+ |sum|^2] + epsilon)            (10), (11)
//     dp_i = -w [ sum_j V (s_i + s_j) grad W_ij + sum_k V_k s_i grad W_ik ],   V = m/rho0            (6)
//
// An analytic wall stands in the sums as one particle with the half-space's gradient. Choices where the paper is
// silent, measured in doc/notebook/theory/pbf.md:
//
//     pressure
//     {
//         ...                         // shared/PressureControls.H
//         selfGradient    yes;        // |sum_j V grad W_ij + sum_k V_k grad W_ik|^2, the derivative by p_i itself
//         unilateral      yes;        // C < 0 counts as 0: pressure pushes, never pulls
//     }

#include "models/density/ConstraintSums.H"
#include "models/density/Density.H"
#include "models/pressure/Pressure.H"
#include "models/pressure/shared/AddPressure.H"
#include "models/pressure/shared/AverageCompression.H"
#include "models/pressure/shared/PressureControls.H"
#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

template<class Kernel>
struct Multiplier
{
    Kernel W;
    scalar volume, densityVolume;       // V, V/S
    scalar epsilon;
    bool selfGradient, unilateral;
    Span<const Position> x;
    NeighbourView near;
    WallView walls;
    Span<scalar> density, multiplier;

    HOST_DEVICE void operator()(int i) const
    {
        const Position xi = x[i];
        ConstraintSums sums = constraintSums(W, volume, i, x, near);
        const auto wall = walls.ofSurfaces(i, xi);
        scalar solid = wall.value;
        sums.squares += squared(wall.gradient);
        sums.gradient += wall.gradient;
        walls.particles.near.forEach(i, [&](int k)
        {
            const Vec3 r = xi - walls.particles.position[k];
            const scalar distance = norm(r);
            solid += walls.particles.volume[k] * W.W(distance);
            const Vec3 gradient = walls.particles.volume[k] * W.g(distance) * r;
            sums.squares += squared(gradient);
            sums.gradient += gradient;
        });
        density[i] = densityVolume * sums.W + solid;
        scalar C = density[i] - 1;
        if (unilateral) C = fmax(C, 0);
        multiplier[i] = C / (sums.squares + (selfGradient ? squared(sums.gradient) : 0) + epsilon);
    }
};

template<class Kernel>
struct Correction
{
    Kernel W;
    scalar volume, relaxation;
    Span<const Position> x;
    NeighbourView near;
    WallView walls;
    Span<const scalar> multiplier;
    Span<Position> corrected;

    HOST_DEVICE void operator()(int i) const
    {
        const Position xi = x[i];
        const scalar si = multiplier[i];
        Vec3 step = si * walls.ofSurfaces(i, xi).gradient;
        near.forEach(i, [&](int j)
        {
            const Vec3 r = xi - x[j];
            step += volume * (si + multiplier[j]) * W.g(norm(r)) * r;
        });
        walls.particles.near.forEach(i, [&](int k)
        {
            const Vec3 r = xi - walls.particles.position[k];
            step += walls.particles.volume[k] * si * W.g(norm(r)) * r;
        });
        corrected[i] = xi - relaxation * step;
    }
};

class Pbf : public Pressure
{
public:
    Pbf(const Dictionary& dict, Liquid& liquid, const Walls&, FreeSurface&)
    :
        controls_(PressureControls::read(dict, liquid, usualOfPbf)),
        selfGradient_(dict.lookupOr("selfGradient", true)),
        unilateral_(dict.lookupOr("unilateral", true)),
        fields_(liquid.fields()),
        multiplier_(liquid.fields().require<scalar>({.name = "multiplier", .dimensions = dimensions::none, .sorted = false}))
    {}

    void begin(scalar dt) override
    {
        iterations_ = 0;
        dt_ = dt;
    }

    bool converged(Liquid& liquid, const Neighbourhood& near, const Walls& walls) override
    {
        if (iterations_ >= controls_.maxIterations || liquid.isEmpty()) return true;
        if (pressure_ && iterations_ == 0) pressure_->setZero();
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                const scalar V = liquid.particleVolume();
                NeighbourLoop(liquid).forEach(Multiplier<Kernel>
                {
                    W, V, V / liquid.latticeSum(), controls_.epsilon, selfGradient_, unilateral_,
                    liquid.predicted.span(), near.view(), walls.view(liquid), liquid.density.span(), multiplier_.span()
                });
            },
            liquid.kernel()
        );
        return !compression_.wantsAnother(liquid, controls_, iterations_);
    }

    void correct(Liquid& liquid, const Neighbourhood& near, const Walls& walls) override
    {
        ++iterations_;
        corrected_.resizeDiscarding(liquid.all());
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                NeighbourLoop(liquid, {valuesOf(multiplier_)}, {placesOf(liquid.predicted)}).forEach(Correction<Kernel>
                {
                    W, liquid.particleVolume(), controls_.relaxation, liquid.predicted.span(), near.view(), walls.view(liquid),
                    multiplier_.span(), corrected_.span()
                });
            },
            liquid.kernel()
        );
        liquid.predicted.swap(corrected_);
        if (pressure_)
        {
            const scalar factor = controls_.relaxation * liquid.restDensity() / (dt_ * dt_);
            forEach(liquid.owned(), AddPressure{factor, multiplier_.span(), pressure_->span()});
        }
    }

    std::optional<Columns> readsOfNeighbours(Liquid& liquid) const override { return Columns{placesOf(liquid.predicted)}; }
    int iterations() const override { return iterations_; }
    double mostCrowded() const override { return 1; }           // from 0.95 spacings drops come to rest

    // p_i = w rho0/dt^2 times the sum of s_i over the iterations: what (6) moves a particle by is the SPH gradient of
    // dt^2 p/rho0.
    const Buffer<scalar>* keepPressure() override
    {
        pressure_ = &fields_.require<scalar>({.name = "p", .dimensions = dimensions::pressure});
        return pressure_;
    }

private:
    PressureControls controls_;
    bool selfGradient_, unilateral_;
    int iterations_ = 0;
    FieldRegistry& fields_;
    Buffer<scalar>& multiplier_;
    scalar dt_ = 0;
    Buffer<scalar>* pressure_ = nullptr;        // where somebody asks for it
    Buffer<Position> corrected_;
    AverageCompression compression_;
};

const PressureTable::Add<Pbf> registered{"pbf", "position based fluids (Macklin and Mueller 2013)"};

}

}
