// SPDX-License-Identifier: GPL-3.0-or-later
#include "freeSurface/HeldLine.H"

#include "particles/NeighbourLoop.H"
#include "walls/LineLimits.H"

#include <utility>

namespace shizuku
{

namespace
{

// Lengths in spacings, times in capillary steps.
constexpr scalar springLength = 0.1f;               // l
constexpr scalar meanHeight = 0.8f;                 // z, of particles at the line
constexpr scalar filterTime = 3;                    // of the speed that limits see
constexpr scalar eveningTime = 30;                  // in which memories at the same place become one
constexpr scalar atLine = 0.2f;                     // closeness from which a particle is at the line: two layers from the wall, or from the surface, but not both

// What neighbours read of a particle near a contact line. In a Vec3, of which w is the wall's number and, behind the point, half of the closeness.
struct LineMotion
{
    scalar u, angle, speed;
    int wall;                                       // -1: none
    scalar closeness;                               // to the line, above 0, up to 1

    HOST_DEVICE static LineMotion of(Vec3 stored)
    {
        if (stored.w < 0) return {0, 0, 0, -1, 0};
        const int wall = int(stored.w);
        return {stored.x, stored.y, stored.z, wall, 2 * (stored.w - scalar(wall))};
    }
    HOST_DEVICE Vec3 stored() const { return {u, angle, speed, wall < 0 ? -1 : scalar(wall) + 0.5f * closeness}; }
};

struct MeasureMotion
{
    scalar spacing, reach;
    Span<const Position> x;
    Span<const Vec3> velocity;
    Span<const scalar> angle, speed;
    FreeSurfaceView surface;
    WallView walls;
    Span<Vec3> motion;

    HOST_DEVICE void operator()(int i) const
    {
        const int k = int(surface.place[i]);
        const ContactLine line = surface.contactAt(k);
        scalar height = -1;
        walls.forEachContact(i, x[i], reach, [&](int a, const WallContact& wall) { if (a == line.wall) height = fmax(wall.distance, 0); });
        if (line.wall < 0 || height < 0)
        {
            motion[k] = LineMotion{0, 0, 0, -1, 0}.stored();
            return;
        }
        // Towards the gas: the surface's own speed, over what of its normal lies along the wall.
        constexpr scalar flattest = 0.5f;
        const Vec3 G = surface.gradient[k], m = -1 / fmax(norm(G), 1e-20f) * G;
        const scalar u = dot(velocity[i] - walls.velocity(line.wall, i, x[i]), m) / fmax(dot(m, line.tangent), flattest);
        const scalar z = height / spacing, s = line.depth / spacing;
        motion[k] = LineMotion{u, angle[i], speed[i], line.wall, 1 / ((1 + z * z) * (1 + s * s))}.stored();
    }
};

struct AdvanceAngle
{
    scalar support, listed;
    scalar way, filtered, evened;                   // that a scaled unit of speed makes, in spacings; shares of a step
    Span<const Position> x;
    NeighbourView near;
    FreeSurfaceView surface;
    WallView walls;
    LineLimitsView limits;
    Span<const Vec3> motion;
    Span<scalar> angle, speed;                      // after the step

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const int k = int(surface.place[i]);
        const LineMotion own = LineMotion::of(motion[k]);
        if (!team.anyBeside(own.closeness > 0)) return;
        const Position xi = x[i];
        const bool first = team.first(), isAt = own.closeness > atLine;
        Means at, nearer;
        if (first && isAt) at.add(1, own);
        near.forEach(i, [&](int j)
        {
            if (surface.isInside(j)) return;
            const int l = int(surface.place[j]);
            const LineMotion other = LineMotion::of(motion[l]);
            const scalar weight = fmax(1 - squared(xi - x[j]) / (support * support), 0);
            if (other.wall != own.wall || weight == 0) return;
            if (other.closeness > atLine) at.add(weight, other);
            if (other.closeness > own.closeness) nearer.add(weight * other.closeness, other);
        }, team);
        at.fold(team);
        nearer.fold(team);
        const AngleLimits bounds = limitsAt(i, xi, own.wall, isAt ? at.speed(own.speed, filtered) : 0, team);
        if (!first || own.closeness == 0) return;
        if (!isAt)
        {
            angle[i] = nearer.known > 0 ? nearer.angles / nearer.known : 0;
            speed[i] = nearer.known > 0 ? nearer.speeds / nearer.known : 0;
            return;
        }
        const scalar mean = at.known > 0 ? at.angles / at.known : surface.contactAt(k).theta;
        const scalar before = own.angle > 0 ? own.angle + evened * (mean - own.angle) : mean;
        angle[i] = within(bounds, before + way * at.u() / perAngle(before));
        speed[i] = at.speed(own.speed, filtered);
    }

private:
    static constexpr scalar least = 1e-4f;          // zero says that there is none

