// SPDX-License-Identifier: GPL-3.0-or-later
#include "advice/StoredStudies.H"

#include "core/angles/Degrees.H"
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

// Between its points by a straight line on logarithmic axes; the ends' values beyond.
StoredNumber onLogarithms(const Curve& curve, double x)
{
    const auto above = curve.lower_bound(x);
    if (above == curve.begin()) return above->second;
    const auto below = std::prev(above);
    if (above == curve.end()) return below->second;
    if (above->first == x) return above->second;
    const double part = std::log(x/below->first)/std::log(above->first/below->first);
    const double value = below->second.value*std::pow(above->second.value/below->second.value, part);
    return {value, joined(below->second.source, above->second.source)};
}

// How near runs must be to tell: where the weight is exp(-1/2). Chosen by how well stored runs are foretold that are left out
// (doc/notebook/advice.md).
constexpr double nearParticles = 1.3, nearChoice = 2, nearBond = 1.5;      // ratios
constexpr double nearAngle = 15;                        // degrees
constexpr double power = 1.5;                           // of errors, in their mean

double ratioDistance(double a, double b, double ratio) { return std::log(a/b)/std::log(ratio); }

double distanceOfParameters(const std::string& scene, double a, double b)
{
    return scene == "gravity" ? ratioDistance(a, b, nearBond) : (a - b)/nearAngle;
}

// Of the answer, in units in which neighbouring parameters' errors are alike.
double sizeOfAnswer(const std::string& scene, double parameter)
{
    return scene == "meniscus" ? std::abs(std::tan(radians(0.5*(90 - parameter)))) : 1;
}

constexpr double tableDigits = 0.01;        // of numbers that went through a table, or a spacing of three digits

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
: runs_(read("accuracy.csv", "step")), iterationRuns_(read("iterations.csv", "iterations")),
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
    if (sets_.empty()) throw FatalInputError({"etc/advice/modelSets.csv", 1}, "There is no model set", "the default's first, then others");
}

// Of the runs of the scene and the model set `asked`, at its parameter, particles and choice.
std::optional<StoredNumber> StoredStudies::typicalError(const std::vector<Run>& runs, Run asked, const Run* leftOut)
{
    std::map<double, std::vector<const Run*>> byParticles;
    for (const Run& run : runs)
    {
        const bool same = &run != leftOut && run.scene == asked.scene && run.modelSet == asked.modelSet;
        if (same) byParticles[run.particles].push_back(&run);
    }
    const auto limits = [](const std::vector<const Run*>& of, double Run::* value)
    {
        const auto less = [&](const Run* a, const Run* b) { return a->*value < b->*value; };
        const auto [low, high] = std::minmax_element(of.begin(), of.end(), less);
        return std::pair{(*low)->*value, (*high)->*value};
    };
    std::vector<const Run*> those;                      // with as many particles as such a choice was tried with
    for (const auto& [n, group] : byParticles)
    {
        const auto [least, most] = limits(group, &Run::choice);
        const bool tried = asked.choice > (1 - tableDigits)*least && asked.choice < (1 + tableDigits)*most;
        if (tried) those.insert(those.end(), group.begin(), group.end());
    }
    const double size = sizeOfAnswer(asked.scene, asked.parameter);
    if (those.empty() || size == 0) return std::nullopt;
    for (double Run::* value : {&Run::particles, &Run::parameter})
    {
        const auto [low, high] = limits(those, value);
        asked.*value = std::clamp(asked.*value, low, high);
    }

    double sum = 0, weights = 0;
    std::map<std::string, double> sources;
    for (const Run* run : those)
    {
        const double a = ratioDistance(asked.particles, run->particles, nearParticles),
            b = ratioDistance(asked.choice, run->choice, nearChoice),
            c = distanceOfParameters(asked.scene, asked.parameter, run->parameter);
        const double weight = std::exp(-0.5*(a*a + b*b + c*c));
        const double spacing = std::cbrt(run->particles/asked.particles);       // asked for, over the run's
        const double amount = run->error*spacing*sizeOfAnswer(run->scene, run->parameter);
        sum += weight*std::pow(amount, power);
        weights += weight;
        sources[run->source] += weight;
    }
    if (weights == 0) return std::nullopt;              // below the smallest number: nothing is near
    constexpr double named = 0.1;                       // share of the weight
    std::string source;
    for (const auto& [name, weight] : sources)
    {
        if (weight >= named*weights) source += (source.empty() ? "" : " and ") + name;
    }
    return StoredNumber{std::pow(sum/weights, 1/power)/size, source};
}

std::optional<double> StoredStudies::scatter(const std::string& modelSet) const
{
    constexpr std::size_t fewest = 20;
    constexpr double share = 0.9;
    std::vector<double> ratios;
    for (const Run& run : runs_)
    {
        if (run.modelSet != modelSet) continue;
        if (const auto foretold = typicalError(runs_, run, &run)) ratios.push_back(run.error/foretold->value);
    }
    if (ratios.size() < fewest) return std::nullopt;
    std::sort(ratios.begin(), ratios.end());
    return ratios[std::size_t(std::ceil(share*double(ratios.size()))) - 1];
}

namespace
{

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
    const std::string& scene, double parameter, const std::string& modelSet, double particles, double step
) const
{
    return typicalError(runs_, {scene, modelSet, parameter, particles, step, 0, ""});
}

std::optional<StoredNumber> StoredStudies::errorOfIterations
(
    const std::string& scene, double parameter, double particles, double iterations
) const
{
    const std::vector<double> run = valuesOf(iterationRuns_, scene, "default", [](const Run& each) { return each.particles; });
    const bool inside = !run.empty() && particles > (1 - tableDigits)*run.front() && particles < (1 + tableDigits)*run.back();
    if (!inside) return std::nullopt;
    return typicalError(iterationRuns_, {scene, "default", parameter, particles, iterations, 0, ""});
}

std::vector<double> StoredStudies::iterations(const std::string& scene) const
{
    return valuesOf(iterationRuns_, scene, "default", [](const Run& run) { return run.choice; });
}

std::vector<double> StoredStudies::particles(const std::string& scene, const std::string& modelSet) const
{
    return valuesOf(runs_, scene, modelSet, [](const Run& run) { return run.particles; });
}

std::vector<double> StoredStudies::steps(const std::string& scene, const std::string& modelSet) const
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
