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

bool SpeedAccuracyPoint::isDrawable() const
{
    return std::isfinite(cost) && std::isfinite(error) && cost > 0;
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
    const auto combine = [&](const std::vector<std::string>& names, const SourceLocation& where)
    {
        std::vector<std::size_t> axes;
        for (const std::string& name : names) axes.push_back(study.axis({name, where}));
        for (const std::size_t axis : axes) isCombined[axis] = true;
        return axes;
    };
    if (error.found("over")) combine(listTexts(error, "over"), error.where("over"));
    if (error.found("repeats")) repeats_ = combine(listTexts(error, "repeats"), error.where("repeats"));
    for (std::size_t axis = 0; axis < study.axes.size(); ++axis)
    {
        if (!isCombined[axis]) shown.push_back(axis);
    }
    const auto placeOf = [&](const std::string& entry, const StudyText& wanted)
    {
        const auto place = std::find(shown.begin(), shown.end(), study.axis(wanted));
        if (place == shown.end())
        {
            throw FatalInputError(wanted.where, "The axis '" + wanted.text + "' of " + entry + " is one that is combined", "one that is not");
        }
        return std::size_t(place - shown.begin());
    };
    series = placeOf("series", {study.dict.lookup<std::string>("series"), study.dict.where("series")});
    if (study.dict.found("along")) along = placeOf("along", {study.dict.lookup<std::string>("along"), study.dict.where("along")});
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

SpeedAccuracyPoint SpeedAccuracy::pointOf(const std::vector<std::size_t>& choices, const std::vector<const RunOutcome*>& runs) const
{
    SpeedAccuracyPoint point;
    for (std::size_t i = 0; i < shown.size(); ++i) point.choices.push_back(study_.axes[shown[i]].choices[choices[i]].name);
    std::map<std::vector<std::size_t>, std::vector<double>> errors;       // by repeat
    for (const RunOutcome* outcome : runs)
    {
        std::vector<std::size_t> repeat;
        for (const std::size_t axis : repeats_) repeat.push_back(outcome->run.choices[axis]);
        const double error = numberIn(*outcome, "error");
        errors[repeat].push_back(error);
        point.cost += numberIn(*outcome, cost)/double(runs.size());
        if (std::isnan(error)) ++point.failed;
    }
    point.runs = int(runs.size());
    bool first = true;
    for (const auto& [repeat, ofRuns] : errors)
    {
        const double error = combined(ofRuns);
        point.error += error/double(errors.size());
        point.errorFrom = first ? error : std::min(point.errorFrom, error);
        point.errorTo = first ? error : std::max(point.errorTo, error);
        first = false;
    }
    return point;
}

void SpeedAccuracy::findLines(std::vector<SpeedAccuracyPoint>& points) const
{
    if (!along) return;
    std::map<std::string, std::map<std::vector<std::string>, std::vector<SpeedAccuracyPoint*>>> lines;    // by series, by setting
    for (SpeedAccuracyPoint& point : points)
    {
        if (!point.isDrawable()) continue;
        std::vector<std::string> setting;
        for (std::size_t i = 0; i < point.choices.size(); ++i)
        {
            if (i != series && i != *along) setting.push_back(point.choices[i]);
        }
        lines[point.choices[series]][setting].push_back(&point);
    }
    const auto product = [&](const std::vector<SpeedAccuracyPoint*>& line)
    {
        double sum = 0;
        for (const SpeedAccuracyPoint* point : line) sum += std::log(point->cost*std::max(point->error, least));
        return sum/double(line.size());
    };
    for (const auto& [name, settings] : lines)
    {
        const auto worse = [&](const auto& a, const auto& b)
        {
            return a.second.size() != b.second.size() ? a.second.size() < b.second.size() : product(a.second) > product(b.second);
        };
        for (SpeedAccuracyPoint* point : std::max_element(settings.begin(), settings.end(), worse)->second) point->onLine = true;
    }
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
        const SpeedAccuracyPoint point = pointOf(key, group);
        points.push_back(point);
        numbers.push_back({point.cost, point.error});
    }
    const std::vector<bool> front = paretoFront(numbers);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].front = front[i];
    findLines(points);
    return points;
}

}
