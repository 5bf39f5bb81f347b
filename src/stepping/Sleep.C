// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/Sleep.H"

#include "reference/FlowNumbers.H"

#include <cmath>

namespace shizuku
{

Sleep::Sleep(const Dictionary& controlDict, Liquid& liquid)
{
    const Dictionary& dict = controlDict.subDict("sleep");
    below_ = dict.lookup<double>("below");
    for_ = dict.lookupDimensioned("for", dimensions::time);
    calmFor_ = &liquid.number("calmFor", 0);
    if (liquid.properties().surfaceTension > 0) return;
    throw FatalInputError
    (
        controlDict.where("sleep"), "Liquid without surface tension has no capillary speed, in which `sleep` measures rest",
        "sigma above 0 in constant/liquidProperties, or no `sleep`"
    );
}

void Sleep::look(const Liquid& liquid, double deltaT, bool wallsMove)
{
    const LiquidProperties& p = liquid.properties();
    const SpeedSquares squares = liquid.parts().fold(reduce(liquid.owned(), SpeedSquareOf{liquid.velocity.span()}, scratch_));
    const double n = double(squares.particles), unit = liquid.units().of(dimensions::velocity);
    const bool isCalm = n > 0 && std::sqrt(valueOf(squares.sum) / n) * unit < below_ * capillarySpeed(p.surfaceTension, p.density, n * p.particleVolume());
    *calmFor_ = isCalm && !wallsMove ? *calmFor_ + deltaT : 0;
}

}
