// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/FloatingBody.H"

#include "models/reactions/WallReactions.H"
#include "wallMotions/SixDoFBody.H"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace shizuku
{

namespace
{

BodyImpulses impulsesOn(const std::string& wall, Liquid& liquid)
{
    BodyImpulses impulses;
    for (int c = 0; c < 3; ++c)
    {
        const auto of = [&](WallReactions::Part part, int component) { return liquid.number(WallReactions::number(wall, part, component), 0); };
        impulses.normal[c] = of(WallReactions::pressure, c) + of(WallReactions::contactLine, c);
        impulses.friction[c] = of(WallReactions::friction, c);
        impulses.frictionMoment[c] = of(WallReactions::friction, c + 3);
    }
    return impulses;
}

AnalyticSurface surfaceAt(const AnalyticSurface& given, const Walls& walls, double time)
{
    const int motion = walls.motions().indexOf(given.name);
    return motion < 0 ? given : moved(given, walls.motions().walls()[motion].motion->at(time));
}

}

FloatingBody::FloatingBody(const std::filesystem::path& casePath, const Liquid& liquid, const Walls& walls, const Models& models)
:
    surfaces_(readAnalyticSurfaces(Dictionary::read(casePath / "constant/walls"))), wall_(walls.freeBody()->wall()), g_(models.bodyForce->uniform()), density_(liquid.properties().density), spacing_(liquid.properties().spacing)
{
    own_ = std::size_t(std::find_if(surfaces_.begin(), surfaces_.end(), [&](const AnalyticSurface& surface) { return surface.name == wall_; }) - surfaces_.begin());
    const SourceLocation where = Dictionary::read(casePath / "constant/walls").where(wall_);
    if (!models.pressure->keepPressure())
    {
        throw FatalInputError(models.dict.where("pressure"), "The liquid moves a body, and the pressure model has no field of the pressure", "one that has, such as completedPbf");
    }
    if (liquid.properties().surfaceTension > 0 && models.dict.lookup<std::string>("surfaceTension") != "none" && !models.freeSurface->active())
    {
        throw FatalInputError(models.dict.where("surfaceTension"), "The liquid moves a body, and the tension model does not know the free surface, along which it pulls", "laplacePressure, continuumSurfaceForce or none");
    }
    if (walls.particles() > 0) throw FatalInputError(where, "The liquid moves a body, and another wall is sampled", "walls of type plane, sphere, cylinder and box");
    if (liquid.ghosts().images()) throw FatalInputError(where, "The liquid moves a body, and the case has sides that repeat or mirror the liquid", "open sides and walls");
}

void FloatingBody::begin(Liquid& liquid) { last_ = impulsesOn(wall_, liquid); }

void FloatingBody::follow(Liquid& liquid, const Walls& walls, double to, double dt)
{
    SixDoFBody& body = *walls.freeBody();
    const BodyImpulses now = impulsesOn(wall_, liquid);
    const Vector3 normal = (now.normal - last_.normal) / dt;
    const Vector3 middle = surfaceAt(surfaces_[own_], walls, to).point;
    const BodyLoad load{normal + (now.friction - last_.friction) / dt, cross(middle, normal) + (now.frictionMoment - last_.frictionMoment) / dt};
    last_ = now;
    // Of a sphere deep in the liquid it is half of what it displaces (Lamb 1932, article 92).
    const double added = 0.5 * liquid.number(WallReactions::wetted(wall_), 0) * density_ * body.volume();
    body.advance(to, dt, load, g_, added);
    if (!std::isfinite(body.speed()))
    {
        std::ostringstream text;
        text << "The body '" << wall_ << "' that the liquid moves has a velocity at " << to << " s that is no number: shorter steps may help (maxCo in system/controlDict)";
        throw FatalError(text.str());
    }
    stopAtWalls(walls, to, dt);
    SixDoFState::forEach(body.state(), wall_, [&](const std::string& name, double number) { liquid.setNumber(name, number); });
}

void FloatingBody::stopAtWalls(const Walls& walls, double to, double dt) const
{
    SixDoFBody& body = *walls.freeBody();
    const Vector3 middle = surfaceAt(surfaces_[own_], walls, to).point;
    for (const AnalyticSurface& given : surfaces_)
    {
        if (given.name == wall_) continue;
        const AnalyticSurface surface = surfaceAt(given, walls, to);
        const double gap = surface.signedDistance(middle) - body.radius() - spacing_;
        body.stopAt(surface.normal(middle), std::max(gap, 0.0) / dt, dt);
    }
}

}
