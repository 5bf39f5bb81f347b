// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/smoothing/SmoothingControls.H"

namespace shizuku
{

namespace
{

void refuseOutOfRange(const Dictionary& coeffs, const std::string& entry, const std::string& expected)
{
    throw FatalInputError(coeffs.where(entry), "Coefficient " + entry + " is out of range", expected);
}

// What is given in capillary steps.
void requireTension(const Dictionary& coeffs, const std::string& entry, double value, const Liquid& liquid)
{
    if (value == 0 || liquid.properties().surfaceTension > 0) return;
    throw FatalInputError
    (
        coeffs.where(entry), "There is no capillary step without a surface tension",
        entry + " 0, or a sigma in constant/liquidProperties"
    );
}

}

scalar shareOf(const Dictionary& coeffs, const std::string& entry, double fallback)
{
    const double share = coeffs.lookupOr(entry, fallback);
    if (!(share >= 0 && share <= 1)) refuseOutOfRange(coeffs, entry, "0 to 1");
    return scalar(share);
}

SmoothingControls::SmoothingControls(const Dictionary& coeffs, const Liquid& liquid, const SmoothingDefaults& defaults, bool atWalls)
:
    c_(shareOf(coeffs, "c", defaults.c)),
    perCapillaryStep_(shareOf(coeffs, "perCapillaryStep", liquid.properties().surfaceTension > 0 ? defaults.perCapillaryStep : 0)),
    capillaryStep_(liquid.units().toScaled(liquid.properties().capillaryStep(), dimensions::time))
{
    const double usual = liquid.properties().surfaceTension > 0 ? defaults.slipAbove : 0;
    const double slips = atWalls ? coeffs.lookupOr("slipAbove", usual) : 0;
    if (!(slips >= 0)) refuseOutOfRange(coeffs, "slipAbove", "0 or more, spacings a capillary step");
    requireTension(coeffs, "perCapillaryStep", perCapillaryStep_, liquid);
    requireTension(coeffs, "slipAbove", slips, liquid);
    if (slips > 0) slipAbove_ = scalar(slips) * liquid.spacing() / capillaryStep_;
}

scalar SmoothingControls::share(scalar dt) const
{
    return scalar(smoothingShare(c_, perCapillaryStep_, dt / capillaryStep_));
}

}
