// SPDX-License-Identifier: GPL-3.0-or-later
#include "SlipReport.H"

#include "core/dictionary/Dictionary.H"
#include "models/viscosity/newtonian/SlipLength.H"

#include <sstream>

namespace shizuku
{

std::string slipReport(const Dictionary& models, double spacing)
{
    if (models.lookup<std::string>("viscosity") != "newtonian") return {};
    const Dictionary coeffs = models.subDictOrEmpty("newtonianCoeffs");
    if (!coeffs.lookupOr("noSlip", true)) return {};
    const double given = coeffs.lookupDimensionedOr("slipLength", dimensions::length, usualSlipLength);
    std::ostringstream text;
    if (given > 0) text << "Slip length " << given << " m (slipLength)" << (given < spacing ? ", below the spacing: the drag on contact lines is modelled" : "");
    else text << "Contact lines slip freely, over up to a spacing of " << spacing << " m: set slipLength in newtonianCoeffs to model their drag";
    return text.str();
}

}
