// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/Time.H"

#include "core/dictionary/Differences.H"
#include "core/fieldFile/AtomicFile.H"
#include "core/messages/Error.H"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <iostream>

namespace shizuku
{

namespace
{

namespace fs = std::filesystem;

// Before hours of computing, not at the first write.
void requireWritable(const fs::path& casePath)
{
    if (::access(casePath.c_str(), W_OK) == 0) return;
    throw FatalError("Cannot write to " + casePath.string() + ": " + std::strerror(errno));
}

// ".0.5.partial", or ".0.5.old.partial" of a file system that cannot exchange two folders.
bool isPartialTime(const std::string& name)
{
    const std::string written = finalName(name), old = ".old";
    const bool replaced = written.ends_with(old);
    return isPartialName(name) && timeOfName(replaced ? written.substr(0, written.size() - old.size()) : written);
}

void removePartialFolders(const fs::path& casePath)
{
    std::vector<fs::path> stale;
    for (const auto& entry : fs::directory_iterator(casePath))
    {
        if (entry.is_directory() && isPartialTime(entry.path().filename().string())) stale.push_back(entry.path());
    }
    for (const fs::path& folder : stale)
    {
        std::cout << "Removing " << folder.string() << ", which an interrupted run left incomplete" << std::endl;
        fs::remove_all(folder);
    }
}

TimeFolder findStart(const fs::path& casePath, const Controls& controls, const Dictionary& dict)
{
    const auto folders = timeFolders(casePath);
    if (folders.empty())
    {
        const SourceLocation where{casePath.string(), 0};
        throw FatalInputError(where, "The case has no time folder", "a folder such as 0 to start from: run fillLiquid, which makes it");
    }
    if (controls.startFrom == StartFrom::firstTime) return folders.front();
    if (controls.startFrom == StartFrom::latestTime) return folders.back();

    std::vector<std::string> names;
    for (const TimeFolder& folder : folders)
    {
        if (namesTime(folder.name, controls.startTime, controls.deltaT)) return folder;
        names.push_back(folder.name);
    }
    throw FatalInputError
    (
        dict.where("startTime"), "There is no folder of the startTime", "one of the times below", names
    );
}

void checkEnd(const Controls& controls, const Dictionary& dict, double startTime)
{
    if (controls.endTime > startTime - TimeState::tolerance * controls.deltaT) return;
    throw FatalInputError
    (
        dict.where("endTime"), "endTime is before the start time of the run",
        "a time from " + timeName(startTime, controls.deltaT, controls.nameFormat) + " on"
    );
}

// What is read at the start only has no effect on this run.
void reportChange(const EntryChange& change)
{
    const auto of = [&](const std::string& word) { return change.entry == word || change.entry.starts_with(word + "."); };
    const bool later = of("startFrom") || of("startTime") || of("functions") || of("application");
    std::cout << "    " << change.entry << ": " << change.before << " -> " << change.after
              << (later ? "   (acts at the next start)\n" : "\n");
}

void warnOfPrecision(const Controls& controls, const Dictionary& dict)
{
    if (controls.format.binary || controls.format.precision >= 9) return;
    warning("Fewer than 9 digits lose bits of a float: a restarted run will differ", dict.where("writePrecision"));
}

// Where a run starts.
TimeFolder startOf(const fs::path& casePath, const Controls& controls, const Dictionary& dict)
{
    TimeFolder folder = findStart(casePath, controls, dict);
    checkEnd(controls, dict, folder.value);
    warnOfPrecision(controls, dict);
    return folder;
}

}

namespace
{

// Whatever is written into a case that is not there any more would make it anew, without its dictionaries.
void refuseRemoved(const fs::path& casePath)
{
    if (fs::is_directory(casePath / "system")) return;
    throw FatalError("The case " + casePath.string() + " was removed or moved while it ran: its folder system is not there any more");
}

}

Time::Time(const fs::path& casePath, bool writes, const std::function<TimeFolder(const Controls&, const Dictionary&)>& start)
    : case_(casePath), writes_(writes), file_(case_ / "system/controlDict"), dict_(Dictionary::read(file_.path())),
      controls_(readControls(Dictionary::read(file_.path()))), pace_("Time")
{
    const TimeFolder folder = start(controls_, dict_);
    startFolder_ = folder.path;

    const TimeState fresh{folder.value, 0, controls_.deltaT, folder.value, 0};
    const std::optional<TimeState> written = readTimeState(folder.path);
    if (!written && folder.value != 0)
    {
        warning("The time has no uniform/time, which runs write: it is taken for a first start", {folder.path.string(), 0});
    }
    state_ = written.value_or(fresh);
    stopIndex_ = state_.index;
    use(controls_);
    start_ = state_;
}

Time::Time(const fs::path& casePath, bool writes)
    : Time(casePath, writes, [&](const Controls& controls, const Dictionary& dict) { return startOf(casePath, controls, dict); })
{}

Time::Time(const fs::path& casePath, const TimeFolder& stored)
    : Time(casePath, false, [&](const Controls&, const Dictionary&) { return stored; })
{}

void Time::use(const Controls& controls)
{
    if (controls.stopAt != controls_.stopAt) stopIndex_ = state_.index;
    controls_ = controls;
    if (state_.deltaT == controls.deltaT) return;
    state_.deltaT = controls.deltaT;
    state_.origin = state_.value;
    state_.originIndex = state_.index;
}

bool Time::intervalIsOver() const
{
    return controls_.write && due(*controls_.write);
}

bool Time::beforeEnd() const
{
    return state_.value < controls_.endTime - TimeState::tolerance * state_.deltaT;
}

bool Time::running() const
{
    switch (controls_.stopAt)
    {
        case StopAt::endTime: break;
        case StopAt::noWriteNow: return false;
        case StopAt::writeNow: return state_.index <= stopIndex_ && beforeEnd();
        case StopAt::nextWrite: return !(state_.index > stopIndex_ && intervalIsOver()) && beforeEnd();
    }
    return beforeEnd();
}

void Time::stop()
{
    controls_.stopAt = StopAt::writeNow;
    stopIndex_ = state_.index;
}

void Time::stopHere()
{
    stop();
    --stopIndex_;
}

void Time::advance()
{
    if (state_.index == start_.index)
    {
        if (writes_)
        {
            requireWritable(case_);
            removePartialFolders(case_);
        }
        pace_ = Progress("Time");
    }
    refuseRemoved(case_);
    ++state_.index;
    state_.value = state_.at(state_.index);
}

void Time::writeNext()
{
    askedIndex_ = state_.index + 1;
}

bool Time::writeDue() const
{
    if (state_.index == start_.index) return false;
    if (state_.index == askedIndex_) return true;
    if (!controls_.write) return false;
    return intervalIsOver() || (!running() && controls_.stopAt != StopAt::noWriteNow);
}

bool Time::reportDue() const
{
    return state_.index % controls_.reportInterval == 0 || writeDue();
}

// Folders that are to be removed once this one is written.
std::vector<fs::path> Time::noteWritten(const fs::path& folder)
{
    refuseRemoved(case_);
    if (folder == startFolder_)
    {
        throw FatalError("Writing would replace " + folder.string() + ", where the run started");
    }
    std::erase(written_, folder);
    written_.push_back(folder);
    std::vector<fs::path> surplus;
    while (controls_.purgeWrite > 0 && written_.size() > static_cast<std::size_t>(controls_.purgeWrite))
    {
        surplus.push_back(written_.front());
        written_.erase(written_.begin());
    }
    return surplus;
}

WriteJob Time::writing(std::function<void(const fs::path&)> fill)
{
    const fs::path folder = path();
    return [folder, surplus = noteWritten(folder), fill = std::move(fill), state = state_]
    {
        writeFolderAtomically(folder, [&](const fs::path& temporary)
        {
            fill(temporary);
            writeTimeState(temporary, state);
        });
        for (const fs::path& old : surplus) removeFolderAtomically(old);
    };
}

Time::SharedWriting Time::sharedWriting()
{
    const fs::path folder = path(), temporary = partialPath(folder);
    const auto end = [folder, temporary, surplus = noteWritten(folder), state = state_]
    {
        writeTimeState(temporary, state);
        putFolderInPlace(folder);
        for (const fs::path& old : surplus) removeFolderAtomically(old);
    };
    return {temporary, [folder] { makePartialFolder(folder); }, end};
}

std::string Time::name() const
{
    return timeName(state_.value, state_.deltaT, controls_.nameFormat);
}

fs::path Time::path() const
{
    return state_.index == start_.index ? startFolder_ : case_ / name();
}

bool Time::readIfModified()
{
    if (!modified()) return false;
    try
    {
        follow(readControlDict());
        return true;
    }
    catch (const FatalInputError& error)
    {
        leaveOut(error);
        return false;
    }
}

Time::ControlDict Time::readControlDict() const
{
    ControlDict now{Dictionary::read(file_.path()), Dictionary::read(file_.path()), {}};
    now.controls = readControls(now.checked);
    checkEnd(now.controls, now.checked, start_.value);
    return now;
}

void Time::follow(const ControlDict& now)
{
    warnOfPrecision(now.controls, now.checked);
    std::cout << "Read " << file_.path().string() << " anew, it has changed\n";
    for (const EntryChange& change : differences(dict_, now.dict)) reportChange(change);
    std::cout << std::flush;
    dict_ = now.dict;
    use(now.controls);
}

void Time::leaveOut(const FatalInputError& error)
{
    warning(std::string(error.what()) + "\nThe change of controlDict is left out, the former values stay in force");
}

std::string Time::progress() const
{
    const double whole = controls_.endTime - start_.value;
    return pace_.text(whole > 0 ? (state_.value - start_.value) / whole : 1);
}

}
