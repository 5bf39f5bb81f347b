#include "advice/StoredStudies.H"

#include "core/dictionary/IncludeFile.H"
#include "core/messages/Error.H"

#include <algorithm>
#include <cmath>
#include <map>

namespace shizuku
{

namespace
{

using Curve = std::map<double, StoredNumber>;

CsvTable table(const std::string& name)
{
    const auto file = findEtcFile("advice/" + name);
    if (!file) throw FatalInputError({"etc/advice/" + name, 0}, "The table of stored studies is not there", "etc/advice/makeData makes it");
    return CsvTable::read(*file);
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
    constexpr double digits = 1e-6;         // of numbers that went through a table
    return !curve.empty() && x > (1 - digits)*curve.begin()->first && x < (1 + digits)*curve.rbegin()->first;
}

}

StoredStudies::StoredStudies() : stability_(table("stability.csv")), stepTimes_(table("stepTime.csv"))
{
    const CsvTable accuracy = table("accuracy.csv"), sets = table("modelSets.csv");
    for (std::size_t i = 0; i < accuracy.rows(); ++i)
    {
        const auto number = [&](const char* column) { return accuracy.number(i, column); };
        runs_.push_back
        ({
            accuracy.text(i, "scene"), accuracy.text(i, "modelSet"), number("parameter"), number("particles"),
            number("capillarySteps"), number("error"), accuracy.text(i, "source")
        });
    }
    for (std::size_t i = 0; i < sets.rows(); ++i)
    {
        sets_.push_back
        ({
            sets.text(i, "modelSet"), sets.text(i, "pressure"), sets.text(i, "surfaceTension"), sets.text(i, "wetting"),
            sets.number(i, "maxCapillaryCo")
        });
    }
}

std::optional<StoredNumber> StoredStudies::error
(
    const std::string& scene, double parameter, const std::string& modelSet, double particles, double capillarySteps
) const
{
    std::map<double, std::map<double, Curve>> byParticlesAndStep;
    for (const Run& run : runs_)
    {
        if (run.scene != scene || run.modelSet != modelSet) continue;
        byParticlesAndStep[run.particles][run.capillarySteps].insert({run.parameter, {run.error, run.source}});
    }
    Curve byParticles;
    for (const auto& [n, bySteps] : byParticlesAndStep)
    {
        Curve steps;
        for (const auto& [step, byParameter] : bySteps) steps.insert({step, onLine(byParameter, parameter)});
        if (inside(steps, capillarySteps)) byParticles.insert({n, onLogarithms(steps, capillarySteps)});
    }
    if (byParticles.empty()) return std::nullopt;
    return onLogarithms(byParticles, particles);
}

std::vector<double> StoredStudies::particles(const std::string& scene, const std::string& modelSet) const
{
    std::map<double, int> all;
    for (const Run& run : runs_)
    {
        if (run.scene == scene && run.modelSet == modelSet) ++all[run.particles];
    }
    std::vector<double> result;
    for (const auto& [n, count] : all) result.push_back(n);
    return result;
}

std::vector<double> StoredStudies::capillarySteps(const std::string& scene, const std::string& modelSet) const
{
    std::map<double, int> all;
    for (const Run& run : runs_)
    {
        if (run.scene == scene && run.modelSet == modelSet) ++all[run.capillarySteps];
    }
    std::vector<double> result;
    for (const auto& [step, count] : all) result.push_back(step);
    return result;
}

std::optional<StoredNumber> StoredStudies::calmSteps(const std::string& modelSet) const
{
    for (std::size_t i = 0; i < stability_.rows(); ++i)
    {
        if (stability_.text(i, "modelSet") == modelSet) return StoredNumber{stability_.number(i, "calmSteps"), stability_.text(i, "source")};
    }
    return std::nullopt;
}

std::optional<ModelSet> StoredStudies::modelSet
(
    const std::string& pressure, const std::string& surfaceTension, const std::string& wetting
) const
{
    const auto fits = [](const std::string& asked, const std::string& has) { return asked == has || asked == "none"; };
    const auto exact = [&](const ModelSet& set) { return (set.surfaceTension == surfaceTension) + (set.wetting == wetting); };
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
