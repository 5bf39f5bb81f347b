#include "DryRun.H"

#include "motion/Motion.H"

#include <chrono>
#include <cmath>
#include <iostream>

namespace shizuku
{

namespace
{

// Seconds of one step's neighbour search, forces and pressure at the start positions.
double timeOneStep(Liquid& liquid, Walls& walls, Models& models, float dt)
{
    const auto step = [&](Neighbourhood& near)
    {
        predictPositions(liquid, dt);
        near.update(liquid);
        walls.update(liquid);
        models.forces.applyBeforeIterations(liquid, near, walls, dt);
        models.pressure->begin();
        while (models.pressure->violated(liquid, near, walls)) models.pressure->correct(liquid, near, walls);
        synchronize();
    };
    Neighbourhood near(liquid);
    step(near);                         // memory is allocated and code loaded here
    const auto start = std::chrono::steady_clock::now();
    step(near);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}

void reportDryRun
(
    const Time& time, const StepControl& control, Liquid& liquid, Walls& walls, Models& models,
    const DeviceInfo& device, const LiquidState& state
)
{
    const SubSteps steps = control.divide(time.deltaT(), state.maxSpeed, liquid, models);
    const double left = std::max(0.0, time.endTime() - time.value());
    const double subSteps = std::max(0.0, std::ceil(left / time.deltaT() - 1e-9)) * steps.count;
    const double seconds = timeOneStep(liquid, walls, models, liquid.units().toScaled(steps.dt, dimensions::time));
    const double megabytes = deviceCounters().peakBytes / 1048576.0;
    std::cout
        << "\nDry run, nothing is written\n"
        << "memory on the device : " << megabytes << " MiB of " << device.memoryBytes / 1048576.0 << " MiB ("
        << deviceCounters().peakBytes / std::max(1, liquid.owned()) << " bytes a liquid particle)\n"
        << "steps                : " << subSteps << " of " << steps.dt << " s, limited by " << steps.limit << '\n'
        << "time a step          : " << 1e3 * seconds << " ms, measured on the start positions\n"
        << "estimated time       : " << seconds * subSteps << " s" << std::endl;
}

}
