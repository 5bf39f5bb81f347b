// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/SpeedMeter.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

struct SpeedOf
{
    Span<const Vec3> velocity;

    HOST_DEVICE SpeedMeter::Fastest operator()(int i) const
    {
        const scalar speed2 = squared(velocity[i]);
        if (speed2 < 1e30f) return {speed2, 0};
        return {0, 1};
    }
};

SpeedOf speedOf(const Liquid& liquid)
{
    return {liquid.velocity.span()};
}

}

void SpeedMeter::watch(const Liquid& liquid)
{
    watched_.add(liquid.owned(), speedOf(liquid));
}

void SpeedMeter::ask(const Liquid& liquid)
{
    watched_.ask();
    now_.ask(liquid.owned(), speedOf(liquid));
}

Speeds SpeedMeter::take(const Liquid& liquid)
{
    const auto [watched, now] = liquid.parts().fold(Both{watched_.take(), now_.take()});
    const auto speed = [&](scalar speed2) { return std::sqrt(double(speed2)) * liquid.units().of(dimensions::velocity); };
    return {speed(now.speed2), speed(std::max(now.speed2, watched.speed2)), now.nonFinite > 0 ? now.nonFinite : watched.nonFinite};
}

Speeds SpeedMeter::measure(const Liquid& liquid)
{
    ask(liquid);
    return take(liquid);
}

}
