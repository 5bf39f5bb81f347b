// SPDX-License-Identifier: GPL-3.0-or-later
// pbfDroplet: liquid with surface tension on wettable solids, by position based fluids.
//
// The time loop, with the sub-step in src/stepping/SubStep.C, is the algorithm. What each line computes, and from which
// paper, stands in the header it comes from.

#include "CaseChanges.H"
#include "CaseWriter.H"
#include "ProfileReport.H"
#include "StepReport.H"
#include "core/arguments/StopSignals.H"
#include "core/arguments/runApplication.H"
#include "core/time/CaseLock.H"
#include "device/DeviceApplication.H"
#include "functionObjects/FunctionObjects.H"
#include "functionObjects/ModelList.H"
#include "stepping/DryRun.H"
#include "stepping/TimeStep.H"

#include <iostream>

namespace shizuku
{

namespace
{

void pbfDroplet(const Arguments& args)
{
    const DeviceInfo device = openNamedDevice();

    Time time(args.casePath());
    CaseChanges changes(time);
    CaseSetup setup(args.casePath());
    setup.make(time.value());
    FunctionObjects functions(time, setup.liquid->properties().spacing, !args.found("noFunctionObjects"));
    setup.readParticles(time);
    setup.refuseBadStart(time);

    Liquid& liquid = *setup.liquid;
    Neighbourhood near(liquid);
    reportRelaxation(setup.relaxOverlap(time, near));
    FlowView flow(time, liquid, near, *setup.walls, *setup.models);
    functions.modelsMade(flow);
    TimeStep step(time, setup, near);
    reportStart(flow);
    limitStepsOfBlobs(flow, step);
    if (args.found("dry-run")) return reportDryRun(time, step.control(), liquid, *setup.walls, *setup.models, device, step.speeds().now);

    const CaseLock alone(args.casePath());
    if (time.index() == 0) step.settle();
    CaseWriter writer;
    ProfileReport profile(args.found("profile"));
    const StopSignals signals;
    std::cout << "Ready for the first step after " << clockTime() << " s" << std::endl;
    stopWhereAsked(time, functions);                    // by the step that the run goes on from
    bool interrupted = false;
    while (time.running())
    {
        if (time.readIfModified()) step.readControls();
        if (changes.apply(time, setup))
        {
            step.beginAnew();
            functions.modelsMade(flow);
        }
        const SubSteps steps = step.divide();
        time.advance();
        step.make(steps);
        flow.moved(steps.dt);
        interrupted = stopWhereSignalled(time, signals);
        if (time.reportDue() || functions.lookAtDensities(time)) flow.computeDensities();
        step.beginNext(steps);
        refuseDivergence(time, steps, liquid.properties().spacing, step.speeds(), writer);

        functions.execute(flow);
        stopWhereAsked(time, functions);
        if (time.reportDue()) reportStep(steps, flow);
        writer.write(time, flow, changes, functions);
        profile.count(steps.count);
    }
    writer.finish();
    reportCosts(liquid, writer);
    profile.report(liquid, near);
    if (interrupted) signals.endIfReceived();
}

}

}

extern "C" int runOnDevice(int argc, char** argv)
{
    using namespace shizuku;
    return runApplication
    (
        argc, argv,
        {
            .name = "pbfDroplet",
            .summary = "Liquid with surface tension on wettable solids, by position based fluids.",
            .options =
            {
                deviceOption(),
                precisionOption(),
                {"dry-run", "", "read and check everything, print memory and cost, run nothing", ""},
                {"profile", "", "print what each kernel took, per sub-step, at the end", ""},
                {"noFunctionObjects", "", "leave out the function objects of system/controlDict", ""}
            },
            .models = modelList
        },
        pbfDroplet
    );
}
