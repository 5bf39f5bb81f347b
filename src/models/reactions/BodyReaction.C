// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/reactions/BodyReaction.H"

#include <numbers>

namespace shizuku
{

namespace
{

struct BodyWeight
{
    WallSurfacesView surfaces;
    int own;
    scalar width, spacing;                      // scaled

    struct Value
    {
        scalar value;
        Vec3 gradient;
        scalar alone;                           // the value without other walls
    };

    // Of t, and its slope.
    struct Fall
    {
        scalar value, slope;
    };

    HOST_DEVICE static Fall evenly(scalar t) { return {1 - t, -1}; }
    HOST_DEVICE static Fall smoothly(scalar t) { return {1 - t * t * t * (10 - t * (15 - 6 * t)), -30 * t * t * (1 - t) * (1 - t)}; }

    HOST_DEVICE Value operator()(Place at) const
    {
        const WallSurface::Nearest nearest = surfaces[own](at);
        const scalar d = fmax(nearest.distance, 0);
        const scalar alone = smoothly(fmin(d / width, 1)).value;
        if (d >= width) return {0, {}, alone};
        WallSurface::Nearest other{width, {}};
        for (int a = 0; a < surfaces.count; ++a)
        {
            if (a == own) continue;
            const WallSurface::Nearest wall = surfaces[a](at);
            if (wall.distance < other.distance) other = wall;
        }
        const scalar e = fmax(other.distance, 0);
        const bool isGap = d + e < width;
        const scalar reach = isGap ? fmax(d + e, 1e-6f * width) : width;
        const scalar t = d / reach;
        const Vec3 slope = isGap ? (1 - t) * nearest.normal - t * other.normal : nearest.normal;
        const scalar share = fmin(fmax(reach / spacing - 1, 0), 1);
        const Fall even = evenly(t), smooth = smoothly(t);
        Vec3 gradient = ((1 - share) * even.slope + share * smooth.slope) / reach * slope;
        if (share > 0 && share < 1) gradient += (smooth.value - even.value) / spacing * (nearest.normal + other.normal);
        return {even.value + share * (smooth.value - even.value), gradient, alone};
    }
};

struct NoteWeight
{
    BodyWeight weight;
    Span<const Position> position;
    Span<scalar> to, alone;

    HOST_DEVICE void operator()(int i) const
    {
        const BodyWeight::Value w = weight(placeOf(position[i]));
        to[i] = w.value;
        alone[i] = w.alone;
    }
};

struct WeightedMomentumOf
{
    Span<const scalar> weight, alone;
    Span<const Position> position;
    Span<const Vec3> velocity;
    double more[3];                             // dt g

    HOST_DEVICE Reaction operator()(int i) const
    {
        if (alone[i] == 0) return {};
        const double w = weight[i];
        const Vec3 u = velocity[i];
        return reactionOf(placeOf(position[i]), w * (u.x + more[0]), w * (u.y + more[1]), w * (u.z + more[2]), alone[i]);
    }
};

// -S grad w dt/rho0
struct StressOf
{
    BodyWeight weight;
    scalar perPressure, tension;                // dt/rho0, 2 dt sigma/rho0
    Span<const Position> position;
    Span<const scalar> pressure;
    FreeSurfaceView surface;                    // where hasSurface
    bool hasSurface;

    HOST_DEVICE Reaction operator()(int i) const
    {
        const Place at = placeOf(position[i]);
        const Vec3 slope = weight(at).gradient;
        if (squared(slope) == 0) return {};
        Vec3 sum = perPressure * pressure[i] * slope;
        if (hasSurface && !surface.isInside(i))
        {
            const Vec3 G = surface(i).gradient;
            const scalar steep = norm(G);
            const Vec3 m = 1 / fmax(steep, 1e-20f) * G;
            sum -= tension * steep * (slope - dot(slope, m) * m);
        }
        return reactionOf(at, sum.x, sum.y, sum.z);
    }
};

struct LossAt
{
    Span<const Position> position;
    Span<const Vec3> loss;

    HOST_DEVICE Reaction operator()(int i) const
    {
        const Vec3 u = loss[i];
        return squared(u) > 0 ? reactionOf(placeOf(position[i]), u.x, u.y, u.z) : Reaction{};
    }
};

ReactionValue taken(Accumulator<Reaction>& sums, const Liquid& liquid)
{
    sums.ask();
    return ReactionValue(liquid.parts().fold(sums.take()));
}

BodyWeight weightOf(const Liquid& liquid, const Walls& walls, int own)
{
    return {walls.view(liquid).surfaces, own, BodyReaction::width * liquid.spacing(), liquid.spacing()};
}

}

void BodyReaction::begin(const Liquid& liquid, const Walls& walls, const std::array<double, 3>& g)
{
    weight_.resizeDiscarding(liquid.owned());
    alone_.resizeDiscarding(liquid.owned());
    forEach(liquid.owned(), NoteWeight{weightOf(liquid, walls, surface_), liquid.position.span(), weight_.span(), alone_.span()});
    before_.add(liquid.owned(), WeightedMomentumOf{std::as_const(weight_).span(), std::as_const(alone_).span(), liquid.position.span(), liquid.velocity.span(), {g[0], g[1], g[2]}});
}

void BodyReaction::pressed(const Liquid& liquid)
{
    pressed_.add(liquid.owned(), WeightedMomentumOf{std::as_const(weight_).span(), std::as_const(alone_).span(), liquid.position.span(), liquid.velocity.span(), {}});
}

void BodyReaction::end(const Liquid& liquid, const Walls& walls, const FreeSurface& surface, Span<const scalar> pressure, scalar dt)
{
    const scalar perDensity = dt / liquid.restDensity();
    const scalar sigma = liquid.units().toScaled(liquid.properties().surfaceTension, dimensions::surfaceTension);
    stress_.add(liquid.owned(), StressOf
    {
        .weight = weightOf(liquid, walls, surface_), .perPressure = perDensity, .tension = 2 * perDensity * sigma, .position = liquid.position.span(),
        .pressure = pressure, .surface = surface.view(), .hasSurface = surface.active()
    });
}

void BodyReaction::rubbed(const Liquid& liquid, Span<const Vec3> loss)
{
    friction_.add(liquid.owned(), LossAt{liquid.position.span(), loss});
}

ReactionValue BodyReaction::takeFriction(const Liquid& liquid) { return taken(friction_, liquid); }

ReactionValue BodyReaction::take(const Liquid& liquid)
{
    // The weight of a shell of liquid all around: int_0^1 w(t) 4 pi (R + t W)^2 W dt, in particles.
    const double R = radius_ / liquid.properties().spacing, W = width;
    const double whole = 4 * std::numbers::pi * W * (R * R / 2 + 2 * R * W / 7 + 5 * W * W / 84);
    ReactionValue sum = taken(before_, liquid);
    sum.share /= whole;
    sum.add(taken(pressed_, liquid), -1);
    sum.add(taken(stress_, liquid), 1);
    return sum;
}

}
