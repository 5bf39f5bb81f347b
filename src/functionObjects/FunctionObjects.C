#include "functionObjects/FunctionObjects.H"

#include "core/fieldFile/BackgroundWriter.H"
#include "surface/CaseSurface.H"

namespace shizuku
{

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
        const Dictionary dict = functions.subDict(name);
        const FunctionSetting setting{time.casePath(), time.casePath() / "postProcessing" / name / time.name(), spacing};
        auto object = FunctionObjectTable::New
        (
            "functionObject", dict.lookup<std::string>("type"), dict.where("type"), dict, setting
        );
        entries_.push_back
        ({
            std::move(object), FunctionControl::execute(dict, time.deltaT()), FunctionControl::write(dict, time.deltaT())
        });
        dict.refuseUnused();
    }
    functions.refuseUnused();           // a value is no function object, unless a macro takes it
}

void FunctionObjects::execute(FlowView& flow)
{
    for (Entry& entry : entries_)
    {
        if (!entry.executeControl.due(flow.time)) continue;
        entry.object->execute(flow);
        entry.unwritten = true;
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

void FunctionObjects::modelsMade(FlowView& flow)
{
    for (Entry& entry : entries_) entry.object->modelsMade(flow);
}

}
