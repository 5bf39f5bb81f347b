// SPDX-License-Identifier: GPL-3.0-or-later
// How long may a sub-step be?
//
// maxCapillaryCo, in capillary steps sqrt(rho d^3/(2 pi sigma)): the longest one of the stored studies up to which the
// answer and the volume stay within the tolerance, and which is calm as a fixed step (doc/studies.md, longSteps).

#include "advice/Rule.H"

#include <algorithm>
#include <cmath>
#include <set>

namespace shizuku
{

namespace
{

class TimeStep : public AdviceRule
{
public:
    AdviceStage stage() const override { return AdviceStage::step; }

    std::optional<Advice> advise(Scene& scene) const override
    {
        if (!scene.hasTension()) return std::nullopt;
        if (scene.limit != "capillary" && scene.limit != "tension")
        {
            const std::string reason = "the " + scene.limit + " limit rules the sub-step, not the capillary one";
            return Advice{"keep", reason, "src/stepping/StepControl.H"};
        }
        const auto set = scene.modelSet();
        const SceneAnswer answer = scene.answer();
        const auto calm = set ? scene.studies->calmSteps(set->name) : std::nullopt;
        if (!calm || answer.scene.empty()) return untold(answer);

        const double n = scene.particles(scene.smallest());
        const auto error = [&](double steps)
        {
            return scene.studies->error(answer.scene, answer.parameter, set->name, n, steps);
        };
        const auto volume = [&](double steps) { return scene.studies->error("volume", 0, set->name, n, steps); };
        std::set<double> tried;
        for (const std::string& study : {answer.scene, std::string("volume")})
        {
            for (const double steps : scene.studies->steps(study, set->name)) tried.insert(steps);
        }
        double best = set->maxCapillaryCo;
        for (const double steps : tried)
        {
            const auto ofAnswer = error(steps), ofVolume = volume(steps);
            if (steps < best || !ofAnswer || !ofVolume) continue;
            if (steps > calm->value || std::max(ofAnswer->value, ofVolume->value) > scene.tolerance) break;
            best = steps;
        }
        const auto there = error(best);
        if (!there) return untold(answer);
        Advice advice
        {
            "keep", "with " + number(best) + " capillary steps: error " + percent(there->value) + ", volume " +
            (volume(best) ? percent(volume(best)->value) : "not known") + "; calm up to " + number(calm->value),
            there->source + ", " + calm->source
        };
        if (std::abs(best/scene.maxCapillaryCo - 1) < 0.05) return advice;
        advice.verdict = "maxCapillaryCo " + number(scene.maxCapillaryCo) + " to " + number(best);
        advice.changes = {{"system/controlDict", "maxCapillaryCo", number(best)}};
        scene.subStep *= best/scene.maxCapillaryCo;
        scene.maxCapillaryCo = best;
        return advice;
    }
};

const AdviceRules::Add<TimeStep> registered{"timeStep"};

}

}
