#include "advice/StoredStudies.H"

#include "core/dictionary/IncludeFile.H"
#include "core/messages/Error.H"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace shizuku
{

namespace
{

using Curve = std::map<double, StoredNumber>;

CsvTable table(const std::string& name)
{
    const auto file = findEtcFile("advice/" + name);
    if (file) return CsvTable::read(*file);
    throw FatalInputError
    (
        {"etc/advice/" + name, 0}, "The table of stored studies is not there", "etc/advice/makeData makes it"
    );
}

std::string joined(const std::string& a, const std::string& b) { return a == b ? a : a + " and " + b; }

// Between its points by a straight line over axis(x), of value(y); the ends' values beyond.
template<class Axis, class Back>
StoredNumber between(const Curve& curve, double x, Axis axis, Axis scale, Back back)
{
    const auto above = curve.lower_bound(x);
    if (above == curve.begin()) return above->second;
    const auto below = std::prev(above);
    if (above == curve.end()) return below->second;
    if (above->first == x) return above->second;
    const double part = (axis(x) - axis(below->first))/(axis(above->first) - axis(below->first));
    const double value = back((1 - part)*scale(below->second.value) + part*scale(above->second.value));
    return {value, joined(below->second.source, above->second.source)};
}

double same(double x) { return x; }
double logarithm(double x) { return std::log(x); }
double power(double x) { return std::exp(x); }

StoredNumber onLine(const Curve& curve, double x) { return between(curve, x, same, same, same); }
StoredNumber onLogarithms(const Curve& curve, double x) { return between(curve, x, logarithm, logarithm, power); }

bool inside(const Curve& curve, double x)
{
    constexpr double digits = 0.01;         // of numbers that went through a table, or a spacing of three digits
    return !curve.empty() && x > (1 - digits)*curve.begin()->first && x < (1 + digits)*curve.rbegin()->first;
}

}

std::vector<StoredStudies::Run> StoredStudies::read(const std::string& name, const std::string& choice)
{
    const CsvTable csv = table(name);
    std::vector<Run> runs;
    for (std::size_t i = 0; i < csv.rows(); ++i)
    {
        const auto number = [&](const std::string& column) { return csv.number(i, column); };
        runs.push_back
        ({
            csv.text(i, "scene"), csv.has("modelSet") ? csv.text(i, "modelSet") : "default", number("parameter"),
            number("particles"), number(choice), number("error"), csv.text(i, "source")
        });
    }
    return runs;
}

StoredStudies::StoredStudies()
: runs_(read("accuracy.csv", "capillarySteps")), iterationRuns_(read("iterations.csv", "iterations")),
  stability_(table("stability.csv")), stepTimes_(table("stepTime.csv"))
{
    const CsvTable sets = table("modelSets.csv");
    for (std::size_t i = 0; i < sets.rows(); ++i)
    {
        sets_.push_back
        ({
            sets.text(i, "modelSet"), sets.text(i, "pressure"), sets.text(i, "surfaceTension"), sets.text(i, "wetting"),
            sets.number(i, "maxCapillaryCo")
        });
    }
}

namespace
{

// By particles, at a choice between those that were run.
template<class Runs>
Curve errorsByParticles
(
    const Runs& runs, const std::string& scene, double parameter, const std::string& modelSet, double choice
)
{
    std::map<double, std::map<double, Curve>> all;
    for (const auto& run : runs)
    {
        if (run.scene != scene || run.modelSet != modelSet) continue;
        all[run.particles][run.choice].insert({run.parameter, {run.error, run.source}});
    }
    Curve byParticles;
    for (const auto& [n, byChoice] : all)
    {
        Curve choices;
        for (const auto& [each, byParameter] : byChoice) choices.insert({each, onLine(byParameter, parameter)});
        if (inside(choices, choice)) byParticles.insert({n, onLogarithms(choices, choice)});
    }
    return byParticles;
}

// Of those runs that a scene was run with; ascending.
template<class Runs, class Value>
std::vector<double> valuesOf(const Runs& runs, const std::string& scene, const std::string& modelSet, Value value)
{
    std::set<double> all;
    for (const auto& run : runs)
    {
        if (run.scene == scene && run.modelSet == modelSet) all.insert(value(run));
    }
    return {all.begin(), all.end()};
}

}

std::optional<StoredNumber> StoredStudies::error
(
    const std::string& scene, double parameter, const std::string& modelSet, double particles, double capillarySteps
) const
{
    const Curve errors = errorsByParticles(runs_, scene, parameter, modelSet, capillarySteps);
    if (errors.empty()) return std::nullopt;
    return onLogarithms(errors, particles);
}

std::optional<StoredNumber> StoredStudies::errorOfIterations
(
    const std::string& scene, double parameter, double particles, double iterations
) const
{
    const Curve errors = errorsByParticles(iterationRuns_, scene, parameter, "default", iterations);
    if (!inside(errors, particles)) return std::nullopt;
    return onLogarithms(errors, particles);
}

std::vector<double> StoredStudies::iterations(const std::string& scene) const
{
    return valuesOf(iterationRuns_, scene, "default", [](const Run& run) { return run.choice; });
}

std::vector<double> StoredStudies::particles(const std::string& scene, const std::string& modelSet) const
{
    return valuesOf(runs_, scene, modelSet, [](const Run& run) { return run.particles; });
}

std::vector<double> StoredStudies::capillarySteps(const std::string& scene, const std::string& modelSet) const
{
    return valuesOf(runs_, scene, modelSet, [](const Run& run) { return run.choice; });
}

std::optional<StoredNumber> StoredStudies::calmSteps(const std::string& modelSet) const
{
    for (std::size_t i = 0; i < stability_.rows(); ++i)
    {
        if (stability_.text(i, "modelSet") != modelSet) continue;
        return StoredNumber{stability_.number(i, "calmSteps"), stability_.text(i, "source")};
    }
    return std::nullopt;
}

std::optional<ModelSet> StoredStudies::modelSet
(
    const std::string& pressure, const std::string& surfaceTension, const std::string& wetting
) const
{
    const auto fits = [](const std::string& asked, const std::string& has) { return asked == has || asked == "none"; };
    const auto exact = [&](const ModelSet& set)
    {
        return (set.surfaceTension == surfaceTension) + (set.wetting == wetting);
    };
    std::optional<ModelSet> best;
    for (const ModelSet& set : sets_)
    {
        if (set.pressure != pressure || !fits(surfaceTension, set.surfaceTension) || !fits(wetting, set.wetting)) continue;
        if (!best || exact(set) > exact(*best)) best = set;
    }
    return best;
}

std::optional<StoredNumber> StoredStudies::stepTime
(
    const std::string& backend, const std::string& device, double particles
) const
{
    std::map<std::string, Curve> byDevice;
    for (std::size_t i = 0; i < stepTimes_.rows(); ++i)
    {
        if (stepTimes_.text(i, "backend") != backend) continue;
        const std::string name = stepTimes_.text(i, "device");
        byDevice[name].insert
        ({
            stepTimes_.number(i, "particles"),
            {stepTimes_.number(i, "seconds"), stepTimes_.text(i, "source")}
        });
    }
    if (byDevice.empty()) return std::nullopt;
    const auto own = byDevice.find(device);
    const auto& [name, curve] = own != byDevice.end() ? *own : *byDevice.begin();
    StoredNumber time = onLogarithms(curve, particles);
    time.source = "measured on " + name + ": " + time.source;
    const double fewest = curve.begin()->first, most = curve.rbegin()->first;
    if (particles < fewest && backend == "cpu") time.value *= particles/fewest;
    if (particles > most) time.value *= particles/most;
    return time;
}

}
