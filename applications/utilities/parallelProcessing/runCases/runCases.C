// runCases: runs many cases side by side on one machine, a few at a time.

#include "CaseRecord.H"
#include "Places.H"
#include "RunningCase.H"

#include "core/arguments/runApplication.H"
#include "core/messages/Error.H"
#include "core/messages/Progress.H"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <iomanip>
#include <iostream>
#include <memory>
#include <thread>

using namespace shizuku;

namespace
{

namespace fs = std::filesystem;

volatile std::sig_atomic_t interrupted = 0;

void onInterrupt(int signal) { interrupted = signal; }

const ApplicationInfo info
{
    "runCases",
    "Runs many case folders side by side: the Allrun of each, with its output in the case's log.runCases. "
    "Cases that have finished are left out, so that the same command goes on after an interruption.",
    {
        {"command", "LINE", "run this line of sh in each case instead of ./Allrun", ""},
        {"device", "auto|cuda|cpu", "where the cases compute; handed to ./Allrun where it is given", "auto"},
        {"jobs", "N", "cases at a time (default: the processor's cores; on GPUs -perDevice each)", ""},
        {"perDevice", "N", "cases at a time on each GPU", "4"}
    },
    {"cases..."},
    false
};

struct Case
{
    std::string name;               // as it was given
    fs::path path;
    CaseRecord record;
    bool finishedBefore = false;
    std::string reason = {};        // why it could not be started
};

std::string commandOf(const Arguments& args)
{
    if (args.found("command")) return args.get("command");
    return args.found("device") ? "./Allrun -device " + args.get("device") : "./Allrun";
}

// Refuses all that could not run before anything does.
std::vector<Case> readCases(const Arguments& args, const std::string& command)
{
    std::vector<Case> cases;
    for (const std::string& name : args.positionals("cases..."))
    {
        if (!fs::is_directory(name)) throw FatalInputError({name, 0}, "The case is no directory", "a case folder");
        const fs::path path = fs::canonical(name);
        if (!args.found("command") && access((path/"Allrun").c_str(), X_OK) != 0)
        {
            throw FatalInputError
            (
                {path.string(), 0}, "The case has no Allrun that can be executed", "one, or -command 'LINE'"
            );
        }
        for (const Case& other : cases)
        {
            if (other.path == path) throw FatalInputError({path.string(), 0}, "The case is given twice", "it once");
        }
        cases.push_back({name, path, readRecord(path)});
        const CaseRecord& record = cases.back().record;
        cases.back().finishedBefore = record.status == "finished" && record.command == command;
    }
    if (cases.empty()) throw FatalInputError({}, "No case is given", "runCases CASE ..., e.g. runCases sweep/*");
    return cases;
}

class Runs
{
public:
    Runs(std::vector<Case>& cases, const std::vector<Place>& places, const std::string& command)
    : places_(places), command_(command), progress_("Cases")
    {
        for (Case& each : cases)
        {
            if (!each.finishedBefore) waiting_.push_back(&each);
        }
        todo_ = waiting_.size();
        std::reverse(waiting_.begin(), waiting_.end());     // the first at the back, where it is taken from
    }

    void toTheEnd()
    {
        std::vector<Running> running(places_.size());
        while (done_ < todo_)
        {
            for (std::size_t i = 0; i < running.size(); ++i)
            {
                if (interrupted) stop(running);
                if (running[i].process && running[i].process->ended()) finish(running[i]);
                if (!running[i].process && !waiting_.empty()) start(running[i], places_[i]);
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }

private:
    struct Running
    {
        Case* of = nullptr;
        std::unique_ptr<RunningCase> process;
    };

    void start(Running& running, const Place& place)
    {
        Case& next = *waiting_.back();
        waiting_.pop_back();
        try
        {
            running = {&next, std::make_unique<RunningCase>(next.path, command_, place.environment)};
            next.record = {command_, "running", 0, 0};
            writeRecord(next.path, next.record);
            std::cout << "Started  " << next.name << (place.device.empty() ? "" : " on " + place.device) << std::endl;
        }
        catch (const FatalError& error)
        {
            running.process.reset();
            next.reason = error.what();
            next.record = {command_, "failed", 1, 0};
            said(next);
        }
    }

    void finish(Running& running)
    {
        Case& ended = *running.of;
        const int exit = running.process->exit();
        ended.record = {command_, exit == 0 ? "finished" : "failed", exit, running.process->seconds()};
        running.process.reset();
        try
        {
            writeRecord(ended.path, ended.record);
        }
        catch (const FatalError& error)
        {
            ended.reason = error.what();
            ended.record.status = "failed";
        }
        said(ended);
    }

    void said(const Case& ended)
    {
        ++done_;
        std::cout << (ended.record.status == "failed" ? "FAILED   " : "Finished ") << ended.name << " in "
                  << durationText(ended.record.seconds) << "  (" << done_ << " of " << todo_ << ": "
                  << progress_.text(double(done_)/double(todo_)) << ')' << std::endl;
        if (!ended.reason.empty()) std::cout << "    " << ended.reason << std::endl;
    }

    [[noreturn]] void stop(std::vector<Running>& running)
    {
        for (Running& each : running)
        {
            if (each.process) each.process->askToEnd();
        }
        for (Running& each : running) each.process.reset();
        throw FatalError
        (
            "Interrupted by signal " + std::to_string(interrupted) + ": what ran was stopped, after "
          + std::to_string(done_) + " of " + std::to_string(todo_) + " cases. The same command goes on."
        );
    }

    const std::vector<Place>& places_;
    std::string command_;
    Progress progress_;
    std::vector<Case*> waiting_;
    std::size_t todo_ = 0, done_ = 0;
};

void printTable(const std::vector<Case>& cases)
{
    std::size_t width = 4;
    for (const Case& each : cases) width = std::max(width, each.name.size());
    std::cout << '\n' << std::left << std::setw(int(width)) << "case" << "  status            seconds\n";
    for (const Case& each : cases)
    {
        std::string status = each.record.status;
        if (each.finishedBefore) status = "finished before";
        if (status == "failed" && each.reason.empty()) status += ", exit " + std::to_string(each.record.exit);
        std::cout << std::left << std::setw(int(width)) << each.name << "  " << std::setw(15) << status << std::right
                  << std::setw(10) << std::fixed << std::setprecision(1) << each.record.seconds << '\n';
    }
    std::cout << std::defaultfloat;
}

void runCases(const Arguments& args)
{
    const std::string command = commandOf(args);
    const std::vector<Place> where = places(args);
    std::vector<Case> cases = readCases(args, command);
    const auto count = [&](const auto& condition) { return std::count_if(cases.begin(), cases.end(), condition); };
    std::cout << "Cases : " << cases.size() << ", of which finished before "
              << count([](const Case& each) { return each.finishedBefore; }) << "; at a time " << where.size() << "\n\n";

    std::signal(SIGINT, onInterrupt);
    std::signal(SIGTERM, onInterrupt);
    Runs(cases, where, command).toTheEnd();
    printTable(cases);

    const auto failed = count([](const Case& each) { return each.record.status == "failed"; });
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
    return runApplication(argc, argv, info, runCases);
}
