// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/TimeState.H"

#include "core/dictionary/Dictionary.H"
#include "core/fieldFile/AtomicFile.H"
#include "core/fieldFile/FoamFileHeader.H"
#include "core/time/TimeName.H"

#include <cmath>
#include <limits>

namespace shizuku
{

namespace
{

std::filesystem::path stateFile(const std::filesystem::path& timeFolder)
{
    return timeFolder / "uniform" / "time";
}

}

double TimeState::at(long step) const
{
    return std::fma(static_cast<double>(step - originIndex), deltaT, origin);
}

void writeTimeState(const std::filesystem::path& timeFolder, const TimeState& state)
{
    const auto file = stateFile(timeFolder);
    writeAtomically(file, [&](std::ostream& stream)
    {
        writeFoamFileHeader(stream, file, "dictionary");
        stream.precision(std::numeric_limits<double>::max_digits10);
        stream
            << "value           " << state.value << ";\n"
            << "index           " << state.index << ";\n"
            << "deltaT          " << state.deltaT << ";\n"
            << "origin          " << state.origin << ";\n"
            << "originIndex     " << state.originIndex << ";\n";
    });
}

std::optional<TimeState> readTimeState(const std::filesystem::path& timeFolder)
{
    const auto file = stateFile(timeFolder);
    if (!std::filesystem::exists(file)) return {};
    const Dictionary dict = Dictionary::read(file);
    TimeState state;
    state.value = dict.lookup<double>("value");
    state.index = dict.lookup<long>("index");
    state.deltaT = dict.lookupPositive("deltaT", dimensions::time);
    state.origin = dict.lookup<double>("origin");
    state.originIndex = dict.lookup<long>("originIndex");
    dict.refuseUnused();
    constexpr long mostSteps = 1'000'000'000'000'000;       // whole numbers that a double tells apart
    const bool counts = 0 <= state.originIndex && state.originIndex <= state.index && state.index <= mostSteps;
    if (!counts)
    {
        throw FatalInputError(dict.where("index"), "The index is " + std::to_string(state.index) + ", the originIndex "
            + std::to_string(state.originIndex), "0 <= originIndex <= index <= " + std::to_string(mostSteps));
    }
    const double rounding = 1e-3*state.deltaT + 1e-12*std::abs(state.value);
    if (std::abs(state.at(state.index) - state.value) > rounding)
    {
        throw FatalInputError(dict.where("value"), "The value is not the time of the step",
            "origin + (index - originIndex) deltaT = " + std::to_string(state.at(state.index)));
    }
    if (!namesTime(timeFolder.filename().string(), state.value, state.deltaT)) return {};
    return state;
}

}
