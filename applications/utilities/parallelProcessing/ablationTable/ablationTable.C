// SPDX-License-Identifier: GPL-3.0-or-later
// ablationTable: runs a case with each of its models switched off or coarsened in turn, and tabulates what that changes of
// its answer and of its cost.
//
// Of the study, beside what Study.H names: one axis, whose first choice is what the others are compared with, and
//     answers
//     {
//         angle   { table spread; file "contactAngle.csv"; column angle; reference 0; }   // as in ErrorMeasure.H
//         way     { table drops; ... scale 4e-3; }    // a change is set against the scale; else against the first choice
//     }

#include "core/arguments/runApplication.H"
#include "study/ErrorMeasure.H"
#include "study/RunCost.H"
#include "study/StudyOptions.H"

#include <cmath>
#include <iostream>
#include <limits>

using namespace shizuku;

namespace
{

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

ApplicationInfo info()
{
    ApplicationInfo result
    {
        "ablationTable",
        "Run the case of a study with one model at a time switched off or coarsened. Tabulate the change of "
        "answers and cost. The same command continues after an interruption.",
        studyOptions(),
        {"study"},
        false
    };
    result.options.push_back({"cost", "wallTime|cpuTime", "Cost to tabulate; take cpuTime if other programs use the machine", "wallTime"});
    return result;
}

struct Answer
{
    std::string name;
    ErrorMeasure measure;
    double scale;                       // nan: the answer of the first choice
};

class AblationMeasure : public RunMeasure
{
public:
    explicit AblationMeasure(const Study& study)
    {
        if (study.axes.size() != 1)
        {
            throw FatalInputError
            (
                study.dict.where("axes"), "An ablation has one axis, this study has " + std::to_string(study.axes.size())
            );
        }
        const Dictionary dict = study.dict.subDict("answers");
        for (const std::string& name : dict.keys())
        {
            const Dictionary answer = dict.subDict(name);
            const double scale = answer.found("scale") ? answer.lookupPositive("scale", dimensions::none) : unknown;
            answers.push_back({name, ErrorMeasure(answer), scale});
        }
        if (answers.empty()) throw FatalInputError(dict.where(), "There is no answer to compare", "angle { table ...; }");
    }

    std::vector<CsvFile::Column> columns() const override
    {
        std::vector<CsvFile::Column> result;
        for (const Answer& answer : answers) result.push_back({answer.name, ""});
        for (const char* cost : {"wallTime", "cpuTime"}) result.push_back({cost, "s/s"});
        result.push_back({"particleSteps", "1/s"});
        result.push_back({"particles", ""});
        return result;
    }

    std::map<std::string, CsvFile::Cell> measure(const RunOutcome& outcome) const override
    {
        const RunCost cost = runCost(outcome.path);
        std::map<std::string, CsvFile::Cell> cells
        {
            {"wallTime", cost.wallTime}, {"cpuTime", cost.cpuTime}, {"particleSteps", cost.particleSteps},
            {"particles", cost.particles}
        };
        if (outcome.end != RunEnd::finished) return cells;
        for (const Answer& answer : answers) cells[answer.name] = answer.measure.of(outcome).measured;
        return cells;
    }

    std::vector<Answer> answers;
};

double numberOf(const RunOutcome& outcome, const std::string& column)
{
    const auto cell = outcome.measured.find(column);
    return cell == outcome.measured.end() ? unknown : std::get<double>(cell->second);
}

void writeAblation
(
    const std::filesystem::path& file, const Study& study, const AblationMeasure& measure, const std::string& costName,
    const std::vector<RunOutcome>& outcomes
)
{
    CsvFile table
    (
        file,
        {
            {"case", ""}, {"change", ""}, {"end", ""}, {"answer", ""}, {"value", ""}, {"changeOfAnswer", "%"},
            {"particles", ""}, {costName, "s/s"}, {"costOfShipped", "%"}
        }
    );
    const RunOutcome& first = outcomes.front();
    for (const RunOutcome& outcome : outcomes)
    {
        const double time = numberOf(outcome, costName), cost = 100*time/numberOf(first, costName);
        for (const Answer& answer : measure.answers)
        {
            const double value = numberOf(outcome, answer.name), shipped = numberOf(first, answer.name);
            const double scale = std::isnan(answer.scale) ? std::abs(shipped) : answer.scale;
            table.addRow
            ({
                study.name, study.axes[0].choices[outcome.run.choices[0]].name, nameOf(outcome.end), answer.name, value,
                100*std::abs(value - shipped)/scale, numberOf(outcome, "particles"), time, cost
            });
        }
    }
    table.write();
    std::cout << "Table: " << file.string() << '\n';
}

void ablationTable(const Arguments& args)
{
    const Study study = readStudy(args);
    const AblationMeasure measure(study);
    study.dict.refuseUnused();
    StudyEngine engine(study, args, measure);
    engine.run();
    if (args.found("prepare")) return;
    reportDeaths(engine.outcomes());
    writeAblation(studyOutput(args, study)/"ablation.csv", study, measure, args.get("cost"), engine.outcomes());
}

}

int main(int argc, char** argv)
{
    return runApplication(argc, argv, info(), ablationTable);
}
