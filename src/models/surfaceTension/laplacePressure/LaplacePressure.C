// SPDX-License-Identifier: GPL-3.0-or-later
// Tension as what it is to the liquid: Laplace's pressure sigma kappa on its free surface, which the half-space that is missing there
// transmits as the density's kernel would.
//
//     a_i     = sigma/rho0 2 kappa g_i R_i G_i/|G_i|,       g_i = |Psi'(s_i)|
//     R_i     = 1 + sign(kappa) sum_j v_ij [o (D_j.G_j/|G_j| - g_j) - S_j.G_j/|G_j|] / sum_j v_ij g_j
//               from 1.03 to 1.3, from 0.7 to 0.97 where kappa < 0; next to walls a mean over time (DisorderMemory.H)
//     v_ij    = W_ij (1 - |s_i - s_j|/(5.5 d))
//     D_j     = sum_l V grad W^rho_jl + grad w              of the density's kernel W^rho, w: the wall's wedge
//     S_j     = 1/2 sum_l V (T_j + T_l) grad W^rho_jl,      T = t (n n - 1/3), t = 3/2 n.(r q D) n, n = G/|G|
//     kappa   : surfaceCurvature/RegressedCurvature.H, steadied where the surface is hollow by the mean over j
//
// Psi: the integral of the density's kernel beyond a plane at depth s_i (freeSurface/FreeSurface.H); j: neighbours near the surface.
//
// The pressure's sum over pairs, -sum_j V (p_i + p_j) grad W^rho_ij, makes of a pressure that is the same everywhere the force -2 p D_i: it
// pushes out of every place where neighbours are missing. A plane misses g_i; 2 sigma kappa g_i holds p = sigma kappa there, up to the outermost
// layer, so that no table of what a force's layers add up to is needed, and a pressure that changes along the surface is that of
// hydrostatics in all layers alike. Particles at rest do not lie as a plane: R is by how much they miss more, as a mean of those around, because
// the force of single particles would leave alone those that stand out of the surface, and liquid would evaporate. o: how much more than
// the sum alone the pressure's model makes of that difference (SurfaceAgreement). What it takes out again of the stress that an order bears
// (density/OrderStress.H) it makes nothing of: with that in R the surface of a drop that swings far would be pulled the more the more its particles are
// sheared, and drive it. Layers at a surface have one direction: of what is taken out only its part along the normal is kept, t. Particles deep inside,
// which are not looked at, count with the t of who sees them.
//
// The rim of a film on a wall that wets wholly is hollow, and pulled outwards. Liquid behind it that is stretched does not follow, so that
// particles of the rim would leave one by one: the pull ends where the liquid at the wall is diluted, from 5 % on, wholly at 20 %.
//
// Walls let liquid come as near as layers of it lie apart, and no nearer (SurfaceAgreement).
//
// Needs a pressure whose force is that sum over pairs; completedPbf completes its gradient along surfaces and walls then.
// sigma and theta are the user's; no number here was chosen by trial but the bounds of R, which is 1.1 in calm drops,
// and the densities between which the pull on a film ends.
// Where the surface is hollow the pressure behind it may fall to 1.5 sigma kappa, and to -sigma/d away from the surface.
// Why, and what each part gives: doc/notebook/theory/laplacePressure.md.
//
//     surfaceTension  laplacePressure;
//     laplacePressureCoeffs { support 3.25; }         // of the normals and the curvature, in spacings; at least 1.5 of the kernel's

#include "device/Holds.H"
#include "freeSurface/SemiImplicitTension.H"
#include "models/density/OrderStress.H"
#include "models/surfaceTension/laplacePressure/DisorderMemory.H"
#include "models/surfaceTension/surfaceCurvature/CurvatureTension.H"
#include "models/surfaceTension/surfaceCurvature/RegressedCurvature.H"
#include "particles/NeighbourLoop.H"
#include "walls/HalfSpace.H"

namespace shizuku
{

namespace
{

// What a particle near the surface misses of its neighbourhood, the slope of the density's kernel there, and its curvature: what its neighbours read.
struct alignas(16) KernelDeficiency
{
    scalar planar;                          // g
    scalar disorder;                        // o times what it misses more
    scalar filled;                          // next to a wall the density over that of a planar surface at this depth; 1 elsewhere
    scalar curvature;
};

template<class Kernel, class Stress>
struct MeasureDeficiency
{
    static constexpr Holds holds = Holds::more;

