// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/FunctionObjects.H"

#include "core/fieldFile/AtomicFile.H"
#include "core/fieldFile/BackgroundWriter.H"
#include "core/fieldFile/FoamFileHeader.H"
#include "core/time/PostProcessing.H"
#include "surface/CaseSurface.H"

#include <algorithm>
#include <limits>
#include <utility>

namespace shizuku
{

namespace
{

// The name is that of a folder below postProcessing.
void checkName(const Dictionary& functions, const std::string& name)
{
    const bool leadsElsewhere = name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos;
    if (!leadsElsewhere) return;
    throw FatalInputError
    (
        functions.where(name), "The function object is named '" + name + "', which names no folder below postProcessing",
        "a name without '/', other than . and .."
    );
}

std::filesystem::path stateFile(const std::filesystem::path& timeFolder)
{
    return timeFolder / "uniform" / "functionObjects";
}

const std::string countedWrites = "executeControlWrites";

template<class Entries>
bool any(const Entries& entries, bool (FunctionObject::*looks)() const)
{
    return std::any_of(entries.begin(), entries.end(), [&](const auto& entry) { return (*entry.object.*looks)(); });
}

void writeState(std::ostream& stream, const std::string& name, const KeptNumbers& state)
{
    stream << name << "\n{\n";
    for (const auto& [entry, numbers] : state)
    {
        stream << "    " << entry << " (";
        for (const double number : numbers) stream << ' ' << number;
        stream << " );\n";
    }
    stream << "}\n";
}

}

void FunctionSetting::requireSurface() const
{
    readSurfaceParameters(casePath, 1);
}

FunctionObjects::FunctionObjects(const Time& time, double spacing, bool enabled)
{
    const Dictionary functions = time.controlDict().subDictOrEmpty("functions");
    if (!enabled) return;
    for (const std::string& name : functions.dictKeys())
    {
        checkName(functions, name);
        const Dictionary dict = functions.subDict(name);
        if (dict.found("libs")) dict.lookup<std::vector<std::string>>("libs");      // of OpenFOAM's: here all are there
        if (!dict.lookupOr("enabled", true))
        {
            dict.markUsed();
            continue;
        }
        const FunctionSetting setting{time.casePath(), time.casePath() / "postProcessing" / name / time.name(), spacing};
        auto object = FunctionObjectTable::New
        (
            "functionObject", dict.lookup<std::string>("type"), dict.where("type"), dict, setting
        );
        entries_.push_back
        ({
            name, std::move(object), FunctionControl::execute(dict, time.deltaT()), FunctionControl::write(dict, time.deltaT())
        });
        dict.refuseUnused();
    }
    functions.refuseUnused();           // a value is no function object, unless a macro takes it
    for (Entry& entry : entries_) entry.object->connect(*this);
    if (time.index() > 0) goOn(time);
}

void FunctionObjects::goOn(const Time& time)
{
    const auto file = stateFile(time.path());
    if (!std::filesystem::exists(file)) return;
    const Dictionary states = Dictionary::read(file);
    for (Entry& entry : entries_)
    {
        const Dictionary dict = states.subDictOrEmpty(entry.name);
        KeptNumbers state;
        for (const std::string& name : dict.keys()) state[name] = dict.lookup<std::vector<double>>(name);
        const std::vector<double>& counted = state[countedWrites];
        if (!counted.empty()) entry.executeControl.goOn(long(counted.front()));
        entry.object->goOn(state, time.value());
    }
}

std::function<void(const std::filesystem::path&)> FunctionObjects::writingState(const Time& time) const
{
    std::map<std::string, KeptNumbers> states;
    for (const Entry& entry : entries_)
    {
        KeptNumbers state = entry.object->state(time.value());
        if (const long writes = entry.executeControl.writes(); writes > 0) state[countedWrites] = {double(writes)};
        if (!state.empty()) states[entry.name] = std::move(state);
    }
    return [states](const std::filesystem::path& timeFolder)
    {
        if (states.empty()) return;
        const auto file = stateFile(timeFolder);
        writeAtomically(file, [&](std::ostream& stream)
        {
            writeFoamFileHeader(stream, file, "dictionary");
            stream.precision(std::numeric_limits<double>::max_digits10);
            for (const auto& [name, state] : states) writeState(stream, name, state);
        });
    };
}

bool FunctionObjects::anyDue(const Time& time, bool (FunctionObject::*looks)() const) const
{
    const auto isOne = [&](const Entry& entry) { return (*entry.object.*looks)() && entry.executeControl.mayBeDue(time); };
    return std::any_of(entries_.begin(), entries_.end(), isOne);
}

bool FunctionObjects::lookAtDensities(const Time& time) const { return anyDue(time, &FunctionObject::looksAtDensities); }
bool FunctionObjects::lookAtParticles(const Time& time) const { return anyDue(time, &FunctionObject::looksAtParticles); }
bool FunctionObjects::lookAtSurface(const Time& time) const { return anyDue(time, &FunctionObject::looksAtSurface); }
bool FunctionObjects::lookAtWholeSurface(const Time& time) const { return anyDue(time, &FunctionObject::looksAtWholeSurface); }

bool FunctionObjects::lookAtViscousWork() const { return any(entries_, &FunctionObject::looksAtViscousWork); }
bool FunctionObjects::lookAtWallReactions() const { return any(entries_, &FunctionObject::looksAtWallReactions); }

void FunctionObjects::execute(FlowView& flow)
{
    for (Entry& entry : entries_)
    {
        if (!entry.executeControl.due(flow.time)) continue;
        if (flow.parts().part() > 0 && !entry.object->measuresInParts()) continue;
        entry.object->execute(flow);
        entry.unwritten = entry.object->table() != nullptr;
    }
}

void FunctionObjects::write(const Time& time, BackgroundWriter& writer)
{
    for (Entry& entry : entries_)
    {
        const bool due = entry.writeControl.due(time) || time.writeDue() || !time.running();
        if (!due || !entry.unwritten) continue;
        if (!std::exchange(entry.written, true))
        {
            const std::filesystem::path table = entry.object->table()->file();
            writer.add([start = time.startTime(), table] { dropRowsBehind(start, table); });
        }
        writer.add(entry.object->writing());
        entry.unwritten = false;
    }
}

std::string FunctionObjects::report() const
{
    std::string lines;
    for (const Entry& entry : entries_)
    {
        const std::string text = entry.object->report();
        if (!text.empty()) lines += entry.name + ": " + text + '\n';
    }
    return lines;
}

std::vector<std::pair<std::string, double>> FunctionObjects::lastNumbers() const
{
    std::vector<std::pair<std::string, double>> numbers;
    for (const Entry& entry : entries_)
    {
        const CsvFile* const table = entry.object->table();
        for (std::size_t c = 0; table && c < table->lastRow().size(); ++c)
        {
            const double* const number = std::get_if<double>(&table->lastRow()[c]);
            if (number && table->columns()[c] != "time") numbers.emplace_back(entry.name + ": " + table->titles()[c], *number);
        }
    }
    return numbers;
}

std::string FunctionObjects::reasonToEnd() const
{
    for (const Entry& entry : entries_)
    {
        const std::string reason = entry.object->reasonToEnd();
        if (!reason.empty()) return entry.name + ": " + reason;
    }
    return {};
}

const CsvFile& FunctionObjects::tableOf(const Dictionary& dict, const std::string& key) const
{
    std::vector<std::string> names;
    for (const Entry& entry : entries_)
    {
        if (entry.object->table()) names.push_back(entry.name);
    }
    const std::string name = dict.lookupChoice(key, names);
    const auto named = [&](const Entry& entry) { return entry.name == name; };
    return *std::find_if(entries_.begin(), entries_.end(), named)->object->table();
}

void FunctionObjects::modelsMade(FlowView& flow)
{
    for (Entry& entry : entries_) entry.object->modelsMade(flow);
}

}
