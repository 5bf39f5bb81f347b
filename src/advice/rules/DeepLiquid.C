// SPDX-License-Identifier: GPL-3.0-or-later
// Do the pressure's coarse grid and particle shifting keep the volume of deep liquid?
//
// pressure/coarseGrid of completedPbf, and particleShifting. An iteration carries a load by one support, so that all of a sub-step reach n h deep. Where
// liquid of depth H is deeper than that, a sub-step leaves it compressed, the more the larger
//
//     dt^2 p/(rho d^2) = dt^2 (g H + U^2)/d^2,        U: the speed with which it meets a wall
//
// which is how far, in spacings, its pressure would throw it in that time. A block a hundred spacings deep that falls on a floor lost
// 0.6, 2.4, 8 and 17 % of its volume at 0.07, 0.27, 1.1 and 4.4 (doc/notebook/performance.md, One simulated second): from 0.1 on the grid is worth its time.
// In so few steps liquid that it throws is sheared with its lattice, into pairs that read as dense where a tenth of it is missing: they are parted (the same page).

#include "advice/Rule.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

constexpr double most = 0.1;

class DeepLiquid : public AdviceRule
{
public:
    // Behind the step and the iterations that the case will have.
    AdviceStage stage() const override { return AdviceStage::pressure; }

    std::optional<Advice> advise(Scene& scene) const override
    {
        const double g = length(scene.gravity), d = scene.spacing, reach = scene.maxIterations*scene.support;
        if (scene.models.at("pressure") != "completedPbf" || g == 0) return std::nullopt;

        double deepest = 0, thrown = 0;         // spacings
        for (const SceneBody& body : scene.bodies)
        {
            const Vector3 size = body.liquid.size(), down = scene.gravity/g;
            const double depth = std::abs(size.x*down.x) + std::abs(size.y*down.y) + std::abs(size.z*down.z);
            if (depth <= reach*d) continue;
            deepest = std::max(deepest, depth/d);
            thrown = std::max(thrown, std::pow(scene.subStep/d, 2)*(g*depth + std::pow(body.impactSpeed, 2)));
        }
        if (deepest == 0 && !scene.coarseGrid && scene.models.at("particleShifting") == "none") return std::nullopt;

        Advice advice
        {
            "keep", deepest == 0 ? "no liquid is deeper than the " + number(reach) + " spacings that its iterations reach" :
            "its iterations reach " + number(reach) + " of " + number(deepest) + " spacings, and its pressure would throw it by " +
            number(thrown) + " of one in a sub-step", "doc/notebook/performance.md; src/advice/rules/DeepLiquid.C"
        };
        const bool needed = thrown > most;
        std::string& shifting = scene.models["particleShifting"];
        const std::string needs = needed ? "closePairs" : "none";
        if (needed != scene.coarseGrid) advice.changes.push_back({"system/solution", "pressure/coarseGrid", needed ? "yes" : "no"});
        if (needs != shifting) advice.changes.push_back({"constant/models", "particleShifting", needs});
        if (advice.changes.empty()) return advice;
        advice.verdict = needed ? "coarseGrid yes, particleShifting closePairs: it would not keep its volume" :
            "coarseGrid no, particleShifting none: it keeps its volume without";
        scene.coarseGrid = needed;
        shifting = needs;
        return advice;
    }
};

const AdviceRules::Add<DeepLiquid> registered{"deepLiquid"};

}

}
