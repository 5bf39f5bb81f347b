// SPDX-License-Identifier: GPL-3.0-or-later
// Says which models, spacing and step a case needs for a tolerance that the user gives, and what the run would cost.

#include "CaseForecast.H"
#include "advice/CaseEdits.H"
#include "advice/TrialCase.H"
#include "core/arguments/runApplication.H"
#include "device/DeviceApplication.H"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr std::size_t mostReported = 10;
constexpr double measuring = 2;             // s, of the start and of steps, for each of two cases

double readTolerance(const Arguments& args)
{
    const double tolerance = args.getDouble("tolerance");
    if (tolerance > 0 && tolerance < 1) return tolerance;
    throw FatalInputError
    (
        {}, "-tolerance is " + args.get("tolerance"),
        "a relative change of the answer, larger than 0 and smaller than 1: 0.05"
    );
}

void reportScene(const Scene& scene, const CaseForecast& forecast)
{
    std::cout << "Liquid: " << forecast.particles << " particles, separate bodies " << scene.bodies.size() << "\n";
    for (std::size_t i = 0; i < std::min(scene.bodies.size(), mostReported); ++i)
    {
        const SceneBody& body = scene.bodies[i];
        std::cout << "Body " << i + 1 << ": " << describe(body.liquid, scene.spacing);
        if (std::isfinite(body.gap))
        {
            std::cout << "    gap to the walls " << body.gap << " m, speed there U " << body.impactSpeed << " m/s\n";
        }
        const std::string numbers = describe(scene.scales(body));
        if (!numbers.empty()) std::cout << "    " << numbers << "\n";
    }
    if (scene.bodies.size() > mostReported) std::cout << "and " << scene.bodies.size() - mostReported << " smaller ones\n";
    std::cout << "Limits of a sub-step:";
    for (const StepLimit& limit : forecast.limits) std::cout << " " << limit.name << " " << limit.dt << " s";
    std::cout << "; " << forecast.run.subStep.limit << " rules: " << forecast.run.subStep.dt << " s\n"
              << "Answer: " << scene.answer().text << "; tolerance " << percent(scene.tolerance) << "\n";
}

void reportAdvice(const std::vector<Advice>& advices, bool explain)
{
    std::cout << "\nAdvice\n";
    for (const Advice& advice : advices)
    {
        std::cout << "    " << std::left << std::setw(14) << advice.rule << advice.verdict << "\n";
        if (explain) std::cout << "        " << advice.reason << "\n        (" << advice.source << ")\n";
        for (const CaseChange& change : advice.changes)
        {
            std::cout << "        " << change.file << ": " << change.entry << " " << change.value << "\n";
        }
    }
}

// Of a case as the solver would run it.
struct Prediction
{
    CaseForecast forecast;
    double start;                           // s, of all but steps, function objects and writing
    std::optional<StoredNumber> secondsPerSubStep, error;
    std::optional<double> likelyError;      // of nine runs in ten
    SceneAnswer answer;
};

// opening: s, that the solver's process takes longer where no other has opened the device. measure: the time of a sub-step is of
// this machine, here and now; else of one whose times are stored.
Prediction predict(const CaseForecast& forecast, double opening, const Scene& scene, const DeviceInfo& device, bool measure)
{
    const double start = forecast.start.seconds.value_or(0) + opening + forecast.firstStep;
    Prediction prediction{forecast, start, {}, scene.error(), scene.likelyError(), scene.answer()};
    std::string name = device.name;
    std::erase(name, ',');              // as the table of times has it
    if (!measure) prediction.secondsPerSubStep = scene.studies->stepTime(device.backend, name, forecast.particles);
    else
    {
        std::ostringstream source;
        source << "measured here on " << forecast.run.measured << " sub-steps";
        prediction.secondsPerSubStep = StoredNumber{forecast.run.secondsPerSubStep, source.str()};
    }
    return prediction;
}

