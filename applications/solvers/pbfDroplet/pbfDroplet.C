// SPDX-License-Identifier: GPL-3.0-or-later
// pbfDroplet: liquid with surface tension on wettable solids, by position based fluids.
//
// The time loop, with the sub-step in src/stepping/SubStep.C, is the algorithm. What each line computes, and from which
// paper, stands in the header it comes from.

#include "CaseChanges.H"
#include "CaseWriter.H"
#include "Divergence.H"
#include "FallenLiquid.H"
#include "LiveView.H"
#include "ProfileReport.H"
#include "SameFiles.H"
#include "StepReport.H"
#include "core/arguments/StopSignals.H"
#include "core/arguments/runApplication.H"
#include "core/time/CaseLock.H"
#include "device/DeviceApplication.H"
#include "device/Processors.H"
#include "device/Sharing.H"
#include "functionObjects/FunctionObjects.H"
#include "functionObjects/ModelList.H"
#include "parallel/ParallelRun.H"
#include "stepping/Balance.H"
#include "stepping/DryRun.H"
#include "stepping/TimeStep.H"

#include <iostream>
#include <optional>

namespace shizuku
{

namespace
{

// Part 0 prints, and has the function objects: what these look at is gathered there. Each part writes its share of a time.
void pbfDroplet(const Arguments& args, const Communicator& parts)
{
    const bool isCut = parts.parts() > 1, isFirst = parts.part() == 0;
    shareProcessors(parts.partsOfHost());
    const DeviceInfo device = openNamedDevice(parts.partOfHost());
    warnOfSharedDevices(device, parts);

    Time time(args.casePath(), isFirst);
    CaseChanges changes(time);
    CaseSetup setup(args.casePath());
    setup.make(time.value());
    if (isCut) setup.models->refuseParts();
    const BalanceControls cutting = BalanceControls::read(args.casePath());
    FunctionObjects functions(time, setup.liquid->properties().spacing, !args.found("noFunctionObjects"));
    Liquid& liquid = *setup.liquid;
    Neighbourhood near(liquid);
    Balance balance(cutting);
    if (isCut) liquid.ghosts().join(parts);
    setup.readParticles(time);
    if (isCut) balance.begin(liquid, near);
    const auto cutWalls = [&] { if (isCut && !cutting.sameBits) setup.walls->cut(balance.cut().rowsOf(parts.part()), near.grid().view()); };
    cutWalls();
    FlowView flow(time, liquid, near, *setup.walls, *setup.models);
    if (isCut) flow.cut(isFirst ? setup.emptyLiquid() : nullptr, cutting.sameBits);
    if (cutting.sameBits) shareAsOf(flow.particles());
    setup.refuseBadStart(time);
    reportRelaxation(setup.relaxOverlap(time, near));
    functions.modelsMade(flow);
    TimeStep step(time, setup, near);
    reportStart(flow, liquid);
    limitStepsOfBlobs(flow, liquid, step);
    FallenLiquid fallen(setup);
    if (args.found("dry-run")) return reportDryRun(time, step.control(), liquid, near, *setup.walls, *setup.models, device, step.speeds().now);

    std::optional<CaseLock> alone;
    if (isFirst) alone.emplace(args.casePath());
    if (time.index() == 0) step.settle();
    CaseWriter writer(parts);
    ProfileReport profile(args.found("profile"));
    const StopSignals signals;
    LiveView view(args, time, liquid, flow);
    reportReady(time);
    stopWhereAsked(time, functions, parts);             // by the step that the run goes on from
    Interruption interruption;
    while (time.running())
    {
        view.attend(time, functions, signals);
        if (readIfModified(time, parts)) step.readControls();
        if (changes.apply(time, setup))
        {
            step.beginAnew();
            functions.modelsMade(flow);
        }
        const SubSteps steps = divideOrRefuse(time, step, setup, writer);
        const double from = time.value();
        setup.population->beginStep(liquid, from, time.deltaT());
        time.advance();
        balance.keep(liquid, near);
        cutWalls();
        step.make(steps);
        flow.moved(steps.dt);
        interruption = stopWhereSignalled(time, signals, parts);
        const bool densitiesAreDue = time.reportDue() || functions.lookAtDensities(time);
        if (densitiesAreDue) flow.computeDensities();
        changePopulation(setup, near, flow, time, from, device);
        if (time.reportDue()) fallen.warn(liquid);
        step.beginNext(steps);
        refuseDivergence(time, steps, step, setup, writer);

        if (time.writeDue()) setup.models->pressure->complete();
        if (isCut && densitiesAreDue) flow.state();
        if (functions.lookAtParticles(time)) flow.gather();
        if (functions.lookAtSurface(time)) flow.gatherSurface(functions.lookAtWholeSurface(time));
        functions.execute(flow);
        stopWhereAsked(time, functions, parts);
        if (isFirst && time.reportDue()) reportStep(steps, flow, *setup.population, functions);
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
        .summary = "Liquid with surface tension on wettable solids, by position based fluids.",
        .options =
        {
            deviceOption(),
            precisionOption(),
            parallelOption("pbfDroplet"),
            {"dry-run", "", "read and check everything, print memory and cost, run nothing", ""},
            {"profile", "", "print what each kernel took, per sub-step, at the end", ""},
            {"noFunctionObjects", "", "leave out the function objects of system/controlDict", ""},
            {"view", "", "show the run in a browser: serve a page at 127.0.0.1, whose address is printed", ""},
            {"viewAt", "[ADDRESS:]PORT", "the same, at this port, for a browser elsewhere or ssh -L", ""}
        },
        .models = modelList
    };
    return runInParts(argc, argv, [&](const Communicator& parts)
    {
        return runApplication(argc, argv, info, [&](const Arguments& args) { pbfDroplet(args, parts); });
    });
}
