// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/Pool.H"

#include "device/Reduce.H"

namespace shizuku
{

namespace
{

struct InPool
{
    double particles = 0;
    HOST_DEVICE void add(const InPool& other) { particles += other.particles; }
};

struct IsInPool
{
    Pool pool;
    Periods periods;
    Span<const Position> position;

    HOST_DEVICE InPool operator()(int i) const { return {pool.contains(placeOf(position[i]), periods) ? 1.0 : 0.0}; }
};

struct Top
{
    double height = -1;
    HOST_DEVICE void add(const Top& other) { height = other.height > height ? other.height : height; }
};

struct TopOver
{
    Pool pool;
    Periods periods;
    double column[3], apart;
    Span<const Position> position;

    HOST_DEVICE Top operator()(int i) const
    {
        const Place x = placeOf(position[i]);
        const double height = pool.heightOf(x, periods);
        if (height < 0 || height > 2*pool.half[pool.axis]) return {};
        const double p[] = {quanta::lengthOf(x.x), quanta::lengthOf(x.y), quanta::lengthOf(x.z)};
        double across2 = 0;
        for (int k = 0; k < 3; ++k)
        {
            const double d = periods.shortest(p[k] - column[k], k);
            if (k != pool.axis) across2 += d*d;
        }
        return {across2 < apart*apart ? height + sqrt(apart*apart - across2) : -1.0};
    }
};

}

double particlesIn(const Liquid& liquid, const Pool& pool, const Periods& periods)
{
    const double unit = liquid.units().length;
    Buffer<InPool> scratch;
    return liquid.parts().fold(reduce(liquid.owned(), IsInPool{pool.scaled(unit), periods.scaled(unit), liquid.position.span()}, scratch)).particles;
}

double restingHeight(const Liquid& liquid, const Pool& pool, const Periods& periods, const Vector3& column, double apart)
{
    const double unit = liquid.units().length;
    Buffer<Top> scratch;
    const TopOver over{pool.scaled(unit), periods.scaled(unit), {column.x/unit, column.y/unit, column.z/unit}, apart/unit, liquid.position.span()};
    return unit*liquid.parts().fold(reduce(liquid.owned(), over, scratch)).height;
}

}
