// XSPH: velocities drift towards their neighbours' mean (Monaghan 1989; Macklin and Mueller 2013, equation (17)).
//
//     u_i += c [ sum_j V (u_j - u_i) W_ij - u_i (walls) ]
//
// Not a physical viscosity: nu does not enter. `per step`: c is the share of a step, as the papers have it, and the damping of a
// second depends on the step. `per capillaryStep`: c is the share of the time t_c = sqrt(rho d^3/(2 pi sigma)), of a step dt
// 1 - (1 - c)^(dt/t_c), and liquid in shorter or longer steps is damped alike. It needs a sigma.
// With noSlip the walls, at rest, take part by their kernel density.
//
//     viscosity   XSPH;
//     XSPHCoeffs  { c 0.05; per step; noSlip yes; }

#include "models/viscosity/Viscosity.H"

#include <cmath>

namespace shizuku
{

namespace
{

template<class Kernel>
struct Smooth
{
    Kernel W;
    float c, volume;
    Span<const Vec3> x, velocity;
    NeighbourView near;
    bool noSlip;
    WallView walls;
    Span<Vec3> smoothed;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const Vec3 xi = x[i], ui = velocity[i];
        Team::Vector sum;
        near.forEach(i, xi, x, [&](auto j, auto r) { sum += W.W(norm(r)) * (velocity[j] - ui); }, team);
        Vec3 change = volume * team.sum(sum);
        if (!team.first()) return;
        if (noSlip) change -= walls.density(i, xi, W) * ui;
        smoothed[i] = ui + c * change;
    }
};

class XSPH : public Viscosity
{
public:
    XSPH(const Dictionary& coeffs, Liquid& liquid)
    :
        c_(float(coeffs.lookupOr("c", 0.05))), noSlip_(coeffs.lookupOr("noSlip", true)), time_(timeOfShare(coeffs, liquid))
    {
        if (!(c_ >= 0 && c_ <= 1)) throw FatalInputError(coeffs.where("c"), "Coefficient c is out of range", "0 to 1");
    }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, float dt) override
    {
        Buffer<Vec3> smoothed(liquid.all());
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                forEachTeam(liquid.owned(), Smooth<Kernel>
                {
                    W, share(dt), liquid.particleVolume(), liquid.position.span(), liquid.velocity.span(), near.view(), noSlip_,
                    walls.view(), smoothed.span()
                });
            },
            liquid.kernel()
        );
        liquid.velocity.swap(smoothed);
    }

private:
    // The time that c is the share of, scaled; 0: each step, whatever its length.
    static float timeOfShare(const Dictionary& coeffs, const Liquid& liquid)
    {
        if (coeffs.lookupChoiceOr("per", {"step", "capillaryStep"}, "step") == "step") return 0;
        if (liquid.properties().surfaceTension > 0)
        {
            return liquid.units().toScaled(liquid.properties().capillaryStep(), dimensions::time);
        }
        throw FatalInputError
        (
            coeffs.where("per"), "There is no capillary step without a surface tension", "per step, or a sigma in constant/liquidProperties"
        );
    }

    float share(float dt) const { return time_ > 0 ? 1 - std::pow(1 - c_, dt / time_) : c_; }

    float c_;
    bool noSlip_;
    float time_;
};

const ViscosityTable::Add<XSPH> registered{"XSPH"};

}

}
