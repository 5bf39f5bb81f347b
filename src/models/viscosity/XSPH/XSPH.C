// XSPH: velocities drift towards their neighbours' mean (Monaghan 1989; Macklin and Mueller 2013, equation (17)).
//
//     u_i += c [ sum_j V (u_j - u_i) W_ij - u_i (walls) ]
//
// Not a physical viscosity: nu does not enter. c is the share of a step; with it alone the damping of a second depends on the step.
// perCapillaryStep, p, is the share of the time t_c = sqrt(rho d^3/(2 pi sigma)): a step dt takes 1 - (1 - p)^(dt/t_c) where that is
// more than c. Liquid in long steps is damped as much as in shorter ones, and the noise of short ones by c. It needs a sigma.
// With noSlip the walls, at rest, take part by their kernel density.
//
//     viscosity   XSPH;
//     XSPHCoeffs  { c 0.05; perCapillaryStep 0; noSlip yes; }

#include "models/viscosity/Viscosity.H"
#include "models/viscosity/XSPH/SmoothingShare.H"

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
        c_(shareOf(coeffs, "c", 0.05)), perCapillaryStep_(shareOf(coeffs, "perCapillaryStep", 0)),
        noSlip_(coeffs.lookupOr("noSlip", true)),
        capillaryStep_(liquid.units().toScaled(liquid.properties().capillaryStep(), dimensions::time))
    {
        if (perCapillaryStep_ > 0 && liquid.properties().surfaceTension == 0)
        {
            throw FatalInputError
            (
                coeffs.where("perCapillaryStep"), "There is no capillary step without a surface tension",
                "perCapillaryStep 0, or a sigma in constant/liquidProperties"
            );
        }
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
    static float shareOf(const Dictionary& coeffs, const std::string& entry, double fallback)
    {
        const double share = coeffs.lookupOr(entry, fallback);
        if (share >= 0 && share <= 1) return float(share);
        throw FatalInputError(coeffs.where(entry), "Coefficient " + entry + " is out of range", "0 to 1");
    }

    float share(float dt) const { return float(smoothingShare(c_, perCapillaryStep_, dt / capillaryStep_)); }

    float c_, perCapillaryStep_;
    bool noSlip_;
    float capillaryStep_;
};

const ViscosityTable::Add<XSPH> registered{"XSPH"};

}

}
