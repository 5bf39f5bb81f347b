// SPDX-License-Identifier: GPL-3.0-or-later
// The contact angle steers the pair force of solids: Fujisawa et al. 2014, equations (20), (21), (30).
//
//     gamma_LS = gamma (1 + cos theta)/2
//     a_ik = -K_ik [ gamma_LS rho0 V_k C(r) r_ik/r + gamma_LS rho_A (n_i - n_k) ],   K_ik = 2 rho0/(rho_i + rho0)
//
// The paper leaves n_k open. `solidNormal` chooses: `SPH`, the liquid's normal (22) at the solid particle; `wall`, the wall's
// unit normal into the liquid, which saves that sum; or `zero`.
// Analytic walls: cohesion with the half-space (HalfSpace.H), the area term with the layer of particles that a sampled
// wall would have, pi (h^2 - (s + d/2)^2)/d^2 of them, half a spacing inside the surface.
//
//     wetting             contactAngle;
//     contactAngleCoeffs  { solidNormal SPH; }

#include "maths/CohesionSpline.H"
#include "models/wetting/Wetting.H"
#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

// n_k at a place on a wall.
template<class Kernel>
struct SolidNormal
{
    enum Choice { zero, wall, sph };

    Choice choice;
    Kernel W;
    scalar volume;
    CellGridView grid;
    Span<const Position> x, start;          // start: with the block, in the place of which iterations of the pressure may have put a number
    Span<const scalar> density;

    HOST_DEVICE Vec3 operator()(Position place, Vec3 wallNormal) const
    {
        if (choice == wall) return wallNormal;
        Vec3 sum;
        if (choice == zero) return sum;
        grid.forEachCandidate(AroundPoint{place, W.h}, [&](int j)
        {
            if (grid.looksAtImages() && !isSameImage(place, withBlock(start[j], x[j]))) return;
            const Vec3 r = place - x[j];
            sum += volume / density[j] * W.g(norm(r)) * r;
        });
        return W.h * sum;
    }
};

template<class Kernel>
struct WallPairForce
{
    CohesionSpline C;
    PairCoefficients gamma;
    scalar restDensity, spacing;
    SolidNormal<Kernel> solidNormal;
    Span<const Position> x;
    Span<const Vec3> normal;
    Span<const scalar> density;
    WallView walls;
    Span<Vec3> acceleration;

    HOST_DEVICE void operator()(int i) const
    {
        const Position xi = x[i];
        const Vec3 ni = normal[i];
        const auto& solid = walls.particles;
        Vec3 sum;
        solid.near.forEach(i, [&](int k)
        {
            const Vec3 r = xi - solid.position[k];
            const scalar distance = norm(r), share = 0.5f * (1 + solid.cosTheta[k]);
            if (distance > 0)
            {
                sum -= share * gamma.cohesion * restDensity * solid.volume[k] * C(distance) / distance * r;
            }
            sum -= share * gamma.area * (ni - solidNormal(solid.position[k], solid.normal[k]));
        });
        walls.forEachSurface(i, xi, [&](const WallSurface& surface, const WallSurface::Nearest& nearest, const HalfSpaceValues& values)
        {
            const scalar share = 0.5f * (1 + surface.cosTheta);
            const scalar depth = nearest.distance + 0.5f * spacing;
            const scalar layer = kernels::pi * fmax(C.h * C.h - depth * depth, 0) / (spacing * spacing);
            sum -= share * gamma.cohesion * restDensity * values.cohesion * nearest.normal;
            sum -= share * gamma.area * layer * (ni - solidNormal(withBlock(xi, xi - depth * nearest.normal), nearest.normal));
        });
        acceleration[i] += 2 / (density[i] + 1) * sum;
    }
};

class ContactAngle : public Wetting
{
public:
    ContactAngle(const Dictionary& coeffs, Liquid& liquid, const Walls&, const SurfaceTension& tension)
    :
        gamma_(requirePairCoefficients(tension, coeffs)),
        solidNormal_(coeffs.lookupChoiceOr("solidNormal", {"SPH", "wall", "zero"}, "SPH")),
        made_(*tension.pairFields()),
        reach_(solidNormal_ == "SPH" ? 2 * liquid.support() + liquid.spacing() : 0)
    {}

    bool active() const override { return true; }

    std::optional<Columns> readsOfNeighbours(Liquid& liquid) const override
    {
        return reach_ > 0 ? Columns{valuesOf(made_.density), valuesOf(liquid.position)} : Columns{};
    }

    // Normals of solid particles are sums over liquid within the support of those that are within it, or half a spacing farther, as lists and walls without particles have them.
    scalar reach() const override { return reach_; }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, Buffer<Vec3>& acceleration) override
    {
        if (walls.particles() + walls.surfaces() == 0) return;
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                using Normal = SolidNormal<Kernel>;
                const auto choice = solidNormal_ == "wall" ? Normal::wall : solidNormal_ == "SPH" ? Normal::sph : Normal::zero;
                NeighbourLoop(liquid, {}, {placesOf(liquid.predicted)}).forEach(WallPairForce<Kernel>
                {
                    {liquid.support()}, gamma_, liquid.restDensity(), liquid.spacing(),
                    {
                        choice, W, liquid.particleVolume(), near.grid().view(), liquid.predicted.span(),
                        liquid.position.span(), made_.density.span()
                    },
                    liquid.predicted.span(), made_.normal.span(), made_.density.span(), walls.view(liquid), acceleration.span()
                }, GhostsOf::all);
            },
            liquid.kernel()
        );
    }

private:
    PairCoefficients gamma_;
    std::string solidNormal_;
    PairFields made_;                       // by the tension
    scalar reach_;
};

const WettingTable::Add<ContactAngle> registered{"contactAngle", "the contact angle steers the pair force of solids (Fujisawa, Imai and Mikawa 2014)"};

}

}
