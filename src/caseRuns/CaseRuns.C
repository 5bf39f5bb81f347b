// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseRuns/CaseRuns.H"

#include "core/messages/Error.H"

#include <algorithm>
#include <csignal>
#include <iostream>
#include <thread>

namespace shizuku
{

namespace
{

volatile std::sig_atomic_t interrupted = 0;

void onInterrupt(int signal) { interrupted = signal; }

}

CaseRuns::CaseRuns
(
    std::vector<CaseRun>& cases, const std::vector<Place>& places, std::function<void(const CaseRun&)> ended
)
:
    places_(places), ended_(std::move(ended)), progress_("Cases")
{
    for (CaseRun& each : cases)
    {
        if (!each.finishedBefore) waiting_.push_back(&each);
    }
    todo_ = waiting_.size();
    std::reverse(waiting_.begin(), waiting_.end());     // the first at the back, where it is taken from
}

void CaseRuns::toTheEnd()
{
    std::signal(SIGINT, onInterrupt);
    std::signal(SIGTERM, onInterrupt);
    std::vector<Running> running(places_.size());
    while (done_ < todo_)
    {
        for (std::size_t i = 0; i < running.size(); ++i)
        {
            if (interrupted) stop(running);
            endLate(running[i]);
            if (running[i].process && running[i].process->ended()) finish(running[i]);
            if (!running[i].process && !waiting_.empty()) start(running[i], places_[i]);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

void CaseRuns::start(Running& running, const Place& place)
{
    CaseRun& next = *waiting_.back();
    waiting_.pop_back();
    try
    {
        if (next.prepare) next.prepare();
        running = {&next, std::make_unique<RunningCase>(next.path, next.command, place.environment)};
        next.record = {next.command, "running", 0, 0};
        writeRecord(next.path, next.record);
        std::cout << "Started  " << next.name << (place.device.empty() ? "" : " on " + place.device) << std::endl;
    }
    catch (const FatalError& error)
    {
        running.process.reset();
        next.record = {next.command, "failed", 1, 0, error.what()};
        said(next);
    }
}

void CaseRuns::endLate(Running& running)
{
    if (!running.process || running.of->timeLimit <= 0 || running.process->seconds() < running.of->timeLimit) return;
    if (running.process->ended()) return;
    running.process->stop();
    running.of->record.reason = "Stopped after " + durationText(running.of->timeLimit) + ", the limit of its time";
    finish(running);
}

void CaseRuns::finish(Running& running)
{
    CaseRun& ended = *running.of;
    const std::string reason = ended.record.reason;
    const int exit = reason.empty() ? running.process->exit() : 1;
    ended.record = {ended.command, exit == 0 ? "finished" : "failed", exit, running.process->seconds(), reason};
    running.process.reset();
    try
    {
        writeRecord(ended.path, ended.record);
    }
    catch (const FatalError& error)
    {
        ended.record.reason = error.what();
        ended.record.status = "failed";
    }
    said(ended);
}

void CaseRuns::said(const CaseRun& ended)
{
    ++done_;
    std::cout << progress_.ended(ended.name, ended.record.status != "failed", ended.record.seconds, done_, todo_) << std::endl;
    if (!ended.record.reason.empty()) std::cout << "    " << ended.record.reason << std::endl;
    ended_(ended);
}

void CaseRuns::stop(std::vector<Running>& running)
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

}
