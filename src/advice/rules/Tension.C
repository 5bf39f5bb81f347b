// SPDX-License-Identifier: GPL-3.0-or-later
// Does the answer need surface tension?
//
//     effect = 1/(Bo + We),    Bo = rho g D^2/sigma,    We = rho U^2 D/sigma
//
// the pressure of tension, sigma/D, over those of weight and impact, rho g D and rho U^2: the terms of the balance of
// momentum (de Gennes, Brochard-Wyart and Quere 2004, chapter 2). U is the speed with which a body meets a wall.
//
// Liquid that no vessel holds spreads, and tension then stops it at a depth of about the capillary length l (chapter 2.2
// there). At v = max(sqrt(g D), U) it would be as shallow as h after the time t of the run:
//
//     effect = (l/h)^2,    h = D^3/(D + v t)^2,    l^2 = sigma/(rho g)
//
// The larger one counts, of all bodies.

#include "advice/Rule.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

class Tension : public AdviceRule
{
public:
    std::optional<Advice> advise(Scene& scene) const override
    {
        if (scene.surfaceTension <= 0) return std::nullopt;
        double effect = 0;
        std::string numbers;
        for (const SceneBody& body : scene.bodies)
        {
            const FlowNumbers n = flowNumbers(scene.scales(body));
            const double shallow = depth(scene, body), spreads = shallow < 1 ? 1/(n.bond*shallow*shallow) : 0;
            const double own = std::max(1/(n.bond + n.weber), spreads);
            if (own <= effect) continue;
            effect = own;
            numbers =
                "Bo = " + number(n.bond) + ", We = " + number(n.weber) + ", depth at the end " + number(shallow) + " D";
        }
        Advice advice
        {
            "keep", "tension against weight and impact: " + percent(effect) + " (" + numbers + ")",
            "balance of momentum, dimensionless; src/advice/rules/Tension.C"
        };
        const bool needed = effect > scene.tolerance;
        if (needed == scene.hasTension()) return advice;
        const bool wets = needed && scene.theta();
        const auto choose = [&](const std::string& kind, const std::string& model)
        {
            if (scene.models[kind] != model) advice.changes.push_back({"constant/models", kind, model});
            scene.models[kind] = model;
        };
        advice.verdict = needed ? "switch on: the scene needs it" : "leave out, and wetting with it";
        const ModelSet& standard = scene.studies->standard();
        choose("surfaceTension", needed ? standard.surfaceTension : "none");
        choose("wetting", wets ? standard.wetting : "none");
        return advice;
    }

private:
    // h/D; 1 in a vessel, and where there is no wall to spread on.
    static double depth(const Scene& scene, const SceneBody& body)
    {
        if (scene.walls.empty() || scene.isVessel()) return 1;
        const double D = body.liquid.diameter(), v = std::max(std::sqrt(length(scene.gravity)*D), body.impactSpeed);
        return std::pow(1 + v*scene.duration/D, -2);
    }
};

const AdviceRules::Add<Tension> registered{"tension"};

}

}