    // l + z/sin^2 theta
    HOST_DEVICE static scalar perAngle(scalar theta)
    {
        constexpr scalar flattest = 0.5f;           // as of u
        const scalar sine = fmax(sin(theta), flattest);
        return springLength + meanHeight / (sine * sine);
    }

    struct Means
    {
        scalar all = 0, us = 0, known = 0, angles = 0, speeds = 0;

        HOST_DEVICE void add(scalar weight, const LineMotion& of)
        {
            all += weight;
            us += weight * of.u;
            if (of.angle == 0) return;
            known += weight;
            angles += weight * of.angle;
            speeds += weight * of.speed;
        }
        HOST_DEVICE void fold(Team team)
        {
            all = team.sum(all);
            us = team.sum(us);
            known = team.sum(known);
            angles = team.sum(angles);
            speeds = team.sum(speeds);
        }
        HOST_DEVICE scalar u() const { return us / fmax(all, 1e-20f); }
        HOST_DEVICE scalar speed(scalar before, scalar share) const { return before + share * (u() - before); }
    };

    HOST_DEVICE static scalar within(AngleLimits bounds, scalar theta) { return fmax(fmin(fmax(theta, bounds.low), bounds.high), least); }

    // Of a sampled wall the mean of its solid particles around.
    HOST_DEVICE AngleLimits limitsAt(int i, Position xi, int wall, scalar u, Team team) const
    {
        AngleLimits bounds;
        if (wall >= 0 && wall < walls.surfaces.count) bounds = limits(limits.ofSurface[wall], u);
        scalar weights = 0, low = 0, high = 0;
        walls.particles.near.forEach(i, [&](int k)
        {
            const scalar near = fmax(1 - squared(xi - walls.particles.position[k]) / (listed * listed), 0), weight = near * near;
            const AngleLimits of = limits(limits.ofSolid[k], u);
            weights += weight;
            low += weight * of.low;
            high += weight * of.high;
        }, team);
        weights = team.sum(weights);
        low = team.sum(low);
        high = team.sum(high);
        return wall < walls.surfaces.count || weights == 0 ? bounds : AngleLimits{low / weights, high / weights};
    }
};

Buffer<scalar>* lineField(Liquid& liquid, const char* name, const Dimensions& dimensions)
{
    return &liquid.fields().require<scalar>({.name = name, .dimensions = dimensions, .written = true, .restarted = true});
}

}

HeldLine::HeldLine(Liquid& liquid)
:
    angle_(lineField(liquid, "contactLineAngle", dimensions::none)), speed_(lineField(liquid, "contactLineSpeed", dimensions::velocity))
{}

void HeldLine::advance(Liquid& liquid, const Neighbourhood& near, const Walls& walls, const FreeSurface& surface, scalar dt)
{
    const Selection& particles = surface.particles();
    const scalar step = dt / liquid.units().toScaled(liquid.properties().capillaryStep(), dimensions::time), d = liquid.spacing();
    motion_.resizeDiscarding(particles.indices.size());
    forEach(particles, MeasureMotion
    {
        d, surface.support(), std::as_const(liquid.position).span(), std::as_const(liquid.velocity).span(), std::as_const(*angle_).span(),
        std::as_const(*speed_).span(), surface.view(), walls.view(liquid), motion_.span()
    });
    for (Buffer<scalar>* next : {&nextAngle_, &nextSpeed_})
    {
        next->resizeDiscarding(liquid.all());
        next->setZero();
    }
    NeighbourLoop(liquid, {valuesOf(particles, motion_, Column::Kind::numbers), valuesOf(liquid.position)}).forEachTeam(particles, AdvanceAngle
    {
        liquid.support(), liquid.support() + 0.5f * d, dt / d, step / (filterTime + step), step / (eveningTime + step),
        std::as_const(liquid.position).span(), near.view(), surface.view(), walls.view(liquid), walls.lineLimits(), std::as_const(motion_).span(),
        nextAngle_.span(), nextSpeed_.span()
    });
    angle_->swap(nextAngle_);
    speed_->swap(nextSpeed_);
}

}
