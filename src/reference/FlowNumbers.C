// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/FlowNumbers.H"

#include <cmath>
#include <numbers>
#include <sstream>

namespace shizuku
{

namespace
{

double ratio(double a, double b) { return a == 0 ? 0 : a/b; }

}

FlowNumbers flowNumbers(const FlowScales& s)
{
    return
    {
        ratio(s.density*s.gravity*s.length*s.length, s.surfaceTension),
        ratio(s.density*s.speed*s.speed*s.length, s.surfaceTension),
        ratio(s.speed*s.length, s.viscosity),
        ratio(s.density*s.viscosity*s.speed, s.surfaceTension),
        std::sqrt(ratio(s.density*s.viscosity*s.viscosity, s.surfaceTension*s.length))
    };
}

double capillarySpeed(double surfaceTension, double density, double volume)
{
    return std::sqrt(surfaceTension/(density*std::cbrt(3*volume/(4*std::numbers::pi))));
}

std::string describe(const FlowScales& scales)
{
    const FlowNumbers n = flowNumbers(scales);
    const bool tension = scales.surfaceTension > 0, viscous = scales.viscosity > 0;
    std::ostringstream text;
    if (tension && !std::isnan(scales.gravity)) text << "Bond number rho g D^2/sigma " << n.bond << ", ";
    if (tension) text << "Weber number rho U^2 D/sigma " << n.weber;
    if (tension && viscous)
    {
        text << ", Ohnesorge number nu sqrt(rho/(sigma D)) " << n.ohnesorge << ", capillary number rho nu U/sigma "
             << n.capillary;
    }
    if (viscous) text << (tension ? ", " : "") << "Reynolds number U D/nu " << n.reynolds;
    return text.str();
}

}
