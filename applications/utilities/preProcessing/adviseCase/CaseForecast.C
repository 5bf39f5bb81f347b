#include "CaseForecast.H"

#include "functionObjects/FunctionObjects.H"
#include "motion/SpeedMeter.H"

namespace shizuku
{

CaseForecast forecastCase(const TrialCase& trial, double measuredFor)
{
    const std::filesystem::path& casePath = trial.path();
    deviceCounters().peakBytes = deviceCounters().bytes;        // of this case alone
    const Time time(casePath);
    const Dictionary solution = Dictionary::read(casePath / "system/solution");
    const Dictionary liquidDict = Dictionary::read(casePath / "constant/liquidProperties");
    Liquid liquid(LiquidProperties::read(solution, liquidDict), solution.subDictOrEmpty("kernel"));
    Walls walls(casePath, time.value(), liquid);
    Models models(casePath, solution, liquid, walls);
    FunctionObjects functions(time, liquid.properties().spacing, !trial.withoutSolid());
    solution.refuseUnused();
    liquidDict.refuseUnused();
    liquid.read(time.path());
    const Neighbourhood near(liquid);
    FlowView flow(time, liquid, near, walls, models);
    functions.modelsMade(flow);

    const StepControl control(time.controlDict());
    SpeedMeter meter;
    const double speed = meter.measure(liquid).now;
    const auto limits = control.limits(time.deltaT(), speed, liquid, models);
    return
    {
        forecastRun(time, control, liquid, walls, models, speed, measuredFor), limits, liquid.owned(), walls.particles()
    };
}

}
