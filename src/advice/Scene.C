// SPDX-License-Identifier: GPL-3.0-or-later
#include "advice/Scene.H"

#include "models/smoothing/SmoothingShare.H"
#include "reference/CapillaryStep.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

constexpr double flattest = 5;              // degrees: thinner caps are films
constexpr std::size_t mostLookedAt = 200;   // bodies, the largest
constexpr double smallestBond = 0.05;       // (R/l)^2, below which a drop on a wall is that of no gravity

}

FlowScales Scene::scales(const SceneBody& body) const
{
    return {body.liquid.diameter(), body.impactSpeed, length(gravity), density, viscosity, surfaceTension};
}

const SceneBody& Scene::smallest() const
{
    std::size_t last = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
        if (bodies[i].liquid.volume >= 0.1*bodies.front().liquid.volume) last = i;
    }
    return bodies[last];
}

double Scene::particles(const SceneBody& body) const { return body.liquid.volume/(spacing*spacing*spacing); }

std::optional<double> Scene::theta() const
{
    double sum = 0;
    int count = 0;
    for (const SceneWall& wall : walls)
    {
        // The floor of a vessel is covered: its angle shows nowhere.
        if (!wall.theta || (wall.type == "plane" && isTube())) continue;
        sum += *wall.theta;
        ++count;
    }
    if (count == 0) return std::nullopt;
    return sum/count;
}

bool Scene::isTube() const
{
    return std::any_of(walls.begin(), walls.end(), [](const SceneWall& wall) { return wall.type == "cylinder"; });
}

bool Scene::isVessel() const
{
    constexpr int sides = 4;
    int planes = 0;
    for (const SceneWall& wall : walls)
    {
        if (wall.type == "cylinder" || wall.type == "box") return true;
        if (wall.plane) ++planes;
    }
    return planes >= sides;
}

std::optional<ModelSet> Scene::modelSet() const
{
    return studies->modelSet(models.at("pressure"), models.at("surfaceTension"), models.at("wetting"));
}

SceneAnswer Scene::answer() const
{
    const double bond = flowNumbers(scales(bodies.front())).bond;
    const bool isHeavy = isVessel() && !isTube() && bond*tolerance > 1;     // tension will not be felt
    if (!hasTension() || isHeavy)
    {
        if (walls.empty() || length(gravity) == 0) return {"", 0, "none that a stored study has"};
        return {"damBreak", 0, "front of liquid that collapses"};
    }
    if (walls.empty()) return {"oscillation", 0, "period of a free drop"};
    if (std::any_of(bodies.begin(), bodies.end(), [&](const SceneBody& body) { return mayJumpOff(body); }))
    {
        return {"", 0, "none that a stored study has: liquid starts with the energy to leave its wall"};
    }
    if (mayMeet()) return {"", 0, "none that a stored study has: bodies of liquid may meet"};
    const std::string angle = theta() ? number(*theta()) + " degrees" : "";
    if (isTube() && length(gravity) > 0 && theta()) return {"meniscus", *theta(), "meniscus at " + angle};
    const double ofRadius = bond/4;
    if (ofRadius >= smallestBond) return {"gravity", ofRadius, "height of a drop at the Bond number (R/l)^2 " + number(ofRadius)};
    if (theta()) return {"sessile", *theta(), "contact angle of " + angle};
    return {"", 0, "none that a stored study has"};
}

double Scene::modelViscosity() const
{
    const std::string& model = models.at("viscosity");
    const double h = support*spacing;
    if (model != "XSPH") return model == "none" ? 0 : viscosity;
    const double steps = subStep/capillaryStep(density*std::pow(spacing, 3), surfaceTension);
    return smoothingShare(smoothing, smoothingPerCapillaryStep, steps)*3/40*h*h/(2*subStep);
}

std::optional<CapStart> Scene::start(const SceneBody& body, double nu) const
{
    if (!body.footing || surfaceTension <= 0 || !hasTension()) return std::nullopt;
    const SceneWall& wall = walls[body.footing->wall];
    if (!wall.theta || !wall.evenTheta) return std::nullopt;
    const double R = 0.5*body.liquid.diameter(), pressing = -dot(gravity, wall.plane->normal);
    if (pressing < 0) return std::nullopt;
    return CapStart
    {
        capAngleOf(body.footing->layer/body.liquid.volume, body.footing->depth/R), *wall.theta,
        density*pressing*R*R/surfaceTension, nu*std::sqrt(density/(surfaceTension*R))
    };
}

bool Scene::mayMeet() const
{
    // How far liquid reaches to the side from the middle of its body: as it is, or as a cap at its contact angle.
    const auto reach = [&](const SceneBody& body)
    {
        const Vector3 size = body.liquid.size();
        const double now = 0.5*std::max({size.x, size.y, size.z});
        if (walls.empty() || !theta()) return now;
        const double angle = std::max(*theta(), flattest), R = 0.5*body.liquid.diameter();
        return std::max(now, R*(angle < 90 ? capFootRadius(angle) : capRadius(angle)));
    };
    const std::size_t looked = std::min(bodies.size(), mostLookedAt);
    for (std::size_t i = 0; i < looked; ++i)
    {
        for (std::size_t j = 0; j < i; ++j)
        {
            const SeparateBody &a = bodies[i].liquid, &b = bodies[j].liquid;
            const Vector3 apart = 0.5*(a.low + a.high - b.low - b.high), approach = a.velocity - b.velocity;
            const double speed2 = dot(approach, approach);
            const double nearest = speed2 > 0 ? std::clamp(-dot(apart, approach)/speed2, 0.0, duration) : 0;      // s
            if (length(apart + nearest*approach) < reach(bodies[i]) + reach(bodies[j]) + support*spacing) return true;
        }
    }
    return false;
}

bool Scene::mayJumpOff(const SceneBody& body) const
{
    const auto cap = start(body, viscosity);
    return cap && jumpOff(*cap).excess();
}

double Scene::relativeStep(double n, double capillarySteps) const
{
    if (answer().scene != "damBreak") return capillarySteps;
    return subStep/std::sqrt(std::cbrt(smallest().liquid.volume/n)/length(gravity));
}

std::optional<StoredNumber> Scene::error() const
{
    const auto set = modelSet();
    const SceneAnswer asked = answer();
    if (!set || asked.scene.empty()) return std::nullopt;
    const double n = particles(smallest());
    return studies->error(asked.scene, asked.parameter, set->name, n, relativeStep(n, maxCapillaryCo));
}

std::optional<double> Scene::likelyError() const
{
    const auto typical = error();
    if (!typical) return std::nullopt;
    const std::string set = modelSet()->name;
    const std::vector<double> run = studies->particles(answer().scene, set);
    const double n = particles(smallest());
    const auto scatter = studies->scatter(set);
    constexpr double digits = 0.01;             // of a spacing of three digits
    if (!scatter || n < (1 - digits)*run.front() || n > (1 + digits)*run.back()) return std::nullopt;
    return *scatter*typical->value;
}

}
