// Continuum surface force (Brackbill, Kothe and Zemach 1992) on the free surface of FreeSurface.H, with walls as the
// liquid's extension at the contact angle.
//
//     m_i     = -G_i/|G_i|                                        the outward normal
//     n_i     = sum_j W_ij |G_j| m_j / |...|                      its mean over the neighbours
//     kappa_i = 2 sum_j w_ij (x_j - x_i).(n_j - n_i) / sum_j w_ij t_ij^2,    w_ij = V b_j |W'_ij|/r_ij,    j near the surface
//     t_ij^2  = r_ij^2 - (x_ij . n_ij)^2                          n_ij: unit vector along n_i + n_j
//     kappa   : brought up to the surface, kappa_i/(1 + kappa_i D_i/2), D_i the mean depth of the pairs
//     kappa'_i: their mean over the neighbours in the density's support, by W_ij b_j
//     a_i     = sigma/rho0 [ 2 kappa b_i G_i / J(kappa) - f psi(|G_i|/G0) g_i ],    kappa going from kappa_i, where kappa'_i is above
//                                                 4 |kappa_i - kappa'_i|, to kappa'_i, where that is below zero
//     g_i     = 2 sum_j W_ij b_j (kappa_j - kappa_i) t_j / sum_j W_ij b_j t_j^2,    j in the density's support: kappa's slope along the
//                                                 surface, t_j the part of x_j - x_i across n_i
//     f       = min(1, (t_c/dt)^2)                t_c: the capillary step
//
// On a sphere each pair gives exactly 2/r at the pair's mean radius. J(kappa): what 2 b |G| adds up to where particles are,
// on the liquid's side of a surface of that curvature (SurfaceLayer.H). b is |G| over that of a planar surface, less the tenth
// from which on a particle is near the surface: so smooth that the force of the layers of particles adds up to the same however far
// they stand apart. Particles with normals apart by more than a right angle lie on different surfaces. At a hollow surface
// liquid is under suction and the surface gives way where a single particle reads too little of it: there all near it have the
// mean. On round drops kappa_i stands.
//
// Only a part 1 - psi of the force acts outside of a particle in the layer (SurfaceLayer.H), so that of sigma kappa there is only that
// part of pressure there. Where kappa changes along the surface, as it does under gravity, the pressure would change too little in
// the layer to hold it: it would flow down as a skin, and push the rim of a puddle outwards. The second part of the force, with g, is
// what is missing: both together are the gradient of -sigma kappa psi, which some pressure always balances. In steps longer than the
// capillary one, sqrt(rho d^3/(2 pi sigma)), it is smaller by the square of how much longer: the waves that it hastens would grow.
//
// Every point of the wall's wedge has the normal m_c = sin(theta) t + cos(theta) n. On a curved surface that meets the wall
// at theta the normals differ by kappa tau, with tau the distance of a particle from the contact line along the surface.
// Its points have the b of their depth, as particles do. So the wedge weighs tau int w (u.(x - y)) dy, u pointing along the surface
// away from the wall: of a surface of constant curvature it then says the same as the liquid, and of one at another angle it
// gives the whole of Young's force.
//
// No cohesion enters, so no internal pressure locks the particles; sigma and theta are the user's, and no other constant depends on
// them or on the case. Which were chosen by trial, and by which: doc/theory/constants.md.
// Where the surface is hollow the pressure behind it may fall to 1.5 sigma kappa, and to -sigma/d away from the surface.
//
// The tension of closed surfaces, and of those that meet a plane everywhere at one angle, does not move liquid as a whole;
// the sums do a little, and it is taken back (models/forces/NetMotion.H).
// What was tried, and what each choice gave, stands in doc/theory/continuumSurfaceForce.md.
//
//     surfaceTension  continuumSurfaceForce;
//     continuumSurfaceForceCoeffs { support 3.25; }   // of the normals and the curvature, in spacings; at least 1.5 of the kernel's

