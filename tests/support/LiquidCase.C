// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/LiquidCase.H"

#include "core/fieldFile/FieldFile.H"

#include <numeric>

namespace shizuku::test
{

CaseText caseOnWettedFloor(bool sampled, int alongX, int alongY)
{
    if (!sampled) return {.walls = floorPlane, .wettability = "floor { theta 60; }"};
    CaseText text = caseOnFloor(latticeBlock(alongX, alongY, 1, 0.8f, {-0.4f * scalar(alongX - 1), -0.4f * scalar(alongY - 1), -0.5f}));
    text.solidTheta.assign(text.solidPositions.size(), 60);
    return text;
}

LiquidCase::LiquidCase(const CaseText& text)
:
    liquid(makeLiquid(text)), walls(makeWalls()), near(liquid), hasAngles_(!text.wettability.empty() || !text.solidTheta.empty())
{}

Walls LiquidCase::makeWalls()
{
    if (const auto sides = Sides::read(folder.path(), liquid.units().length)) liquid.ghosts().repeat(*sides);
    return Walls(folder.path(), 0, liquid);
}

// Writes the case's files as well: the walls read them next.
Liquid LiquidCase::makeLiquid(const CaseText& text) const
{
    folder.write("constant/walls", text.walls);
    folder.write("constant/wettability", text.wettability);
    folder.write("constant/g", text.g);
    if (!text.boundary.empty()) folder.write("constant/boundary", text.boundary);
    if (!text.solidPositions.empty())
    {
        SolidParticles solid;
        for (const Vec3& p : text.solidPositions) solid.positions.push_back(text.spacing * Vector3(p.x, p.y, p.z));
        solid.normals.assign(solid.positions.size(), {text.solidNormal.x, text.solidNormal.y, text.solidNormal.z});
        for (std::size_t k = 0; k < text.solidNormals.size(); ++k)
        {
            solid.normals[k] = {text.solidNormals[k].x, text.solidNormals[k].y, text.solidNormals[k].z};
        }
        solid.patch.assign(solid.positions.size(), 0);
        solid.patches = {"floor"};
        writeSolidParticles(folder.path(), solid, {.binary = true});
    }
    if (!text.solidTheta.empty())
    {
        const FieldData theta{.name = "theta", .type = FieldType::scalar, .dimensions = {}, .values = text.solidTheta};
        std::filesystem::create_directories(folder.path() / "0/solid");
        writeField(folder.path() / "0/solid/theta", theta, {.binary = true});
    }
    Dictionary solution = Dictionary::parse("spacing " + std::to_string(text.spacing) + ";");
    return Liquid
    (
        LiquidProperties::read(solution, Dictionary::parse(text.liquidProperties)), Dictionary::parse(text.kernel)
    );
}

void LiquidCase::useWalls(scalar contactReach)
{
    WallUse use{contactReach, surface.agreed().closest, {}};
    if (hasAngles_) use.angles = walls.readAngles();
    walls.use(liquid, use);
}

void LiquidCase::place(const std::vector<Vec3>& positions, const std::vector<Vec3>& velocities)
{
    const int n = int(positions.size());
    std::vector<Vec3> scaled;
    for (const Vec3& p : positions) scaled.push_back(liquid.spacing() * p);
    std::vector<std::uint32_t> id(n);
    std::iota(id.begin(), id.end(), 0u);

    liquid.resize(n);
    liquid.position.upload(placed(scaled));
    liquid.predicted.upload(placed(scaled));
    liquid.velocity.upload(velocities.empty() ? std::vector<Vec3>(n) : velocities);
    liquid.id.upload(id);
    if (surface.active() || (hasAngles_ && !walls.angles())) useWalls();
    near.update(liquid, surface.support());
    walls.update(liquid);
    reconstruct(surface);
}

void LiquidCase::reconstruct(FreeSurface& any) const
{
    any.search(liquid, near, walls);
    if (any.cutOff()) any.search(liquid, near, walls);
}

}
