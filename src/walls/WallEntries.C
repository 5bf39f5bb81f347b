// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/WallEntries.H"

#include "caseFiles/AnalyticSurface.H"
#include "caseFiles/SolidParticles.H"
#include "core/dictionary/Dictionary.H"
#include "core/messages/Error.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// Of each solid particle.
std::vector<std::uint32_t> wallsOfParticles(const std::filesystem::path& casePath, const std::vector<std::string>& names, const std::vector<std::string>& sampled)
{
    const SolidParticles solid = readSolidParticles(casePath);
    const auto wallOf = readWallsOfPatches(casePath);
    std::vector<std::uint32_t> ofPatch;
    for (const std::string& patch : solid.patches)
    {
        const auto known = wallOf.find(patch);
        const std::string wall = sampled.size() == 1 ? sampled.front() : known == wallOf.end() ? patch : known->second;
        const auto name = std::find(names.begin(), names.end(), wall);
        if (name == names.end())
        {
            throw FatalInputError({(casePath/"constant/solid/surfaces").string(), 0}, "constant/solid does not say which wall its patch '" + patch + "' belongs to", "run sampleSurface again");
        }
        ofPatch.push_back(std::uint32_t(name - names.begin()));
    }
    std::vector<std::uint32_t> walls;
    for (const int patch : solid.patch) walls.push_back(ofPatch[patch]);
    return walls;
}

}

std::vector<std::string> WallEntries::readNames(const std::filesystem::path& casePath)
{
    const auto file = casePath/"constant/walls";
    if (!std::filesystem::exists(file)) return {};
    return Dictionary::read(file).dictKeys();
}

WallEntries WallEntries::read(const std::filesystem::path& casePath)
{
    WallEntries entries{readNames(casePath), {}, {}, {}};
    if (entries.names.empty()) return entries;
    const Dictionary walls = Dictionary::read(casePath/"constant/walls");
    for (const AnalyticSurface& surface : readAnalyticSurfaces(walls))
    {
        const auto name = std::find(entries.names.begin(), entries.names.end(), surface.name);
        const int faces = surface.type == AnalyticSurface::Type::box ? 6 : 1;
        entries.ofSurface.insert(entries.ofSurface.end(), faces, std::uint32_t(name - entries.names.begin()));
        entries.radius.insert(entries.radius.end(), faces, surface.radius);
    }
    std::vector<std::string> sampled;
    for (const std::string& name : entries.names) if (walls.subDict(name).lookup<std::string>("type") == "particles") sampled.push_back(name);
    if (!sampled.empty()) entries.ofParticle = wallsOfParticles(casePath, entries.names, sampled);
    return entries;
}

}
