// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/HeldLiquid.H"

#include "device/ForEach.H"

namespace shizuku
{

namespace
{

struct Keep
{
    Span<const Position> position;
    Span<Position> start;

    HOST_DEVICE void operator()(int i) const { start[i] = position[i]; }
};

// By the first stream that a particle was in when the sub-step began.
struct Hold
{
    Span<const Stream> streams;
    scalar dt;
    Span<const Position> start;
    Span<Position> position;
    Span<Vec3> velocity;

    HOST_DEVICE void operator()(int i) const
    {
        const Position from = start[i];
        const Place x = placeOf(from);
        int k = 0;
        while (k < streams.size && !streams[k].contains(x)) ++k;
        if (k == streams.size) return;
        const Vec3 u = streams[k].velocity();
        velocity[i] = u;
        position[i] = withBlock(from, from + dt * u);
    }
};

}

void HeldLiquid::set(const std::vector<Stream>& streams, bool bear)
{
    bear_ = bear;
    streams_.upload(streams);
}

void HeldLiquid::begin(const Liquid& liquid)
{
    if (streams_.size() == 0) return;
    start_.resizeDiscarding(liquid.owned());
    forEach(liquid.owned(), Keep{liquid.position.span(), start_.span()});
}

void HeldLiquid::end(Liquid& liquid, scalar dt)
{
    if (streams_.size() == 0) return;
    forEach(liquid.owned(), Hold{streams_.span(), dt, start_.span(), liquid.position.span(), liquid.velocity.span()});
}

}
