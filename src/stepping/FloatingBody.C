// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/FloatingBody.H"

#include "caseFiles/SolidParticles.H"
#include "models/reactions/WallReactions.H"
#include "wallMotions/SixDoFBody.H"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace shizuku
{

namespace
{

std::array<double, 6> impulsesOn(const std::string& wall, Liquid& liquid)
{
    std::array<double, 6> sum{};
    for (int part = 0; part < WallReactions::parts; ++part)
    {
        for (int c = 0; c < 6; ++c) sum[c] += liquid.number(WallReactions::number(wall, WallReactions::Part(part), c), 0);
    }
    return sum;
}

}

FloatingBody::FloatingBody(const std::filesystem::path& casePath, const Liquid& liquid, const Walls& walls, const Models& models)
:
    surfaces_(readAnalyticSurfaces(Dictionary::read(casePath / "constant/walls"))), wall_(walls.freeBody()->wall()), g_(models.bodyForce->uniform()), density_(liquid.properties().density), spacing_(liquid.properties().spacing)
{
    const SourceLocation where = Dictionary::read(casePath / "constant/walls").where(wall_);
    if (!models.pressure->keepPressure())
    {
        throw FatalInputError(models.dict.where("pressure"), "The liquid moves a body, and the pressure model has no field of the pressure", "one that has, such as completedPbf");
    }
    if (liquid.properties().surfaceTension > 0 && models.dict.lookup<std::string>("surfaceTension") != "none" && !models.freeSurface->active())
    {
        throw FatalInputError(models.dict.where("surfaceTension"), "The liquid moves a body, and the tension model does not know the free surface, along which it pulls", "laplacePressure, continuumSurfaceForce or none");
    }
    if (useSolidParticles(casePath)) throw FatalInputError(where, "The liquid moves a body, and another wall is sampled", "walls of type plane, sphere, cylinder and box");
    if (liquid.ghosts().images()) throw FatalInputError(where, "The liquid moves a body, and the case has sides that repeat or mirror the liquid", "open sides and walls");
}

void FloatingBody::begin(Liquid& liquid) { last_ = impulsesOn(wall_, liquid); }

void FloatingBody::follow(Liquid& liquid, const Walls& walls, double to, double dt)
{
    SixDoFBody& body = *walls.freeBody();
    const std::array<double, 6> now = impulsesOn(wall_, liquid);
    BodyLoad load;
    for (int c = 0; c < 3; ++c)
    {
        load.force[c] = (now[c] - last_[c]) / dt;
        load.moment[c] = (now[c + 3] - last_[c + 3]) / dt;
    }
    last_ = now;
    body.advance(to, dt, load, g_, density_);
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
    const auto now = [&](const AnalyticSurface& surface)
    {
        const int motion = walls.motions().indexOf(surface.name);
        return motion < 0 ? surface : moved(surface, walls.motions().walls()[motion].motion->at(to));
    };
    const auto own = std::find_if(surfaces_.begin(), surfaces_.end(), [&](const AnalyticSurface& surface) { return surface.name == wall_; });
    const Vector3 middle = now(*own).point;
    for (const AnalyticSurface& given : surfaces_)
    {
        if (given.name == wall_) continue;
        const AnalyticSurface surface = now(given);
        const double gap = surface.signedDistance(middle) - body.radius() - spacing_;
        body.stopAt(surface.normal(middle), std::max(gap, 0.0) / dt, dt);
    }
}

}
