// SPDX-License-Identifier: GPL-3.0-or-later
#include "thetaModels/LineLaws.H"

#include "caseFiles/SolidParticles.H"
#include "core/paths/Existence.H"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace shizuku
{

namespace
{

using Law = std::shared_ptr<const ContactAngleLaw>;

Law lawOf(const Dictionary& wettability, const std::string& name, const std::filesystem::path& casePath)
{
    if (!wettability.found(name)) return nullptr;       // which who reads the angles says
    const Dictionary entry = wettability.subDict(name);
    const Law law = readLaw(entry, casePath);
    if (law) entry.refuseUnused();
    return law;
}

// Of distributions, so that there are not as many materials as solid particles.
LineAngles rounded(const LineAngles& angles)
{
    constexpr double step = 0.05;           // degrees
    const auto round = [](double theta) { return step*std::round(theta/step); };
    return {round(angles.receding), round(angles.theta), round(angles.advancing)};
}

class Materials
{
public:
    explicit Materials(LineLaws& laws) : laws_(laws) {}

    std::uint32_t index(const Law& law, const LineAngles& angles)
    {
        const auto [place, isNew] = known_.try_emplace({law.get(), angles}, std::uint32_t(laws_.materials.size()));
        if (isNew) laws_.materials.push_back({law, angles});
        return place->second;
    }

private:
    LineLaws& laws_;
    std::map<std::pair<const ContactAngleLaw*, LineAngles>, std::uint32_t> known_;
};

}

std::shared_ptr<const LineLaws> LineLaws::read
(
    const std::filesystem::path& casePath, const std::vector<std::string>& names, const std::vector<double>& ofSurfaces,
    const std::vector<double>& ofParticles
)
{
    if (!isThere(casePath/"constant/wettability")) return nullptr;
    const Dictionary wettability = Dictionary::read(casePath/"constant/wettability");
    std::vector<Law> surfaces, patches;
    for (const std::string& name : names) surfaces.push_back(lawOf(wettability, name, casePath));
    if (!ofParticles.empty())
    {
        for (const std::string& patch : readSolidPatches(casePath)) patches.push_back(lawOf(wettability, patch, casePath));
    }
    const auto isThereAny = [](const std::vector<Law>& of) { return std::any_of(of.begin(), of.end(), [](const Law& law) { return law != nullptr; }); };
    if (!isThereAny(surfaces) && !isThereAny(patches)) return nullptr;

    auto laws = std::make_shared<LineLaws>();
    Materials materials(*laws);
    const auto constant = [](double theta) { return LineAngles{theta, theta, theta}; };
    for (std::size_t a = 0; a < surfaces.size(); ++a)
    {
        laws->surfaces.push_back(materials.index(surfaces[a], surfaces[a] ? surfaces[a]->at({}) : constant(ofSurfaces[a])));
    }
    if (ofParticles.empty()) return laws;
    const SolidParticles solid = readSolidParticles(casePath);
    for (std::size_t k = 0; k < ofParticles.size(); ++k)
    {
        const Law& law = patches[solid.patch[k]];
        laws->particles.push_back(materials.index(law, rounded(law ? law->at(solid.positions[k]) : constant(ofParticles[k]))));
    }
    return laws;
}

std::string LineLaws::text() const
{
    constexpr LineScales any{1e-4, 1e-3, 0.07};
    std::ostringstream text;
    text << std::hexfloat;
    for (const WallMaterial& material : materials)
    {
        const double speed = material.typicalSpeed(any);
        for (const double u : {-speed, 0.0, speed}) text << material.limits(u, any).first << ' ' << material.limits(u, any).second << ' ';
        text << speed << ' ' << material.angles.theta << ' ';
    }
    for (const auto* of : {&surfaces, &particles}) for (const std::uint32_t index : *of) text << index << ' ';
    return text.str();
}

ContactAngleLaw::Limits LineLaws::range(const LineScales& scales) const
{
    constexpr double fast = 10;
    ContactAngleLaw::Limits range{180, 0};
    for (const WallMaterial& material : materials)
    {
        const double speed = fast*material.typicalSpeed(scales);
        for (const double u : {-speed, speed})
        {
            const auto [low, high] = material.limits(u, scales);
            range = {std::min(range.first, low), std::max(range.second, high)};
        }
    }
    return range;
}

bool LineLaws::followSpeed(const LineScales& scales) const
{
    return std::any_of(materials.begin(), materials.end(), [&](const WallMaterial& material) { return material.typicalSpeed(scales) > 0; });
}

}
