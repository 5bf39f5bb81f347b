#include "DryRun.H"

#include "SubStep.H"

#include <chrono>
#include <cmath>
#include <iostream>

namespace shizuku
{

namespace
{

// Seconds of one sub-step. Memory is allocated and code loaded in the one before.
double timeSubStep(Liquid& liquid, Walls& walls, Models& models, float dt)
{
    Neighbourhood near(liquid);
    subStep(liquid, near, walls, models, dt);
    synchronize();
    const auto start = std::chrono::steady_clock::now();
    subStep(liquid, near, walls, models, dt);
    synchronize();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}

void reportDryRun
(
    const Time& time, const StepControl& control, Liquid& liquid, Walls& walls, Models& models,
    const DeviceInfo& device, double maxSpeed
)
{
    const SubSteps steps = control.divide(time.deltaT(), maxSpeed, liquid, models);
    const double left = std::max(0.0, time.endTime() - time.value());
    const double subSteps = std::max(0.0, std::ceil(left / time.deltaT() - 1e-9)) * steps.count;
    const double seconds = timeSubStep(liquid, walls, models, liquid.units().toScaled(steps.dt, dimensions::time));
    const double megabytes = deviceCounters().peakBytes / 1048576.0;
    std::cout
        << "\nDry run, nothing is written\n"
        << "memory on the device : " << megabytes << " MiB of " << device.memoryBytes / 1048576.0 << " MiB ("
        << deviceCounters().peakBytes / std::max(1, liquid.owned()) << " bytes a liquid particle)\n"
        << "steps                : " << subSteps << " of " << steps.dt << " s, limited by " << steps.limit << '\n'
        << "time a step          : " << 1e3 * seconds << " ms, measured on the first steps\n"
        << "estimated time       : " << seconds * subSteps << " s" << std::endl;
}

}
