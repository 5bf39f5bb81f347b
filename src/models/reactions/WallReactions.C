// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/reactions/WallReactions.H"

#include "freeSurface/WallContribution.H"
#include "walls/HalfSpace.H"

namespace shizuku
{

namespace
{

struct MomentumOf
{
    Span<const Position> position;
    Span<const Vec3> velocity;
    double more[3];                             // dt g

    HOST_DEVICE Reaction operator()(int i) const
    {
        const Vec3 u = velocity[i];
        return reactionOf(placeOf(position[i]), u.x + more[0], u.y + more[1], u.z + more[2]);
    }
};

// What a wall gets at a particle, in parts.
struct EstimateAt
{
    std::uint32_t wall;
    scalar h, spacing;
    scalar perPressure, tension, friction;      // 2 dt/rho0, 2 dt sigma/rho0, dt nu; 0: there is no estimate
    Span<const Position> position;
    Span<const Vec3> velocity;
    Span<const scalar> pressure;                // empty: none
    WallView walls;
    Span<const std::uint32_t> ofSurface, ofParticle, fileOrder;
    HalfSpaceView plane;
    ExtendedLiquidView extended;
    FreeSurfaceView surface;                    // where hasSurface

    bool hasSurface;

    HOST_DEVICE WallReactions::Reactions operator()(int i) const
    {
        const Position x = position[i];
        const Nearest solid = nearestSolid(i, x);
        Vec3 by[WallReactions::parts];
        scalar touch = 0;
        walls.forEachContact(i, x, h, [&](int a, const WallContact& contact)
        {
            if ((a < walls.surfaces.count ? ofSurface[a] : solid.wall) != wall) return;
            if (a < walls.surfaces.count) touch = fmax(touch, 1 - fmax(contact.distance, 0) / h);
            addTo(by, i, a, x, contact);
        });
        if (solid.wall == wall) touch = fmax(touch, 1 - solid.distance / h);
        if (touch == 0) return {};
        WallReactions::Reactions reactions;
        for (int part = 0; part < WallReactions::parts; ++part)
        {
            const Vec3 v = by[part];
            reactions.of[part] = reactionOf(placeOf(x), v.x, v.y, v.z, part == WallReactions::friction ? norm(v) : touch);
        }
        return reactions;
    }

private:
    struct Nearest
    {
        std::uint32_t wall = ~std::uint32_t(0);
        scalar distance;
    };

    HOST_DEVICE Nearest nearestSolid(int i, Position x) const
    {
        Nearest nearest{~std::uint32_t(0), h};
        walls.particles.near.forEach(i, [&](int k)
        {
            const scalar distance = norm(x - walls.particles.position[k]);
            if (distance < nearest.distance) nearest = {ofParticle[fileOrder[k]], distance};
        });
        return nearest;
    }

    HOST_DEVICE void addTo(Vec3* by, int i, int a, Position x, const WallContact& contact) const
    {
        const Vec3 n = contact.normal;
        if (pressure.size > 0) by[WallReactions::pressure] += perPressure * pressure[i] * slope(i, a, contact);
        const scalar weight = 2 * plane(contact.distance).gradient;
        if (friction > 0)
        {
            const Vec3 u = velocity[i] - walls.velocity(a, i, x);
            by[WallReactions::friction] += friction * weight / fmax(contact.distance, 0.25f * spacing) * (u - dot(u, n) * n);
        }
        if (!hasSurface || surface.isInside(i)) return;
        const Vec3 G = surface(i).gradient;
        const scalar steep = norm(G);
        const Vec3 m = 1 / fmax(steep, 1e-20f) * G;
        by[WallReactions::contactLine] += tension * steep * weight * (n - dot(n, m) * m);
    }

