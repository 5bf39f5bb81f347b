// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallMotions/WallMotions.H"

#include "wallMotions/SixDoFBody.H"

#include <algorithm>
#include <map>

namespace shizuku
{

namespace
{

// OpenFOAM's motions of meshes are answered with the entry to write.
void refuseForeignType(const Dictionary& dict)
{
    static const std::map<std::string, std::string> known
    {
        {"linearMotion", "`type translation;` with velocity"},
        {"oscillatingLinearMotion", "`type oscillation;` with amplitude and frequency"},
        {"rotatingMotion", "`type rotation;` with origin, axis and omega"},
        {"oscillatingRotatingMotion", "`type angularOscillation;` with origin, axis, amplitude and frequency"},
        {"tabulated6DoFMotion", "`type table;` with times and displacements"},
        {"sixDoFRigidBodyMotion", "`type sixDoF;` with mass, momentOfInertia, centreOfMass, and translations and rotations in place of constraints"}
    };
    const auto found = known.find(dict.lookup<std::string>("type"));
    if (found != known.end()) throw FatalInputError(dict.where("type"), found->first + " is OpenFOAM's motion of a mesh", found->second);
}

void move(std::vector<AnalyticSurface>& surfaces, const WallMotions& motions, double time)
{
    for (AnalyticSurface& surface : surfaces)
    {
        const int index = motions.indexOf(surface.name);
        if (index >= 0) surface = moved(surface, motions.walls()[index].motion->at(time));
    }
}

void move(SolidParticles& solid, const std::filesystem::path& casePath, const WallMotions& motions, double time)
{
    if (motions.none()) return;
    std::vector<Pose> poses;
    for (const MovingWall& wall : motions.walls()) poses.push_back(wall.motion->at(time));
    const std::vector<int> index = motions.indicesOf(casePath, solid);
    for (std::size_t k = 0; k < index.size(); ++k)
    {
        if (index[k] < 0) continue;
        solid.positions[k] = poses[index[k]](solid.positions[k]);
        solid.normals[k] = poses[index[k]].turned(solid.normals[k]);
    }
}

// m, of the only shape that the liquid may move.
double radiusOf(const Dictionary& wall, const std::string& name, const SourceLocation& motion)
{
    const std::string type = wall.lookupOr<std::string>("type", "");
    if (type == "sphere" && wall.lookupOr<std::string>("liquid", "") == "outside") return wall.lookupPositive("radius", dimensions::length);
    throw FatalInputError(motion, "The wall '" + name + "' is " + (type == "sphere" ? "a sphere with liquid inside" : "of type '" + type + "'") + ", and its motion is that of a body in the liquid", "a wall of type sphere with `liquid outside;`");
}

}

WallMotions WallMotions::read(const std::filesystem::path& casePath)
{
    WallMotions motions;
    const auto file = casePath/"constant/walls";
    if (!std::filesystem::exists(file)) return motions;
    const Dictionary walls = Dictionary::read(file);
    for (const std::string& name : walls.dictKeys())
    {
        const Dictionary wall = walls.subDict(name);
        if (!wall.found("motion")) continue;
        const Dictionary dict = wall.subDict("motion");
        refuseForeignType(dict);
        std::shared_ptr<const WallMotion> motion = WallMotionTable::New("wall-motion", dict.lookup<std::string>("type"), dict.where("type"), dict);
        dict.refuseUnused();
        if (motion->axis() && wall.lookupOr<std::string>("type", "") == "box")
        {
            throw FatalInputError(dict.where("type"), "The wall '" + name + "' is a box, which keeps its directions, and has a motion that turns it", "six walls of type plane, or a box that moves without turning");
        }
        if (SixDoFBody* body = motion->body())
        {
            if (motions.body()) throw FatalInputError(dict.where("type"), "The wall '" + name + "' is a second body that the liquid moves, besides '" + motions.body()->wall() + "'", "one wall with a motion of type sixDoF");
            body->belongTo(casePath, name, radiusOf(wall, name, dict.where("type")));
        }
        motions.walls_.push_back({name, std::move(motion)});
    }
    return motions;
}

SixDoFBody* WallMotions::body() const
{
    for (const MovingWall& wall : walls_) if (wall.motion->body()) return wall.motion->body();
    return nullptr;
}

int WallMotions::indexOf(const std::string& wall) const
{
    for (std::size_t k = 0; k < walls_.size(); ++k) if (walls_[k].name == wall) return int(k);
    return -1;
}

std::vector<int> WallMotions::indicesOf(const std::filesystem::path& casePath, const SolidParticles& solid) const
{
    const std::map<std::string, std::string> wallOf = readWallsOfPatches(casePath);
    std::vector<int> ofPatch;
    for (const std::string& patch : solid.patches)
    {
        const auto wall = wallOf.find(patch);
        ofPatch.push_back(indexOf(wall == wallOf.end() ? patch : wall->second));
    }
    for (const MovingWall& wall : walls_)
    {
        const bool isSampled = Dictionary::read(casePath/"constant/walls").subDict(wall.name).lookupOr<std::string>("type", "") == "particles";
        const bool isFound = std::find(ofPatch.begin(), ofPatch.end(), indexOf(wall.name)) != ofPatch.end();
        if (!isSampled || isFound) continue;
        throw FatalInputError({(casePath/"constant/solid/surfaces").string(), 0}, "The wall '" + wall.name + "' moves, and constant/solid does not say which particles are its own", "run sampleSurface again");
    }
    std::vector<int> indices;
    for (const int patch : solid.patch) indices.push_back(ofPatch[patch]);
    return indices;
}

AnalyticSurface moved(AnalyticSurface surface, const Pose& pose)
{
    surface.point = pose(surface.point);
    surface.direction = pose.turned(surface.direction);
    surface.min += pose.shift;
    surface.max += pose.shift;
    return surface;
}

std::vector<AnalyticSurface> readAnalyticSurfaces(const std::filesystem::path& casePath, double time)
{
    std::vector<AnalyticSurface> surfaces = readAnalyticSurfaces(Dictionary::read(casePath/"constant/walls"));
    move(surfaces, WallMotions::read(casePath), time);
    return surfaces;
}

SolidParticles readSolidParticles(const std::filesystem::path& casePath, double time)
{
    SolidParticles solid = readSolidParticles(casePath);
    move(solid, casePath, WallMotions::read(casePath), time);
    return solid;
}

CaseWalls readCaseWalls(const std::filesystem::path& casePath, double time)
{
    CaseWalls walls = readCaseWalls(casePath);
    const WallMotions motions = WallMotions::read(casePath);
    move(walls.analytic, motions, time);
    if (!walls.solid.positions.empty()) move(walls.solid, casePath, motions, time);
    return walls;
}

}
