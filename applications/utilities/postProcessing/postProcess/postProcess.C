// SPDX-License-Identifier: GPL-3.0-or-later
// postProcess: the case's function objects on its stored times, with the tables that a run writes.
//
// The liquid of each time is read as for a restart, and what lies around each particle is listed anew: sums over neighbours agree with a
// run's to the rounding of single precision.

#include "caseFiles/LiquidFiles.H"
#include "core/arguments/runApplication.H"
#include "core/time/PostProcessing.H"
#include "device/DeviceApplication.H"
#include "functionObjects/FunctionControl.H"
#include "functionObjects/FunctionObject.H"
#include "functionObjects/ModelList.H"
#include "motion/Motion.H"
#include "stepping/CaseSetup.H"

#include <algorithm>
#include <iostream>

namespace shizuku
{

namespace
{

struct Measurement
{
    std::string name;
    std::unique_ptr<FunctionObject> object;
};

// Of the name in system/controlDict, or of the type of that name with its defaults.
Dictionary entriesOf(const Dictionary& functions, const std::string& name)
{
    const std::vector<std::string> known = functions.dictKeys(), types = FunctionObjectTable::words();
    if (std::find(known.begin(), known.end(), name) != known.end()) return functions.subDict(name);
    if (std::find(types.begin(), types.end(), name) != types.end()) return Dictionary::parse("type " + name + ";", "-func " + name);
    std::vector<std::string> names = known;
    names.insert(names.end(), types.begin(), types.end());
    throw FatalInputError(functions.where(), "There is no function object '" + name + "'", "one of system/controlDict, or a type", names, name);
}

std::unique_ptr<FunctionObject> make(const Dictionary& dict, const FunctionSetting& setting, double deltaT)
{
    auto object = FunctionObjectTable::New("functionObject", dict.lookup<std::string>("type"), dict.where("type"), dict, setting);
    if (dict.found("libs")) dict.lookup<std::vector<std::string>>("libs");      // of OpenFOAM's
    dict.lookupOr("enabled", true);                 // it is asked for
    FunctionControl::execute(dict, deltaT);         // when, which is now
    FunctionControl::write(dict, deltaT);
    dict.refuseUnused();
    return object;
}

// Those of -func, or all of the case; what needs more than stored times is refused, or left out.
std::vector<Measurement> measurements(const Arguments& args, const Time& first, double spacing)
{
    const Dictionary functions = first.controlDict().subDictOrEmpty("functions");
    const bool named = args.found("func");
    std::vector<Measurement> result;
    for (const std::string& name : named ? args.getList("func") : functions.dictKeys())
    {
        const Dictionary dict = entriesOf(functions, name);
        if (!named && !dict.lookupOr("enabled", true)) continue;
        const FunctionSetting setting{first.casePath(), first.casePath() / "postProcessing" / (name + ".stored") / first.name(), spacing};
        auto object = make(dict, setting, first.deltaT());
        if (const std::string reason = object->needsOfRun(); !reason.empty())
        {
            const std::string found = "The function object '" + name + "' needs a run: " + reason;
            if (named) throw FatalInputError(dict.where(), found, "one that measures what stored times hold");
            std::cout << found << ". It is left out\n";
            continue;
        }
        result.push_back({name, std::move(object)});
    }
    if (result.empty()) throw FatalInputError(functions.where(), "There is no function object for stored times", "one, or -func with a type");
    return result;
}

void measure(const Time& time, std::vector<Measurement>& measurements)
{
    CaseSetup setup(time.casePath());
    setup.make(time.value());
    setup.readParticles(time);
    Neighbourhood near(*setup.liquid);
    predictPositions(*setup.liquid, 0);
    near.update(*setup.liquid);
    setup.walls->update(*setup.liquid);
    FlowView flow(time, *setup.liquid, near, *setup.walls, *setup.models);
    for (Measurement& measurement : measurements)
    {
        measurement.object->modelsMade(flow);
        measurement.object->execute(flow);
    }
}

void postProcess(const Arguments& args)
{
    const auto holds = [](const TimeFolder& time) { return std::filesystem::exists(time.path / "liquid/U"); };
    const auto times = selectTimesWith(args, holds, "liquid", "<time>/liquid/positions and U, of fillLiquid or the solver");
    openNamedDevice();

    const Time first(args.casePath(), times.front());
    std::vector<Measurement> all = measurements(args, first, readSpacing(args.casePath()));
    for (const TimeFolder& time : times)
    {
        std::cout << "Time = " << time.name << " s" << std::endl;
        measure(Time(args.casePath(), time), all);
    }
    for (const Measurement& measurement : all)
    {
        const CsvFile& table = *measurement.object->table();
        dropRowsBehind(first.value(), table.file());
        measurement.object->writing()();
        std::cout << "Wrote " << table.file().string() << ": " << table.rows() << (table.rows() == 1 ? " row\n" : " rows\n");
    }
}

}

}

extern "C" int runOnDevice(int argc, char** argv)
{
    using namespace shizuku;
    ApplicationInfo info
    {
        .name = "postProcess",
        .summary = "Apply function objects to stored times. Tables go to postProcessing/<name>.stored/<first time>.",
        .options =
        {
            deviceOption(),
            precisionOption(),
            {"func", "LIST", "Names from system/controlDict, or types, e.g. \"(drop energy)\" (default: all of system/controlDict)", ""}
        },
        .models = modelList
    };
    for (const Option& option : timeSelectionOptions()) info.options.push_back(option);
    return runApplication(argc, argv, info, postProcess);
}
