// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/SuspectNumbers.H"

#include "core/angles/Degrees.H"
#include "core/messages/Error.H"
#include "core/paths/Existence.H"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr double earth = 9.81;          // m/s2
constexpr double farthest = 50;         // diameters between a drop and the nearest wall: longer flights are of no scene of wetting

// Nothing where the file is not there, or is none.
std::optional<Dictionary> dictionaryAt(const std::filesystem::path& file)
{
    if (!isThere(file)) return std::nullopt;
    try
    {
        return Dictionary::read(file);
    }
    catch (const FatalInputError&)
    {
        return std::nullopt;
    }
}

// The same of an entry: value(). One that cannot be read is the program's to refuse that needs it.
template<class Value>
auto entryOr(const Value& value, decltype(value()) fallback)
{
    try
    {
        return value();
    }
    catch (const FatalInputError&)
    {
        return fallback;
    }
}

double numberOf(const Dictionary& dict, const std::string& key, const Dimensions& dimensions)
{
    return entryOr([&] { return dict.lookupPositive(key, dimensions, true); }, 0.0);
}

struct Range
{
    const char* name;
    Dimensions dimensions;
    double least, most;
    const char* unit;
    const char* water;
};

const Range ranges[] =
{
    {"sigma", dimensions::surfaceTension, 1e-4, 2, "N/m", "0.0728"},        // liquids near their critical points, molten metals
    {"rho", dimensions::density, 50, 25000, "kg/m3", "998"},                // liquid hydrogen, molten osmium
    {"nu", dimensions::kinematicViscosity, 1e-8, 1e3, "m2/s", "1e-6"}       // superheated metals, pitch
};

void lookAtProperties(const Dictionary& liquid, std::vector<Suspect>& suspects)
{
    for (const Range& range : ranges)
    {
        const double value = numberOf(liquid, range.name, range.dimensions);
        if (value == 0 || (value >= range.least && value <= range.most)) continue;
        std::ostringstream text;
        text << range.name << " is " << value << " " << range.unit << ": is that meant? Water has " << range.water << " " << range.unit
             << ", and no liquid less than " << range.least << " or more than " << range.most;
        suspects.push_back({text.str(), liquid.where(range.name)});
    }
}

// No drop that wets a wall is as large as that; a dam break of metres has no tension.
void lookAtSpacing(const Dictionary& solution, const Dictionary& liquid, const Dictionary& models, std::vector<Suspect>& suspects)
{
    if (entryOr([&] { return models.lookupOr<std::string>("surfaceTension", "none"); }, std::string("none")) == "none") return;
    const double spacing = numberOf(solution, "spacing", dimensions::length), sigma = numberOf(liquid, "sigma", dimensions::surfaceTension);
    const double rho = numberOf(liquid, "rho", dimensions::density);
    if (!(spacing > 0 && sigma > 0 && rho > 0)) return;
    const double capillary = std::sqrt(sigma/(rho*earth));
    if (spacing <= capillary) return;
    std::ostringstream text;
    text << "The spacing of " << spacing << " m is beyond this liquid's capillary length, " << capillary << " m, with a surface tension: are lengths millimetres? All of a case are metres\n"
            "    Expected: a drop of a millimetre has spacing 1e-4; without tension, surfaceTension none";
    suspects.push_back({text.str(), solution.where("spacing")});
}

// Of one number or several; none where the entry is something else.
std::vector<double> anglesOf(const Dictionary& wall, const std::string& key)
{
    if (!wall.found(key) || wall.isDict(key)) return {};
    const std::vector<double> list = entryOr([&] { return wall.lookup<std::vector<double>>(key); }, std::vector<double>());
    if (!list.empty()) return list;
    return entryOr([&] { return std::vector<double>{wall.lookup<double>(key)}; }, std::vector<double>());
}

// All of a wall's at most pi, and not all of them zero.
void lookAtAngles(const Dictionary& wettability, std::vector<Suspect>& suspects)
{
    for (const std::string& name : wettability.dictKeys())
    {
        const Dictionary wall = wettability.subDict(name);
        double largest = 0;
        std::string of;
        for (const char* key : {"theta", "theta0", "thetaAdv", "thetaRec"})
        {
            for (const double angle : anglesOf(wall, key))
            {
                if (angle <= largest) continue;
                largest = angle;
                of = key;
            }
        }
        if (!(largest > 0 && largest <= std::numbers::pi)) continue;
        std::ostringstream text;
        text << of << " of '" << name << "' is " << largest << " degrees: are these radians? " << largest << " radians are " << degrees(largest) << " degrees";
        suspects.push_back({text.str(), wall.where(of)});
    }
}

}

std::vector<Suspect> suspectEntries(const std::filesystem::path& casePath)
{
    std::vector<Suspect> suspects;
    const auto liquid = dictionaryAt(casePath/"constant/liquidProperties"), solution = dictionaryAt(casePath/"system/solution");
    const auto models = dictionaryAt(casePath/"constant/models"), wettability = dictionaryAt(casePath/"constant/wettability");
    if (liquid) lookAtProperties(*liquid, suspects);
    if (liquid && solution && models) lookAtSpacing(*solution, *liquid, *models, suspects);
    if (wettability) lookAtAngles(*wettability, suspects);
    return suspects;
}

std::vector<Suspect> suspectPlaces
(
    const std::filesystem::path& casePath, const std::vector<SeparateBody>& bodies, const std::vector<AnalyticSurface>& walls,
    const std::vector<Vector3>& solid
)
{
    if (bodies.empty() || (walls.empty() && solid.empty())) return {};
    const SeparateBody& body = bodies.front();
    const Vector3 middle = 0.5*(body.low + body.high);
    double nearest = std::numeric_limits<double>::infinity();
    for (const AnalyticSurface& wall : walls) nearest = std::min(nearest, wall.signedDistance(middle));
    for (const Vector3& x : solid) nearest = std::min(nearest, length(x - middle));
    const double gap = nearest - 0.5*length(body.size());
    if (!(gap > farthest*body.diameter())) return {};
    std::ostringstream text;
    text << "The liquid is " << gap << " m from every wall, " << std::round(gap/body.diameter()) << " times the diameter of its largest body: is that meant? All lengths are metres\n"
            "    Expected: a drop near what it falls on, with the speed that it has there (velocity in system/fillLiquidDict)";
    return {{text.str(), {(casePath/"system/fillLiquidDict").string(), 0}}};
}

void warnOf(const std::vector<Suspect>& suspects)
{
    for (const Suspect& suspect : suspects) warning(suspect.text, suspect.where);
}

}
