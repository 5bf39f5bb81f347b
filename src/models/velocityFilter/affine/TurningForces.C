// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/velocityFilter/affine/TurningForces.H"

#include "device/ForEach.H"
#include "device/Holds.H"

#include <utility>
#include <variant>

namespace shizuku
{

namespace
{

struct FindWay
{
    Span<const Position> predicted, position;
    Span<Vec3> way;

    HOST_DEVICE void operator()(int i) const { way[i] = predicted[i] - position[i]; }
};

struct FindTurn
{
    scalar dt;
    Span<const Vec3> way, velocity;
    Span<Vec3> before, turn;

    HOST_DEVICE void operator()(int i) const
    {
        const Vec3 a = 1 / (dt * dt) * (dt * velocity[i] - way[i]), change = squared(before[i]) > 0 ? a - before[i] : Vec3{};
        turn[i] = change - dot(change, a) / fmax(squared(a), 1e-20f) * a;
        before[i] = a;
    }
};

template<class Kernel>
struct TakeBackTurn
{
    static constexpr Holds holds = Holds::more;

    Kernel W;
    scalar volume, dt;
    Span<const Position> x;
    NeighbourView near;
    Span<const Vec3> turn;
    Span<Vec3> velocity;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const Vec3 own = turn[i];
        Team::Vector sum;
        near.forEach(i, x[i], x, [&](auto j, auto r) { sum += W.W(norm(r)) * (turn[j] - own); }, team);
        const Vec3 mean = own + volume * team.sum(sum);
        if (team.first()) velocity[i] -= dt * mean;
    }
};

}

TurningForces::TurningForces(Liquid& liquid)
:
    before_(liquid.fields().require<Vec3>
    ({
        .name = "stepAcceleration", .dimensions = dimensions::acceleration, .written = true, .restarted = true, .exchanged = true
    }))
{}

void TurningForces::begin(const Liquid& liquid)
{
    way_.resizeDiscarding(liquid.owned());
    forEach(liquid.owned(), FindWay{liquid.predicted.span(), liquid.position.span(), way_.span()});
}

void TurningForces::apply(Liquid& liquid, const Neighbourhood& near, scalar dt)
{
    Buffer<Vec3> turn(liquid.all());
    forEach(liquid.owned(), FindTurn
    {
        dt, std::as_const(way_).span(), std::as_const(liquid.velocity).span(), before_.span(), turn.span()
    });
    liquid.ghosts().copy(turn);
    std::visit
    (
        [&]<class Kernel>(const Kernel& W)
        {
            forEachTeam(liquid.owned(), TakeBackTurn<Kernel>
            {
                W, liquid.particleVolume(), dt, std::as_const(liquid.position).span(), near.view(), std::as_const(turn).span(), liquid.velocity.span()
            });
        },
        liquid.kernel()
    );
}

}
