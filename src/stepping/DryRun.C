// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/DryRun.H"

#include "stepping/SubStep.H"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace shizuku
{

namespace
{

double secondsOf(const std::function<void()>& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    synchronize();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// A line a part.
std::string ofParts(const std::vector<std::size_t>& bytes, const std::vector<int>& particles, const std::vector<int>& ghosts)
{
    std::ostringstream text;
    for (std::size_t part = 0; part < bytes.size(); ++part)
    {
        text << "    part " << std::left << std::setw(12) << part << ": " << particles[part] << " particles, " << ghosts[part] << " ghosts, " << bytes[part] / 1048576.0 << " MiB\n";
    }
    return text.str();
}

}

RunForecast forecastRun
(
    const Time& time, const StepControl& control, Liquid& liquid, Neighbourhood& near, Walls& walls, Models& models, double maxSpeed,
    double measuredFor
)
{
    RunForecast forecast;
    forecast.subStep = control.divide(time.deltaT(), maxSpeed, liquid, models);
    const double left = std::max(0.0, time.endTime() - time.value());
    forecast.subSteps = std::max(0.0, std::ceil(left / time.deltaT() - 1e-9)) * forecast.subStep.count;

    const scalar dt = liquid.units().toScaled(forecast.subStep.dt, dimensions::time);
    if (time.index() == 0) settle(liquid, near, walls, models, dt);
    SubStep subStep(liquid, near, walls, models);
    const auto step = [&] { subStep(dt, time.value()); };
    forecast.firstSubStep = secondsOf(step);
    double sum = 0;
    do
    {
        sum += secondsOf(step);
        ++forecast.measured;
    }
    while (sum < measuredFor && forecast.measured < forecast.subSteps);
    forecast.secondsPerSubStep = sum / forecast.measured;
    forecast.bytes = deviceCounters().peakBytes;
    return forecast;
}

void reportDryRun
(
    const Time& time, const StepControl& control, Liquid& liquid, Neighbourhood& near, Walls& walls, Models& models,
    const DeviceInfo& device, double maxSpeed
)
{
    const RunForecast forecast = forecastRun(time, control, liquid, near, walls, models, maxSpeed);
    const std::vector<std::size_t> bytes = liquid.parts().gather(forecast.bytes);
    const std::vector<int> particles = liquid.parts().gather(liquid.owned()), ghosts = liquid.parts().gather(liquid.all() - liquid.owned());
    const std::size_t most = std::max_element(bytes.begin(), bytes.end()) - bytes.begin();
    const double megabytes = bytes[most] / 1048576.0;
    std::cout
        << "\nDry run, nothing is written\n"
        << "memory on the device : " << megabytes << " MiB of " << device.memoryBytes / 1048576.0 << " MiB ("
        << bytes[most] / std::max(1, particles[most]) << " bytes a liquid particle)" << (bytes.size() > 1 ? ", of the part that needs most\n" : "\n")
        << (bytes.size() > 1 ? ofParts(bytes, particles, ghosts) : "")
        << "steps                : " << forecast.subSteps << " of " << forecast.subStep.dt << " s, limited by "
        << forecast.subStep.limit << '\n'
        << "time a step          : " << 1e3 * forecast.secondsPerSubStep << " ms, measured on the first steps\n"
        << "estimated time       : " << forecast.seconds() << " s" << std::endl;
}

}