void report(const std::string& what, const Prediction& p)
{
    const RunForecast& run = p.forecast.run;
    std::cout << "    " << what << "\n"
              << "        particles     " << p.forecast.particles << ", of solids " << p.forecast.solidParticles << "\n"
              << "        sub-steps     " << run.subSteps << " of " << run.subStep.dt << " s, limited by "
              << run.subStep.limit << "\n"
              << "        memory        " << run.bytes/1048576.0 << " MiB of the device\n"
              << "        time          ";
    const SolverStart& started = p.forecast.start;
    if (!started.seconds) std::cout << "not known, as the solver does not start on a copy of the case: " << started.refusal << "\n";
    else if (p.secondsPerSubStep)
    {
        const double loop = p.secondsPerSubStep->value*run.subSteps;
        const double functions = p.forecast.functions, waiting = p.forecast.waiting(loop + functions);
        std::cout << p.start + loop + functions + waiting << " s: start " << p.start << ", steps " << loop
                  << ", function objects " << functions << ", waiting for writing " << waiting << " ("
                  << p.secondsPerSubStep->source << ")\n";
    }
    else std::cout << "not known: no benchmark of such a device is stored; -measure\n";
    std::cout << "        error         ";
    if (p.error)
    {
        std::cout << percent(p.error->value);
        if (p.likelyError) std::cout << "; of ten runs nine below " << percent(*p.likelyError);
        std::cout << " (" << p.error->source << ")\n";
    }
    else if (p.answer.scene.empty()) std::cout << "not known, the answer is " << p.answer.text << "\n";
    else std::cout << "not known: no stored study of this scene and these models\n";
}

// What has to be run again.
void reportApplied(const std::vector<std::filesystem::path>& written, const std::vector<CaseChange>& changes, bool solid)
{
    for (const auto& file : written)
    {
        std::cout << "Wrote " << file.string() << "; as it was: " << file.filename().string() << ".old*\n";
    }
    const auto isGeometry = [](const CaseChange& c) { return c.entry == "spacing" || c.file == "constant/walls"; };
    if (std::any_of(changes.begin(), changes.end(), isGeometry))
    {
        std::cout << "Run ./Allclean, if there are results, and then " << (solid ? "sampleSurface, sampleTheta and " : "")
                  << "fillLiquid again\n";
    }
}

void adviseCase(const Arguments& args)
{
    const double tolerance = readTolerance(args);
    const bool measure = args.found("measure");
    const double measuredFor = measure ? measuring : 0;
    const std::vector<std::string> backend{"-device", args.get("device"), "-precision", args.get("precision")};

    const StoredStudies studies;
    const TrialCase trial(args.casePath());
    const SolverStart alone = startSolver(trial, backend, measuredFor);
    const DeviceInfo device = openNamedDevice();
    const CaseForecast present = forecastCase(trial, backend, measuredFor);
    const double opening = alone.seconds && present.start.seconds ? *alone.seconds - *present.start.seconds : 0;
    // The scene has the walls that were left out of the trial.
    Scene scene = Scene::read(args.casePath(), trial.path(), studies, tolerance);
    scene.subStep = present.run.subStep.dt;
    scene.limit = present.run.subStep.limit;
    if (trial.startsAnew()) std::cout << "The run is over: what follows is of its start\n";
    reportScene(scene, present);
    if (trial.withoutSolid())
    {
        std::cout << "The walls are not sampled: what follows of memory and time is without their particles\n";
    }

    const Prediction asItIs = predict(present, opening, scene, device, measure);
    const std::vector<Advice> advices = adviseOn(scene);
    reportAdvice(advices, args.found("explain"));
    std::vector<CaseChange> changes;
    for (const Advice& advice : advices) changes.insert(changes.end(), advice.changes.begin(), advice.changes.end());

    std::cout << "\nPrediction\n";
    report("as it is", asItIs);
    if (changes.empty())
    {
        std::cout << "\nNothing to change" << std::endl;
        return;
    }
    const TrialCase advised(args.casePath(), changes);
    report("as advised", predict(forecastCase(advised, backend, measuredFor), opening, scene, device, measure));
    std::cout << std::endl;
    if (!args.found("apply")) return;
    const auto isSampled = [](const SceneWall& wall) { return wall.type == "particles"; };
    const bool solid = std::any_of(scene.walls.begin(), scene.walls.end(), isSampled);
    reportApplied(changeCase(args.casePath(), changes, true), changes, solid);
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
            .name = "adviseCase",
            .summary = "Advise on models, spacing and time step for a tolerance. Predict error, time and memory.",
            .options =
            {
                {"tolerance", "SHARE", "Relative error that you accept", "0.05"},
                {"explain", "", "Print the reason for each advice, its numbers and their source", ""},
                {"apply", "", "Write the advice into the case; the old dictionaries are kept as *.old", ""},
                {"measure", "", "Time a few steps on this device (default: use stored times of another device)", ""},
                deviceOption(),
                precisionOption()
            }
        },
        adviseCase
    );
}
