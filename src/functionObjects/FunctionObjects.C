#include "functionObjects/FunctionObjects.H"

namespace shizuku
{

FunctionObjects::FunctionObjects(const Time& time, bool enabled) : time_(time)
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
}

void FunctionObjects::execute(const LiquidState& state)
{
    for (const auto& object : objects_) object->execute(time_, state);
}

void FunctionObjects::write()
{
    for (const auto& object : objects_) object->write();
}

}
