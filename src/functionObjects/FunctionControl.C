// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/FunctionControl.H"

namespace shizuku
{

FunctionControl FunctionControl::execute(const Dictionary& dict, double deltaT)
{
    const bool asWritten = dict.found("writeControl") && !dict.found("executeControl") && !dict.found("executeInterval");
    return asWritten ? write(dict, deltaT) : FunctionControl(dict, "execute", "timeStep", deltaT);
}

FunctionControl FunctionControl::write(const Dictionary& dict, double deltaT)
{
    return FunctionControl(dict, "write", "writeTime", deltaT);
}

FunctionControl::FunctionControl
(
    const Dictionary& dict, const std::string& what, const std::string& fallback, double deltaT
)
{
    std::vector<std::string> words = scheduleWords();
    words.insert(words.end(), {"writeTime", "onEnd"});
    control_ = dict.lookupChoiceOr(what + "Control", words, fallback);
    const bool counted = control_ == "timeStep" || control_ == "writeTime";
    if (control_ == "onEnd" || (counted && !dict.found(what + "Interval"))) return;
    schedule_ = readSchedule(dict, what, counted ? "timeStep" : control_, deltaT);
}

bool FunctionControl::due(const Time& time)
{
    return mayBeDue(time) && (control_ != "writeTime" || ++writes_ % long(schedule_.interval) == 0);
}

bool FunctionControl::mayBeDue(const Time& time) const
{
    if (control_ == "onEnd") return !time.running();
    return control_ == "writeTime" ? time.writeDue() : time.due(schedule_);
}

}
