#include "functionObjects/FunctionObjects.H"

namespace shizuku
{

FunctionObjects::FunctionObjects(FlowView& flow, bool enabled)
{
    const Time& time = flow.time;
    const Dictionary functions = time.controlDict().subDictOrEmpty("functions");
    if (!enabled) return;
    for (const std::string& name : functions.dictKeys())
    {
        const Dictionary dict = functions.subDict(name);
        auto object = FunctionObjectTable::New
        (
            "functionObject", dict.lookup<std::string>("type"), dict.where("type"), dict, flow,
            time.casePath() / "postProcessing" / name / time.name()
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

void FunctionObjects::write(const Time& time)
{
    for (Entry& entry : entries_)
    {
        const bool due = entry.writeControl.due(time) || !time.running();
        if (!due || !entry.unwritten) continue;
        entry.object->write();
        entry.unwritten = false;
    }
}

void FunctionObjects::modelsChanged(FlowView& flow)
{
    for (Entry& entry : entries_) entry.object->modelsChanged(flow);
}

}