#include "freeSurface/FreeSurface.H"
#include "models/surfaceTension/SurfaceTension.H"
#include "models/surfaceTension/continuumSurfaceForce/SurfaceLayer.H"

namespace shizuku
{

namespace
{

constexpr scalar sharpest = 0.7f;           // largest |kappa|, times the spacing
constexpr scalar holds = 1.5f;              // lowest pressure at a hollow surface, over sigma kappa
constexpr scalar trusted = 4;               // kappa' from which a single kappa stands, over its distance from kappa'
constexpr scalar flattest = 0.05f;          // least sin(theta) for the distance from the contact line

HOST_DEVICE inline auto onSameSurface(Vec3 mi, Vector auto mj) { return squared(mj) > 0.25f && dot(mi, mj) >= 0; }

// Single normals are tilted by a few degrees where the particles stand in layers along a wall; their mean is not.
struct SmoothNormal
{
    WendlandC2 W;
    scalar steepest;                        // the planar |G|
    FreeSurfaceView surface;
    SelectedSearch near;
    Span<Vec3> normal;                      // with w = b; zero away from the surface

    HOST_DEVICE void operator()(Group places, Team team) const
    {
        const scalar least = leastSlope * steepest;
        GroupOfParticles group{};
        Vec3 own[Group::most];
        #pragma unroll
        for (int p = 0; p < Group::most; ++p)
        {
            group.index[p] = places[p];
            own[p] = surface.gradient[places[p]];
            if (p < places.size && squared(own[p]) > least * least) group.members |= 1u << p;
        }
        Team::Vector around[Group::most];
        near.forEach(group, [&](auto l) { return surface.gradient[l]; }, [&](int p, auto Gl, auto r)
        {
            const auto same = squared(Gl) > least * least && dot(own[p], Gl) >= 0;
            if (noneOf(same)) return;
            around[p] -= (same ? W.W(norm(r)) : 0) * Gl;
        }, team);
        const Vec3 sums = team.sums(around);
        if (team.lane >= places.size) return;
        const int k = places.first + team.lane;
        const Vec3 G = surface.gradient[k], sum = sums - W.W(0) * G;
        const bool isNear = (group.members >> team.lane & 1) != 0;
        Vec3 mean = isNear ? 1 / norm(sum) * sum : Vec3{};
        mean.w = isNear ? shareOfForce(norm(G) / steepest) : 0;
        normal[k] = mean;
    }
};

struct Curvature
{
    WendlandC2 W;
    scalar volume, largest;
    FreeSurfaceView surface;
    Span<const Vec3> normal;                // with w = b
    SelectedSearch near;                    // among positions with w = depth
    Span<const std::uint32_t> selected;
    ExtendedLiquidView extended;
    WallView walls;
    Span<scalar> curvature;                 // meaningless away from the surface

