// SPDX-License-Identifier: GPL-3.0-or-later
// May the liquid jump off the wall that it starts on?
//
// A body on a flat wall of one contact angle, taken as the cap of its volume that has as much liquid within a spacing of the
// wall (the least surface that such a start can have): where its surfaces have more energy than a free sphere that touches
// the wall, liquid of low viscosity is thrown off as it draws together. Formulas, and from which Ohnesorge number on it stays
// whatever the wall: src/reference/CapOnWall.H. The run has the viscosity of its model, XSPH's in place of the liquid's.

#include "advice/Rule.H"

#include <cmath>

namespace shizuku
{

namespace
{

class Start : public AdviceRule
{
public:
    // Behind the viscosity that the case will have.
    AdviceStage stage() const override { return AdviceStage::step; }

    std::optional<Advice> advise(Scene& scene) const override
    {
        const double viscosity = scene.modelViscosity();
        const SceneBody* worst = nullptr;
        double most = 0;
        for (const SceneBody& body : scene.bodies)
        {
            const auto cap = scene.start(body, viscosity);
            if (!cap) continue;
            const JumpOff jump = jumpOff(*cap);
            const double energy = jump.start/jump.free;
            if (worst && energy <= most) continue;
            worst = &body;
            most = energy;
        }
        if (!worst) return std::nullopt;

        const CapStart cap = *scene.start(*worst, viscosity);
        const JumpOff jump = jumpOff(cap);
        Advice advice
        {
            "keep", "it wets '" + scene.walls[worst->footing->wall].name + "' of " + number(cap.theta) +
            " degrees as a cap of " + number(cap.angle) + " would, with " + number(jump.start/jump.free) +
            " times the energy of a free ball that touches it; the cap at rest has " + number(jump.rest/jump.free),
            "exact caps; Sanjay, Chantelot and Lohse 2023; src/reference/CapOnWall.H"
        };
        if (!jump.excess()) return advice;
        advice.reason += "; it stays on any wall where Oh + Bo is 1 or more (of R), and has " + number(cap.ohnesorge + cap.bond) +
            " by " + scene.models.at("viscosity") + ", " + number(scene.start(*worst, scene.viscosity)->ohnesorge + cap.bond) +
            " by its own viscosity";
        if (cap.staysAnyhow())
        {
            advice.verdict = "keep: too thick or heavy to jump off";
            return advice;
        }
        const double R = 0.5*worst->liquid.diameter();
        const double enough = (1 - cap.bond)*std::sqrt(scene.surfaceTension*R/scene.density);
        advice.verdict = "it may jump off the wall: start with a cap of " + wholeNumber(std::ceil(jump.flattest)) +
            " degrees, or with a viscosity of " + number(enough) + " m2/s";
        return advice;
    }
};

const AdviceRules::Add<Start> registered{"start"};

}

}
