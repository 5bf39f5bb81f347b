// SPDX-License-Identifier: GPL-3.0-or-later
// Double density relaxation: Clavet, Beaudoin and Poulin 2005, Particle-based viscoelastic fluid simulation, section 4.
//
//     rho_i  = sum_j (1 - r/h)^2,      rho'_i = sum_j (1 - r/h)^3                       j another particle
//     P_i    = k (rho_i - rhoR),       P'_i = k' rho'_i
//     D_ij   = dt^2 (P_i (1 - r/h) + P'_i (1 - r/h)^2) r_ij/r        half of it for i, half back for j
//
// A pressure model: rest density and incompressibility come from P. Tension comes along: at the surface P is negative and
// pulls, while P' keeps particles apart. No theory leads from sigma to k and k', so sigma is not used and no contact angle can
// be given: it goes with surfaceTension none and wetting none. The paper moves one pair after the other; here all pairs move at once,
// each by what both its particles ask for.
//
// k' is `near` times k, as a rule 2.5 as in the paper. The cubic lattice of the case's spacing fixes the rest: rhoR is such that
// its virial pressure p = rho0/6 sum_j r (P (1 - r/h) + P' (1 - r/h)^2) vanishes, k such that dp/drho = c^2 (shared/SoundSpeed.H).
// A solid particle stands for V_k/V of a particle that stays and has the liquid particle's own P. Sampled walls only.
//
//     pressure    Clavet2005;             // in constant/models
//     pressure    { maxDensityVariation 0.01; maxSpeed 1; near 2.5; }       // in system/solution

#include "maths/Lattice.H"
#include "models/pressure/Pressure.H"
#include "models/pressure/shared/IterationControls.H"
#include "models/pressure/shared/SoundSpeed.H"
#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

HOST_DEVICE inline scalar square(scalar x) { return x * x; }
HOST_DEVICE inline scalar cube(scalar x) { return x * x * x; }

struct Relaxation
{
    scalar h, restSum;                  // rhoR
    scalar k, kNear;                    // acceleration
};

struct Pressures
{
    Relaxation of;
    scalar perVolume;                   // 1/V
    Span<const Position> x;
    NeighbourView near;
    WallParticlesView solid;
    Span<scalar> pressure, nearPressure;

    HOST_DEVICE void operator()(int i) const
    {
        const Position xi = x[i];
        scalar sum = 0, nearSum = 0;
        const auto add = [&](scalar r, scalar weight)
        {
            const scalar open = fmax(1 - r / of.h, 0);
            sum += weight * square(open);
            nearSum += weight * cube(open);
        };
        near.forEach(i, [&](int j) { add(norm(xi - x[j]), 1); });
        solid.near.forEach(i, [&](int k) { add(norm(xi - solid.position[k]), solid.volume[k] * perVolume); });
        pressure[i] = of.k * (sum - of.restSum);
        nearPressure[i] = of.kNear * nearSum;
    }
};

struct Relax
{
    scalar h, half, perVolume;          // half: dt^2/2
    Span<const Position> x;
    NeighbourView near;
    WallParticlesView solid;
    Span<const scalar> pressure, nearPressure;
    Span<Position> corrected;

    HOST_DEVICE void operator()(int i) const
    {
        const Position xi = x[i];
        const scalar own = pressure[i], ownNear = nearPressure[i];
        Vec3 sum;
        const auto push = [&](Vec3 r, scalar P, scalar nearP)
        {
            const scalar distance = norm(r), open = fmax(1 - distance / h, 0);
            if (distance > 0) sum += open * (P + nearP * open) / distance * r;
        };
        near.forEach(i, [&](int j) { push(xi - x[j], own + pressure[j], ownNear + nearPressure[j]); });
        solid.near.forEach(i, [&](int k)
        {
            const scalar share = solid.volume[k] * perVolume;
            push(xi - solid.position[k], share * own, share * ownNear);
        });
        corrected[i] = xi + half * sum;
    }
};

// Of the lattice of spacing d, d^3 times the sum of f(r) over its other points.
template<class F>
double around(double d, double h, const F& f)
{
    return latticeSum(scalar(d), scalar(h), [&](scalar r) { return r > 0 && r < h ? f(r) : 0; });
}

