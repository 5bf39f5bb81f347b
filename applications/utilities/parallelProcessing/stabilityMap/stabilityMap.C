// SPDX-License-Identifier: GPL-3.0-or-later
// stabilityMap: runs a study over a grid of choices and maps what became of each run.

#include "StabilityChart.H"

#include "core/arguments/runApplication.H"
#include "core/dictionary/EntryText.H"
#include "study/ComparisonRows.H"
#include "study/RunCost.H"
#include "study/StudyOptions.H"

#include <iostream>

using namespace shizuku;

namespace
{

ApplicationInfo info()
{
    return
    {
        "stabilityMap",
        "Run the case of a study over a grid of choices. Map the outcome of each run: calm, noisy, wrong, frozen, "
        "clustered, volume lost, leaked, exploded, not a number, refused. The same command continues after an interruption.",
        studyOptions(),
        {"study"},
        false
    };
}

// Numbers of the comparison `stability`, and of the study's
//     answer { comparison stability; quantity "contact angle"; within 10; start @start@; }    // may be absent
//     limits { volumeLoss 1; ... }        // may be absent: see Stability.H
class StabilityMeasure : public RunMeasure
{
public:
    explicit StabilityMeasure(const Study& study) : limits_(StabilityLimits::read(study.dict.subDictOrEmpty("limits")))
    {
        if (!study.dict.found("answer")) return;
        const Dictionary answer = study.dict.subDict("answer");
        asked_ = true;
        comparison_ = answer.lookup<std::string>("comparison");
        quantity_ = answer.lookup<std::string>("quantity");
        where_ = answer.where("quantity");
        within_ = {entryText(answer, "within"), answer.where("within")};
        if (answer.found("start")) start_ = {entryText(answer, "start"), answer.where("start")};
    }

    std::vector<CsvFile::Column> columns() const override
    {
        return
        {
            {"class", ""}, {"nonFinite", ""}, {"speed", ""}, {"stray", "%"}, {"behindWalls", "%"}, {"nearest", "spacings"},
            {"volumeChange", "%"}, {"reference", ""}, {"measured", ""}, {"start", ""}, {"particles", ""}, {"subStep", "s"},
            {"wallTime", "s/s"}
        };
    }

    std::map<std::string, CsvFile::Cell> measure(const RunOutcome& outcome) const override
    {
        const StabilityEvidence e = evidence(outcome);
        const RunCost cost = runCost(outcome.path);
        return
        {
            {"class", nameOf(classify(e, limits_))}, {"nonFinite", e.nonFinite}, {"speed", e.speed}, {"stray", e.stray},
            {"behindWalls", e.behindWalls}, {"nearest", e.nearest}, {"volumeChange", e.volumeChange}, {"reference", e.reference},
            {"measured", e.measured}, {"start", e.start}, {"particles", cost.particles}, {"subStep", cost.subStep},
            {"wallTime", cost.wallTime}
        };
    }

private:
    StabilityEvidence evidence(const RunOutcome& outcome) const
    {
        StabilityEvidence e;
        e.finished = outcome.end == RunEnd::finished;
        e.reason = outcome.reason;
        if (!e.finished) return e;

        const ComparisonRows rows(outcome.path);
        const auto number = [&](const char* quantity) { return rows.require("stability", quantity, where_); };
        e.nonFinite = number("particles that are no numbers").measured;
        e.speed = number("rms speed over capillary speed").measured;
        e.stray = number("stray particles").measured;
        e.behindWalls = number("particles behind the walls").measured;
        e.nearest = number("distance to the nearest").measured;
        e.volumeChange = number("volume of the particles").deviation;
        if (!asked_) return e;
        const auto answer = rows.find(comparison_, quantity_);
        if (!answer) return e;          // not asked of this case
        e.reference = answer->reference;
        e.measured = answer->measured;
        e.within = numberOf(within_, outcome.values);
        if (!start_.text.empty()) e.start = numberOf(start_, outcome.values);
        return e;
    }

    StabilityLimits limits_;
    bool asked_ = false;
    std::string comparison_, quantity_;
    SourceLocation where_;
    StudyText within_, start_;
};

// What the engine has measured; died where a run left nothing to measure.
std::vector<Stability> classesOf(const std::vector<RunOutcome>& outcomes)
{
    std::vector<Stability> classes;
    for (const RunOutcome& outcome : outcomes)
    {
        classes.push_back(Stability::died);
        const auto cell = outcome.measured.find("class");
        if (cell == outcome.measured.end()) continue;
        for (const Stability stability : allStabilities())
        {
            if (nameOf(stability) == std::get<std::string>(cell->second)) classes.back() = stability;
        }
    }
    return classes;
}

void stabilityMap(const Arguments& args)
{
    const Study study = readStudy(args);
    const StabilityMeasure measure(study);
    const MapLayout layout = MapLayout::read(study);
    study.dict.refuseUnused();
    StudyEngine engine(study, args, measure);
    engine.run();
    if (args.found("prepare")) return;

    const std::vector<Stability> classes = classesOf(engine.outcomes());
    const std::filesystem::path output = studyOutput(args, study);
    std::cout << '\n';
    for (const Stability stability : allStabilities())
    {
        long count = 0;
        for (std::size_t i = 0; i < classes.size(); ++i)
        {
            count += classes[i] == stability && engine.outcomes()[i].end != RunEnd::notRun;
        }
        if (count > 0) std::cout << nameOf(stability) << ": " << count << '\n';
    }
    std::cout << '\n';
    reportDeaths(engine.outcomes());
    writeTables(output, study, layout, engine.outcomes(), classes);
    drawMaps(output, study, layout, engine.outcomes(), classes);
}

}

int main(int argc, char** argv)
{
    return runApplication(argc, argv, info(), stabilityMap);
}
