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
    particles += other.particles;
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
        sums.mostSpeed2 = speed2;
        sums.mostCompression = compression;
        sums.speed2 = wideQuanta(speed2);
        sums.volume = wideQuanta(1 / (1 + compression));
        sums.compression = wideQuanta(compression);
        sums.position[0] = Int128(x.x), sums.position[1] = Int128(x.y), sums.position[2] = Int128(x.z);
        sums.velocity[0] = wideQuanta(u.x), sums.velocity[1] = wideQuanta(u.y), sums.velocity[2] = wideQuanta(u.z);
        sums.particles = 1;
        return sums;
    }
};

}

LiquidState LiquidStateMeter::measure(const Liquid& liquid)
{
    const LiquidSums own = reduce
    (
        liquid.owned(), StateOfParticle{liquid.position.span(), liquid.velocity.span(), liquid.density.span()}, scratch_
    );
    const LiquidSums sums = liquid.parts().fold(own);
    const double n = double(sums.particles);
    const Units& units = liquid.units();
    const LiquidProperties& p = liquid.properties();
    const double speed = units.of(dimensions::velocity);

    LiquidState state;
    state.volume = p.particleVolume() * valueOf(sums.volume);
    state.kineticEnergy = 0.5 * p.particleMass() * valueOf(sums.speed2) * speed * speed;
    state.maxSpeed = std::sqrt(double(sums.mostSpeed2)) * speed;
    state.maxDensityError = sums.mostCompression;
    if (n == 0) return state;
    state.averageDensityError = valueOf(sums.compression) / n;
    for (int c = 0; c < 3; ++c)
    {
        state.centroid[c] = double(Int128(sums.position[c])) / double(std::int64_t(1) << quanta::fractionBits) / n * units.length;
        state.momentum[c] = p.particleMass() * valueOf(sums.velocity[c]) * speed;
    }
    return state;
}

}
