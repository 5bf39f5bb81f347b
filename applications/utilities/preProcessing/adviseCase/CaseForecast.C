// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseForecast.H"

#include "core/arguments/runApplication.H"
#include "core/fieldFile/AtomicFile.H"
#include "device/KeptMemory.H"
#include "functionObjects/FunctionObjects.H"
#include "motion/SpeedMeter.H"
#include "particles/ParticleFiles.H"
#include "stepping/CaseSetup.H"

#include <algorithm>
#include <array>
#include <cmath>

namespace shizuku
{

namespace
{

// s, in the whole run. Time goes on as in the solver, so that those are counted that are due then; the liquid stays. The first
// time, which loads code and allocates memory, is no measure of the others.
double secondsOfFunctions(Time& time, FunctionObjects& functions, FlowView& flow, double dt)
{
    constexpr double timed = 0.2;
    const double left = std::max(0.0, time.endTime() - time.value());
    const double frames = std::ceil(left / time.deltaT() - 1e-9);
    double first = 0, others = 0;
    int count = 0;
    for (; count < frames && (count < 2 || first + others < timed); ++count)
    {
        const double begun = clockTime();
        time.advance();
        flow.moved(dt);
        functions.execute(flow);
        (count == 0 ? first : others) += clockTime() - begun;
    }
    return count > 1 ? first + others * (frames - 1) / (count - 1) : first;
}

// s, of the particles into a folder of the trial that is no time: the median of several, as a disk may be busy once.
double secondsOfWriting(const TrialCase& trial, const Time& time, FlowView& flow)
{
    std::array<double, 5> seconds{};
    for (std::size_t i = 0; i < seconds.size(); ++i)
    {
        const double begun = clockTime();
        ParticleWriter fields;
        const std::string name = "writing" + std::to_string(i);
        writeFolderAtomically(trial.path() / name, fields.copy(flow.liquid(), flow.liquid().units(), time.format()));
        seconds[i] = clockTime() - begun;
    }
    std::sort(seconds.begin(), seconds.end());
    return seconds[seconds.size() / 2];
}

int writesOf(const std::filesystem::path& casePath)
{
    Time time(casePath);
    int writes = 0;
    while (time.running())
    {
        time.advance();
        if (time.writeDue()) ++writes;
    }
    return writes;
}

}

CaseForecast forecastCase(const TrialCase& trial, const std::vector<std::string>& backend, double measuredFor)
{
    const std::filesystem::path& casePath = trial.path();
    device::dropKeptMemory();                                   // the solver may need it
    const SolverStart start = startSolver(trial, backend, measuredFor);
    deviceCounters().peakBytes = deviceCounters().bytes;        // of this case alone
    Time time(casePath);
    CaseSetup setup(casePath);
    setup.make(time.value());
    Liquid& liquid = *setup.liquid;
    Walls& walls = *setup.walls;
    Models& models = *setup.models;
    FunctionObjects functions(time, liquid.properties().spacing, !trial.withoutSolid());
    setup.readParticles(time);
    measureCrowding(liquid);        // as the solver does, for its time
    device::dropKeptMemory();
    Neighbourhood near(liquid);
    setup.relaxOverlap(time, near);
    FlowView flow(time, liquid, near, walls, models);
    functions.modelsMade(flow);

    const StepControl control(time.controlDict());
    SpeedMeter meter;
    const double speed = meter.measure(liquid).now;
    const auto limits = control.limits(time.deltaT(), speed, liquid, models);
    const RunForecast run = forecastRun(time, control, liquid, near, walls, models, speed, measuredFor);
    const double firstStep = std::max(0.0, run.firstSubStep - run.secondsPerSubStep);
    const double functionsTime = secondsOfFunctions(time, functions, flow, run.subStep.dt);
    return
    {
        run, limits, liquid.owned(), walls.particles(), start, firstStep, functionsTime, writesOf(casePath),
        secondsOfWriting(trial, time, flow)
    };
}

double CaseForecast::waiting(double computing) const
{
    if (writes == 0) return 0;
    return writing + (writes - 1) * std::max(0.0, writing - computing / writes);
}

}
