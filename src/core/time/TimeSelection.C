// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/Time.H"
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

std::vector<TimeFolder> chosenTimes(const Arguments& args)
{
    if (args.found("latestTime") && args.found("time"))
    {
        throw FatalInputError({}, "Both -latestTime and -time are given", "one of them");
    }
    const auto folders = timeFolders(args.casePath());
    if (folders.empty()) failNothing(args, "The case has no time folder", folders);
    if (args.found("latestTime")) return {folders.back()};
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

}

std::vector<TimeFolder> selectTimes(const Arguments& args)
{
    std::vector<TimeFolder> times = chosenTimes(args);
    if (!args.found("listTimes")) return times;
    for (const TimeFolder& time : times) std::cout << time.name << '\n';
    std::cout << std::flush;
    std::exit(EXIT_SUCCESS);
}

std::vector<TimeFolder> selectTimesWith
(
    const Arguments& args, const std::function<bool(const TimeFolder&)>& holds, const std::string& what, const std::string& expected
)
{
    std::vector<TimeFolder> times = selectTimes(args);
    std::erase_if(times, [&](const TimeFolder& time) { return !holds(time); });
    if (!times.empty()) return times;
    throw FatalInputError({args.casePath().string(), 0}, "None of the selected times holds " + what, expected);
}

}
