// SPDX-License-Identifier: GPL-3.0-or-later
#include "linearSolvers/ConjugateGradients.H"

#include "device/ForEach.H"
#include "device/Reduce.H"

#include <limits>
#include <utility>

namespace shizuku
{

namespace
{

using Sums = ConjugateGradients::Sums;
using Progress = ConjugateGradients::Progress;

constexpr double quantaOfOne = 0x1p72;

HOST_DEVICE WideSum quanta(scalar value) { return Int128(double(value) * quantaOfOne); }
HOST_DEVICE double numberOf(const WideSum& sum) { return double(Int128(sum)) / quantaOfOne; }

struct SumResidual
{
    Span<const Vec3> residual, product, u;

    HOST_DEVICE Sums operator()(int i) const
    {
        return {quanta(squared(residual[i])), quanta(dot(residual[i], product[i])), quanta(squared(u[i]))};
    }
};

// What the sums of all say of an iteration.
struct Advise
{
    // Roundings of u make a residual, too.
    static constexpr double rounding = 4 * std::numeric_limits<scalar>::epsilon();

    double tolerance;
    bool isFirst;
    Span<Progress> progress;
    Readback::Post look;

    HOST_DEVICE void operator()(const Sums& sums) const
    {
        const double squares = numberOf(sums.squares), energy = numberOf(sums.energy), solution = numberOf(sums.solution);
        Progress now = isFirst ? Progress{} : progress[0];
        // u is as near to the solution as the residual is small. That of the start is no measure where noise makes it as large as steps are too long for it.
        if (isFirst) now.enough = fmax(tolerance * tolerance * (solution > 0 ? fmin(squares, solution) : squares), rounding * rounding * solution);
        if (!(squares > now.enough)) now.hasEnded = 1;
        if (!now.hasEnded)
        {
            ++now.iterations;
            now.beta = isFirst ? 0 : squares / now.squares;
            now.alpha = squares / (isFirst ? energy : energy - now.beta * squares / now.alpha);
            now.squares = squares;
        }
        progress[0] = now;
        if (look.words) look(now.hasEnded ? 1 + now.iterations : 0);
    }
};

// The same of the sums of each part.
struct AdviseOfParts
{
    Span<const Sums> ofParts;
    Advise advise;

    HOST_DEVICE void operator()(int) const
    {
        Sums all;
        for (int part = 0; part < ofParts.size; ++part) all.add(ofParts[part]);
        advise(all);
    }
};

struct Advance
{
    Span<const Progress> progress;
    bool isFirst;
    Span<Vec3> u, residual, direction, ofDirection;         // ofDirection: A times it
    Span<const Vec3> product;

    HOST_DEVICE void operator()(int i) const
    {
        const Progress now = progress[0];
        if (now.hasEnded) return;
        const scalar alpha = scalar(now.alpha), beta = scalar(now.beta);
        const Vec3 p = isFirst ? residual[i] : residual[i] + beta * direction[i];
        const Vec3 s = isFirst ? product[i] : product[i] + beta * ofDirection[i];
        u[i] += alpha * p;
        residual[i] -= alpha * s;
        direction[i] = p;
        ofDirection[i] = s;
    }
};

}

void ConjugateGradients::advise
(
    const ParticleSet& particles, int iteration, Span<const Vec3> residual, Span<const Vec3> product, Span<const Vec3> u, const Readback::Post& look
)
{
    const Advise advise{controls_.tolerance, iteration == 0, progress_.span(), look};
    const SumResidual ofParticle{residual, product, u};
    if (particles.parts().parts() == 1) return reduceFor(particles.owned(), ofParticle, scratch_, advise);
    reduce(particles.owned(), ofParticle, scratch_, sums_);
    particles.ghosts().gather(sums_, scratch_);
    forEach(1, AdviseOfParts{scratch_.span(), advise});
}

void ConjugateGradients::solve(const ParticleSet& particles, const Operator& A, Buffer<Vec3> residual, Buffer<Vec3>& u)
{
    Buffer<Vec3> product(particles.all()), direction(particles.all()), ofDirection(particles.all());
    progress_.resizeDiscarding(1);
    const Readback::Post none{};
    const int unlooked = std::exchange(unlooked_, 0);
    for (int iteration = 0; iteration < controls_.maxIterations; ++iteration)
    {
        const bool looks = iteration >= unlooked;
        A(residual, product);
        advise(particles, iteration, std::as_const(residual).span(), std::as_const(product).span(), std::as_const(u).span(), looks ? ended_.ask() : none);
        forEach(particles.owned(), Advance
        {
            progress_.span(), iteration == 0, u.span(), residual.span(), direction.span(), ofDirection.span(), std::as_const(product).span()
        });
        if (const std::uint32_t ended = looks ? *ended_.wait() : 0)
        {
            unlooked_ = int(ended) - 1;
            return;
        }
    }
}

}