    HOST_DEVICE void operator()(Group places, Team team) const
    {
        GroupOfParticles group{};
        Vec3 normals[Group::most];
        scalar own[Group::most];
        #pragma unroll
        for (int p = 0; p < Group::most; ++p)
        {
            group.index[p] = places[p];
            normals[p] = normal[places[p]];
            own[p] = near.points[places[p]].w;
            if (p < places.size && squared(normals[p]) > 0) group.members |= 1u << p;
        }
        Team::Scalar spreads[Group::most] = {}, weights[Group::most] = {}, depths[Group::most] = {};
        near.forEach(group, [&](auto l) { return normal[l]; }, [&](int p, auto other, auto r)
        {
            const auto same = onSameSurface(normals[p], other);
            if (noneOf(same)) return;
            const auto mean = normals[p] + other;
            const auto slope = same ? -volume * other.w * W.g(norm(r)) : 0;
            const auto up = dot(r, mean);
            const auto along = same ? slope * (squared(r) - up * up / squared(mean)) : 0;
            spreads[p] -= slope * dot(r, other - normals[p]);
            weights[p] += along;
            depths[p] += along * 0.5f * (own[p] + r.w);
        }, team);
        const scalar spread = team.sums(spreads), weight = team.sums(weights), depth = team.sums(depths);
        if ((group.members >> team.lane & 1) == 0) return;
        const int k = places.first + team.lane;
        addWalls(k, spread, weight, depth);
    }

private:
    // The walls' part, and what comes of all.
    HOST_DEVICE void addWalls(int k, scalar spread, scalar weight, scalar depth) const
    {
        const int i = int(selected[k]);
        const Vec3 xi = near.points[k], mi = normal[k];
        const scalar own = xi.w;
        const ContactLine line = surface.contact[k];
        walls.forEachContact(i, xi, W.h, [&](int a, const WallContact& wall)
        {
            if (a != line.wall) return;
            const WedgeIntegrals wedge = extended(line.theta, wall.distance / W.h, line.depth / W.h);
            const Vec3 slope = 1 / W.h * (wedge.tangential * line.tangent + wedge.normal * wall.normal);
            const scalar sine = sin(line.theta), cosine = cos(line.theta);
            const Vec3 upward = sine * wall.normal - cosine * line.tangent;
            const scalar fromLine = (wall.distance + cosine * line.depth) / fmax(sine, flattest);
            const scalar along = fmax(0, -fromLine * dot(slope, upward));
            spread += dot(slope, sine * line.tangent + cosine * wall.normal - mi);
            weight += along;
            depth += along * own;
        });
        const scalar kappa = weight > 0 ? fmin(fmax(2 * spread / weight, -largest), largest) : 0;
        curvature[k] = weight > 0 ? kappa / fmax(0.3f, 1 + 0.5f * kappa * depth / weight) : 0;
    }
};

struct Force
{
    WendlandC2 W;
    SurfaceLayerView layer;
    scalar sigma, restDensity, steepest, along;     // along: how much of the part along the surface
    NeighbourView near;
    FreeSurfaceView surface;
    Span<const Vec3> normal;                        // with w = b
    Span<const scalar> curvature;
    Span<Vec3> gradient;                            // with w = the lowest pressure
    scalar factor;
    Span<Vec3> target;                              // gets factor times the acceleration

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const int k = int(surface.place[i]);
        const Vec3 xi = surface.position[k], mi = normal[k];
        if (squared(mi) == 0) return;
        const scalar own = curvature[k], ownWeight = W.W(0) * mi.w;
        scalar weight = 0, sum = 0, spread = 0;
        Vec3 slopes = {};
        near.forEach(i, [&](int j)
        {
            const int l = int(surface.place[j]);
            if (int(surface.place[j + 1]) == l) return;
            const Vec3 other = normal[l];
            if (!onSameSurface(mi, other)) return;
            const Vec3 r = surface.position[l] - xi, t = r - dot(r, mi) * mi;
            const scalar w = W.W(norm(r)) * other.w;
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
        const scalar mean = weight > 0 ? sum / weight : own, away = fabs(own - mean);
        const scalar u = mean > trusted * away ? 1 : fmax(mean, 0) / fmax(trusted * away, 1e-20f);
        const scalar kappa = mean + u * u * (3 - 2 * u) * (own - mean), jump = sigma * kappa;
        const Vec3 G = gradient[k];
        gradient[k].w = fmin(fmax(holds * jump, G.w), 0);
        const Vec3 g = spread > 0 ? 2 / spread * slope : Vec3{};
        const Vec3 acceleration = 1 / restDensity * (2 * jump / layer.sum(kappa) * mi.w * G
                                                     - along * sigma * layer.deeper(norm(G) / steepest) * g);
        target[i] += factor * acceleration;
    }
};

class ContinuumSurfaceForce : public SurfaceTension
{
public:
    ContinuumSurfaceForce(const Dictionary& coeffs, Liquid& liquid, Walls& walls, FreeSurface& surface)
    :
        surface_(surface),
        sigma_(liquid.units().toScaled(liquid.properties().surfaceTension, dimensions::surfaceTension)),
        capillaryStep_(liquid.units().toScaled(liquid.properties().capillaryStep(), dimensions::time))
    {
        const scalar support = scalar(coeffs.lookupOr("support", double(FreeSurface::usualSupport(liquid))));
        if (!(support >= FreeSurface::leastSupport(liquid) && support <= 8))
        {
            throw FatalInputError
            (
                coeffs.where("support"), "The support of the surface is out of range",
                "1.5 times the kernel's to 8 spacings"
            );
        }
        surface.require(liquid, walls, support, sigma_ / liquid.spacing());
    }

