// SPDX-License-Identifier: GPL-3.0-or-later
#include "StoredCase.H"

#include "caseFiles/LiquidFiles.H"
#include "core/fieldFile/CsvTable.H"
#include "liveView/CaseScene.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

std::vector<double> speedsAt(const TimeFolder& time, std::size_t particles)
{
    const auto file = time.path/"liquid/U";
    if (!std::filesystem::exists(file)) return {};
    const FieldData velocity = readField(file, FieldType::vector, dimensions::velocity, long(particles));
    std::vector<double> speeds(particles);
    for (std::size_t i = 0; i < particles; ++i) speeds[i] = std::hypot(velocity(i, 0), velocity(i, 1), velocity(i, 2));
    return speeds;
}

// Whether solid particles are elsewhere at another time, or have other angles.
bool changesSolid(const std::filesystem::path& casePath, const std::vector<TimeFolder>& times)
{
    const auto first = findInstance(casePath, times.front().value, "solid/theta"), last = findInstance(casePath, times.back().value, "solid/theta");
    return first != last || solidMoves(casePath);
}

// The tables below postProcessing whose rows are times, one row a time.
std::map<std::string, std::map<double, double>> measuredValues(const std::filesystem::path& casePath)
{
    std::map<std::string, std::map<double, double>> measured;
    const auto folder = casePath/"postProcessing";
    if (!std::filesystem::is_directory(folder)) return measured;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    {
        if (entry.path().extension() != ".csv") continue;
        const CsvTable table = CsvTable::read(entry.path());
        const std::string name = entry.path().lexically_relative(folder).begin()->string();
        if (table.columns().empty() || table.columns().front() != "time") continue;
        const std::vector<double> times = table.numbers("time");
        for (const std::string& column : table.columns())
        {
            std::vector<double> values;
            try { values = table.numbers(column); }
            catch (const FatalInputError&) { continue; }                // text
            if (column == "time") continue;
            for (std::size_t row = 0; row < values.size(); ++row) measured[name + ": " + column][times[row]] = values[row];
        }
    }
    return measured;
}

}

StoredCase::StoredCase(const Arguments& args)
:
    case_(args.casePath()),
    times_(selectTimesWith
    (
        args, [](const TimeFolder& time) { return std::filesystem::exists(time.path/"liquid/positions"); }, "liquid", "<time>/liquid/positions: run fillLiquid before"
    )),
    spacing_(readSpacing(case_)), solidChanges_(changesSolid(case_, times_)), measured_(measuredValues(case_))
{}

std::string StoredCase::scene(std::size_t stride) const
{
    std::string times;
    for (std::size_t i = 0; i < times_.size(); i += stride)
    {
        if (i > 0) times += ',';
        times += jsonNumber(times_[i].value);
    }
    return sceneText(case_, times_.front().value, "\"mode\":\"stored\",\"times\":[" + times + "]");
}

std::string StoredCase::solid(std::size_t index, std::size_t limit) const
{
    const double time = at(index).value;
    const auto folder = findInstance(case_, time, "solid/theta");
    std::vector<double> theta;
    if (!folder.empty()) theta = readField(folder/"solid/theta").values;
    return solidMessage(case_, time, theta, limit);
}

const TimeFolder& StoredCase::at(std::size_t index) const
{
    if (index >= times_.size()) throw FatalInputError({}, "There is no stored time " + std::to_string(index), "0 to " + std::to_string(times_.size() - 1));
    return times_[index];
}

std::string StoredCase::frame(std::size_t index, std::size_t limit) const
{
    const TimeFolder& time = at(index);
    ViewFrame frame;
    frame.time = time.value;
    frame.spacing = spacing_;
    frame.positions = readLiquidPositions(time.path, spacing_);
    frame.values = speedsAt(time, frame.positions.size());
    frame.unit = "m/s";
    frame.walls = movedWallsText(case_, time.value);
    for (const auto& [title, rows] : measured_)
    {
        const auto after = rows.upper_bound(time.value*(1 + 1e-9));     // the last row up to this time
        if (after != rows.begin()) frame.numbers.emplace_back(title, std::prev(after)->second);
    }
    return encodeFrame(frame, limit);
}

}
