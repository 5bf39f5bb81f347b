// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/RunReason.H"

#include <fstream>

namespace shizuku
{

std::string reasonOf(const std::filesystem::path& casePath, int exit)
{
    std::ifstream stream(casePath/"log.runCases");
    std::string reason, last;
    bool inError = false;
    for (std::string line; std::getline(stream, line);)
    {
        const std::size_t first = line.find_first_not_of(" \t");
        const bool blank = first == std::string::npos;
        if (!blank) last = line;
        if (line.find("--> FATAL") != std::string::npos)
        {
            reason.clear();
            inError = true;
            continue;
        }
        if (inError && blank && !reason.empty()) inError = false;
        if (inError && !blank) reason += (reason.empty() ? "" : " ") + line.substr(first);
    }
    if (!reason.empty()) return reason;
    return exit > 128 ? "ended by signal " + std::to_string(exit - 128)
        : "exit " + std::to_string(exit) + (last.empty() ? "" : "; " + last);
}

}