    // Of what the wall adds to the density.
    HOST_DEVICE Vec3 slope(int i, int a, const WallContact& contact) const
    {
        const ContactLine line = hasSurface ? surface.contactOf(i) : ContactLine{};
        const bool meets = a == line.wall;
        const WedgeIntegrals wedge = extended(line.theta, contact.distance / h, meets ? line.depth / h : 1);
        Vec3 sum = wedge.normal / h * contact.normal;
        if (meets) sum += wedge.tangential / h * line.tangent;
        return sum;
    }
};

}

WallReactions::WallReactions(const std::filesystem::path& casePath, const Liquid& liquid, const Walls& walls)
:
    entries_(WallEntries::read(casePath)), plane_(tabulateHalfSpace(liquid.kernel())), estimates_(entries_.names.size())
{
    ofSurface_.upload(entries_.ofSurface);
    ofParticle_.upload(entries_.ofParticle);
    if (!walls.freeBody()) return;
    body_.emplace(walls.surfaceOfBody(), entries_.radius[walls.surfaceOfBody()]);
    bodyEntry_ = entries_.ofSurface[walls.surfaceOfBody()];
}

std::string WallReactions::number(const std::string& wall, Part part, int c)
{
    const char* const names[] = {"ImpulseX", "ImpulseY", "ImpulseZ", "MomentX", "MomentY", "MomentZ"};
    return wall + "_" + partNames[part] + names[c];
}

std::string WallReactions::wetted(const std::string& body) { return body + "_wetted"; }

void WallReactions::begin(const Liquid& liquid, const Walls& walls, const Models& models, scalar dt)
{
    pressure_ = models.pressure->keepPressure();
    const auto g = models.bodyForce->uniform();
    const auto scaled = [&](double a) { return double(dt) * liquid.units().toScaled(a, dimensions::acceleration); };
    const std::array<double, 3> gravity{scaled(g[0]), scaled(g[1]), scaled(g[2])};
    before_.add(liquid.owned(), MomentumOf{liquid.position.span(), liquid.velocity.span(), {gravity[0], gravity[1], gravity[2]}});
    if (!body_) return;
    body_->begin(liquid, walls, gravity);
    frictionOnBody_ = models.viscosity->keepFriction(entries_.names[bodyEntry_]);
}

void WallReactions::pressed(const Liquid& liquid)
{
    pressed_.add(liquid.owned(), MomentumOf{liquid.position.span(), liquid.velocity.span(), {}});
    if (body_) body_->pressed(liquid);
}

void WallReactions::end(const Liquid& liquid, const Walls& walls, const Models& models, scalar dt)
{
    after_.add(liquid.owned(), MomentumOf{liquid.position.span(), liquid.velocity.span(), {}});
    if (entries_.names.empty()) return;
    if (const auto angles = walls.contactAngles(models.freeSurface->support()); !extended_ || angles != angles_)
    {
        extended_.emplace(liquid.kernel(), angles);
        angles_ = angles;
    }
    const bool hasSurface = models.freeSurface->active();
    const Units& units = liquid.units();
    const scalar perDensity = 2 * dt / liquid.restDensity();
    const scalar sigma = units.toScaled(liquid.properties().surfaceTension, dimensions::surfaceTension);
    const scalar nu = units.toScaled(liquid.properties().viscosity, dimensions::kinematicViscosity);
    EstimateAt estimate
    {
        .wall = 0, .h = liquid.support(), .spacing = liquid.spacing(), .perPressure = perDensity, .tension = perDensity * sigma,
        .friction = models.viscosity->holdsAtWalls() ? dt * nu : 0, .position = liquid.position.span(), .velocity = liquid.velocity.span(),
        .pressure = pressure_ ? pressure_->span() : Span<const scalar>{}, .walls = walls.view(liquid), .ofSurface = std::as_const(ofSurface_).span(),
        .ofParticle = std::as_const(ofParticle_).span(), .fileOrder = walls.fileOrder(), .plane = {plane_.span(), liquid.support()},
        .extended = extended_->view(), .surface = models.freeSurface->view(), .hasSurface = hasSurface
    };
    for (std::size_t wall = 0; wall < estimates_.size(); ++wall)
    {
        estimate.wall = std::uint32_t(wall);
        estimates_[wall].add(liquid.owned(), estimate);
    }
    if (!body_) return;
    body_->end(liquid, walls, *models.freeSurface, estimate.pressure, dt);
    if (frictionOnBody_) body_->rubbed(liquid, frictionOnBody_->span());
}

void WallReactions::addTo(Liquid& liquid)
{
    const auto taken = [&](auto& sums)
    {
        sums.ask();
        return liquid.parts().fold(sums.take());
    };
    const ReactionValue before(taken(before_)), pressed(taken(pressed_)), after(taken(after_));
    ReactionValue rest = before, restOfFriction = pressed;           // what walls got in all, less what is estimated
    rest.add(pressed, -1);
    restOfFriction.add(after, -1);
    std::vector<std::array<ReactionValue, parts>> walls;
    double touched = 0, rubbed = 0;
    for (auto& estimates : estimates_)
    {
        std::array<ReactionValue, parts>& wall = walls.emplace_back();
        const Reactions sums = taken(estimates);
        for (int part = 0; part < parts; ++part) wall[part] = ReactionValue(sums.of[part]);
        rest.add(wall[pressure], -1);
        rest.add(wall[contactLine], -1);
        restOfFriction.add(wall[friction], -1);
        touched += wall[pressure].share;
        rubbed += wall[friction].share;
    }
    if (body_)
    {
        std::array<ReactionValue, parts>& body = walls[bodyEntry_];
        ReactionValue rubs = body_->takeFriction(liquid);
        if (rubbed > body[friction].share && frictionOnBody_)
        {
            rubs.add(body[friction], -1);
            rubbed -= body[friction].share;
            body[friction].share = 0;
            body[friction].add(rubs, 1);
            restOfFriction.add(rubs, -1);
        }
        ReactionValue more = body_->take(liquid);
        liquid.setNumber(wetted(entries_.names[bodyEntry_]), std::min(more.share, 1.0));
        more.add(body[pressure], -1);
        more.add(body[contactLine], -1);
        if (touched > body[pressure].share)         // else all is its own
        {
            touched -= body[pressure].share;
            body[pressure].share = 0;
            body[pressure].add(more, 1);
            rest.add(more, -1);
        }
    }
    if (touched == 0) return;
    const double impulse = liquid.properties().particleMass() * liquid.units().of(dimensions::velocity);
    for (std::size_t w = 0; w < walls.size(); ++w)
    {
        auto& wall = walls[w];
        const double share = wall[pressure].share / touched;
        wall[pressure].add(rest, share);
        wall[friction].add(restOfFriction, rubbed > 0 ? wall[friction].share / rubbed : share);
        for (int part = 0; part < parts; ++part)
        {
            for (int c = 0; c < 6; ++c)
            {
                liquid.number(number(entries_.names[w], Part(part), c), 0) += impulse * (c < 3 ? 1 : liquid.units().length) * wall[part].of[c];
            }
        }
    }
}

}
