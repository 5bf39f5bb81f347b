#include "CaseChanges.H"

#include "core/angles/Degrees.H"
#include "core/dictionary/Differences.H"
#include "geometry/thetaModels/ThetaField.H"
#include "stepping/StartCheck.H"

#include <algorithm>
#include <cmath>
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
std::string rangeOf(const std::vector<scalar>& cosines)
{
    const auto [low, high] = std::minmax_element(cosines.begin(), cosines.end());
    const auto angle = [](scalar cosine) { return std::round(1e4 * degrees(std::acos(cosine))) / 1e4; };
    std::ostringstream text;
    text << angle(*high);
    if (*low != *high) text << " to " << angle(*low);
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
    watchTheta(time);
}

void CaseChanges::watchTheta(const Time& time)
{
    const auto folder = findInstance(time.casePath(), time.value(), "solid/theta");
    if (!folder.empty()) theta_.emplace(folder / "solid/theta");
}

Dictionary CaseChanges::readOrEmpty(const std::filesystem::path& file)
{
    return std::filesystem::exists(file) ? Dictionary::read(file) : Dictionary();
}

bool CaseChanges::apply(const Time& time, Liquid& liquid, Walls& walls, Models& models)
{
    if (!time.modifiable()) return false;
    std::string names;
    bool wettability = false;
    for (Watched& dictionary : dictionaries_)
    {
        if (!dictionary.file.changed()) continue;
        const std::string name = std::filesystem::relative(dictionary.file.path(), time.casePath()).string();
        names += (names.empty() ? "" : ", ") + name;
        wettability = wettability || name == wettabilityFile;
    }
    if (theta_ && theta_->changed()) names += (names.empty() ? "" : ", ") + std::string("solid/theta");
    if (names.empty()) return false;
    try
    {
        make(time, wettability, liquid, walls, models);
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

void CaseChanges::make(const Time& time, bool wettability, Liquid& liquid, Walls& walls, Models& models)
{
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
    const auto cosines = walls.cosines();
    std::vector<double> theta;
    if (cosines && wettability && walls.particles() > 0) theta = caseTheta(time.casePath());
    std::optional<WallCosines> newCosines;
    if (cosines) newCosines = walls.readCosines(time.value());
    if (!theta.empty()) newCosines->setParticles(theta);

    // The models are made with the new values in force, and nothing stays of these where a model cannot be made.
    liquid.change(wanted.viscosity, wanted.surfaceTension);
    if (newCosines) walls.use(*newCosines);
    try
    {
        Models fresh(time.casePath(), solution, liquid, walls);
        solution.refuseUnused();
        models = std::move(fresh);
    }
    catch (...)
    {
        liquid.change(former.viscosity, former.surfaceTension);
        if (cosines) walls.use(*cosines);
        throw;
    }
    const bool otherTheta = cosines && cosines->particles != newCosines->particles;
    if (!theta.empty() && otherTheta)
    {
        writeTheta(findInstance(time.casePath(), time.value(), "solid/theta"), theta, time.format());
    }
    watchTheta(time);

    std::cout << "The case has changed, the models were made anew\n";
    takeOver(time, now);
    if (otherTheta)
    {
        std::cout << "    solid/theta: " << rangeOf(cosines->particles) << " -> " << rangeOf(newCosines->particles) << " degrees\n";
    }
    std::cout << std::flush;
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
