// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/StepControl.H"

#include "core/time/Controls.H"

#include <cmath>
#include <sstream>
#include <utility>

namespace shizuku
{

StepControl::StepControl(const Dictionary& controlDict)
:
    adjust_(controlDict.lookupOr("adjustTimeStep", true)),
    maxCo_(controlDict.lookupOr("maxCo", 0.5)),
    maxCapillaryCo_(controlDict.lookupOr("maxCapillaryCo", usualCapillaryCo)),
    restCapillaryCo_(std::max(maxCapillaryCo_, controlDict.lookupOr("restCapillaryCo", 0.0))),
    capillaryCo_(maxCapillaryCo_),
    maxSubSteps_(controlDict.lookupOr("maxSubSteps", 1000)),
    where_(controlDict.where("deltaT"))
{}

std::vector<StepLimit> StepControl::limits
(
    double deltaT, double maxSpeed, const Liquid& liquid, const Models& models
) const
{
    if (!adjust_) return {};

    const LiquidProperties& p = liquid.properties();
    std::vector<StepLimit> limits;
    const double speed = maxSpeed + models.bodyForce->acceleration() * deltaT;
    if (speed > 0) limits.push_back({"Courant", maxCo_ * p.spacing / speed});
    if (models.forces.active() && p.surfaceTension > 0)
    {
        limits.push_back({"capillary", capillaryCo_ * p.capillaryStep()});
    }
    const std::pair<const char*, double> ofModels[] =
    {
        {"tension", models.forces.tension().stepLimit(p)}, {"viscous", models.viscosity->stepLimit(p)}, {"acoustic", models.pressure->stepLimit(p)}
    };
    for (const auto& [name, dt] : ofModels)
    {
        if (std::isfinite(dt)) limits.push_back({name, dt});
    }
    return limits;
}

// Long steps take ten times what water takes of a swing. So the liquid moves little in them.
double StepControl::follow(double last, double maxSpeed, const LiquidProperties& properties) const
{
    constexpr double little = 0.0125, much = 4 * little;         // spacings
    const double moved = maxSpeed * restCapillaryCo_ * properties.capillaryStep() / properties.spacing;
    if (moved > much) return maxCapillaryCo_;
    return moved < little ? restCapillaryCo_ : last;
}

SubSteps StepControl::divide(double deltaT, double maxSpeed, const Liquid& liquid, const Models& models) const
{
    SubSteps steps{1, deltaT, "deltaT"};
    for (const StepLimit& limit : limits(deltaT, maxSpeed, liquid, models))
    {
        if (!(limit.dt < steps.dt)) continue;
        steps.dt = limit.dt;
        steps.limit = limit.name;
    }
    if (!adjust_) return steps;

    const double count = std::ceil(deltaT / steps.dt * (1 - 1e-9));
    if (!(count <= maxSubSteps_))
    {
        std::ostringstream text;
        text << "The step of " << deltaT << " s would need " << count << " sub-steps (" << steps.limit
             << " limit), more than maxSubSteps " << maxSubSteps_ << '.';
        std::ostringstream expected;
        expected << "a deltaT of " << maxSubSteps_*steps.dt << " s at most, or a larger maxSubSteps, in system/controlDict.\n"
                 << "    The liquid, or a wall at it, moves at up to " << maxSpeed << " m/s; where that is absurd, the run is diverging";
        throw FatalInputError(where_, text.str(), expected.str());
    }
    steps.count = std::max(1, int(count));
    steps.dt = deltaT / steps.count;
    return steps;
}

}
