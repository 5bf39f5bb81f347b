// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/pressure/shared/SoundSpeed.H"

#include "models/pressure/shared/IterationControls.H"

#include <cmath>

namespace shizuku
{

SoundSpeed SoundSpeed::read(const Dictionary& dict, const Liquid& liquid)
{
    const LiquidProperties& p = liquid.properties();
    const double variation = dict.lookupOr("maxDensityVariation", 0.01);
    refuseIf(!(variation > 0 && variation <= 0.5), dict, "maxDensityVariation", "more than 0, at most 0.5");
    const bool tension = p.surfaceTension > 0 && !dict.found("maxSpeed");
    const double speed = tension ? 2 * std::sqrt(p.surfaceTension / (p.density * p.spacing))
                                 : dict.lookupPositive("maxSpeed", dimensions::velocity);
    const double c = speed / std::sqrt(variation);
    return {c, 0.4 * 0.5 * liquid.units().toSI(liquid.support(), dimensions::length) / c, 0.3 * std::sqrt(variation)};
}

}
