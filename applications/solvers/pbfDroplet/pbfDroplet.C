// SPDX-License-Identifier: GPL-3.0-or-later
// pbfDroplet: liquid with surface tension on wettable solids, by position based fluids.
//
// The time loop, with the sub-step in src/stepping/SubStep.C, is the algorithm. What each line computes, and from which
// paper, stands in the header it comes from.

#include "CaseSeries.H"
#include "CaseWriter.H"
#include "Divergence.H"
#include "FallenLiquid.H"
#include "LiveView.H"
#include "PreparedCase.H"
#include "ProfileReport.H"
#include "SameFiles.H"
#include "StartWarnings.H"
#include "StepReport.H"
#include "core/arguments/StopSignals.H"
#include "core/arguments/runApplication.H"
#include "device/DeviceApplication.H"
#include "device/Processors.H"
#include "functionObjects/ModelList.H"
#include "parallel/ParallelRun.H"
#include "stepping/DryRun.H"
#include "stepping/TimeStep.H"

#include <iostream>

namespace shizuku
{

namespace
{

// What the models were asked for before they changed does not hold.
void takeNewModels(TimeStep& step, FunctionObjects& functions, FlowView& flow)
{
    step.dropPrepared();
    functions.modelsMade(flow);
}

// Threads and device of this part.
DeviceInfo openDevice(const Communicator& parts)
{
    shareProcessors(parts.partsOfHost());
    DeviceInfo device = openNamedDevice(parts.partOfHost());
    warnOfSharedDevices(device, parts);
    return device;
}

void countWhatIsLookedAt(const FunctionObjects& functions, TimeStep& step)
{
    if (functions.lookAtViscousWork()) step.countViscousWork();
    if (functions.lookAtWallReactions()) step.countWallReactions();
}

// Where what is suspect is said.
void warnIfDue(const Time& time, const Liquid& liquid, FallenLiquid& fallen, StartWarnings& warnings)
{
    if (!time.reportDue()) return;
    fallen.warn(liquid);
    warnings.print();
}

void pbfDroplet(const Arguments& args, const Communicator& parts)
{
    const DeviceInfo device = openDevice(parts);
    PreparedCase prepared(args.casePath(), parts, !args.found("noFunctionObjects"));
    auto& [time, changes, setup, run, functions, near, flow] = prepared;
    Liquid& liquid = *setup.liquid;
    TimeStep step(time, setup, near);
    reportStart(flow);
    StartWarnings warnings(flow, liquid);
    FallenLiquid fallen(setup);
    limitStepsOfBlobs(flow, liquid, step);
    countWhatIsLookedAt(functions, step);
    if (args.found("dry-run")) return reportDryRun(time, step.control(), liquid, near, *setup.walls, *setup.models, device, step.speeds().now);

    run.lockCase();
    if (time.index() == 0) step.settle();
    CaseWriter writer(parts);
    ProfileReport profile(args.found("profile"));
    const StopSignals signals;
    LiveView view(args, time, liquid, flow);
    warnings.printIfSoon();
    reportReady(time);
    stopWhereAsked(time, functions, parts);             // by the step that the run goes on from
    Interruption interruption;
    while (time.running())
    {
        view.attend(time, functions, signals);
        if (readIfModified(time, parts)) step.readControls();
        if (changes.apply(time, setup)) takeNewModels(step, functions, flow);
        const SubSteps steps = divideOrRefuse(time, step, setup, writer);
        const double from = time.value();
        setup.population->beginStep(liquid, from, time.deltaT());
        time.advance();
        run.keepBalance(near);

        step.make(steps, from);
        if (steps.count > 0) flow.moved(steps.dt);
        interruption = stopWhereSignalled(time, signals, parts);
        const bool densities = time.reportDue() || functions.lookAtDensities(time);
        if (densities) flow.computeDensities();
        changePopulation(setup, near, flow, time, from, device);
        warnIfDue(time, liquid, fallen, warnings);
        step.prepareNext(steps);
        refuseDivergence(time, steps, step, setup, writer);

        if (time.writeDue()) setup.models->pressure->complete();
        run.gather(flow, functions, time, densities);
        functions.execute(flow);
        stopWhereAsked(time, functions, parts);
        if (run.isFirst() && time.reportDue()) reportStep(steps, flow, *setup.population, functions);
        writer.write(time, flow, changes, functions);
        profile.count(steps.count);
    }
    view.attend(time, functions, signals);              // the last state
    writer.finish();
    reportCosts(liquid, writer);
    profile.report(liquid, near);
    endWhereInterrupted(interruption, parts);
}

}

}

extern "C" int runOnDevice(int argc, char** argv)
{
    using namespace shizuku;
    const ApplicationInfo info
    {
        .name = "pbfDroplet",
        .summary = "Compute liquid with surface tension on wettable solids by position based fluids. Cases that are given run one after another in this process, each with its log.pbfDroplet.",
        .options =
        {
            deviceOption(),
            precisionOption(),
            parallelOption("pbfDroplet"),
            {"dry-run", "", "Read and check the case, print memory and cost, run nothing", ""},
            {"profile", "", "Print the time of each kernel in a sub-step at the end", ""},
            {"noFunctionObjects", "", "Run without the function objects of system/controlDict", ""},
            {"view", "", "Show the run in a browser; the address of the page is printed", ""},
            {"viewAt", "[ADDRESS:]PORT", "The same at this address and port, for another machine or ssh -L", ""}
        },
        .positional = {"cases..."},
        .models = modelList
    };
    return runInParts(argc, argv, [&](const Communicator& parts)
    {
        return runApplication(argc, argv, info, [&](const Arguments& args)
        {
            const auto runOne = [&](const Arguments& each) { pbfDroplet(each, parts); };
            if (args.givesCases()) runSeries(args, runOne);
            else runOne(args);
        });
    });
}
