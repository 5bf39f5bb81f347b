// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/RunOrigin.H"

#include "study/SolverLog.H"

#include <fstream>
#include <regex>
#include <set>

namespace shizuku
{

RunOrigin runOrigin(const std::filesystem::path& casePath)
{
    static const std::regex first("Shizuku (\\S+), (\\w+ +\\d+ \\d+) .*"), device("Device : \\w+, ([^,]*).*");
    constexpr int head = 20;
    std::ifstream stream(solverLog(casePath));
    RunOrigin origin;
    std::smatch match;
    std::string line;
    for (int k = 0; k < head && std::getline(stream, line); ++k)
    {
        if (std::regex_match(line, match, first))
        {
            origin.version = match[1];
            origin.date = match[2];
        }
        else if (std::regex_match(line, match, device)) origin.device = match[1];
    }
    return origin;
}

std::string summaryOf(const std::vector<RunOrigin>& origins)
{
    std::string text;
    for (const auto part : {&RunOrigin::version, &RunOrigin::device, &RunOrigin::date})
    {
        std::set<std::string> words;
        for (const RunOrigin& origin : origins)
        {
            if (!(origin.*part).empty()) words.insert(origin.*part);
        }
        std::string list;
        for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
        if (!list.empty()) text += (text.empty() ? "" : "; ") + list;
    }
    return text;
}

}
