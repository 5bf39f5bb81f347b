// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/RunCost.H"

#include "core/paths/Existence.H"
#include "core/time/PostProcessing.H"
#include "study/SolverLog.H"

#include <fstream>
#include <limits>
#include <regex>
#include <vector>

namespace shizuku
{

namespace
{

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// The solver reports some of its steps: "deltaT = 2.6e-05 s, 38 sub-steps, limited by capillary".
void readLog(const std::filesystem::path& log, RunCost& cost)
{
    static const std::regex particles("Liquid particles (\\d+).*"), step("deltaT = (\\S+) s, (\\d+) sub-step.*");
    static const std::regex time("Time = (\\S+) s  .*"), execution("ExecutionTime = (\\S+) s .*");
    double sum = 0;
    long count = 0;
    std::vector<double> times, executions;
    std::ifstream stream(log);
    std::smatch match;
    for (std::string line; std::getline(stream, line);)
    {
        if (std::regex_match(line, match, particles)) cost.particles = std::stod(match[1]);
        else if (std::regex_match(line, match, time)) times.push_back(std::stod(match[1]));
        else if (std::regex_match(line, match, execution) && executions.size() < times.size())
        {
            executions.push_back(std::stod(match[1]));
        }
        else if (std::regex_match(line, match, step))
        {
            sum += std::stod(match[1]);
            ++count;
        }
    }
    if (executions.size() > 1)
    {
        const std::size_t last = executions.size() - 1;
        cost.cpuTime = (executions[last] - executions[0])/(times[last] - times[0]);
    }
    if (count > 0) cost.subStep = sum/double(count);
}

}

RunCost runCost(const std::filesystem::path& casePath, const std::string& functionObject)
{
    RunCost cost{unknown, unknown, unknown, unknown, unknown};
    readLog(solverLog(casePath), cost);
    cost.particleSteps = cost.particles/cost.subStep;
    if (!isFolder(casePath/"postProcessing"/functionObject)) return cost;

    const CsvTable steps = readTable(casePath, functionObject, "stepTime.csv");
    double wall = 0;
    for (std::size_t row = 1; row < steps.rows(); ++row) wall += 1e-3*steps.number(row, "wall");
    if (steps.rows() > 1) cost.wallTime = wall/(steps.number(steps.rows() - 1, "time") - steps.number(0, "time"));
    return cost;
}

}
