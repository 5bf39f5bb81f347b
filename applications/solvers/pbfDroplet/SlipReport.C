// SPDX-License-Identifier: GPL-3.0-or-later
#include "SlipReport.H"

#include "core/dictionary/Dictionary.H"

#include <sstream>

namespace shizuku
{

std::string slipReport(const Dictionary& models, double spacing)
{
    if (models.lookup<std::string>("viscosity") != "newtonian") return {};
    const Dictionary coeffs = models.subDictOrEmpty("newtonianCoeffs");
    if (!coeffs.lookupOr("noSlip", true)) return {};
    const double given = coeffs.lookupDimensionedOr("slipLength", dimensions::length, 0);
    std::ostringstream text;
    text << "Contact lines slip over ";
    if (given > spacing) text << given << " m, slipLength";
    else text << "up to a spacing, " << spacing << " m" << (given > 0 ? "; slipLength is shorter, and not resolved" : "");
    return text.str();
}

}
