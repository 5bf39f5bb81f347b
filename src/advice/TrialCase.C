// SPDX-License-Identifier: GPL-3.0-or-later
#include "advice/TrialCase.H"

#include "advice/CaseEdits.H"
#include "caseFiles/LiquidFiles.H"
#include "caseFiles/SampledWall.H"
#include "caseFiles/SolidParticles.H"
#include "core/dictionary/DictionaryEditor.H"
#include "core/dictionary/DictionaryExpansion.H"
#include "core/fieldFile/AtomicFile.H"
#include "core/time/Time.H"
#include "liquidBodies/FilledBody.H"

#include <algorithm>
#include <cstdlib>

namespace shizuku
{

namespace
{

namespace fs = std::filesystem;

// Beside the case, where writing takes as long as it will take there; else where temporary files go.
fs::path temporaryFolder(const fs::path& casePath)
{
    const fs::path beside = fs::canonical(casePath).parent_path();
    for (const fs::path& where : {beside, fs::temp_directory_path()})
    {
        std::string name = (where/".adviseCase-XXXXXX").string();
        if (mkdtemp(name.data())) return name;
    }
    throw FatalError("Cannot make a folder in " + beside.string() + " or " + fs::temp_directory_path().string());
}

// Files are copied, folders linked.
void take(const fs::path& from, const fs::path& to)
{
    fs::create_directories(to);
    for (const auto& entry : fs::directory_iterator(from))
    {
        const fs::path name = to/entry.path().filename();
        if (entry.is_directory()) fs::create_directory_symlink(fs::absolute(entry.path()), name);
        else fs::copy_file(entry.path(), name);
    }
}

}

TrialCase::TrialCase(const fs::path& casePath, const std::vector<CaseChange>& changes)
: case_(casePath), path_(temporaryFolder(casePath))
{
    try
    {
        make(changes);
    }
    catch (...)
    {
        fs::remove_all(path_);
        throw;
    }
}

void TrialCase::make(const std::vector<CaseChange>& changes)
{
    for (const char* folder : {"system", "constant"}) take(case_/folder, path_/folder);
    // Times, and folders that dictionaries include from; tables of the trial stay in the trial.
    for (const auto& entry : fs::directory_iterator(case_))
    {
        const fs::path name = path_/entry.path().filename();
        if (!entry.is_directory() || fs::exists(name) || name.filename() == "postProcessing") continue;
        fs::create_directory_symlink(fs::absolute(entry.path()), name);
    }
    changeCase(path_, changes, false);
    startsAnew_ = returnToStart();
    const auto times = timeFolders(path_);
    const bool filled = !times.empty() && fs::exists(times.back().path/"liquid");
    const bool anew = std::any_of(changes.begin(), changes.end(), [](const CaseChange& c) { return c.entry == "spacing"; });
    if (!filled || anew) refill();

    const double start = times.empty() ? 0 : times.back().value;
    withoutSolid_ = useSolidParticles(path_) &&
        (!haveSolidParticles(path_) || findInstance(path_, start, "solid/theta").empty());
    if (withoutSolid_) leaveOutSolid();
}

// Of a run that is over no time is left: what there is to be said of it is of its beginning.
bool TrialCase::returnToStart() const
{
    constexpr double digits = 1e-9;
    const auto times = timeFolders(path_);
    if (times.size() < 2 || !fs::exists(times.front().path/"liquid")) return false;
    const double endTime = Dictionary::read(path_/"system/controlDict").lookupDimensioned("endTime", dimensions::time);
    if (endTime*(1 - digits) > times.back().value) return false;
    for (std::size_t i = 1; i < times.size(); ++i) fs::remove(path_/times[i].name);
    changeCase(path_, {{"system/controlDict", "startFrom", "firstTime"}}, false);
    return true;
}

TrialCase::~TrialCase()
{
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

void TrialCase::refill() const
{
    const fs::path dict = path_/"system/fillLiquidDict";
    if (!fs::exists(dict))
    {
        throw FatalInputError
        (
            {case_.string(), 0}, "The case has no liquid", "0/liquid, or a system/fillLiquidDict that makes it"
        );
    }
    for (const TimeFolder& time : timeFolders(path_)) fs::remove(path_/time.name);
    fs::create_directories(path_/"0/liquid");
    if (fs::exists(case_/"0/solid")) fs::create_directory_symlink(fs::absolute(case_/"0/solid"), path_/"0/solid");

    const double spacing = readSpacing(path_);
    writeBodies(path_/"0/liquid", readBodies(Dictionary::read(dict), path_, spacing), spacing, {.binary = true});
    changeCase(path_, {{"system/controlDict", "startFrom", "firstTime"}}, false);
}

void TrialCase::leaveOutSolid() const
{
    const fs::path file = path_/"constant/walls";
    DictionaryEditor editor(readText(file), file.string());
    for (const SampledWall& wall : readSampledWalls(path_)) editor.remove(wall.name);
    writeAtomically(file, [&](std::ostream& stream) { stream << editor.text(); });
    changeCase(path_, {{"constant/models", "wetting", "none"}}, false);
}

}
