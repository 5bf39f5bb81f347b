// SPDX-License-Identifier: GPL-3.0-or-later
// speedAccuracy: runs a study over a grid of choices and draws the error over the cost of each.

#include "SpeedAccuracyChart.H"

#include "core/arguments/runApplication.H"
#include "study/RunOrigin.H"
#include "study/StudyOptions.H"

#include <algorithm>
#include <iostream>

using namespace shizuku;

namespace
{

ApplicationInfo info()
{
    ApplicationInfo result
    {
        "speedAccuracy",
        "Run the case of a study over a grid of choices. Measure error and cost of each run and draw "
        "the Pareto front. The same command continues after an interruption.",
        studyOptions(),
        {"study"},
        false
    };
    result.options.push_back({"cost", "wallTime|cpuTime|particleSteps", "Cost to draw (default: that of the study)", ""});
    return result;
}

void printFront(const Study& study, const SpeedAccuracy& chart, const std::vector<SpeedAccuracyPoint>& points)
{
    std::cout << "\nPareto front (";
    for (const std::size_t axis : chart.shown) std::cout << study.axes[axis].name << ", ";
    std::cout << "cost, error):\n";
    for (const SpeedAccuracyPoint& point : points)
    {
        if (!point.front) continue;
        std::cout << "   ";
        for (const std::string& choice : point.choices) std::cout << ' ' << choice;
        std::cout << ": " << point.cost << ", " << point.error << '\n';
    }
    std::cout << '\n';
}

// What the runs were made with.
std::string footOf(const std::vector<RunOutcome>& outcomes)
{
    std::vector<RunOrigin> origins;
    for (const RunOutcome& outcome : outcomes)
    {
        if (outcome.end == RunEnd::finished) origins.push_back(runOrigin(outcome.path));
    }
    return summaryOf(origins);
}

void speedAccuracy(const Arguments& args)
{
    const Study study = readStudy(args);
    const SpeedAccuracy chart(study, args.found("cost") ? args.get("cost") : "");
    study.dict.refuseUnused();
    StudyEngine engine(study, args, chart);
    engine.run();
    if (args.found("prepare")) return;

    const std::vector<SpeedAccuracyPoint> points = chart.points(engine.outcomes());
    printFront(study, chart, points);
    const std::filesystem::path output = studyOutput(args, study);
    writePoints(output/"speedAccuracy.csv", study, chart, points);
    drawPoints(output/"speedAccuracy", study, chart, points, footOf(engine.outcomes()));
    reportDeaths(engine.outcomes());
}

}

int main(int argc, char** argv)
{
    return runApplication(argc, argv, info(), speedAccuracy);
}
