// SPDX-License-Identifier: GPL-3.0-or-later
// How many particles does the tolerance ask for?
//
// The fewest N from which on the stored studies have the answer within the tolerance, of the smallest body:
//
//     spacing = (V/N)^(1/3)
//
// with the time step that the model set was measured at. A coarse run that is better than finer ones is luck and does not
// count. Numbers of particles outside of the studies are never advised.

#include "advice/Rule.H"

#include <cmath>

namespace shizuku
{

namespace
{

constexpr double finer = 1.02;              // ratio of the numbers that are tried
constexpr double worthwhile = 0.1;          // change of the spacing below which all stays

class Spacing : public AdviceRule
{
public:
    AdviceStage stage() const override { return AdviceStage::resolution; }

    std::optional<Advice> advise(Scene& scene) const override
    {
        const auto set = scene.modelSet();
        const SceneAnswer answer = scene.answer();
        std::vector<double> tried;
        if (set) tried = scene.studies->particles(answer.scene, set->name);
        if (tried.empty()) return untold(answer);
        const auto error = [&](double n)
        {
            const double step = scene.relativeStep(n, set->maxCapillaryCo);
            return scene.studies->error(answer.scene, answer.parameter, set->name, n, step);
        };
        const auto isWithin = [&](double n)
        {
            const auto there = error(n);
            return there && there->value <= scene.tolerance;
        };
        const double now = scene.particles(scene.smallest());
        const auto present = error(now);
        double fewest = tried.back();
        if (!present || !error(fewest)) return untold(answer);
        const bool reached = isWithin(fewest);
        while (reached && fewest/finer >= tried.front() && isWithin(fewest/finer)) fewest /= finer;
        Advice advice
        {
            "keep", "error of the " + answer.text + " with " + wholeNumber(now) + " particles: " + percent(present->value) +
            (reached ? "; the tolerance asks for " + wholeNumber(fewest) : "; no stored study reaches the tolerance: " +
            percent(error(fewest)->value) + " with " + wholeNumber(fewest)), error(fewest)->source
        };
        if (!reached) return advice;
        const double digits = std::pow(10, std::floor(std::log10(scene.spacing)) - 2);
        const double advised = digits*std::floor(scene.spacing*std::cbrt(now/fewest)/digits*(1 + 1e-9));
        if (std::abs(advised/scene.spacing - 1) < worthwhile) return advice;
        if (!scene.refillable)
        {
            advice.verdict = "a spacing of " + number(advised) + " m would do, but no system/fillLiquidDict fills it anew";
            return advice;
        }
        advice.verdict = advised > scene.spacing ? "coarser: " : "finer: ";
        advice.verdict += number(scene.spacing) + " to " + number(advised) + " m";
        advice.changes = {{"system/solution", "spacing", number(advised)}};
        scene.spacing = advised;
        return advice;
    }
};

const AdviceRules::Add<Spacing> registered{"spacing"};

}

}
