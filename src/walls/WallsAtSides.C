// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/WallsAtSides.H"

#include "caseFiles/AnalyticSurface.H"
#include "caseFiles/SolidParticles.H"
#include "meshes/NearestPoint.H"

#include <cmath>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr double aligned = 1e-6;            // of unit vectors, and of supports: what is less is a rounding

struct SideOfWalls
{
    int axis;
    double at, support;                     // m
    double sign, offset;                    // of the map to what lies beyond it
    bool isPlane;

    // An interval along the axis that is solid, or that the liquid is in.
    bool isAway(double from, double to) const { return to <= at - support || from >= at + support; }
    bool isHalved(double from, double to) const { return isPlane && std::abs(0.5 * (from + to) - at) < aligned * support; }

    bool meets(const AnalyticSurface& surface) const
    {
        using Type = AnalyticSurface::Type;
        const double along = std::abs(surface.direction[axis]), from = surface.point[axis] - surface.radius, to = surface.point[axis] + surface.radius;
        const double low = surface.min[axis], high = surface.max[axis];
        switch (surface.type)
        {
            case Type::plane: return along < aligned || (isPlane && along > 1 - aligned && isAway(from, to));
            case Type::sphere: return isAway(from, to) || isHalved(from, to);
            case Type::cylinder: return along > 1 - aligned || (along < aligned && (isAway(from, to) || isHalved(from, to)));
            case Type::box: return (isAway(low, low) && isAway(high, high)) || isHalved(low, high);
        }
        return false;
    }

    // A solid particle near it whose image is none.
    std::optional<std::size_t> looseEnd(const std::vector<Vector3>& solid, double spacing) const
    {
        if (solid.empty()) return std::nullopt;
        const NearestPoint nearest(solid);
        for (std::size_t k = 0; k < solid.size(); ++k)
        {
            if (std::abs(solid[k][axis] - at) > support) continue;
            Vector3 image = solid[k];
            image[axis] = sign * image[axis] + offset;
            if (!nearest.within(image, spacing)) return k;
        }
        return std::nullopt;
    }
};

std::string expectedOf(AnalyticSurface::Type type, bool isPlane)
{
    using Type = AnalyticSurface::Type;
    const std::string axis = isPlane ? "with its axis in the symmetry plane" : "across it and a support away from it";
    if (type == Type::plane) return "a plane whose normal has no component along the side's axis";
    if (type == Type::cylinder) return "a cylinder along the side's axis, or one " + axis;
    return isPlane ? "its centre in the symmetry plane, or all of it a support away from it" : "all of it a support away from the side";
}

}

void refuseBreaksAtSides(const std::filesystem::path& casePath, const Dictionary& walls, const Sides& sides, const Liquid& liquid)
{
    const double unit = liquid.units().length, support = unit * double(liquid.support());
    const std::vector<AnalyticSurface> surfaces = readAnalyticSurfaces(walls);
    const SolidParticles solid = useSolidParticles(casePath) ? readSolidParticles(casePath) : SolidParticles();
    for (int k = 0; k < 3; ++k)
    {
        for (const bool upper : {false, true})
        {
            const Sides::Kind kind = sides.box().kind[k][upper];
            if (kind == Sides::Kind::open) continue;
            const bool isPlane = kind == Sides::Kind::symmetryPlane;
            const SideMap& map = sides.maps().map[k][upper ? AtSides::upper : AtSides::lower];
            const SideOfWalls side{k, sides.box().at[k][upper], support, double(map.sign), unit * quanta::lengthOf(map.offset), isPlane};
            const std::string where = "does not go on beyond the " + std::string(isPlane ? "symmetry plane " : "cyclic side ") + BoxSides::name(k, upper);
            for (const AnalyticSurface& surface : surfaces)
            {
                if (side.meets(surface)) continue;
                throw FatalInputError
                (
                    walls.where(surface.name), "The " + typeName(surface.type) + " '" + surface.name + "' " + where + " of constant/boundary as its image there would",
                    expectedOf(surface.type, isPlane)
                );
            }
            if (const auto loose = side.looseEnd(solid.positions, liquid.properties().spacing))
            {
                std::ostringstream expected;
                expected << "a surface that goes on beyond the side by a support, " << support << " m, as " << (isPlane ? "its mirror image does" : "it does at the other side");
                throw FatalInputError
                (
                    walls.where(), "The wall '" + solid.patches[solid.patch[*loose]] + "' " + where + " of constant/boundary: the solid particle at "
                  + str(solid.positions[*loose]) + " m has no image there", expected.str()
                );
            }
        }
    }
}

}
