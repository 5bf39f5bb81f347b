// SPDX-License-Identifier: GPL-3.0-or-later
// Does the answer need the liquid's viscosity, and does the model give it?
//
//     effect = 1 - exp(-5 nu t/R^2)
//
// what the viscosity takes of the amplitude of a drop's slowest mode in the time t of the run (Lamb 1881;
// src/reference/DropOscillation.H), R the radius of the smallest body. XSPH damps with
//
//     nu_XSPH = c s^2/(2 dt),    s^2 = 3/40 h^2
//
// instead (doc/notebook/theory/viscosity.md), whatever the liquid's nu is; where that changes the answer newtonian is the better one.

#include "advice/Rule.H"
#include "reference/DropOscillation.H"

#include <cmath>

namespace shizuku
{

namespace
{

class Viscosity : public AdviceRule
{
    // What takes the particles' noise in place of XSPH, and takes no swing with it.
    static void calm(const Scene& scene, Advice& advice)
    {
        if (!scene.hasTension()) return;
        if (scene.models.at("surfaceTension") == "laplacePressure")
        {
            advice.changes.push_back({"constant/models", "laplacePressureCoeffs/curvatureAt", "start"});
        }
        if (scene.models.at("pressure") == "completedPbf") advice.changes.push_back({"system/solution", "pressure/orderRemoved", "1"});
    }

public:
    std::optional<Advice> advise(Scene& scene) const override
    {
        const double R = 0.5*scene.smallest().liquid.diameter();
        const auto lost = [&](double nu) { return 1 - std::exp(-dropDamping(2, nu, R)*scene.duration); };
        const double nu = scene.viscosity, effect = lost(nu);
        const double smoothing = scene.modelViscosity(), smoothed = lost(smoothing);     // where XSPH is the model
        Advice advice
        {
            "keep", "viscosity takes " + percent(effect) + " of a swing in the time of the run (5 nu t/R^2 = " +
            number(dropDamping(2, nu, R)*scene.duration) + ")",
            "Lamb 1881; src/advice/rules/Viscosity.C"
        };
        const std::string model = scene.models.at("viscosity");
        const bool isXSPH = model == "XSPH";
        if (isXSPH)
        {
            advice.reason += "; XSPH takes " + percent(smoothed) + " (nu_XSPH = " + number(smoothing) + " m2/s)";
            advice.source += ", doc/notebook/theory/viscosity.md";
        }
        std::string better = model;
        const bool own = model == "laminar" || model == "newtonian";
        if (effect <= scene.tolerance && (own || (isXSPH && smoothed <= scene.tolerance)))
        {
            better = "none";
            advice.verdict = "leave out";
        }
        else if (model == "none" && effect > scene.tolerance)
        {
            better = "newtonian";
            advice.verdict = "switch on: the scene needs it";
        }
        else if (isXSPH && std::abs(smoothed - effect) > scene.tolerance)
        {
            better = "newtonian";
            advice.verdict = smoothed > effect ? "take newtonian: XSPH damps more than the liquid does" : "take newtonian: the liquid is thicker than XSPH makes it";
        }
        if (better != model) advice.changes = {{"constant/models", "viscosity", better}};
        if (better == "newtonian" && model != better) calm(scene, advice);
        scene.models["viscosity"] = better;
        return advice;
    }
};

const AdviceRules::Add<Viscosity> registered{"viscosity"};

}

}
