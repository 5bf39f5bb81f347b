// SPDX-License-Identifier: GPL-3.0-or-later
#include "WallsOfPicture.H"

#include "caseFiles/AnalyticMesh.H"

#include <algorithm>
#include <limits>

namespace shizuku
{

namespace
{

const std::vector<Vector3>& liquidOf(const PictureScene& scene) { return scene.liquid.vertices.empty() ? scene.particles : scene.liquid.vertices; }

// From the lowest liquid to a little above the highest.
void addGlass(PictureScene& scene, const AnalyticSurface& tube)
{
    double low = std::numeric_limits<double>::max(), high = -low;
    for (const Vector3& x : liquidOf(scene))
    {
        low = std::min(low, dot(x - tube.point, tube.direction));
        high = std::max(high, dot(x - tube.point, tube.direction));
    }
    const double above = 0.2*(high - low);
    scene.glass.push_back({tube.point + low*tube.direction, tube.direction, high - low + above, tube.radius});
}

}

void addAnalyticWalls(PictureScene& scene, const std::vector<AnalyticSurface>& walls)
{
    using Type = AnalyticSurface::Type;
    for (const AnalyticSurface& wall : walls)
    {
        const bool isRound = wall.type == Type::cylinder || wall.type == Type::sphere;
        if (wall.type == Type::cylinder && wall.liquidInside) addGlass(scene, wall);
        else if (isRound && !wall.liquidInside) addMesh(scene.walls, wall, boundsOf(liquidOf(scene)));
    }
}

}
