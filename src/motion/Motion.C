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
    Span<const Vec3> position, velocity;
    Span<Vec3> predicted;

    HOST_DEVICE void operator()(int i) const { predicted[i] = position[i] + dt * (velocity[i] + change); }
};

struct Displace
{
    scalar dt2;
    Span<const Vec3> acceleration;
    Span<Vec3> predicted;

    HOST_DEVICE void operator()(int i) const { predicted[i] += dt2 * acceleration[i]; }
};

struct Update
{
    scalar perStep;
    Span<const Vec3> predicted;
    Span<Vec3> position, velocity;

    HOST_DEVICE void operator()(int i) const
    {
        velocity[i] = perStep * (predicted[i] - position[i]);
        position[i] = predicted[i];
    }
};

}

void predictPositions(Liquid& liquid, scalar dt, Vec3 change)
{
    forEach(liquid.owned(), Predict{dt, change, liquid.position.span(), liquid.velocity.span(), liquid.predicted.span()});
}

void displace(Liquid& liquid, const Buffer<Vec3>& acceleration, scalar dt)
{
    forEach(liquid.owned(), Displace{dt * dt, acceleration.span(), liquid.predicted.span()});
}

void updateVelocities(Liquid& liquid, scalar dt)
{
    liquid.velocity.resizeDiscarding(liquid.all());
    forEach(liquid.owned(), Update{1 / dt, liquid.predicted.span(), liquid.position.span(), liquid.velocity.span()});
}

}
