// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/LiquidState.H"

namespace shizuku
{

HOST_DEVICE void LiquidSums::add(const LiquidSums& other)
{
    speed2 += other.speed2;
    volume += other.volume;
    compression += other.compression;
    for (int c = 0; c < 3; ++c)
    {
        position[c] += other.position[c];
        velocity[c] += other.velocity[c];
    }
    mostSpeed2 = fmax(mostSpeed2, other.mostSpeed2);
    mostCompression = fmax(mostCompression, other.mostCompression);
}

namespace
{

struct StateOfParticle
{
    Span<const Position> position;
    Span<const Vec3> velocity;
    Span<const scalar> density;

    HOST_DEVICE LiquidSums operator()(int i) const
    {
        const Place x = placeOf(position[i]);
        const Vec3 u = velocity[i];
        const scalar speed2 = squared(u), compression = fmax(density[i] - 1, 0);
        LiquidSums sums;
        sums.speed2 = sums.mostSpeed2 = speed2;
        sums.volume = 1 / (1 + compression);
        sums.compression = sums.mostCompression = compression;
        sums.position[0] = quanta::lengthOf(x.x), sums.position[1] = quanta::lengthOf(x.y), sums.position[2] = quanta::lengthOf(x.z);
        sums.velocity[0] = u.x, sums.velocity[1] = u.y, sums.velocity[2] = u.z;
        return sums;
    }
};

}

LiquidState LiquidStateMeter::measure(const Liquid& liquid)
{
    const int n = liquid.owned();
    const LiquidSums sums = reduce
    (
        n, StateOfParticle{liquid.position.span(), liquid.velocity.span(), liquid.density.span()}, scratch_
    );
    const Units& units = liquid.units();
    const LiquidProperties& p = liquid.properties();
    const double speed = units.of(dimensions::velocity);

    LiquidState state;
    state.volume = p.particleVolume() * sums.volume;
    state.kineticEnergy = 0.5 * p.particleMass() * sums.speed2 * speed * speed;
    state.maxSpeed = std::sqrt(double(sums.mostSpeed2)) * speed;
    state.maxDensityError = sums.mostCompression;
    if (n == 0) return state;
    state.averageDensityError = sums.compression / n;
    for (int c = 0; c < 3; ++c)
    {
        state.centroid[c] = sums.position[c] / n * units.length;
        state.momentum[c] = p.particleMass() * sums.velocity[c] * speed;
    }
    return state;
}

}
