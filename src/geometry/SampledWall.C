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
        SampledWall sampled{name, casePath/"constant"/"triSurface"/wall.lookup<std::string>("surface"), 1, {}, wall.where()};
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

}
