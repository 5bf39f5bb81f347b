// SPDX-License-Identifier: GPL-3.0-or-later
// Predictive-corrective incompressible SPH: Solenthaler and Pajarola 2009.
//
//     p_i += delta (rho*_i - rho0),   rho*_i at the predicted positions                (9), in every iteration, from p = 0
//     delta = 1/( beta [ sum grad W . sum grad W + sum (grad W . grad W) ] ),  beta = 2 (dt m/rho0)^2       (8)
//     F_i   = -m^2 sum_j (p_i + p_j)/rho0^2 grad W_ij                                  gradients at the step's beginning
//
// The sums of delta are those of the cubic lattice, whose first is zero: the paper's prototype particle with a full
// neighbourhood. An iteration moves the predicted positions by what the change of p adds to F, which is the paper's
// prediction from the start, F being linear in p. p >= 0. Walls push with the particle's own pressure (Akinci et al. 2012).
// The tolerance is of the average compression, as in all models here; the paper bounds the largest.
//
//     pressure    PCISPH;                 // in constant/models
//     pressure    { minIterations 3; maxIterations 50; tolerance 1e-3; }          // in system/solution

#include "models/density/Density.H"
#include "models/pressure/Pressure.H"
#include "models/pressure/shared/AddPressure.H"
#include "models/pressure/shared/AverageCompression.H"
#include "models/pressure/shared/PressureControls.H"
#include "models/pressure/shared/PressureField.H"
#include "models/pressure/shared/PushApart.H"
#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

struct RaiseByDensity
{
    scalar delta;                       // times rho0
    scalar perPressure;                 // dt^2/rho0
    Span<const scalar> density, pressure;
    Span<scalar> increase;

    HOST_DEVICE void operator()(int i) const
    {
        const scalar before = pressure[i];
        increase[i] = (fmax(before + delta * (density[i] - 1), 0) - before) * perPressure;
    }
};

class PCISPH : public Pressure
{
public:
    PCISPH(const Dictionary& dict, Liquid& liquid, const Walls&, FreeSurface&)
    :
        controls_(IterationControls::read(dict, {3, 50, 1e-3})),
        squares_(bulkSquares(liquid)),
        pressure_(freshPressure(liquid))
    {}

    void begin(scalar dt) override
    {
        iterations_ = 0;
        dt_ = dt;
        pressure_.setZero();
    }

    bool converged(Liquid& liquid, const Neighbourhood& near, const Walls& walls) override
    {
        if (iterations_ >= controls_.maxIterations || liquid.isEmpty()) return true;
        const scalar perPressure = dt_ * dt_ / liquid.restDensity();
        increase_.resizeDiscarding(liquid.all());
        computeDensity(liquid, near, walls);
        forEach(liquid.owned(), RaiseByDensity
        {
            1 / (2 * perPressure * squares_), perPressure, liquid.density.span(), pressure_.span(), increase_.span()
        });
        return !compression_.wantsAnother(liquid, controls_, iterations_);
    }

    void correct(Liquid& liquid, const Neighbourhood& near, const Walls& walls) override
    {
        ++iterations_;
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                NeighbourLoop(liquid, {valuesOf(increase_)}, {valuesOf(liquid.position)}).forEach(PushApart<Kernel, SumOfBoth>
                {
                    W, liquid.particleVolume(), {increase_.span()}, liquid.position.span(), near.view(), walls.view(liquid),
                    liquid.predicted.span()
                });
            },
            liquid.kernel()
        );
        forEach(liquid.owned(), AddPressure{liquid.restDensity() / (dt_ * dt_), increase_.span(), pressure_.span()});
    }

    std::optional<Columns> readsOfNeighbours(Liquid& liquid) const override
    {
        if (iterations_ > 0) return Columns{placesOf(liquid.predicted)};
        return Columns{placesOf(liquid.predicted), valuesOf(liquid.position)};
    }
    int iterations() const override { return iterations_; }
    double mostCompression() const override { return mostTakenOutAtOnce; }
    const Buffer<scalar>* keepPressure() override { return &pressure_; }

private:
    IterationControls controls_;
    scalar squares_;                    // sum of |V grad W|^2 over the lattice
    scalar dt_ = 0;
    int iterations_ = 0;
    Buffer<scalar>& pressure_;
    Buffer<scalar> increase_;           // of p, times dt^2/rho0
    AverageCompression compression_;
};

const PressureTable::Add<PCISPH> registered{"PCISPH", "predictive-corrective incompressible SPH (Solenthaler and Pajarola 2009)"};

}

}
