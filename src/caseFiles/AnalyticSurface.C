// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/AnalyticSurface.H"

#include "caseFiles/UnitVector.H"

#include <algorithm>
#include <utility>

namespace shizuku
{

namespace
{

Vector3 radialVector(const AnalyticSurface& surface, const Vector3& x)
{
    const Vector3 r = x - surface.point;
    return surface.type == AnalyticSurface::Type::cylinder ? r - dot(r, surface.direction)*surface.direction : r;
}

// The face of the box that is nearest to a point inside it: distance and normal into the box.
std::pair<double, Vector3> nearestFace(const AnalyticSurface& box, const Vector3& x)
{
    const std::pair<double, Vector3> faces[] =
    {
        {x.x - box.min.x, {1, 0, 0}}, {box.max.x - x.x, {-1, 0, 0}},
        {x.y - box.min.y, {0, 1, 0}}, {box.max.y - x.y, {0, -1, 0}},
        {x.z - box.min.z, {0, 0, 1}}, {box.max.z - x.z, {0, 0, -1}},
    };
    return *std::min_element
    (
        std::begin(faces), std::end(faces), [](const auto& a, const auto& b) { return a.first < b.first; }
    );
}

// From x to the nearest point of the box; zero inside.
Vector3 towardsBox(const AnalyticSurface& box, const Vector3& x)
{
    const auto component = [](double value, double low, double high) { return std::clamp(value, low, high) - value; };
    return
    {
        component(x.x, box.min.x, box.max.x),
        component(x.y, box.min.y, box.max.y),
        component(x.z, box.min.z, box.max.z)
    };
}

bool readLiquidInside(const Dictionary& wall)
{
    return wall.lookupChoice("liquid", {"inside", "outside"}) == "inside";
}

AnalyticSurface readSurface(const std::string& name, const std::string& type, const Dictionary& wall)
{
    using Type = AnalyticSurface::Type;
    AnalyticSurface surface;
    surface.name = name;
    if (type == "plane")
    {
        surface.type = Type::plane;
        surface.point = wall.lookupDimensionedVector("point", dimensions::length);
        surface.direction = readUnitVector(wall, "normal");
    }
    else if (type == "sphere")
    {
        surface.type = Type::sphere;
        surface.point = wall.lookupDimensionedVector("centre", dimensions::length);
        surface.radius = wall.lookupPositive("radius", dimensions::length);
        surface.liquidInside = readLiquidInside(wall);
    }
    else if (type == "cylinder")
    {
        surface.type = Type::cylinder;
        surface.point = wall.lookupDimensionedVector("point", dimensions::length);
        surface.direction = readUnitVector(wall, "axis");
        surface.radius = wall.lookupPositive("radius", dimensions::length);
        surface.liquidInside = readLiquidInside(wall);
    }
    else
    {
        surface.type = Type::box;
        surface.min = wall.lookupDimensionedVector("min", dimensions::length);
        surface.max = wall.lookupDimensionedVector("max", dimensions::length);
        for (int axis = 0; axis < 3; ++axis)
        {
            if (!(surface.min[axis] < surface.max[axis]))
            {
                throw FatalInputError
                (
                    wall.where("max"),
                    "The box " + wall.name() + " has min " + str(surface.min) + " and max " + str(surface.max),
                    "every component of min below that of max"
                );
            }
        }
    }
    return surface;
}

}

double AnalyticSurface::signedDistance(const Vector3& x) const
{
    switch (type)
    {
        case Type::plane:
            return dot(x - point, direction);
        case Type::sphere:
        case Type::cylinder:
        {
            const double outside = length(radialVector(*this, x)) - radius;
            return liquidInside ? -outside : outside;
        }
        case Type::box:
            break;
    }
    const double outside = length(towardsBox(*this, x));
    return outside > 0 ? -outside : nearestFace(*this, x).first;
}

Vector3 AnalyticSurface::normal(const Vector3& x) const
{
    switch (type)
    {
        case Type::plane:
            return direction;
        case Type::sphere:
        case Type::cylinder:
        {
            const Vector3 radial = radialVector(*this, x);
            const Vector3 outward =
                squaredLength(radial) > 0 ? normalized(radial)
              : type == Type::cylinder ? perpendicular(direction)
              : Vector3(0, 0, 1);
            return liquidInside ? -outward : outward;
        }
        case Type::box:
            break;
    }
    const Vector3 inward = towardsBox(*this, x);
    return squaredLength(inward) > 0 ? normalized(inward) : nearestFace(*this, x).second;
}

std::string typeName(AnalyticSurface::Type type)
{
    switch (type)
    {
        case AnalyticSurface::Type::plane: return "plane";
        case AnalyticSurface::Type::sphere: return "sphere";
        case AnalyticSurface::Type::cylinder: return "cylinder";
        case AnalyticSurface::Type::box: break;
    }
    return "box";
}

std::vector<AnalyticSurface> readAnalyticSurfaces(const Dictionary& walls)
{
    std::vector<AnalyticSurface> surfaces;
    for (const std::string& name : walls.dictKeys())
    {
        const Dictionary wall = walls.subDict(name);
        const std::string type = wall.lookupChoice("type", {"particles", "plane", "sphere", "cylinder", "box"});
        if (type == "particles")
        {
            wall.markUsed();
        }
        else
        {
            surfaces.push_back(readSurface(name, type, wall));
            wall.subDictOrEmpty("motion").markUsed();
        }
    }
    return surfaces;
}

}