    const FreeSurface* freeSurface() const override { return &surface_; }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, Buffer<Vec3>& acceleration) override
    {
        add(liquid, near, walls, 1, acceleration);
    }

    // The force sees no positions but those of the free surface.
    bool move(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt) override
    {
        add(liquid, near, walls, dt * dt, liquid.predicted);
        return true;
    }

    void begin(scalar dt) override { dt_ = dt; }

    bool isInternal() const override { return oneAngle_; }

private:
    // Adds factor times the acceleration.
    void add(const Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar factor, Buffer<Vec3>& target)
    {
        const WendlandC2 W = surface_.kernel();
        const scalar most = sharpest / liquid.spacing();
        if (!extended_) tabulate(walls, liquid.spacing());
        const int room = surface_.particles().indices.size();
        Buffer<Vec3> normal(room);
        Buffer<scalar> curvature(room);
        const FreeSurfaceView view = surface_.view();
        const SelectedSearch among = near.wide(surface_.particles(), surface_.position());
        forEachGroup(surface_.particles(), SmoothNormal
        {
            W, surface_.steepest(), view, among, normal.span()
        });
        forEachGroup(surface_.particles(), Curvature
        {
            W, liquid.particleVolume(), most, view, normal.span(), among,
            surface_.particles().indices.span(), extended_->view(), walls.view(), curvature.span()
        });
        forEachTeam(surface_.particles(), Force
        {
            W, {sums_.span(), parts_.span(), most}, sigma_, liquid.restDensity(), surface_.steepest(),
            alongPart(), near.view(), view, normal.span(), curvature.span(), surface_.gradient(), factor, target.span()
        });
    }

    // Of the part along the surface: less in steps longer than the capillary one.
    scalar alongPart() const
    {
        const scalar shorter = capillaryStep_ / dt_;
        return fmin(1, shorter * shorter);
    }

    // What the force adds up to, and the wedge's part in the curvature: of what lies near the surface.
    void tabulate(const Walls& walls, scalar spacing)
    {
        const WendlandC2 W = surface_.kernel();
        sums_.upload(tabulateSurfaceLayer(W, spacing, sharpest / spacing));
        parts_.upload(tabulateDeeperPart(W));
        const auto plane = tabulateHalfSpace(W);
        const HalfSpaceView view{{plane.data(), int(plane.size())}, W.h};
        std::vector<scalar> shares(101);
        for (int k = 0; k <= 100; ++k) shares[k] = shareOfForce(view(0.01f * scalar(k) * W.h).gradient / surface_.steepest());
        extended_.emplace(W, walls.contactAngles(W.h), shares);
        oneAngle_ = walls.oneContactAngle();
    }

    FreeSurface& surface_;
    scalar sigma_;
    scalar capillaryStep_, dt_ = 0;         // the step: 0 before the first
    Buffer<scalar> sums_, parts_;           // J and psi (SurfaceLayer.H)
    std::optional<ExtendedLiquid> extended_;
    bool oneAngle_ = false;
};

const SurfaceTensionTable::Add<ContinuumSurfaceForce> registered{"continuumSurfaceForce"};

}

}
