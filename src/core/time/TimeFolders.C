// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/Time.H"
#include "core/time/TimeName.H"
#include "core/time/TimeState.H"

#include <algorithm>

namespace shizuku
{

std::vector<TimeFolder> timeFolders(const std::filesystem::path& casePath)
{
    std::vector<TimeFolder> folders;
    for (const auto& entry : std::filesystem::directory_iterator(casePath))
    {
        const std::string name = entry.path().filename().string();
        const auto named = timeOfName(name);
        if (!named || !entry.is_directory()) continue;
        try
        {
            const auto state = readTimeState(entry.path());
            folders.push_back({state ? state->value : *named, name, entry.path()});
        }
        catch (const FatalInputError&)
        {
            if (std::filesystem::exists(entry.path())) throw;       // else purgeWrite of a run has removed it meanwhile
        }
    }
    std::sort
    (
        folders.begin(), folders.end(), [](const TimeFolder& a, const TimeFolder& b) { return a.value < b.value; }
    );
    return folders;
}

std::filesystem::path findInstance
(
    const std::filesystem::path& casePath, double time, const std::filesystem::path& relative
)
{
    const auto folders = timeFolders(casePath);
    for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder)
    {
        if (folder->value <= time && std::filesystem::exists(folder->path / relative)) return folder->path;
    }
    const auto constant = casePath / "constant";
    return std::filesystem::exists(constant / relative) ? constant : std::filesystem::path();
}

}
