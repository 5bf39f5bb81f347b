#include "StepControl.H"

#include <cmath>
#include <sstream>

namespace shizuku
{

StepControl::StepControl(const Dictionary& controlDict)
:
    adjust_(controlDict.lookupOr("adjustTimeStep", true)),
    maxCo_(controlDict.lookupOr("maxCo", 0.5)),
    maxCapillaryCo_(controlDict.lookupOr("maxCapillaryCo", 0.3)),
    maxSubSteps_(controlDict.lookupOr("maxSubSteps", 1000))
{}

SubSteps StepControl::divide(double deltaT, double maxSpeed, const Liquid& liquid, const Models& models) const
{
    SubSteps steps{1, deltaT, "deltaT"};
    if (!adjust_) return steps;

    constexpr double pi = 3.14159265358979323846;
    const LiquidProperties& p = liquid.properties();
    const auto limit = [&](double dt, const std::string& name)
    {
        if (dt < steps.dt)
        {
            steps.dt = dt;
            steps.limit = name;
        }
    };
    const double speed = maxSpeed + models.bodyForce->acceleration() * deltaT;
    if (speed > 0) limit(maxCo_ * p.spacing / speed, "Courant");
    if (models.forces.active() && p.surfaceTension > 0)
    {
        limit(maxCapillaryCo_ * std::sqrt(p.particleMass() / (2 * pi * p.surfaceTension)), "capillary");
    }
    limit(models.viscosity->stepLimit(p), "viscous");

    const double count = std::ceil(deltaT / steps.dt * (1 - 1e-9));
    if (!(count <= maxSubSteps_))
    {
        std::ostringstream text;
        text << "The step of " << deltaT << " s would need " << count << " sub-steps (" << steps.limit
             << " limit), more than maxSubSteps " << maxSubSteps_ << ".\n    The liquid moves at up to " << maxSpeed
             << " m/s; where that is absurd, the run is diverging.\n"
             << "    Reduce deltaT, or raise maxSubSteps in system/controlDict.";
        throw FatalError(text.str());
    }
    steps.count = std::max(1, int(count));
    steps.dt = deltaT / steps.count;
    return steps;
}

}