Relaxation readRelaxation(const Dictionary& dict, const Liquid& liquid, double c)
{
    const double near = dict.lookupOr("near", 2.5);
    refuseIf(!(near > 0), dict, "near", "more than 0");
    const double d = liquid.spacing(), h = liquid.support();
    const auto sums = [&](double spacing, double power, bool arm)
    {
        return around(spacing, h, [&](scalar r) { return std::pow(1 - r / h, power) * (arm ? r : 1); }) / std::pow(spacing, 3);
    };
    Relaxation relaxation{scalar(h), 0, 1, scalar(near)};
    const double rest = sums(d, 2, false) + near * sums(d, 3, false) * sums(d, 2, true) / sums(d, 1, true);
    relaxation.restSum = scalar(rest);
    // Virial pressure over rho0 for k = 1 at the density ratio D.
    const auto pressure = [&](double D)
    {
        const double spacing = d / std::cbrt(D), P = sums(spacing, 2, false) - rest, nearP = near * sums(spacing, 3, false);
        return D / 6 * (P * sums(spacing, 1, true) + nearP * sums(spacing, 2, true));
    };
    constexpr double step = 0.01;
    const double square = (pressure(1 + step) - pressure(1 - step)) / (2 * step);
    relaxation.k = scalar(c * c / square);
    relaxation.kNear = scalar(near * c * c / square);
    return relaxation;
}

class Clavet2005 : public Pressure
{
public:
    Clavet2005(const Dictionary& dict, Liquid& liquid, const Walls& walls, FreeSurface&)
    :
        sound_(SoundSpeed::read(dict, liquid)),
        relaxation_(readRelaxation(dict, liquid, liquid.units().toScaled(sound_.value, dimensions::velocity)))
    {
        if (walls.surfaces() > 0)
        {
            throw FatalInputError
            (
                dict.where(), "The pressure model Clavet2005 acts between particles, and this case has analytic walls",
                "walls of type particles, or another pressure model"
            );
        }
    }

    void begin(scalar dt) override
    {
        dt_ = dt;
        made_ = 0;
    }

    bool converged(Liquid& liquid, const Neighbourhood& near, const Walls& walls) override
    {
        if (made_ > 0 || liquid.isEmpty()) return true;
        pressure_.resizeDiscarding(liquid.all());
        nearPressure_.resizeDiscarding(liquid.all());
        NeighbourLoop(liquid).forEach(Pressures
        {
            relaxation_, 1 / liquid.particleVolume(), liquid.predicted.span(), near.view(), walls.view(liquid).particles,
            pressure_.span(), nearPressure_.span()
        });
        return false;
    }

    void correct(Liquid& liquid, const Neighbourhood& near, const Walls& walls) override
    {
        ++made_;
        corrected_.resizeDiscarding(liquid.all());
        NeighbourLoop(liquid, {valuesOf(pressure_), valuesOf(nearPressure_)}, {placesOf(liquid.predicted)}).forEach(Relax
        {
            relaxation_.h, 0.5f * dt_ * dt_, 1 / liquid.particleVolume(), liquid.predicted.span(), near.view(),
            walls.view(liquid).particles, pressure_.span(), nearPressure_.span(), corrected_.span()
        });
        liquid.predicted.swap(corrected_);
    }

    std::optional<Columns> readsOfNeighbours(Liquid& liquid) const override { return Columns{placesOf(liquid.predicted)}; }
    double stepLimit(const LiquidProperties&) const override { return sound_.stepLimit; }
    double mostCrowded() const override { return 1; }           // from 0.95 spacings drops come to rest
    int iterations() const override { return made_; }

private:
    SoundSpeed sound_;
    Relaxation relaxation_;
    scalar dt_ = 0;
    int made_ = 0;
    Buffer<scalar> pressure_, nearPressure_;
    Buffer<Position> corrected_;
};

const PressureTable::Add<Clavet2005> registered{"Clavet2005", "double density relaxation (Clavet, Beaudoin and Poulin 2005)"};

}

}
