// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/ViscousWork.H"

namespace shizuku
{

namespace
{

struct Both
{
    SpeedSquares before, behind;

    void add(const Both& other)
    {
        before.add(other.before);
        behind.add(other.behind);
    }
};

}

void ViscousWork::before(const Liquid& liquid)
{
    before_.add(liquid.owned(), SpeedSquareOf{liquid.velocity.span()});
}

void ViscousWork::behind(const Liquid& liquid)
{
    behind_.add(liquid.owned(), SpeedSquareOf{liquid.velocity.span()});
}

void ViscousWork::addTo(Liquid& liquid)
{
    before_.ask();
    behind_.ask();
    const Both both = liquid.parts().fold(Both{before_.take(), behind_.take()});
    const double unit = liquid.units().of(dimensions::velocity);
    const double taken = valueOf(both.before.sum) - valueOf(both.behind.sum);
    liquid.number(number, 0) += 0.5 * liquid.properties().particleMass() * unit * unit * taken;
}

}
