// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/Motion.H"

#include "device/ForEach.H"

namespace shizuku
{

namespace
{

struct Predict
{
    scalar dt;
    Vec3 change;
    Span<const Position> position;
    Span<const Vec3> velocity;
    Span<Position> predicted;

    HOST_DEVICE void operator()(int i) const 
    {
        const Position from = position[i];
        predicted[i] = withBlock(from, from + dt * (velocity[i] + change));
    }
};

struct TakePredicted
{
    Span<const Position> predicted;
    Span<Position> position;

    HOST_DEVICE void operator()(int i) const { position[i] = withBlock(position[i], predicted[i]); }
};

struct Displace
{
    scalar dt2;
    Span<const Vec3> acceleration;
    Span<Position> predicted;

    HOST_DEVICE void operator()(int i) const { predicted[i] += dt2 * acceleration[i]; }
};

struct Update
{
    scalar perStep;
    Span<const Position> predicted;
    Span<Position> position;
    Span<Vec3> velocity;

    HOST_DEVICE void operator()(int i) const
    {
        const Position from = position[i], to = predicted[i];
        velocity[i] = perStep * (to - from);
        position[i] = withBlock(from, to);
    }
};

}

void takePredicted(Liquid& liquid)
{
    forEach(liquid.owned(), TakePredicted{liquid.predicted.span(), liquid.position.span()});
}

void predictPositions(Liquid& liquid, scalar dt, Vec3 change)
{
    forEach(liquid.owned(), Predict{dt, change, liquid.position.span(), liquid.velocity.span(), liquid.predicted.span()});
}

void displace(Liquid& liquid, const Buffer<Vec3>& acceleration, scalar dt)
{
    forEach(liquid.owned(), Displace{dt * dt, acceleration.span(), liquid.predicted.span()});
}

void dropVelocities(Liquid& liquid) { liquid.velocity = {}; }

void updateVelocities(Liquid& liquid, scalar dt)
{
    liquid.velocity.resizeDiscarding(liquid.all());
    forEach(liquid.owned(), Update{1 / dt, liquid.predicted.span(), liquid.position.span(), liquid.velocity.span()});
}

}
