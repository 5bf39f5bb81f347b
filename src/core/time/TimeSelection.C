// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/LatestTime.H"
#include "core/time/TimeName.H"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <sstream>

namespace shizuku
{

namespace
{

// A closed range of times; a single time is a range of one.
struct TimeRange
{
    double from = -std::numeric_limits<double>::infinity();
    double to = std::numeric_limits<double>::infinity();
};

double readBound(const std::string& text, const std::string& option)
{
    if (const auto value = timeOfName(text)) return *value;
    throw FatalInputError
    (
        {}, "Option -time has the value '" + option + "'", "a time A or a range A:B, A: or :B, several with commas"
    );
}

std::vector<TimeRange> readRanges(const std::string& option)
{
    std::vector<TimeRange> ranges;
    std::istringstream parts(option);
    for (std::string part; std::getline(parts, part, ',');)
    {
        TimeRange range;
        const auto colon = part.find(':');
        const std::string from = part.substr(0, colon);
        const std::string to = colon == std::string::npos ? from : part.substr(colon + 1);
        if (colon == std::string::npos || !from.empty()) range.from = readBound(from, option);
        if (colon == std::string::npos || !to.empty()) range.to = readBound(to, option);
        ranges.push_back(range);
    }
    return ranges;
}

// By the name, which is what the user sees and types.
bool selected(const TimeFolder& folder, const std::vector<TimeRange>& ranges)
{
    const double named = timeOfName(folder.name).value();
    return std::any_of
    (
        ranges.begin(), ranges.end(), [&](const TimeRange& range) { return named >= range.from && named <= range.to; }
    );
}

[[noreturn]] void failNothing(const Arguments& args, const std::string& found, const std::vector<TimeFolder>& folders)
{
    std::vector<std::string> names;
    for (const TimeFolder& folder : folders) names.push_back(folder.name);
    const std::string expected = names.empty() ? "a time folder such as 0" : "one of the times below";
    throw FatalInputError({args.casePath().string(), 0}, found, expected, names);
}

}

std::vector<Option> timeSelectionOptions()
{
    return
    {
        {"latestTime", "", "Only the latest time", ""},
        {"listTimes", "", "Print the selected times and stop", ""},
        {"time", "A[:B]", "Only the time A, or the range A:B, A: or :B; several with commas", ""},
    };
}

namespace
{

using Holds = std::function<bool(const TimeFolder&)>;

// Beside a run the later ones may not have been worked on yet, which is said.
std::vector<TimeFolder> latestOf(const std::vector<TimeFolder>& folders, const Holds& holds, const std::string& what)
{
    const auto latest = std::find_if(folders.rbegin(), folders.rend(), holds);
    if (latest == folders.rend()) return {};
    if (latest != folders.rbegin() && !what.empty())
    {
        std::cout << "The latest time " << folders.back().name << " does not hold " << what << ". The latest one that does is " << latest->name << std::endl;
    }
    return {*latest};
}

std::vector<TimeFolder> chosenTimes(const Arguments& args, const Holds& holds, const std::string& what)
{
    if (args.found("latestTime") && args.found("time"))
    {
        throw FatalInputError({}, "Both -latestTime and -time are given", "one of them");
    }
    const auto folders = timeFolders(args.casePath());
    if (folders.empty()) failNothing(args, "The case has no time folder", folders);
    if (args.found("latestTime")) return latestOf(folders, holds, args.found("listTimes") ? "" : what);
    if (!args.found("time")) return folders;

    const auto ranges = readRanges(args.get("time"));
    std::vector<TimeFolder> chosen;
    for (const TimeFolder& folder : folders)
    {
        if (selected(folder, ranges)) chosen.push_back(folder);
    }
    if (chosen.empty()) failNothing(args, "The option -time " + args.get("time") + " selects no time", folders);
    return chosen;
}

std::vector<TimeFolder> listedOrChosen(const Arguments& args, const Holds& holds, const std::string& what)
{
    std::vector<TimeFolder> times = chosenTimes(args, holds, what);
    if (!args.found("listTimes")) return times;
    for (const TimeFolder& time : times) std::cout << time.name << '\n';
    std::cout << std::flush;
    std::exit(EXIT_SUCCESS);
}

}

std::vector<TimeFolder> selectTimes(const Arguments& args)
{
    return listedOrChosen(args, [](const TimeFolder&) { return true; }, "");
}

std::vector<TimeFolder> selectTimesWith
(
    const Arguments& args, const std::function<bool(const TimeFolder&)>& holds, const std::string& what, const std::string& expected
)
{
    std::vector<TimeFolder> times = listedOrChosen(args, holds, what);
    std::erase_if(times, [&](const TimeFolder& time) { return !holds(time); });
    if (!times.empty()) return times;
    throw FatalInputError({args.casePath().string(), 0}, "None of the selected times holds " + what, expected);
}

TimeFolder latestTimeWith
(
    const std::filesystem::path& casePath, const std::function<bool(const TimeFolder&)>& holds, const std::string& what, const std::string& expected
)
{
    const std::vector<TimeFolder> latest = latestOf(timeFolders(casePath), holds, what);
    if (!latest.empty()) return latest.back();
    throw FatalInputError({casePath.string(), 0}, "No time holds " + what, expected);
}

}
