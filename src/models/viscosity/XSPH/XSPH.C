// XSPH: velocities drift towards their neighbours' mean (Monaghan 1989; Macklin and Mueller 2013, equation (17)).
//
//     u_i += c [ sum_j V (u_j - u_i) W_ij - u_i (walls) ]
//
// A smoothing per step, not a physical viscosity: nu does not enter, and the damping of a second depends on the step.
// With noSlip the walls, at rest, take part by their kernel density.
//
//     viscosity   XSPH;
//     XSPHCoeffs  { c 0.05; noSlip yes; }

#include "models/viscosity/Viscosity.H"

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
    XSPH(const Dictionary& coeffs, Liquid&)
    :
        c_(float(coeffs.lookupOr("c", 0.05))), noSlip_(coeffs.lookupOr("noSlip", true))
    {
        if (!(c_ >= 0 && c_ <= 1)) throw FatalInputError(coeffs.where("c"), "Coefficient c is out of range", "0 to 1");
    }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, float) override
    {
        Buffer<Vec3> smoothed(liquid.all());
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                forEachTeam(liquid.owned(), Smooth<Kernel>
                {
                    W, c_, liquid.particleVolume(), liquid.position.span(), liquid.velocity.span(), near.view(), noSlip_,
                    walls.view(), smoothed.span()
                });
            },
            liquid.kernel()
        );
        liquid.velocity.swap(smoothed);
    }

private:
    float c_;
    bool noSlip_;
};

const ViscosityTable::Add<XSPH> registered{"XSPH"};

}

}
