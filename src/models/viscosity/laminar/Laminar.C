// SPDX-License-Identifier: GPL-3.0-or-later
// Newtonian viscosity nu of constant/liquidProperties: the Laplacian of Morris, Fox and Zhu 1997.
//
//     du_i/dt = sum_j 2 nu V (x_ij . grad W_ij)/(r^2 + 0.01 h^2) (u_i - u_j)
//
// With noSlip the share of walls is summed too, with their velocities for u_j: of sampled ones by the same sum, 0.01 h^2 included, of analytic ones by the
// half-space's integral of 2 W'(r)/r (HalfSpace.H), without it. Explicit, so the
// step is limited to 0.125 d^2/nu.
//
//     viscosity      laminar;
//     laminarCoeffs  { noSlip yes; }

#include "models/viscosity/Viscosity.H"
#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

template<class Kernel>
struct Diffuse
{
    Kernel W;
    scalar nuDt, volume;
    bool noSlip;
    Span<const Position> x;
    Span<const Vec3> velocity;
    NeighbourView near;
    WallView walls;
    Span<Vec3> diffused;

    HOST_DEVICE scalar weight(scalar r) const { return 2 * r * r * W.g(r) / (r * r + 0.01f * W.h * W.h); }

    HOST_DEVICE void operator()(int i) const
    {
        const Position xi = x[i];
        const Vec3 ui = velocity[i];
        Vec3 sum;
        near.forEach(i, [&](int j) { sum += volume * weight(norm(xi - x[j])) * (ui - velocity[j]); });
        if (noSlip)
        {
            walls.particles.near.forEach(i, [&](int k)
            {
                sum += walls.particles.volume[k] * weight(norm(xi - walls.particles.position[k])) * (ui - walls.motion.ofParticle(k));
            });
            walls.forEachSurface(i, xi, [&](const WallSurface& surface, const WallSurface::Nearest&, const HalfSpaceValues& values)
            {
                sum -= values.drag * (ui - walls.velocity(surface, i, xi));
            });
        }
        diffused[i] = ui + nuDt * sum;
    }
};

class Laminar : public Viscosity
{
public:
    Laminar(const Dictionary& coeffs, Liquid& liquid)
    :
        noSlip_(coeffs.lookupOr("noSlip", true)),
        nu_(liquid.units().toScaled(liquid.properties().viscosity, dimensions::kinematicViscosity))
    {}

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt) override
    {
        diffused_.resizeDiscarding(liquid.all());
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                NeighbourLoop(liquid).forEach(Diffuse<Kernel>
                {
                    W, nu_ * dt, liquid.particleVolume(), noSlip_, liquid.position.span(), liquid.velocity.span(),
                    near.view(), walls.view(liquid), diffused_.span()
                });
            },
            liquid.kernel()
        );
        liquid.velocity.swap(diffused_);
    }

    std::optional<Columns> readsOfNeighbours(Liquid& liquid) const override { return Columns{valuesOf(liquid.position), valuesOf(liquid.velocity)}; }
    double stepLimit(const LiquidProperties& p) const override { return 0.125 * p.spacing * p.spacing / p.viscosity; }

private:
    bool noSlip_;
    scalar nu_;
    Buffer<Vec3> diffused_;
};

const ViscosityTable::Add<Laminar> registered{"laminar", "Laplacian of Morris, Fox and Zhu 1997, with nu of constant/liquidProperties"};

}

}
