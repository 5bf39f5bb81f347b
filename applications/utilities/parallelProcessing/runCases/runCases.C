// SPDX-License-Identifier: GPL-3.0-or-later
// runCases: runs many cases side by side on one machine, a few at a time.

#include "caseRuns/CaseRuns.H"
#include "caseRuns/MultiProcessService.H"
#include "core/arguments/runApplication.H"
#include "core/messages/Error.H"
#include "core/paths/Existence.H"

#include <unistd.h>

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <optional>

using namespace shizuku;

namespace
{

namespace fs = std::filesystem;

ApplicationInfo info()
{
    ApplicationInfo result
    {
        "runCases",
        "Run the Allrun of many case folders side by side. The output of each goes to its log.runCases. "
        "Finished cases are skipped, so the same command continues after an interruption.",
        {
            {"command", "LINE", "Run this line of sh in each case instead of ./Allrun", ""},
            {"mps", "", "Share each GPU by NVIDIA's multi-process service, which is started for this run", ""}
        },
        {"cases..."},
        false
    };
    for (const Option& option : placeOptions(4)) result.options.push_back(option);
    return result;
}

std::string commandOf(const Arguments& args)
{
    if (args.found("command")) return args.get("command");
    return args.found("device") ? "./Allrun -device " + args.get("device") : "./Allrun";
}

// Refuses all that could not run before anything does.
std::vector<CaseRun> readCases(const Arguments& args, const std::string& command)
{
    std::vector<CaseRun> cases;
    for (const std::string& name : args.positionals("cases..."))
    {
        if (!isFolder(name)) throw FatalInputError({name, 0}, "The case is no directory", "a case folder");
        const fs::path path = fs::canonical(name);
        if (!args.found("command") && access((path/"Allrun").c_str(), X_OK) != 0)
        {
            throw FatalInputError
            (
                {path.string(), 0}, "The case has no Allrun that can be executed", "one, or -command 'LINE'"
            );
        }
        for (const CaseRun& other : cases)
        {
            if (other.path == path) throw FatalInputError({path.string(), 0}, "The case is given twice", "it once");
        }
        const CaseRecord record = readRecord(path);
        const bool finished = record.status == "finished" && record.command == command;
        cases.push_back({name, path, command, record, finished});
    }
    if (cases.empty()) throw FatalInputError({}, "No case is given", "runCases CASE ..., e.g. runCases sweep/*");
    return cases;
}

void printTable(const std::vector<CaseRun>& cases)
{
    std::size_t width = 4;
    for (const CaseRun& each : cases) width = std::max(width, each.name.size());
    std::cout << '\n' << std::left << std::setw(int(width)) << "case" << "  status            seconds\n";
    for (const CaseRun& each : cases)
    {
        std::string status = each.record.status;
        if (each.finishedBefore) status = "finished before";
        if (status == "failed" && each.record.reason.empty()) status += ", exit " + std::to_string(each.record.exit);
        std::cout << std::left << std::setw(int(width)) << each.name << "  " << std::setw(15) << status << std::right
                  << std::setw(10) << std::fixed << std::setprecision(1) << each.record.seconds << '\n';
    }
    std::cout << std::defaultfloat;
}

void runCases(const Arguments& args)
{
    const std::vector<Place> where = places(args);
    if (args.found("mps") && where.front().device.empty())
    {
        throw FatalInputError({}, "Option -mps is given, but the cases run on the CPU", "a GPU, or no -mps");
    }
    std::vector<CaseRun> cases = readCases(args, commandOf(args));
    const auto count = [&](const auto& condition) { return std::count_if(cases.begin(), cases.end(), condition); };
    std::cout << "Cases : " << cases.size() << ", of which finished before "
              << count([](const CaseRun& each) { return each.finishedBefore; }) << "; at a time " << where.size() << "\n\n";

    std::optional<MultiProcessService> sideBySide;
    if (args.found("mps")) sideBySide.emplace();
    CaseRuns(cases, where).toTheEnd();
    printTable(cases);

    const auto failed = count([](const CaseRun& each) { return each.record.status == "failed"; });
    if (failed == 0) return;
    throw FatalError
    (
        std::to_string(failed) + " of " + std::to_string(cases.size())
      + " cases failed; what each printed is in its log.runCases"
    );
}

}

int main(int argc, char** argv)
{
    return runApplication(argc, argv, info(), runCases);
}