    Kernel W;
    scalar volume, densityVolume;           // V, V/S
    scalar spacing, ordering;
    Span<const Position> x;
    NeighbourView near;
    WallContribution walls;                   // of the density's kernel
    FreeSurfaceView surface;
    HalfSpaceView plane;                    // of the density's kernel
    Span<KernelDeficiency> deficiency;      // but for the curvature
    Stress stress;
    Span<scalar> taken;                     // t

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const int k = int(surface.place[i]);
        typename Stress::Moments moments;
        const ConstraintSums liquid = constraintSums(W, volume, i, x, near, team, moments);
        const auto wall = walls(i, x[i], surface.contactAt(k), team);
        const Vec3 G = surface.gradient[k];
        if constexpr (Stress::present)
        {
            const auto T = stress.ofUnitPressure(i, x[i], moments.over(team), surface(i), plane, walls, wall.anyWall, team);
            if (team.first()) taken[k] = 1.5f * dot(T * G, G) / fmax(squared(G), 1e-20f);
        }
        if (!team.first()) return;
        const HalfSpaceValues gas = plane(surface.depthOf(k));
        const scalar planar = gas.gradient;
        const scalar density = (densityVolume * liquid.W + wall.value) / (1 - gas.density);
        const scalar atWall = fmin(wall.value / plane(0.5f * spacing).density, 1);
        const scalar missing = dot(liquid.gradient + wall.gradient, G) / fmax(norm(G), 1e-20f);
        deficiency[k] = {planar, ordering * (missing - planar), 1 - atWall * (1 - density), 0};
    }
};

struct AddCurvature
{
    FreeSurfaceView surface;
    Span<const scalar> curvature;
    Span<KernelDeficiency> deficiency;

    HOST_DEVICE void operator()(int i) const
    {
        const int k = int(surface.place[i]);
        deficiency[k].curvature = curvature[k];
    }
};

// The same, and takes out of the disorder what the pressure takes out of the order's stress.
template<class Kernel>
struct RemoveOrderStress
{
    static constexpr Holds holds = Holds::more;

    Kernel W;
    scalar volume;
    Span<const Position> x;
    NeighbourView near;
    FreeSurfaceView surface;
    Span<const Vec3> normal;
    Span<const scalar> taken;               // t
    AddCurvature addCurvature;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const int k = int(surface.place[i]);
        const Position xi = x[i];
        const scalar own = taken[k];
        const Vec3 G = surface.gradient[k], n = 1 / fmax(norm(G), 1e-20f) * G;
        scalar sum = 0;
        near.forEach(i, [&](int j)
        {
            const Vec3 r = xi - x[j];
            const scalar slope = W.g(norm(r));
            if (slope == 0) return;
            const scalar along = dot(r, n);
            const int l = surface.isInside(j) ? k : int(surface.place[j]);
            const Vec3 m = squared(normal[l]) > 0 && l != k ? normal[l] : n;
            sum += slope * (own * along + 0.5f * taken[l] * (3 * dot(r, m) * dot(m, n) - along));
        }, team);
        sum = team.sum(sum);
        if (!team.first()) return;
        addCurvature(i);
        addCurvature.deficiency[k].disorder -= 1.0f / 3 * volume * sum;
    }
};

// R - 1: in calm drops, and its bounds. Below the least one R would feed swings that go far.
constexpr scalar calm = 0.1f, least = 0.03f, most = 0.3f;

// sigma kappa R: the jump of pressure that a particle's force is of. more: R - 1, at least `least`.
HOST_DEVICE inline scalar withDisorder(scalar jump, scalar more)
{
    const scalar bounded = fmin(more, most);
    return jump * (jump < 0 ? 1 - bounded : 1 + bounded);
}

// The force of the jump.
struct Push
{
    scalar restDensity;
    FreeSurfaceView surface;
    Span<const KernelDeficiency> deficiency;
    Span<Vec3> gradient;                    // with the lowest pressures
    ForceTarget target;

    HOST_DEVICE void operator()(int i, scalar jump, Remembered disorder) const { push(i, jump, withDisorder(jump, disorder.more)); }

    // lowestOf: the jump that says how far the pressure may fall.
    HOST_DEVICE void push(int i, scalar lowestOf, scalar jump) const
    {
        const int k = int(surface.place[i]);
        const Vec3 G = gradient[k];
        setLowestPressure(gradient[k], lowestBehind(lowestOf, lowestPressureBeside(G)));
        target.add(i, 2 * jump * deficiency[k].planar / (restDensity * norm(G)) * G);
    }
};

