// SPDX-License-Identifier: GPL-3.0-or-later
#include "SpeedAccuracyPoints.H"

#include "core/dictionary/EntryText.H"
#include "core/fieldFile/CsvTable.H"
#include "study/ParetoFront.H"
#include "study/RunCost.H"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shizuku
{

namespace
{

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::vector<ReferencePoint> readReferences(const std::filesystem::path& file)
{
    const CsvTable table = CsvTable::read(file);
    std::vector<ReferencePoint> points;
    for (std::size_t row = 0; row < table.rows(); ++row)
    {
        points.push_back({table.text(row, "source"), table.number(row, "cost"), table.number(row, "error")});
    }
    return points;
}

double numberIn(const RunOutcome& outcome, const std::string& column)
{
    const auto cell = outcome.measured.find(column);
    return outcome.end == RunEnd::finished && cell != outcome.measured.end() ? std::get<double>(cell->second) : unknown;
}

}

SpeedAccuracy::SpeedAccuracy(const Study& study, const std::string& wantedCost)
:
    title(study.dict.lookupOr("title", study.name)),
    cost(study.dict.lookupChoice("cost", {"wallTime", "cpuTime", "particleSteps"})),
    study_(study),
    error_(study.dict.subDict("error"))
{
    if (!wantedCost.empty()) cost = wantedCost;
    const Dictionary error = study.dict.subDict("error");
    label = error.lookup<std::string>("label");
    least = error.lookupPositive("least", dimensions::none);
    combine_ = error.lookupChoiceOr("combine", {"mean", "rms", "worst"}, "mean");

    std::vector<bool> isCombined(study.axes.size());
    if (error.found("over"))
    {
        for (const std::string& axis : listTexts(error, "over")) isCombined[study.axis({axis, error.where("over")})] = true;
    }
    for (std::size_t axis = 0; axis < study.axes.size(); ++axis)
    {
        if (!isCombined[axis]) shown.push_back(axis);
    }
    const StudyText wanted{study.dict.lookup<std::string>("series"), study.dict.where("series")};
    const auto place = std::find(shown.begin(), shown.end(), study.axis(wanted));
    if (place == shown.end())
    {
        throw FatalInputError(wanted.where, "The series '" + wanted.text + "' is an axis that is combined", "one that is not");
    }
    series = place - shown.begin();
    if (study.dict.found("references")) references = readReferences(study.folder/study.dict.lookup<std::string>("references"));
}

std::vector<CsvFile::Column> SpeedAccuracy::columns() const
{
    return
    {
        {"reference", ""}, {"measured", ""}, {"error", ""}, {"wallTime", "s/s"}, {"cpuTime", "s/s"}, {"particleSteps", "1/s"},
        {"particles", ""}, {"subStep", "s"}
    };
}

std::map<std::string, CsvFile::Cell> SpeedAccuracy::measure(const RunOutcome& outcome) const
{
    const RunCost spent = runCost(outcome.path);
    std::map<std::string, CsvFile::Cell> cells
    {
        {"wallTime", spent.wallTime}, {"cpuTime", spent.cpuTime}, {"particleSteps", spent.particleSteps},
        {"particles", spent.particles}, {"subStep", spent.subStep}
    };
    if (outcome.end != RunEnd::finished) return cells;
    const MeasuredError error = error_.of(outcome);
    cells["reference"] = error.reference;
    cells["measured"] = error.measured;
    cells["error"] = error.error;
    return cells;
}

double SpeedAccuracy::combined(const std::vector<double>& errors) const
{
    double sum = 0, worst = 0;
    for (const double error : errors)
    {
        if (std::isnan(error)) return unknown;
        sum += combine_ == "rms" ? error*error : error;
        worst = std::max(worst, error);
    }
    const double mean = sum/double(errors.size());
    return combine_ == "worst" ? worst : combine_ == "rms" ? std::sqrt(mean) : mean;
}

std::vector<SpeedAccuracyPoint> SpeedAccuracy::points(const std::vector<RunOutcome>& outcomes) const
{
    std::map<std::vector<std::size_t>, std::vector<const RunOutcome*>> groups;
    for (const RunOutcome& outcome : outcomes)
    {
        std::vector<std::size_t> key;
        for (const std::size_t axis : shown) key.push_back(outcome.run.choices[axis]);
        groups[key].push_back(&outcome);
    }
    std::vector<SpeedAccuracyPoint> points;
    std::vector<CostAndError> numbers;
    for (const auto& [key, group] : groups)
    {
        SpeedAccuracyPoint point;
        for (std::size_t i = 0; i < shown.size(); ++i) point.choices.push_back(study_.axes[shown[i]].choices[key[i]].name);
        std::vector<double> errors;
        for (const RunOutcome* outcome : group)
        {
            errors.push_back(numberIn(*outcome, "error"));
            point.cost += numberIn(*outcome, cost)/double(group.size());
            if (std::isnan(errors.back())) ++point.failed;
        }
        point.runs = int(group.size());
        point.error = combined(errors);
        points.push_back(point);
        numbers.push_back({point.cost, point.error});
    }
    const std::vector<bool> front = paretoFront(numbers);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].front = front[i];
    return points;
}

}
