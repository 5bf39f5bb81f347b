// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/SampledWall.H"

#include "core/fieldFile/MappedFile.H"
#include "core/paths/Existence.H"

#include <boost/crc.hpp>

#include <algorithm>
#include <iomanip>

namespace shizuku
{

namespace
{

// Empty where the wall is what it was.
std::string changeOf(const SampledWall& wall, const Dictionary& made)
{
    const std::string name = "the wall '" + wall.name + "'", surface = wall.file.filename().string();
    if (!made.found(wall.name)) return name + " was not sampled";
    const Dictionary was = made.subDict(wall.name);
    const auto formerly = was.lookup<std::string>("surface");
    if (formerly != surface) return name + " was made of " + formerly + ", not of " + surface;
    if (was.lookup<double>("scale") != wall.scale) return "the scale of " + name + " has changed";
    if (was.lookupOr("flip", false) != wall.flip) return "flip of " + name + " has changed";
    if (was.lookup<double>("closeHoles") != wall.closeHoles.value_or(0)) return "closeHoles of " + name + " has changed";
    if (!isThere(wall.file)) return "";
    const bool same = was.lookup<std::string>("sum") == std::to_string(SurfaceMark::of(wall).sum);
    return same ? "" : surface + " of " + name + " has changed";
}

// The first there is.
std::string changeOf(const std::vector<SampledWall>& walls, const Dictionary& made)
{
    for (const SampledWall& wall : walls)
    {
        if (const std::string change = changeOf(wall, made); !change.empty()) return change;
    }
    for (const std::string& name : made.dictKeys())
    {
        const bool there = std::any_of(walls.begin(), walls.end(), [&](const SampledWall& wall) { return wall.name == name; });
        if (!there) return "the wall '" + name + "' is not sampled any more";
    }
    return "";
}

}

std::vector<SampledWall> readSampledWalls(const std::filesystem::path& casePath)
{
    const Dictionary walls = Dictionary::read(casePath/"constant"/"walls");
    std::vector<SampledWall> result;
    for (const std::string& name : walls.dictKeys())
    {
        const Dictionary wall = walls.subDict(name);
        const std::string type = wall.lookupChoice("type", {"particles", "plane", "sphere", "cylinder", "box"});
        if (type != "particles")
        {
            wall.markUsed();
            continue;
        }
        SampledWall sampled{name, casePath/"constant"/"triSurface"/wall.lookup<std::string>("surface"), 1, {}, wall.lookupOr("flip", false), wall.where(), wall.where("surface")};
        if (wall.found("scale")) sampled.scale = wall.lookupPositive("scale", dimensions::none);
        if (wall.found("closeHoles"))
        {
            sampled.closeHoles = wall.lookupPositive("closeHoles", dimensions::length, true);
        }
        wall.subDictOrEmpty("motion").markUsed();
        result.push_back(sampled);
    }
    walls.refuseUnused();
    return result;
}

void refuseMissingSurface(const SampledWall& wall)
{
    namespace fs = std::filesystem;
    if (isThere(wall.file)) return;
    const fs::path folder = wall.file.parent_path();
    std::vector<std::string> names;
    if (isFolder(folder))
    {
        for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
    }
    const std::string name = wall.file.filename().string();
    throw FatalInputError
    (
        wall.surface, "The surface '" + name + "' of the wall '" + wall.name + "' is not in " + folder.string(),
        "a file of " + folder.string() + (names.empty() ? ", which holds none" : ""), names, name
    );
}

SurfaceMark SurfaceMark::of(const SampledWall& wall)
{
    const MappedFile file(wall.file);
    boost::crc_32_type sum;
    sum.process_bytes(file.text().data(), file.text().size());
    return {wall.name, wall.file.filename().string(), wall.scale, wall.closeHoles.value_or(0), sum.checksum(), wall.flip};
}

void writeMarks(std::ostream& stream, const std::vector<SurfaceMark>& marks)
{
    stream << std::setprecision(17);
    for (const SurfaceMark& mark : marks)
    {
        stream << mark.wall << "\n{\n    surface     \"" << mark.surface << "\";\n    scale       " << mark.scale
               << ";\n    closeHoles  " << mark.closeHoles << ";\n    sum         \"" << mark.sum << "\";\n";
        if (mark.flip) stream << "    flip        yes;\n";
        if (mark.patches != std::vector{mark.wall})
        {
            stream << "    patches     (";
            for (const std::string& patch : mark.patches) stream << (&patch == &mark.patches.front() ? "" : " ") << patch;
            stream << ");\n";
        }
        if (!mark.form.empty()) stream << "    form        " << mark.form << ";\n";
        stream << "}\n";
    }
}

std::map<std::string, std::string> readWallsOfPatches(const std::filesystem::path& casePath)
{
    std::map<std::string, std::string> walls;
    const auto file = casePath/"constant/solid/surfaces";
    if (!isThere(file)) return walls;
    const Dictionary made = Dictionary::read(file);
    for (const std::string& name : made.dictKeys())
    {
        for (const std::string& patch : made.subDict(name).lookupOr("patches", std::vector{name})) walls[patch] = name;
    }
    return walls;
}

std::vector<std::string> branchingSheets(const std::filesystem::path& casePath)
{
    const auto file = casePath/"constant/solid/surfaces";
    std::vector<std::string> texts;
    if (!isThere(file)) return texts;
    const Dictionary made = Dictionary::read(file);
    for (const std::string& name : made.dictKeys())
    {
        if (made.subDict(name).lookupOr<std::string>("form", "") != "branching") continue;
        texts.push_back("The wall '" + name + "' is of open sheets that meet in an edge: each holds liquid on one side, and what comes round its border goes through");
    }
    return texts;
}

std::string otherSurfaces(const std::filesystem::path& casePath)
{
    const auto file = casePath/"constant/solid/surfaces";
    if (!isThere(file)) return "";
    const std::string change = changeOf(readSampledWalls(casePath), Dictionary::read(file));
    if (change.empty()) return "";
    return "constant/solid is not of the walls as they are: " + change + "\n    Run sampleSurface and sampleTheta again, and fillLiquid";
}

}