// Of long steps: notes the jump, for SemiImplicitTension. R of the moment feeds waves that such steps do not resolve, and they follow less of it.
struct NoteJump
{
    scalar resolved;                        // t_c/dt
    FreeSurfaceView surface;
    Span<scalar> noted;

    HOST_DEVICE void operator()(int i, scalar jump, Remembered disorder) const
    {
        const scalar followed = resolved + (1 - resolved) * disorder.share;
        noted[surface.place[i]] = withDisorder(jump, calm + followed * (disorder.more - calm));
    }
};

struct PushByNoted
{
    Span<const Vec3> normal;
    Span<const scalar> jump;
    Push push;

    HOST_DEVICE void operator()(int i) const
    {
        const int k = int(push.surface.place[i]);
        if (squared(normal[k]) > 0) push.push(i, jump[k], jump[k]);
    }
};

// Take: Push or NoteJump.
template<class Take>
struct FindJump
{
    // Of a film at a wall, the density over a planar surface's below which it pulls nothing on, and from which it does wholly.
    static constexpr scalar torn = 0.8f, whole = 0.95f;
    // Depths by which particles differ count for R until nothing is left of them at this, in spacings.
    static constexpr scalar unlike = 5.5f;

    WendlandC2 W;
    scalar sigma, spacing;
    scalar followed;                                // share of what single curvatures differ by from their mean
    NeighbourView near;
    FreeSurfaceView surface;
    Span<const Vec3> normal;                        // with b
    Span<const KernelDeficiency> deficiency;
    DisorderMemoryView memory;
    Take take;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const int k = int(surface.place[i]);
        const Position xi = surface.position[k];
        const Vec3 mi = normal[k];
        if (squared(mi) == 0) return;
        const scalar own = deficiency[k].curvature;
        const scalar depth = surface.depthOf(k);
        const bool first = team.first();
        scalar weight = first ? W.W(0) * weightBeside(mi) : 0, kappas = weight * own;
        scalar planar = first ? W.W(0) * deficiency[k].planar : 0, disorder = first ? W.W(0) * deficiency[k].disorder : 0;
        scalar all = first ? W.W(0) : 0, filled = all * deficiency[k].filled;
        forEachOnSurface(i, mi, near, surface, normal, [&](int l, Vec3 other)
        {
            const scalar w = W.W(norm(surface.position[l] - xi));
            const KernelDeficiency there = deficiency[l];
            weight += w * weightBeside(other);
            kappas += w * weightBeside(other) * there.curvature;
            const scalar alike = w * (1 - fabs(depthBeside(surface.position[l]) - depth) / (unlike * spacing));
            planar += alike * there.planar;
            disorder += alike * there.disorder;
            all += w;
            filled += w * there.filled;
        }, team);
        weight = team.sum(weight);
        kappas = team.sum(kappas);
        planar = team.sum(planar);
        disorder = team.sum(disorder);
        all = team.sum(all);
        filled = team.sum(filled);
        if (!first) return;
        const scalar mean = weight > 0 ? kappas / weight : own;
        scalar jump = sigma * steadied(mean + followed * (own - mean), mean);
        if (jump < 0) jump *= fmin(fmax((filled / all - torn) / (whole - torn), 0), 1);
        take(i, jump, memory(i, xi, surface.contactAt(k), fmax(disorder / fmax(planar, 1e-20f), least)));
    }
};

class LaplacePressure : public CurvatureTension<RegressedCurvature>
{
public:
    LaplacePressure(const Dictionary& coeffs, Liquid& liquid, const Walls& walls, FreeSurface& surface)
    :
        CurvatureTension(coeffs, liquid, surface),
        plane_(tabulateHalfSpace(liquid.kernel())),
        semiImplicit_(liquid)
    {
        if (walls.particles() + walls.surfaces() > 0) memory_.emplace(liquid);
        // Half of what close-packed layers lie apart, 2^(1/6) sqrt(2/3) spacings: there is where the pressure holds the first layer of disordered liquid.
        constexpr scalar halfOfLayers = 0.458f;
        surface.agreed().pressureJump = true;
        surface.agreed().closest = halfOfLayers;
    }

    std::optional<Columns> readsOfNeighbours(Liquid&) const override { return Columns{}; }
    int parts(scalar dt) const override { return semiImplicit_.parts(dt); }
    double stepLimit(const LiquidProperties& p) const override { return SemiImplicitTension::longestCalm * p.capillaryStep(); }

