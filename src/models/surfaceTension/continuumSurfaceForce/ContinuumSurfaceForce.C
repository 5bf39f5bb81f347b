// SPDX-License-Identifier: GPL-3.0-or-later
// Continuum surface force (Brackbill, Kothe and Zemach 1992) on the free surface of FreeSurface.H, with walls as the
// liquid's extension at the contact angle.
//
//     kappa_i : the curvature (surfaceCurvature/PairCurvature.H), n_i: the mean normal, b_i: |G| over that of a planar surface, less a tenth
//     kappa'_i: its mean over the neighbours in the density's support, by W_ij b_j
//     a_i     = sigma/rho0 [ 2 kappa b_i G_i / J(kappa) - f psi(|G_i|/G0) g_i ],    kappa going from kappa_i, where kappa'_i is above
//                                                 4 |kappa_i - kappa'_i|, to kappa'_i, where that is below zero
//     g_i     = 2 sum_j W_ij b_j (kappa_j - kappa_i) t_j / sum_j W_ij b_j t_j^2,    j in the density's support: kappa's slope along the
//                                                 surface, t_j the part of x_j - x_i across n_i
//     f       = min(1, (t_c/dt)^2)                t_c: the capillary step
//
// J(kappa): what 2 b |G| adds up to where particles are, on the liquid's side of a surface of that curvature (SurfaceLayer.H). b is so smooth that the
// force of the layers of particles adds up to the same however far they stand apart. At a hollow surface
// liquid is under suction and the surface gives way where a single particle reads too little of it: there all near it have the
// mean. On round drops kappa_i stands.
//
// Only a part 1 - psi of the force acts outside of a particle in the layer (SurfaceLayer.H), so that of sigma kappa there is only that
// part of pressure there. Where kappa changes along the surface, as it does under gravity, the pressure would change too little in
// the layer to hold it: it would flow down as a skin, and push the rim of a puddle outwards. The second part of the force, with g, is
// what is missing: both together are the gradient of -sigma kappa psi, which some pressure always balances. In steps longer than the
// capillary one, sqrt(rho d^3/(2 pi sigma)), it is smaller by the square of how much longer: the waves that it hastens would grow.
//
// No cohesion enters, so no internal pressure locks the particles; sigma and theta are the user's, and no other constant depends on
// them or on the case. Which were chosen by trial, and by which: doc/notebook/theory/constants.md.
// Where the surface is hollow the pressure behind it may fall to 1.5 sigma kappa, and to -sigma/d away from the surface.
//
// The tension of closed surfaces, and of those that meet a plane everywhere at one angle, does not move liquid as a whole;
// the sums do a little, and it is taken back (models/forces/RigidMotion.H).
// What was tried, and what each choice gave, stands in doc/notebook/theory/continuumSurfaceForce.md.
//
//     surfaceTension  continuumSurfaceForce;
//     continuumSurfaceForceCoeffs { support 3.25; }   // of the normals and the curvature, in spacings; at least 1.5 of the kernel's

#include "models/surfaceTension/continuumSurfaceForce/SurfaceLayer.H"
#include "models/surfaceTension/surfaceCurvature/CurvatureTension.H"
#include "models/surfaceTension/surfaceCurvature/PairCurvature.H"
#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

struct Force
{
    WendlandC2 W;
    SurfaceLayerView layer;
    scalar sigma, restDensity, steepest, along;     // along: how much of the part along the surface
    NeighbourView near;
    FreeSurfaceView surface;
    Span<const Vec3> normal;                        // with b
    Span<const scalar> curvature;
    Span<Vec3> gradient;                            // with the lowest pressures
    ForceTarget target;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const int k = int(surface.place[i]);
        const Position xi = surface.position[k];
        const Vec3 mi = normal[k];
        if (squared(mi) == 0) return;
        const scalar own = curvature[k], ownWeight = W.W(0) * weightBeside(mi);
        scalar weight = 0, sum = 0, spread = 0;
        Vec3 slopes = {};
        forEachOnSurface(i, mi, near, surface, normal, [&](int l, Vec3 other)
        {
            const Vec3 r = surface.position[l] - xi, t = r - dot(r, mi) * mi;
            const scalar w = W.W(norm(r)) * weightBeside(other);
            weight += w;
            sum += w * curvature[l];
            slopes += w * (curvature[l] - own) * t;
            spread += w * squared(t);
        }, team);
        const Vec3 slope = team.sum(slopes);
        spread = team.sum(spread);
        weight = team.sum(weight) + ownWeight;
        sum = team.sum(sum) + ownWeight * own;
        if (!team.first()) return;
        const scalar kappa = steadied(own, weight > 0 ? sum / weight : own), jump = sigma * kappa;
        const Vec3 G = gradient[k];
        setLowestPressure(gradient[k], lowestBehind(jump, lowestPressureBeside(G)));
        const Vec3 g = spread > 0 ? 2 / spread * slope : Vec3{};
        const Vec3 acceleration = 1 / restDensity * (2 * jump / layer.sum(kappa) * weightBeside(mi) * G
                                                     - along * sigma * layer.deeper(norm(G) / steepest) * g);
        target.add(i, acceleration);
    }
};

class ContinuumSurfaceForce : public CurvatureTension<PairCurvature>
{
public:
    ContinuumSurfaceForce(const Dictionary& coeffs, Liquid& liquid, const Walls&, FreeSurface& surface)
    :
        CurvatureTension(coeffs, liquid, surface)
    {}

    std::optional<Columns> readsOfNeighbours(Liquid&) const override { return Columns{}; }

private:
    void add
    (
        const Liquid& liquid, const Neighbourhood& near, const Walls&, CurvatureField& field,
        ForceTarget target
    ) override
    {
        const WendlandC2 W = surface_.kernel();
        const scalar most = largestCurvature(liquid);
        if (sums_.size() == 0)
        {
            sums_.upload(tabulateSurfaceLayer(W, liquid.spacing(), most));
            parts_.upload(tabulateDeeperPart(W));
        }
        NeighbourLoop(liquid, {valuesOf(surface_.particles(), field.curvature)}, {valuesOf(surface_.particles(), field.normal)}).forEachTeam(surface_.particles(), Force
        {
            W, {sums_.span(), parts_.span(), most}, sigma_, liquid.restDensity(), surface_.steepest(),
            followed(), near.view(), surface_.view(), field.normal.span(), field.curvature.span(), surface_.gradient(), target
        });
    }

    Buffer<scalar> sums_, parts_;           // J and psi (SurfaceLayer.H)
};

const SurfaceTensionTable::Add<ContinuumSurfaceForce> registered{"continuumSurfaceForce", "force on the free surface's layer (Brackbill, Kothe and Zemach 1992)"};

}

}
