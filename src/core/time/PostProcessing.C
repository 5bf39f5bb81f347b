// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/PostProcessing.H"

#include "core/messages/Error.H"
#include "core/time/TimeName.H"

#include <algorithm>

namespace shizuku
{

namespace fs = std::filesystem;

CsvTable readTable(const fs::path& casePath, const std::string& name, const std::string& file)
{
    const fs::path folder = casePath/"postProcessing"/name;
    std::vector<std::pair<double, fs::path>> tables;
    if (fs::is_directory(folder))
    {
        for (const auto& entry : fs::directory_iterator(folder))
        {
            const auto start = timeOfName(entry.path().filename().string());
            if (start && fs::exists(entry.path()/file)) tables.emplace_back(*start, entry.path()/file);
        }
    }
    if (tables.empty()) throw FatalInputError({folder.string(), 0}, "There is no table " + file, "one below a start time");
    std::sort(tables.begin(), tables.end());
    CsvTable result = CsvTable::read(tables.front().second);
    for (auto next = tables.begin() + 1; next != tables.end(); ++next)
    {
        result.continueWith(CsvTable::read(next->second), "time");
    }
    return result;
}

}
