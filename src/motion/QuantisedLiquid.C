// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/QuantisedLiquid.H"

#include "device/ForEach.H"
#include "device/Reduce.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

HOST_DEVICE void LiquidExtent::add(const LiquidExtent& other)
{
    const auto least = [](std::int64_t a, std::int64_t b) { return a < b ? a : b; };
    const auto most = [](std::int64_t a, std::int64_t b) { return a > b ? a : b; };
    low = {least(low.x, other.low.x), least(low.y, other.low.y), least(low.z, other.low.z)};
    high = {most(high.x, other.high.x), most(high.y, other.high.y), most(high.z, other.high.z)};
    mostSpeed2 = fmax(mostSpeed2, other.mostSpeed2);
}

namespace
{

struct ExtentOfParticle
{
    Span<const Position> position;
    Span<const Vec3> velocity;

    HOST_DEVICE LiquidExtent operator()(int i) const
    {
        const Place x = placeOf(position[i]);
        return {x, x, squared(velocity[i])};
    }
};

// A part of a range as one of all words; 0 of what is not a number.
HOST_DEVICE inline std::uint16_t wordOfPart(double part, double range)
{
    return range > 0 ? std::uint16_t(fmin(fmax(65535 * part / range, 0.0), 65535.0) + 0.5) : std::uint16_t(0);
}

struct QuantiseParticles
{
    int particles, shown;
    Span<const Position> position;
    Span<const Vec3> velocity;
    Span<const LiquidExtent> extent;
    QuantisedLiquid::Words* words;              // these two in the host's memory
    LiquidExtent* extentOnHost;

    HOST_DEVICE void operator()(int k) const
    {
        const LiquidExtent all = extent[0];
        if (k == 0) *extentOnHost = all;
        const int i = int(std::int64_t(k) * particles / shown);
        const Place x = placeOf(position[i]);
        words[k] =
        {
            wordOfPart(double(x.x - all.low.x), double(all.high.x - all.low.x)),
            wordOfPart(double(x.y - all.low.y), double(all.high.y - all.low.y)),
            wordOfPart(double(x.z - all.low.z), double(all.high.z - all.low.z)),
            wordOfPart(sqrt(double(squared(velocity[i]))), sqrt(double(all.mostSpeed2)))
        };
    }
};

}

void QuantisedLiquid::ask(const Liquid& liquid, std::size_t limit)
{
    const int particles = liquid.owned(), shown = int(std::min(limit, std::size_t(particles)));
    taken_ = {};
    taken_.shown = std::size_t(shown);
    taken_.particles = std::size_t(particles);
    length_ = liquid.units().length;
    speed_ = liquid.units().of(dimensions::velocity);
    if (shown == 0) return;
    words_.resizeDiscarding(shown);
    extentOnHost_.resizeDiscarding(1);
    reduce(particles, ExtentOfParticle{liquid.position.span(), liquid.velocity.span()}, scratch_, extent_);
    forEach
    (
        shown,
        QuantiseParticles{particles, shown, liquid.position.span(), liquid.velocity.span(), extent_.span(), words_.data(), extentOnHost_.data()}
    );
    done_.resize(1);
    behind_.ask(done_);
}

QuantisedLiquid::Taken QuantisedLiquid::take()
{
    if (taken_.shown == 0 || taken_.words) return taken_;
    behind_.wait();
    const LiquidExtent& extent = *extentOnHost_.data();
    const auto place = [&](Place p) { return Vector3{quanta::lengthOf(p.x) * length_, quanta::lengthOf(p.y) * length_, quanta::lengthOf(p.z) * length_}; };
    taken_.words = words_.data();
    taken_.low = place(extent.low);
    taken_.high = place(extent.high);
    taken_.mostSpeed = std::sqrt(double(extent.mostSpeed2)) * speed_;
    return taken_;
}

}
