// The contact angle steers the pair force of solids: Fujisawa et al. 2014, equations (20), (21), (30).
//
//     gamma_LS = gamma (1 + cos theta)/2
//     a_ik = -K_ik [ gamma_LS rho0 V_k C(r) r_ik/r + gamma_LS rho_A (n_i - n_k) ],   K_ik = 2 rho0/(rho_i + rho0)
//
// The paper leaves n_k open. `solidNormal` chooses: `wall`, the wall's unit normal into the liquid, or `zero`.
// Analytic walls: cohesion with the half-space (HalfSpace.H), the area term with the layer of particles that a sampled
// wall would have, pi (h^2 - (s + d/2)^2)/d^2 of them, half a spacing inside the surface.
//
//     wetting             contactAngle;
//     contactAngleCoeffs  { solidNormal wall; }

#include "models/surfaceTension/pairTension/CohesionSpline.H"
#include "models/wetting/Wetting.H"

namespace shizuku
{

namespace
{

struct WallPairForce
{
    CohesionSpline C;
    PairCoefficients gamma;
    float restDensity, spacing;
    float solidNormal;                  // 1: n_k is the wall's normal, 0: n_k = 0
    Span<const Vec3> x, normal;
    Span<const float> density;
    WallView walls;
    Span<Vec3> acceleration;

    HOST_DEVICE void operator()(int i) const
    {
        const Vec3 xi = x[i], ni = normal[i];
        const auto& solid = walls.particles;
        Vec3 sum;
        solid.near.forEach(i, [&](int k)
        {
            const Vec3 r = xi - solid.position[k];
            const float distance = norm(r), share = 0.5f * (1 + solid.cosTheta[k]);
            if (distance > 0)
            {
                sum -= share * gamma.cohesion * restDensity * solid.volume[k] * C(distance) / distance * r;
            }
            sum -= share * gamma.area * (ni - solidNormal * solid.normal[k]);
        });
        walls.surfaces.forEach(xi, [&](const WallSurface& surface, const WallSurface::Place& place, const HalfSpaceValues& values)
        {
            const float share = 0.5f * (1 + surface.cosTheta);
            const float depth = place.distance + 0.5f * spacing;
            const float layer = kernels::pi * fmaxf(C.h * C.h - depth * depth, 0) / (spacing * spacing);
            sum -= share * gamma.cohesion * restDensity * values.cohesion * place.normal;
            sum -= share * gamma.area * layer * (ni - solidNormal * place.normal);
        });
        acceleration[i] += 2 / (density[i] + 1) * sum;
    }
};

class ContactAngle : public Wetting
{
public:
    ContactAngle(const Dictionary& coeffs, Liquid& liquid, Walls& walls, const SurfaceTension& tension)
    :
        gamma_(requirePairCoefficients(tension, coeffs)),
        solidNormal_(coeffs.lookupChoiceOr("solidNormal", {"wall", "zero"}, "wall") == "wall"),
        normal_(liquid.fields().require<Vec3>({.name = "normal", .dimensions = dimensions::none, .sorted = false}))
    {
        walls.requireContactAngles();
    }

    bool active() const override { return true; }

    void apply(Liquid& liquid, const Walls& walls, Buffer<Vec3>& acceleration) override
    {
        if (walls.particles() + walls.surfaces() == 0) return;
        forEach(liquid.owned(), WallPairForce
        {
            {liquid.support()}, gamma_, liquid.restDensity(), liquid.spacing(), solidNormal_ ? 1.0f : 0.0f,
            liquid.predicted.span(), normal_.span(), liquid.density.span(), walls.view(), acceleration.span()
        });
    }

private:
    PairCoefficients gamma_;
    bool solidNormal_;
    Buffer<Vec3>& normal_;
};

const WettingTable::Add<ContactAngle> registered{"contactAngle"};

}

}
