// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallMotions/BodyStops.H"

#include "wallMotions/SixDoFBody.H"

#include <algorithm>

namespace shizuku
{

namespace
{

AnalyticSurface surfaceAt(const AnalyticSurface& given, const WallMotions& motions, double time)
{
    const int motion = motions.indexOf(given.name);
    return motion < 0 ? given : moved(given, motions.walls()[motion].motion->at(time));
}

AnalyticSurface plane(const std::string& name, const Vector3& point, const Vector3& normal)
{
    AnalyticSurface side;
    side.name = name;
    side.point = point;
    side.direction = normal;
    return side;
}

void addSides(const AnalyticSurface& box, std::vector<AnalyticSurface>& to)
{
    for (int c = 0; c < 3; ++c)
    {
        Vector3 inwards;
        inwards[c] = 1;
        to.push_back(plane(box.name, box.min, inwards));
        to.push_back(plane(box.name, box.max, -inwards));
    }
}

}

BodyStops::BodyStops(const std::vector<AnalyticSurface>& walls, const std::string& own, double gap) : gap_(gap)
{
    for (const AnalyticSurface& wall : walls)
    {
        if (wall.name == own) own_ = wall;
        else if (wall.type == AnalyticSurface::Type::box) addSides(wall, others_);
        else others_.push_back(wall);
    }
    if (own_.name.empty()) throw FatalError("No analytic wall has the name '" + own + "'");
}

Vector3 BodyStops::middle(const WallMotions& motions, double time) const { return surfaceAt(own_, motions, time).point; }

void BodyStops::stop(const WallMotions& motions, double to, double dt) const
{
    constexpr int most = 50;                            // what a wall takes may drive the body at another one: a groove of 60 degrees leaves a quarter each time
    SixDoFBody& body = *motions.body();
    const Vector3 at = middle(motions, to);
    struct Limit
    {
        Vector3 normal;
        double approach;                                // m/s
    };
    std::vector<Limit> limits;
    for (const AnalyticSurface& given : others_)
    {
        const AnalyticSurface wall = surfaceAt(given, motions, to);
        const double gap = wall.signedDistance(at) - body.radius() - gap_;
        const double gapNext = surfaceAt(given, motions, to + dt).signedDistance(at) - body.radius() - gap_;
        limits.push_back({wall.normal(at), (std::max(gap, 0.0) + gapNext - gap)/dt});
    }
    for (int k = 0; k < most; ++k)
    {
        bool isStopped = false;
        for (const Limit& limit : limits) isStopped |= body.stopAt(at, limit.normal, limit.approach, dt);
        if (!isStopped) return;
    }
}

}
