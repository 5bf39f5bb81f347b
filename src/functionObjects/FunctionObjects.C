// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/FunctionObjects.H"

#include "core/fieldFile/BackgroundWriter.H"
#include "surface/CaseSurface.H"

#include <algorithm>

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
}

bool FunctionObjects::lookAtDensities(const Time& time) const
{
    const auto looks = [&](const Entry& entry) { return entry.object->looksAtDensities() && entry.executeControl.mayBeDue(time); };
    return std::any_of(entries_.begin(), entries_.end(), looks);
}

void FunctionObjects::execute(FlowView& flow)
{
    for (Entry& entry : entries_)
    {
        if (!entry.executeControl.due(flow.time)) continue;
        entry.object->execute(flow);
        entry.unwritten = entry.object->table() != nullptr;
    }
}

void FunctionObjects::write(const Time& time, BackgroundWriter& writer)
{
    for (Entry& entry : entries_)
    {
        const bool due = entry.writeControl.due(time) || !time.running();
        if (!due || !entry.unwritten) continue;
        writer.add(entry.object->writing());
        entry.unwritten = false;
    }
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
