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
    text << "Contact lines slip over ";
    if (given > 0) text << given << " m, slipLength" << (given < spacing ? "; what lies between it and a spacing holds them as a drag" : "");
    else text << "up to a spacing, " << spacing << " m; a slipLength above 0 in newtonianCoeffs would be the liquid's own";
    return text.str();
}

}
