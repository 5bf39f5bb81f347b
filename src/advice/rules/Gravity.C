// SPDX-License-Identifier: GPL-3.0-or-later
// Does the answer need gravity?
//
// Of a body that stands on a level plane: the change of its height against the spherical cap of the same volume and
// contact angle (of all bodies in one, where they may meet), by the exact profile of Bashforth and Adams (1883; src/reference/BashforthAdams.H). Of a free body: how far
// it falls in the time of the run over its diameter, g t^2/(2 D). Bodies that have to fall first, or stand on anything else,
// need it.

#include "advice/Rule.H"
#include "reference/BashforthAdams.H"

#include <cmath>
#include <limits>

namespace shizuku
{

namespace
{

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double level = 0.9998;            // cosine of one degree
constexpr double smallest = 1;              // degrees: below, a film, whose profile is no drop's

struct Effect
{
    double value;
    std::string reason;
};

class Gravity : public AdviceRule
{
public:
    std::optional<Advice> advise(Scene& scene) const override
    {
        const bool on = scene.models.at("bodyForce") == "gravity";
        if (length(scene.availableGravity) == 0 || (!on && scene.models.at("bodyForce") != "none")) return std::nullopt;
        Effect largest{0, ""};
        for (const SceneBody& body : scene.bodies)
        {
            const Effect own = effectOn(scene, body);
            if (own.value >= largest.value) largest = own;
        }
        Advice advice
        {
            "keep", largest.reason,
            "Bashforth and Adams 1883, Young and Laplace; src/advice/rules/Gravity.C"
        };
        if (!on) advice.verdict = "leave it out";
        const bool needed = largest.value > scene.tolerance;
        if (needed == on) return advice;
        advice.verdict = needed ? "switch on: the scene needs it (constant/g)" : "leave out";
        scene.models["bodyForce"] = needed ? "gravity" : "none";
        scene.gravity = needed ? scene.availableGravity : Vector3();
        advice.changes = {{"constant/models", "bodyForce", scene.models["bodyForce"]}};
        return advice;
    }

private:
    static double volumeOfAll(const Scene& scene)
    {
        double volume = 0;
        for (const SceneBody& body : scene.bodies) volume += body.liquid.volume;
        return volume;
    }

    static Effect effectOn(const Scene& scene, const SceneBody& body)
    {
        const double g = length(scene.availableGravity), D = body.liquid.diameter();
        if (scene.walls.empty())
        {
            const double fall = 0.5*g*scene.duration*scene.duration/D;
            return {fall, "a free body falls g t^2/2 = " + number(fall) + " diameters in the time of the run"};
        }
        if (!std::isfinite(body.gap))
        {
            return {infinite, "how far a body is from the wall shows only when it is sampled (sampleSurface)"};
        }
        if (body.gap > scene.spacing)
        {
            return {infinite, "a body is let go " + number(body.gap/D) + " diameters above the wall"};
        }
        if (!scene.hasTension()) return {infinite, "nothing but weight drives the liquid"};
        const SceneWall& wall = scene.walls.front();
        const bool stands = scene.walls.size() == 1 && wall.plane && wall.theta && *wall.theta > smallest &&
            dot(wall.plane->normal, scene.availableGravity) < -level*g;
        if (!stands)
        {
            return {infinite, "the walls are no level plane of known contact angle: weight moves the liquid along them"};
        }
        const double l = std::sqrt(scene.surfaceTension/(scene.density*g));
        const double volume = scene.mayMeet() ? volumeOfAll(scene) : body.liquid.volume;
        const double heavy = bashforthAdamsOfVolume(volume, l, *wall.theta).height();
        const double light = bashforthAdamsOfVolume(volume, infinite, *wall.theta).height();
        const double effect = std::abs(heavy/light - 1);
        return
        {
            effect, "the weight changes the height of a drop at rest by " + percent(effect) + " (D = " + number(D/l) +
            " capillary lengths, theta = " + number(*wall.theta) + ")"
        };
    }
};

const AdviceRules::Add<Gravity> registered{"gravity"};

}

}
