// SPDX-License-Identifier: GPL-3.0-or-later
// Forces that turn with the liquid, as they were where the step began.
//
// Forces are found at the predicted positions x + dt u. Those of liquid that turns at Omega point there where they should a step later, and of its angular momentum
// (Omega dt)^2 is lost in a step. The acceleration a of a particle in the step before is, but for dt^2 of it, that at the beginning of this one. So of its change
// the mean over the neighbours is taken back,
//
//     b_i  = (1 - a a^T/|a|^2) (a_i - a_i^before)
//     u_i -= dt [ b_i + sum_j V W_ij (b_j - b_i) ]
//
// of what turns it, and not of what makes it larger: a pressure that has to grow does so at once. a: of all that moves particles but what acts on the whole liquid alike.
// What each variant gave: doc/notebook/theory/viscosity.md.
//
//     velocityCorrection  keepsTurns;

#include "device/ForEach.H"
#include "device/Holds.H"
#include "models/velocityCorrection/VelocityCorrection.H"
#include "particles/NeighbourLoop.H"

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

    HOST_DEVICE void operator()(int i, Team team) const
    {
        if (!team.first()) return;
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

class KeepsTurns : public VelocityCorrection
{
public:
    KeepsTurns(const Dictionary&, Liquid& liquid)
    :
        before_(liquid.fields().require<Vec3>
        ({
            .name = "stepAcceleration", .dimensions = dimensions::acceleration, .written = true, .restarted = true
        }))
    {}

    std::optional<Columns> readsOfNeighbours(Liquid& liquid) const override { return Columns{valuesOf(liquid.position)}; }

    void notePrediction(const Liquid& liquid) override
    {
        way_.resizeDiscarding(liquid.owned());
        forEach(liquid.owned(), FindWay{liquid.predicted.span(), liquid.position.span(), way_.span()});
    }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls&, scalar dt) override
    {
        Buffer<Vec3> turn(liquid.all());
        NeighbourLoop(liquid).forEachOwned(FindTurn
        {
            dt, std::as_const(way_).span(), std::as_const(liquid.velocity).span(), before_.span(), turn.span()
        }, {valuesOf(turn)});
        std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                NeighbourLoop(liquid, {}, {valuesOf(liquid.position), valuesOf(turn)}).forEachTeam(TakeBackTurn<Kernel>
                {
                    W, liquid.particleVolume(), dt, std::as_const(liquid.position).span(), near.view(), std::as_const(turn).span(),
                    liquid.velocity.span()
                });
            },
            liquid.kernel()
        );
    }

private:
    Buffer<Vec3>& before_;              // a of the step before, by particle; 0 before the first
    Buffer<Vec3> way_;                  // to the predicted positions
};

const VelocityCorrectionTable::Add<KeepsTurns> registered{"keepsTurns", "gives back what forces take of the liquid's turning"};

}

}