    void commit() override
    {
        CurvatureTension::commit();
        if (memory_) memory_->commit();
    }

private:
    void measure(const Liquid& liquid, const Neighbourhood& near, const Walls& walls) override
    {
        if (!extended_) extended_.emplace(liquid.kernel(), walls.contactAngles(surface_.support()));
        edges_.follow(walls.view(liquid).planes, liquid.kernel(), liquid);
        const int room = surface_.particles().indices.size();
        deficiency_.resizeDiscarding(room);
        const scalar removed = surface_.agreed().orderRemoved;
        taken_.resizeDiscarding(removed > 0 ? room : 0);
        if (removed > 0) measure(liquid, near, walls, OrderStress{removed, 0.5f * liquid.spacing()});
        else measure(liquid, near, walls, NoOrderStress{});
    }

    Columns measured() override
    {
        if (surface_.agreed().orderRemoved > 0) return {valuesOf(surface_.particles(), taken_)};
        return {};
    }

    void add
    (
        const Liquid& liquid, const Neighbourhood& near, const Walls& walls, CurvatureField& field,
        ForceTarget target
    ) override
    {
        const FreeSurfaceView view = surface_.view();
        const AddCurvature addCurvature{view, field.curvature.span(), deficiency_.span()};
        if (surface_.agreed().orderRemoved > 0)
        {
            std::visit
            (
                [&]<class Kernel>(const Kernel& W)
                {
                    NeighbourLoop
                    (
                        liquid, {}, {placesOf(liquid.predicted), valuesOf(surface_.particles(), field.normal), valuesOf(surface_.particles(), taken_)}
                    ).forEachTeam(surface_.particles(), RemoveOrderStress<Kernel>
                    {
                        W, liquid.particleVolume(), liquid.predicted.span(), near.view(), view, field.normal.span(), taken_.span(), addCurvature
                    });
                },
                liquid.kernel()
            );
        }
        else forEach(surface_.particles(), addCurvature);
        taken_ = {};
        const Push push{liquid.restDensity(), view, std::as_const(deficiency_).span(), surface_.gradient(), target};
        if (!semiImplicit_.isNeeded(step())) findJump(liquid, near, walls, field, push);
        else
        {
            Buffer<scalar> jump(surface_.particles().indices.size());
            jump.setZero();
            findJump(liquid, near, walls, field, NoteJump{semiImplicit_.resolved(step()), view, jump.span()});
            semiImplicit_.smooth(liquid, near, surface_, step(), field.normal, jump);
            forEach(surface_.particles(), PushByNoted{std::as_const(field.normal).span(), std::as_const(jump).span(), push});
        }
        deficiency_ = {};
    }

    template<class Take>
    void findJump(const Liquid& liquid, const Neighbourhood& near, const Walls& walls, CurvatureField& field, const Take& take)
    {
        NeighbourLoop
        (
            liquid, {valuesOf(surface_.particles(), deficiency_)}, {surface_.positions(), valuesOf(surface_.particles(), field.normal)}
        ).forEachTeam(surface_.particles(), FindJump<Take>
        {
            surface_.kernel(), sigma_, liquid.spacing(), followed(), near.view(), surface_.view(), std::as_const(field.normal).span(), std::as_const(deficiency_).span(),
            memory_ ? memory_->view(liquid, walls, step(), capillaryStep()) : DisorderMemoryView{}, take
        });
    }

    template<class Stress>
    void measure(const Liquid& liquid, const Neighbourhood& near, const Walls& walls, const Stress& stress)
    {
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                NeighbourLoop(liquid, {}, {placesOf(liquid.predicted)}).forEachTeam(surface_.particles(), MeasureDeficiency<Kernel, Stress>
                {
                    W, liquid.particleVolume(), liquid.particleVolume() / liquid.latticeSum(), liquid.spacing(), surface_.agreed().ordering,
                    liquid.predicted.span(), near.view(), {extended_->view(), W.h, walls.view(liquid), edges_.view()}, surface_.view(),
                    {plane_.span(), W.h}, deficiency_.span(), stress, taken_.span()
                });
            },
            liquid.kernel()
        );
    }

    Buffer<HalfSpaceValues> plane_;
    std::optional<ExtendedLiquid> extended_;        // of the density's kernel
    SampledEdges edges_;
    Buffer<KernelDeficiency> deficiency_;           // while the force is found, as t
    Buffer<scalar> taken_;
    std::optional<DisorderMemory> memory_;  // where there are walls
    SemiImplicitTension semiImplicit_;      // in steps longer than the capillary one
};

const SurfaceTensionTable::Add<LaplacePressure> registered{"laplacePressure", "Laplace's pressure on the free surface"};

}

}
