#include "functionObjects/FunctionObjects.H"

namespace shizuku
{

FunctionObjects::FunctionObjects(const Time& time, bool enabled)
{
    const Dictionary functions = time.controlDict().subDictOrEmpty("functions");
    if (!enabled) return;
    for (const std::string& name : functions.dictKeys())
    {
        const Dictionary dict = functions.subDict(name);
        objects_.push_back(FunctionObjectTable::New
        (
            "functionObject", dict.lookup<std::string>("type"), dict.where("type"), dict,
            time.casePath() / "postProcessing" / name / time.name()
        ));
        dict.refuseUnused();
    }
    functions.refuseUnused();           // a value is no function object, unless a macro takes it
}

void FunctionObjects::execute(FlowView& flow)
{
    for (const auto& object : objects_) object->execute(flow);
}

void FunctionObjects::write()
{
    for (const auto& object : objects_) object->write();
}

}
