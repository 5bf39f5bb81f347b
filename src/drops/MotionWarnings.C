// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/MotionWarnings.H"

#include <sstream>

namespace shizuku
{

namespace
{

constexpr double felt = 0.1;            // Ohnesorge number: a swing loses half of its height within one
constexpr double turning = 0.05;        // of the capillary speed, at the radius: far above what particles do at rest

}

std::vector<std::string> motionWarnings(const std::string& model, const std::vector<SeparateBody>& bodies, const FlowScales& liquid)
{
    std::vector<std::string> warnings;
    if (bodies.empty() || liquid.surfaceTension == 0 || (model != "none" && model != "XSPH")) return warnings;

    FlowScales scales = liquid;
    scales.length = bodies.front().diameter();
    if (const double ohnesorge = flowNumbers(scales).ohnesorge; ohnesorge >= felt)
    {
        std::ostringstream text;
        text << "nu, " << liquid.viscosity << " m2/s, does not act with viscosity " << model << ", and would be felt (Ohnesorge number "
             << ohnesorge << ")\n    viscosity laminar or newtonian takes it";
        warnings.push_back(text.str());
    }
    for (std::size_t i = 0; i < bodies.size() && model == "XSPH"; ++i)
    {
        const SeparateBody& body = bodies[i];
        const double speed = length(body.angularVelocity)*body.diameter()/2;
        if (speed < turning*capillarySpeed(liquid.surfaceTension, liquid.density, body.volume)) continue;
        std::ostringstream text;
        text << "body " << i + 1 << " of " << bodies.size() << " turns at " << length(body.angularVelocity)
             << " rad/s, which viscosity XSPH soon stops\n    viscosity newtonian lets liquid turn, longest with velocityCorrection keepsTurns";
        warnings.push_back(text.str());
        break;                          // one tells of all
    }
    return warnings;
}

}
