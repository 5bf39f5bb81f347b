// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/PostProcessing.H"

#include "core/fieldFile/AtomicFile.H"
#include "core/messages/Error.H"
#include "core/time/TimeName.H"

#include <algorithm>
#include <cmath>
#include <fstream>

namespace shizuku
{

namespace fs = std::filesystem;

namespace
{

// Folders of start times below postProcessing/<name>, with that time, in order.
std::vector<std::pair<double, fs::path>> runsOf(const fs::path& folder)
{
    std::vector<std::pair<double, fs::path>> runs;
    if (!fs::is_directory(folder)) return runs;
    for (const auto& entry : fs::directory_iterator(folder))
    {
        const auto start = timeOfName(entry.path().filename().string());
        if (start && entry.is_directory()) runs.emplace_back(*start, entry.path());
    }
    std::sort(runs.begin(), runs.end());
    return runs;
}

// Rows up to a time, which they have with nine digits.
std::size_t rowsUntil(double time, const CsvTable& table)
{
    const double last = time + 1e-8*std::abs(time);
    std::size_t rows = 0;
    while (rows < table.rows() && table.number(rows, "time") <= last) ++rows;
    return rows;
}

void keepRows(std::size_t rows, const fs::path& file)
{
    std::ifstream stream(file);
    std::string text, line;
    for (std::size_t n = 0; n <= rows && std::getline(stream, line); ++n) text += line + '\n';
    writeAtomically(file, [&](std::ostream& kept) { kept << text; });
}

}

CsvTable readTable(const fs::path& casePath, const std::string& name, const std::string& file)
{
    const fs::path folder = casePath/"postProcessing"/name;
    std::vector<fs::path> tables;
    for (const auto& [start, run] : runsOf(folder))
    {
        if (fs::exists(run/file)) tables.push_back(run/file);
    }
    if (tables.empty()) throw FatalInputError({folder.string(), 0}, "There is no table " + file, "one below a start time");
    CsvTable result = CsvTable::read(tables.front());
    for (auto next = tables.begin() + 1; next != tables.end(); ++next)
    {
        result.continueWith(CsvTable::read(*next), "time");
    }
    return result;
}

void dropRowsBehind(double start, const fs::path& table)
{
    for (const auto& [ofRun, run] : runsOf(table.parent_path().parent_path()))
    {
        const fs::path file = run/table.filename();
        fs::remove(partialPath(file));
        if (file == table || !fs::exists(file)) continue;
        try
        {
            const CsvTable earlier = CsvTable::read(file);
            const std::size_t rows = rowsUntil(start, earlier);
            if (rows == earlier.rows()) continue;
            if (rows > 0) keepRows(rows, file);
            else fs::remove(file);
        }
        catch (const FatalInputError& error)
        {
            warning(std::string(error.what()) + "\nThis table of an earlier run is left as it is");
        }
        std::error_code notEmpty;
        if (!fs::exists(file)) fs::remove(run, notEmpty);
    }
}

}
