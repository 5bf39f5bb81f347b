#include "StepReport.H"

#include "core/arguments/runApplication.H"

#include <iostream>

namespace shizuku
{

void reportStep(const Time& time, const SubSteps& steps, const Models& models, const LiquidState& state)
{
    std::cout
        << "\nTime = " << time.name() << " s  (" << time.progress() << ")\n"
        << "deltaT = " << steps.dt << " s, " << steps.count << (steps.count > 1 ? " sub-steps" : " sub-step")
        << ", limited by " << steps.limit << '\n'
        << "pressure: iterations " << models.pressure->iterations()
        << ", density error average " << state.averageDensityError << ", maximum " << state.maxDensityError << '\n'
        << "volume = " << state.volume << " m3, kinetic energy = " << state.kineticEnergy
        << " J, max |U| = " << state.maxSpeed << " m/s\n"
        << executionTime() << std::endl;
}

void refuseDivergence(const Time& time, const LiquidState& state, const std::string& lastWritten)
{
    if (state.nonFinite == 0) return;
    throw FatalError
    (
        "The run diverged at time " + time.name() + " s: the position or velocity of "
      + std::to_string(state.nonFinite) + " particles is not a finite number.\n    The last good state is kept in "
      + lastWritten + ".\n    Try a smaller deltaT, maxCo or maxCapillaryCo in system/controlDict,"
        " or more iterations in system/solution."
    );
}

}
