// SPDX-License-Identifier: GPL-3.0-or-later
#include "AnalyticWalls.H"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace shizuku
{

namespace
{

constexpr int around = 96, along = 48;          // faces

// From the lowest liquid to the highest along an axis [m].
std::pair<double, double> rangeAlong(const PictureScene& scene, const AnalyticSurface& wall)
{
    double low = std::numeric_limits<double>::max(), high = -low;
    for (const Vector3& x : scene.liquid.vertices.empty() ? scene.particles : scene.liquid.vertices)
    {
        low = std::min(low, dot(x - wall.point, wall.direction));
        high = std::max(high, dot(x - wall.point, wall.direction));
    }
    return {low, high};
}

void addGlass(PictureScene& scene, const AnalyticSurface& tube)
{
    const auto [low, high] = rangeAlong(scene, tube);
    const double above = 0.2*(high - low);
    scene.glass.push_back({tube.point + low*tube.direction, tube.direction, high - low + above, tube.radius});
}

// Of a surface of revolution: place(0 ... 1 along it, unit vector away from its axis), with two triangles for each of its faces.
template<class Place>
void addRevolved(TriangleMesh& mesh, const Vector3& axis, int rows, const Place& place)
{
    const Vector3 right = perpendicular(axis), ahead = cross(axis, right);
    const int first = int(mesh.vertices.size());
    for (int row = 0; row <= rows; ++row)
    {
        for (int k = 0; k < around; ++k)
        {
            const double angle = 2*std::numbers::pi*k/around;
            mesh.vertices.push_back(place(double(row)/rows, std::cos(angle)*right + std::sin(angle)*ahead));
        }
    }
    for (int row = 0; row < rows; ++row)
    {
        for (int k = 0; k < around; ++k)
        {
            const int a = first + row*around + k, b = first + row*around + (k + 1) % around;
            mesh.faces.push_back({a, b, b + around});
            mesh.faces.push_back({a, b + around, a + around});
        }
    }
}

}

void addAnalyticWalls(PictureScene& scene, const std::vector<AnalyticSurface>& walls)
{
    using Type = AnalyticSurface::Type;
    for (const AnalyticSurface& wall : walls)
    {
        if (wall.type == Type::cylinder && wall.liquidInside) addGlass(scene, wall);
        else if (wall.type == Type::cylinder)
        {
            const auto [low, high] = rangeAlong(scene, wall);
            const double beyond = 0.5*(high - low), from = low - beyond, length = high - low + 2*beyond;
            addRevolved(scene.walls, wall.direction, 1, [&](double part, const Vector3& away) { return wall.point + (from + part*length)*wall.direction + wall.radius*away; });
        }
        else if (wall.type == Type::sphere && !wall.liquidInside)
        {
            const Vector3 axis(0, 0, 1);
            addRevolved(scene.walls, axis, along, [&](double part, const Vector3& away)
            {
                const double polar = std::numbers::pi*part;
                return wall.point + wall.radius*(std::sin(polar)*away - std::cos(polar)*axis);
            });
        }
    }
}

}
