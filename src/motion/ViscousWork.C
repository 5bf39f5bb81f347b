// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/ViscousWork.H"

namespace shizuku
{

namespace
{

struct Sums
{
    SpeedSquares before, behind, dissipated;

    void add(const Sums& other)
    {
        before.add(other.before);
        behind.add(other.behind);
        dissipated.add(other.dissipated);
    }
};

struct ValueOf
{
    Span<const scalar> taken;

    HOST_DEVICE SpeedSquares operator()(int i) const { return {wideQuanta(taken[i]), 1}; }
};

}

void ViscousWork::before(const Liquid& liquid)
{
    before_.add(liquid.owned(), SpeedSquareOf{liquid.velocity.span()});
}

void ViscousWork::behind(const Liquid& liquid, const std::optional<Buffer<scalar>>& dissipation)
{
    behind_.add(liquid.owned(), SpeedSquareOf{liquid.velocity.span()});
    isToldApart_ = dissipation.has_value();
    if (isToldApart_) dissipated_.add(liquid.owned(), ValueOf{dissipation->span()});
}

void ViscousWork::addTo(Liquid& liquid)
{
    before_.ask();
    behind_.ask();
    dissipated_.ask();
    const Sums sums = liquid.parts().fold(Sums{before_.take(), behind_.take(), dissipated_.take()});
    const double unit = liquid.units().of(dimensions::velocity), joules = 0.5 * liquid.properties().particleMass() * unit * unit;
    const double taken = valueOf(sums.before.sum) - valueOf(sums.behind.sum), ofLiquid = isToldApart_ ? valueOf(sums.dissipated.sum) : taken;
    liquid.number(number, 0) += joules * ofLiquid;
    liquid.number(ofFilter, 0) += joules * (taken - ofLiquid);
}

}
