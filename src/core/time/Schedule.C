// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/Schedule.H"

#include <cmath>

namespace shizuku
{

namespace
{

long intervalsUntil(const TimeState& state, long step, double interval)
{
    const double nearest = state.at(step) + (0.5 + TimeState::tolerance) * state.deltaT;
    return static_cast<long>(std::floor(nearest / interval));
}

}

bool Schedule::due(const TimeState& state) const
{
    if (!inSeconds) return state.index % static_cast<long>(interval) == 0;
    return intervalsUntil(state, state.index, interval) > intervalsUntil(state, state.index - 1, interval);
}

std::vector<std::string> scheduleWords()
{
    return {"timeStep", "runTime", "adjustableRunTime"};
}

Schedule readSchedule(const Dictionary& dict, const std::string& what, const std::string& control, double deltaT)
{
    const std::string key = what + "Interval";
    if (control == "timeStep")
    {
        const int steps = dict.lookup<int>(key);
        if (steps >= 1) return {false, double(steps)};
        throw FatalInputError(dict.where(key), key + " is " + std::to_string(steps), "a whole number from 1");
    }
    const double interval = dict.lookupPositive(key, dimensions::time);
    const double steps = interval / deltaT;
    if (control == "adjustableRunTime" && std::abs(steps - std::round(steps)) > 1e-6 * steps)
    {
        throw FatalInputError
        (
            dict.where(key), key + " is " + std::to_string(steps) + " times deltaT",
            "a whole number of deltaT with " + what + "Control adjustableRunTime: deltaT is never shortened to meet a "
            "time of writing; " + what + "Control runTime writes at the nearest step"
        );
    }
    return {true, interval};
}

}
