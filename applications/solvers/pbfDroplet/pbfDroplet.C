// pbfDroplet: liquid with surface tension on wettable solids, by position based fluids.
//
// The time loop, with the sub-step in src/stepping/SubStep.C, is the algorithm. What each line computes, and from which
// paper, stands in the header it comes from.

#include "CaseChanges.H"
#include "ProfileReport.H"
#include "StepReport.H"
#include "core/arguments/runApplication.H"
#include "core/fieldFile/BackgroundWriter.H"
#include "core/time/CaseLock.H"
#include "device/DeviceApplication.H"
#include "functionObjects/FunctionObjects.H"
#include "motion/SpeedMeter.H"
#include "particles/ParticleFiles.H"
#include "stepping/DryRun.H"
#include "stepping/StartCheck.H"
#include "stepping/StepControl.H"
#include "stepping/SubStep.H"

#include <iostream>
#include <optional>

namespace shizuku
{

namespace
{

void pbfDroplet(const Arguments& args)
{
    const DeviceInfo device = openNamedDevice();

    Time time(args.casePath());
    CaseChanges changes(time);
    const Dictionary solution = Dictionary::read(args.casePath() / "system/solution");
    const Dictionary liquidDict = Dictionary::read(args.casePath() / "constant/liquidProperties");

    Liquid liquid(LiquidProperties::read(solution, liquidDict), solution.subDictOrEmpty("kernel"));
    Walls walls(args.casePath(), time.value(), liquid);
    Models models(args.casePath(), solution, liquid, walls);
    models.takeEffect(liquid, walls);
    StepControl control(time.controlDict());
    FunctionObjects functions(time, liquid.properties().spacing, !args.found("noFunctionObjects"));
    const bool relaxes = relaxesOverlap(solution);
    solution.refuseUnused();
    liquidDict.refuseUnused();

    liquid.read(time.path());
    const StartLimits limits = StartLimits::of(time.index(), *models.pressure);
    if (!relaxes) refuseOverlap(liquid, time.path(), limits);
    if (time.index() == 0) walls.refuseLiquidInside(liquid);
    Neighbourhood near(liquid);
    if (relaxes) reportRelaxation(relaxOverlap(liquid, near, walls, limits));
    FlowView flow(time, liquid, near, walls, models);
    if (time.index() == 0) warnOfResolution(flow);
    warnOfOtherSolid(time, walls);
    functions.modelsMade(flow);
    const bool calm = needsCalmSteps(flow, control);
    if (calm) control.capCapillary(calmCapillaryCo);
    SpeedMeter meter;
    Speeds speeds = meter.measure(liquid);
    std::cout << "Liquid particles " << liquid.owned() << ", solid particles " << walls.particles()
              << ", analytic surfaces " << walls.surfaces() << std::endl;

    if (args.found("dry-run")) return reportDryRun(time, control, liquid, walls, models, device, speeds.now);

    const CaseLock alone(args.casePath());
    const auto subSteps = [&] { return control.divide(time.deltaT(), speeds.now, liquid, models); };
    const auto scaled = [&](const SubSteps& steps) { return liquid.units().toScaled(steps.dt, dimensions::time); };
    if (time.index() == 0) settle(liquid, near, walls, models, scaled(subSteps()));

    std::optional<ProfileReport> profile;
    if (args.found("profile")) profile.emplace();
    std::cout << "Ready for the first step after " << clockTime() << " s" << std::endl;
    SubStep subStep(liquid, near, walls, models);
    ParticleWriter fields;
    BackgroundWriter writer;
    while (time.running())
    {
        if (time.readIfModified())
        {
            control = StepControl(time.controlDict());
            if (calm) control.capCapillary(calmCapillaryCo);
        }
        if (changes.apply(time, liquid, walls, models))
        {
            subStep.beginAnew();
            functions.modelsMade(flow);
        }
        const SubSteps steps = subSteps();
        const scalar dt = scaled(steps);
        time.advance();

        for (int step = 0; step < steps.count; ++step)
        {
            subStep(dt);
            if (step + 1 < steps.count) meter.watch(liquid);
        }
        flow.moved(steps.dt);
        if (time.reportDue() || functions.lookAtDensities(time)) flow.computeDensities();
        meter.ask(liquid);
        subStep.begin(dt);                              // mostly the next one is as long
        speeds = meter.take(liquid);
        refuseDivergence(time, steps, liquid.properties().spacing, speeds, writer);

        functions.execute(flow);
        stopWhereAsked(time, functions);
        if (time.reportDue()) reportStep(steps, flow);
        if (time.writeDue())
        {
            models.pressure->complete();
            const auto particles = fields.copy(flow.liquid(), liquid.units(), time.format());
            const auto theta = changes.writingTheta(time.format());
            writer.add(time.writing([=](const std::filesystem::path& folder)
            {
                particles(folder);
                theta(folder);
            }));
        }
        functions.write(time, writer);
        writer.start();
        if (profile) profile->count(steps.count);
    }
    writer.finish();
    reportCosts(liquid, writer);
    if (profile) profile->report(liquid, near);
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
            }
        },
        pbfDroplet
    );
}
