// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseChanges.H"

#include "SameFiles.H"
#include "core/dictionary/Differences.H"
#include "thetaModels/ThetaField.H"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace shizuku
{

namespace
{

const char* const wettabilityFile = "constant/wettability";

// spacing, kernel and density make the particles what they are.
void refuseFixed(const Dictionary& former, const Dictionary& now)
{
    for (const EntryChange& change : differences(former, now))
    {
        const bool fixed = change.entry == "spacing" || change.entry == "rho" || change.entry.starts_with("kernel");
        if (!fixed) continue;
        throw FatalInputError
        (
            now.where(), "Entry '" + change.entry + "' was changed from " + change.before + " to " + change.after
          + ", which a run cannot follow", change.before + ", or a new run"
        );
    }
}

// A contact angle of the whole field, or its range, in degrees.
std::string rangeOf(const std::vector<double>& theta)
{
    const auto [low, high] = std::minmax_element(theta.begin(), theta.end());
    std::ostringstream text;
    text << *low;
    if (*low != *high) text << " to " << *high;
    return text.str();
}

}

CaseChanges::CaseChanges(const Time& time)
{
    for (const std::string file :
        {"system/solution", "constant/liquidProperties", "constant/models", "constant/g", wettabilityFile})
    {
        const auto path = time.casePath() / file;
        dictionaries_.push_back({WatchedFile(path), readOrEmpty(path)});
    }
    const auto folder = findInstance(time.casePath(), time.value(), "solid/theta");
    if (!folder.empty()) theta_.emplace(folder / "solid/theta");
}

Dictionary CaseChanges::readOrEmpty(const std::filesystem::path& file)
{
    return std::filesystem::exists(file) ? Dictionary::read(file) : Dictionary();
}

bool CaseChanges::apply(const Time& time, CaseSetup& setup)
{
    if (!time.modifiable()) return false;
    const Communicator& parts = setup.liquid->parts();
    const std::uint32_t changed = parts.fold(Changed{look()}).files;
    if (changed == 0) return false;
    awaitSameFiles(parts, files());
    if (parts.parts() > 1) look();              // who sees the same files later
    const std::string names = note(changed, time.casePath());
    try
    {
        make(time, setup);
        anew_ = {};
        return true;
    }
    catch (const FatalInputError& error)
    {
        warning
        (
            std::string(error.what()) + "\nThe change of " + names + " is left out, the former values stay in force"
        );
        return false;
    }
}

// A bit each of the dictionaries that have changed, and one for the angles.
std::uint32_t CaseChanges::look()
{
    std::uint32_t changed = 0;
    for (std::size_t d = 0; d < dictionaries_.size(); ++d) changed |= std::uint32_t(dictionaries_[d].file.changed()) << d;
    return changed | std::uint32_t(theta_ && theta_->changed()) << dictionaries_.size();
}

std::vector<std::filesystem::path> CaseChanges::files() const
{
    std::vector<std::filesystem::path> files;
    for (const Watched& dictionary : dictionaries_) files.push_back(dictionary.file.path());
    if (theta_) files.push_back(theta_->path());
    return files;
}

// What there is to be made anew; the names of the files.
std::string CaseChanges::note(std::uint32_t changed, const std::filesystem::path& casePath)
{
    std::string names;
    const auto add = [&](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
    for (std::size_t d = 0; d < dictionaries_.size(); ++d)
    {
        if ((changed >> d & 1) == 0) continue;
        const std::string name = std::filesystem::relative(dictionaries_[d].file.path(), casePath).string();
        add(name);
        if (name == wettabilityFile) anew_.wettability = true;
    }
    if (changed >> dictionaries_.size() & 1)
    {
        add("solid/theta");
        anew_.theta = true;
    }
    return names;
}

void CaseChanges::make(const Time& time, CaseSetup& setup)
{
    Liquid& liquid = *setup.liquid;
    Walls& walls = *setup.walls;
    Models& models = *setup.models;
    std::vector<Dictionary> now;
    for (const Watched& dictionary : dictionaries_) now.push_back(readOrEmpty(dictionary.file.path()));
    refuseFixed(dictionaries_[0].former, now[0]);
    refuseFixed(dictionaries_[1].former, now[1]);

    // Everything that may be wrong is read before anything is changed.
    const Dictionary solution = readOrEmpty(dictionaries_[0].file.path());
    const Dictionary liquidDict = readOrEmpty(dictionaries_[1].file.path());
    const LiquidProperties former = liquid.properties(), wanted = LiquidProperties::read(solution, liquidDict);
    solution.subDictOrEmpty("kernel").markUsed();
    relaxesOverlap(solution);           // of a start
    liquidDict.refuseUnused();
    // The models are made with the new values in force, and nothing stays of these where a model cannot be made.
    const std::optional<WallAngles> formerAngles = walls.angles();
    const FieldRegistry::Infos formerFields = liquid.fields().infos();
    models.pressure->complete();
    liquid.change(wanted.viscosity, wanted.surfaceTension);
    try
    {
        Models fresh(time.casePath(), solution, liquid, walls);
        solution.refuseUnused();
        if (liquid.parts().parts() > 1) fresh.refuseParts();
        if (fresh.angles && walls.particles() > 0)
        {
            if (anew_.wettability) fresh.angles->particles = caseTheta(time.casePath());
            else if (!anew_.theta && formerAngles) fresh.angles->particles = formerAngles->particles;
        }
        models = std::move(fresh);
    }
    catch (...)
    {
        liquid.change(former.viscosity, former.surfaceTension);
        liquid.fields().restore(formerFields);
        throw;
    }
    models.takeEffect(liquid, walls);
    const std::optional<WallAngles>& angles = walls.angles();
    const bool otherTheta = angles && formerAngles && angles->particles != formerAngles->particles;
    if (otherTheta) written_ = std::make_shared<const std::vector<double>>(angles->particles);

    std::cout << "The case has changed, the models were made anew\n";
    takeOver(time, now);
    if (otherTheta)
    {
        std::cout << "    solid/theta: " << rangeOf(formerAngles->particles) << " -> " << rangeOf(angles->particles) << " degrees\n";
    }
    std::cout << std::flush;
}

std::function<void(const std::filesystem::path&)> CaseChanges::writingTheta(const WriteFormat& format) const
{
    return [theta = written_, format](const std::filesystem::path& timeFolder)
    {
        if (theta) writeTheta(timeFolder, *theta, format);
    };
}

// The dictionaries that are in force from now on; says what is new in them.
void CaseChanges::takeOver(const Time& time, const std::vector<Dictionary>& now)
{
    for (std::size_t d = 0; d < now.size(); ++d)
    {
        const auto name = std::filesystem::relative(dictionaries_[d].file.path(), time.casePath());
        for (const EntryChange& change : differences(dictionaries_[d].former, now[d]))
        {
            std::cout << "    " << name.string() << ": " << change.entry << ": " << change.before << " -> " << change.after << '\n';
        }
        dictionaries_[d].former = now[d];
    }
}

}
