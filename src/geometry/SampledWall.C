#include "geometry/SampledWall.H"

namespace shizuku
{

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
        SampledWall sampled{name, casePath/"constant"/"triSurface"/wall.lookup<std::string>("surface"), 1, {}, wall.where(), wall.where("surface")};
        if (wall.found("scale")) sampled.scale = wall.lookupPositive("scale", dimensions::none);
        if (wall.found("closeHoles"))
        {
            sampled.closeHoles = wall.lookupPositive("closeHoles", dimensions::length, true);
        }
        result.push_back(sampled);
    }
    walls.refuseUnused();
    return result;
}

void refuseMissingSurface(const SampledWall& wall)
{
    namespace fs = std::filesystem;
    if (fs::exists(wall.file)) return;
    const fs::path folder = wall.file.parent_path();
    std::vector<std::string> names;
    if (fs::is_directory(folder))
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

}
