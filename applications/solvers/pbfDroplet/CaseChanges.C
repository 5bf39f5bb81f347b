// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseChanges.H"

#include "SameFiles.H"
#include "core/dictionary/Differences.H"
#include "thetaModels/LineLaws.H"
#include "wallMotions/CrossingWalls.H"
#include "thetaModels/ThetaField.H"

#include <algorithm>
#include <iostream>
#include <sstream>
#include <utility>

namespace shizuku
{

namespace
{

const char* const wettabilityFile = "constant/wettability";
const char* const sourcesFile = "constant/sources";
const char* const wallsFile = "constant/walls";

// may: what of that dictionary a run follows.
[[noreturn]] void refuseChange(const EntryChange& change, const Dictionary& now, const std::string& may = "")
{
    throw FatalInputError
    (
        now.where(), "Entry '" + change.entry + "' was changed from " + change.before + " to " + change.after + ", which a run cannot follow",
        change.before + ", or a new run" + may
    );
}

// spacing, kernel and density make the particles what they are.
void refuseFixed(const Dictionary& former, const Dictionary& now)
{
    for (const EntryChange& change : differences(former, now))
    {
        const bool fixed = change.entry == "spacing" || change.entry == "rho" || change.entry.starts_with("kernel");
        if (fixed) refuseChange(change, now);
    }
}

// Walls are where and what the run began with, but for how they move.
void refuseOtherWalls(const std::vector<EntryChange>& changes, const Dictionary& now)
{
    for (const EntryChange& change : changes)
    {
        const std::vector<std::string> names = now.dictKeys();
        const bool isMotion = std::any_of(names.begin(), names.end(), [&](const std::string& wall) { return change.entry.starts_with(wall + ".motion."); });
        if (!isMotion) refuseChange(change, now, "; of walls a run follows `motion` alone");
    }
}

// Sources are where and what the run began with, but for how fast liquid comes in.
void refuseOtherSources(const std::vector<EntryChange>& changes, const Dictionary& now)
{
    for (const EntryChange& change : changes)
    {
        if (!Sources::mayChange(change.entry)) refuseChange(change, now, "; of sources a run follows flowRate, velocity, rate, speed and level alone");
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
        {"system/solution", "constant/liquidProperties", "constant/models", "constant/g", wettabilityFile, sourcesFile, wallsFile})
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

class CaseChanges::Fresh
{
public:
    // Throws FatalInputError. anew: of the contact angles.
    Fresh(const Time& time, CaseSetup& setup, std::vector<Dictionary> now, const Anew& anew) : former(*setup.liquid), now(std::move(now))
    {
        const Dictionary &solution = this->now[0], &liquidDict = this->now[1];
        Liquid& liquid = *setup.liquid;
        const LiquidProperties wanted = LiquidProperties::read(solution, liquidDict);
        solution.subDictOrEmpty("kernel").markUsed();
        relaxesOverlap(solution);           // of a start
        liquidDict.refuseUnused();
        liquid.change(wanted.viscosity, wanted.surfaceTension);
        models.emplace(time.casePath(), solution, liquid, *setup.walls);
        solution.refuseUnused();
        if (liquid.ghosts().mayBe()) models->refuseGhostBlind(liquid, "The liquid goes on in other parts, or across sides, which it cannot");
        if (setup.body) FloatingBody::refuseModels(liquid, *models);
        if (anew.walls)
        {
            motions = WallMotions::read(time.casePath());
            setup.walls->refuseMotions(liquid, *motions, time.value());
            refuseCrossingWalls(time.casePath(), time.value(), time.endTime(), liquid.properties().spacing);
        }
        if (anew.sources)
        {
            sources.emplace(time.casePath(), liquid);
            sources->refuseLongSteps(time.deltaT());
        }
        if (!models->angles || setup.walls->particles() == 0) return;
        const std::optional<WallAngles>& angles = setup.walls->angles();
        if (anew.wettability) models->angles->particles = caseTheta(time.casePath());
        else if (!anew.theta && angles) models->angles->particles = angles->particles;
        else return;
        setup.walls->readLaws(*models->angles);
    }

    // What has been read.
    std::string text() const
    {
        std::ostringstream text;
        text << std::hexfloat << textOf(models->dict);
        for (const Dictionary& dict : now) text << textOf(dict);
        for (const double component : models->bodyForce->uniform()) text << component << ' ';
        if (!models->angles) return text.str();
        for (const std::vector<double>* of : {&models->angles->surfaces, &models->angles->particles})
        {
            for (const double theta : *of) text << theta << ' ';
        }
        if (models->angles->laws) text << models->angles->laws->text();
        return text.str();
    }

    // Of the liquid, what is put back.
    struct Former
    {
        explicit Former(Liquid& liquid) : liquid(&liquid), properties(liquid.properties()), fields(liquid.fields().infos()) {}
        Former(Former&& other) noexcept : liquid(std::exchange(other.liquid, nullptr)), properties(other.properties), fields(std::move(other.fields)) {}
        Former& operator=(Former&&) = delete;
        ~Former()
        {
            if (!liquid) return;
            liquid->change(properties.viscosity, properties.surfaceTension);
            liquid->fields().restore(fields);
        }

        Liquid* liquid;                     // nothing: all stays as it is now
        LiquidProperties properties;
        FieldRegistry::Infos fields;
    };

    Former former;
    std::vector<Dictionary> now;
    std::optional<WallMotions> motions;     // where walls have changed
    std::optional<Sources> sources;         // where they have changed
    std::optional<Models> models;           // behind `former`: they go before their fields
};

bool CaseChanges::apply(const Time& time, CaseSetup& setup)
{
    if (!time.modifiable()) return false;
    const Communicator& parts = setup.liquid->parts();
    std::uint32_t changed = parts.fold(Changed{look()}).files;
    if (changed == 0) return false;
    setup.models->pressure->complete();
    std::string names;
    std::optional<Fresh> fresh;
    try
    {
        readTheSame(parts, [&]
        {
            fresh.reset();
            changed = parts.fold(Changed{changed | look()}).files;      // what is changed from here on is seen in the next step
            names = note(changed, time.casePath());
            std::vector<Dictionary> now = readAll();
            refuseFixed(dictionaries_[0].former, now[0]);
            refuseFixed(dictionaries_[1].former, now[1]);
            const std::size_t before = dictionaries_.size() - 2;
            refuseOtherSources(differences(dictionaries_[before].former, now[before]), now[before]);
            refuseOtherWalls(differences(dictionaries_.back().former, now.back()), now.back());
            fresh.emplace(time, setup, std::move(now), anew_);
            return fresh->text();
        });
    }
    catch (const FatalInputError& error)
    {
        warning
        (
            std::string(error.what()) + "\nThe change of " + names + " is left out, the former values stay in force"
        );
        return false;
    }
    take(time, setup, std::move(*fresh));
    anew_ = {};
    return true;
}

// A bit each of the dictionaries that have changed, and one for the angles.
std::uint32_t CaseChanges::look()
{
    std::uint32_t changed = 0;
    for (std::size_t d = 0; d < dictionaries_.size(); ++d) changed |= std::uint32_t(dictionaries_[d].file.changed()) << d;
    return changed | std::uint32_t(theta_ && theta_->changed()) << dictionaries_.size();
}

std::vector<Dictionary> CaseChanges::readAll() const
{
    std::vector<Dictionary> now;
    for (const Watched& dictionary : dictionaries_) now.push_back(readOrEmpty(dictionary.file.path()));
    return now;
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
        if (name == sourcesFile) anew_.sources = true;
        if (name == wallsFile) anew_.walls = true;
    }
    if (changed >> dictionaries_.size() & 1)
    {
        add("solid/theta");
        anew_.theta = true;
    }
    return names;
}

void CaseChanges::take(const Time& time, CaseSetup& setup, Fresh fresh)
{
    Walls& walls = *setup.walls;
    const std::optional<WallAngles> formerAngles = walls.angles();
    fresh.former.liquid = nullptr;
    if (fresh.motions) walls.useMotions(*setup.liquid, std::move(*fresh.motions));
    if (fresh.sources) setup.population->useSources(std::move(*fresh.sources));
    *setup.models = std::move(*fresh.models);
    setup.models->takeEffect(*setup.liquid, walls);
    const std::optional<WallAngles>& angles = walls.angles();
    const bool otherTheta = angles && formerAngles && angles->particles != formerAngles->particles;
    if (otherTheta) written_ = std::make_shared<const std::vector<double>>(angles->particles);

    std::cout << "The case has changed, the models were made anew\n";
    takeOver(time, fresh.now);
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
