// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/FloatingBody.H"

#include "models/reactions/WallReactions.H"
#include "wallMotions/SixDoFBody.H"

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

}

FloatingBody::FloatingBody(const std::filesystem::path& casePath, const Liquid& liquid, const Walls& walls, const Models& models)
:
    FloatingBody(Dictionary::read(casePath / "constant/walls"), liquid, walls, models)
{}

FloatingBody::FloatingBody(const Dictionary& wallsDict, const Liquid& liquid, const Walls& walls, const Models& models)
:
    wall_(walls.freeBody()->wall()), stops_(readAnalyticSurfaces(wallsDict), wall_, liquid.properties().spacing), density_(liquid.properties().density)
{
    const SourceLocation where = wallsDict.where(wall_);
    refuseModels(liquid, models);
    if (walls.particles() > 0) throw FatalInputError(where, "The liquid moves a body, and another wall is sampled", "walls of type plane, sphere, cylinder and box");
    if (liquid.ghosts().images()) throw FatalInputError(where, "The liquid moves a body, and the case has sides that repeat or mirror the liquid", "open sides and walls");
}

void FloatingBody::refuseModels(const Liquid& liquid, const Models& models)
{
    if (!models.pressure->keepPressure())
    {
        throw FatalInputError(models.dict.where("pressure"), "The liquid moves a body, and the pressure model has no field of the pressure", "one that has, such as completedPbf");
    }
    if (liquid.properties().surfaceTension > 0 && models.dict.lookup<std::string>("surfaceTension") != "none" && !models.freeSurface->active())
    {
        throw FatalInputError(models.dict.where("surfaceTension"), "The liquid moves a body, and the tension model does not know the free surface, along which it pulls", "laplacePressure, continuumSurfaceForce or none");
    }
}

void FloatingBody::begin(Liquid& liquid) { last_ = impulsesOn(wall_, liquid); }

void FloatingBody::follow(Liquid& liquid, const Walls& walls, const Models& models, double to, double dt)
{
    SixDoFBody& body = *walls.freeBody();
    const BodyImpulses now = impulsesOn(wall_, liquid);
    const Vector3 normal = (now.normal - last_.normal) / dt;
    const Vector3 middle = stops_.middle(walls.motions(), to);
    const BodyLoad load{normal + (now.friction - last_.friction) / dt, cross(middle, normal) + (now.frictionMoment - last_.frictionMoment) / dt};
    last_ = now;
    // Of a sphere deep in the liquid it is half of what it displaces (Lamb 1932, article 92).
    const double added = 0.5 * liquid.number(WallReactions::wetted(wall_), 0) * density_ * body.volume();
    body.advance(to, dt, load, Vector3(models.bodyForce->uniform()), added);
    if (!std::isfinite(body.speed()))
    {
        std::ostringstream text;
        text << "The body '" << wall_ << "' that the liquid moves has a velocity at " << to << " s that is no number: shorter steps may help (maxCo in system/controlDict)";
        throw FatalError(text.str());
    }
    stops_.stop(walls.motions(), to, dt);
    SixDoFState::forEach(body.state(), wall_, [&](const std::string& name, double number) { liquid.setNumber(name, number); });
}

}
