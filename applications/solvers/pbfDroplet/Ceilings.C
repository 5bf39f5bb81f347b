// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ceilings.H"

#include "device/Buffer.H"
#include "device/ForEach.H"
#include "device/Vec3.H"

#include <algorithm>

namespace shizuku
{

namespace
{

struct CopyVector
{
    Span<const Vec3> from;
    Span<Vec3> to;

    HOST_DEVICE void operator()(int i) const { to[i] = from[i]; }
};

// Many chains, so that neither latency nor the width of the processor's vectors limits.
struct MultiplyAdd
{
    static constexpr int chains = 64, turns = 64;
    static constexpr double operations = 2.0 * chains * turns;

    scalar factor;
    Span<scalar> result;

    HOST_DEVICE void operator()(int i) const
    {
        scalar x[chains];
        for (int c = 0; c < chains; ++c) x[c] = scalar(i + c);
        for (int turn = 0; turn < turns; ++turn)
        {
            for (int c = 0; c < chains; ++c) x[c] = x[c] * factor + 0.5f;
        }
        scalar sum = 0;
        for (int c = 0; c < chains; ++c) sum += x[c];
        result[i] = sum;
    }
};

// The shortest of several calls, in seconds.
template<class F>
double shortest(int n, const F& f)
{
    double milliseconds = 1e30;
    for (int turn = 0; turn < 6; ++turn)
    {
        startProfile();
        forEach(n, f);
        milliseconds = std::min(milliseconds, stopProfile().at(0).milliseconds);
    }
    return 1e-3 * milliseconds;
}

}

Ceilings measureCeilings()
{
    const int vectors = 1 << 24, chains = 1 << 20;
    Buffer<Vec3> from(vectors), to(vectors);
    from.setZero();
    Buffer<scalar> result(chains);
    const double copied = 2.0 * vectors * sizeof(Vec3);
    return
    {
        copied / shortest(vectors, CopyVector{from.span(), to.span()}),
        MultiplyAdd::operations * chains / shortest(chains, MultiplyAdd{0.999f, result.span()})
    };
}

}
