// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/Controls.H"

#include <algorithm>
#include <limits>
#include <utility>

namespace shizuku
{

namespace
{

template<class Enum>
Enum choose
(
    const Dictionary& dict, const std::string& key, const std::vector<std::string>& words, const std::string& fallback
)
{
    const std::string word = dict.lookupChoiceOr(key, words, fallback);
    return static_cast<Enum>(std::find(words.begin(), words.end(), word) - words.begin());
}

int readInteger(const Dictionary& dict, const std::string& key, int fallback, int least, int most)
{
    const int value = dict.lookupOr<int>(key, fallback);
    if (value >= least && value <= most) return value;
    throw FatalInputError
    (
        dict.where(key), key + " is " + std::to_string(value),
        most == std::numeric_limits<int>::max()
            ? "a whole number from " + std::to_string(least)
            : "a whole number from " + std::to_string(least) + " to " + std::to_string(most)
    );
}

double readDeltaT(const Dictionary& dict)
{
    constexpr double least = 1e-12;     // s: molecules meet more often than that
    const double deltaT = dict.lookupPositive("deltaT", dimensions::time);
    if (deltaT >= least) return deltaT;
    throw FatalInputError(dict.where("deltaT"), "deltaT is " + dict.lookup<std::string>("deltaT") + " s, less than a liquid knows",
        "1e-12 s or more");
}

std::optional<Schedule> readWrite(const Dictionary& dict, double deltaT)
{
    std::vector<std::string> words = scheduleWords();
    words.push_back("none");
    const std::string control = dict.lookupChoiceOr("writeControl", words, "timeStep");
    if (control != "none") return readSchedule(dict, "write", control, deltaT);
    if (dict.found("writeInterval")) dict.lookup<double>("writeInterval");      // may stay for the next run
    return {};
}

// Keywords of OpenFOAM that mean nothing here, and why.
void refuseForeign(const Dictionary& dict)
{
    const std::pair<const char*, const char*> foreign[] =
    {
        {"maxDeltaT", "deltaT, which the solver divides and never enlarges"},
        {"graphFormat", "no graphFormat: tables are written as .csv"},
    };
    for (const auto& [key, expected] : foreign)
    {
        if (dict.found(key)) throw FatalInputError(dict.where(key), std::string("Found ") + key, expected);
    }
    if (dict.found("writeCompression") && dict.lookup<std::string>("writeCompression") != "uncompressed")
    {
        if (dict.lookup<bool>("writeCompression"))
        {
            throw FatalInputError
            (
                dict.where("writeCompression"), "writeCompression is on", "off; writeFormat binary makes small files"
            );
        }
    }
}

void checkStepControl(const Dictionary& dict)
{
    if (dict.found("adjustTimeStep")) dict.lookup<bool>("adjustTimeStep");
    for (const char* key : {"maxCo", "maxCapillaryCo", "restCapillaryCo"})
    {
        if (dict.found(key)) dict.lookupPositive(key, dimensions::none);
    }
    if (dict.found("sleep"))
    {
        const Dictionary& sleep = dict.subDict("sleep");
        sleep.lookupPositive("below", dimensions::none);
        sleep.lookupPositive("for", dimensions::time);
        sleep.refuseUnused();
    }
    readInteger(dict, "maxSubSteps", 1, 1, std::numeric_limits<int>::max());
}

void leaveToOthers(const Dictionary& dict)
{
    dict.lookupOr<std::string>("application", "");
    dict.subDictOrEmpty("functions").markUsed();
    if (dict.found("libs")) dict.lookup<std::vector<std::string>>("libs");
}

}

Controls readControls(const Dictionary& dict)
{
    Controls controls;
    controls.startFrom = choose<StartFrom>(dict, "startFrom", {"firstTime", "startTime", "latestTime"}, "latestTime");
    if (controls.startFrom == StartFrom::startTime || dict.found("startTime"))
    {
        controls.startTime = dict.lookupDimensioned("startTime", dimensions::time);
    }
    controls.stopAt = choose<StopAt>(dict, "stopAt", {"endTime", "writeNow", "noWriteNow", "nextWrite"}, "endTime");
    controls.endTime = dict.lookupDimensioned("endTime", dimensions::time);
    controls.deltaT = readDeltaT(dict);
    controls.write = readWrite(dict, controls.deltaT);
    controls.purgeWrite = readInteger(dict, "purgeWrite", 0, 0, std::numeric_limits<int>::max());
    controls.format.binary = dict.lookupChoiceOr("writeFormat", {"ascii", "binary"}, "ascii") == "binary";
    controls.format.precision = readInteger(dict, "writePrecision", 9, 1, 17);
    controls.nameFormat.precision = readInteger(dict, "timePrecision", 6, 1, 17);
    const std::string style = dict.lookupChoiceOr("timeFormat", {"general", "fixed", "scientific"}, "general");
    controls.nameFormat.style =
        style == "fixed" ? std::chars_format::fixed
      : style == "scientific" ? std::chars_format::scientific
      : std::chars_format::general;
    controls.runTimeModifiable = dict.lookupOr<bool>("runTimeModifiable", false);
    controls.reportInterval = readInteger(dict, "reportInterval", 10, 1, std::numeric_limits<int>::max());

    checkStepControl(dict);
    leaveToOthers(dict);
    refuseForeign(dict);
    dict.refuseUnused();
    return controls;
}

}
