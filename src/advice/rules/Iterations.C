// SPDX-License-Identifier: GPL-3.0-or-later
// How many pressure iterations a sub-step does a drop at rest need?
//
// pressure/maxIterations: the fewest from which on the stored study (doc/studies/iterations-runs.csv, sessile drops) has
// the angle and the volume within the tolerance. The study is of corrections of 0.3 (pressure/relaxation). Of liquid that
// moves fast nothing is stored: from We = 0.1 on it is left as it is.

#include "advice/Rule.H"

#include <algorithm>

namespace shizuku
{

namespace
{

constexpr double fastest = 0.1;             // We
constexpr double relaxationOfStudy = 0.3;

class Iterations : public AdviceRule
{
public:
    AdviceStage stage() const override { return AdviceStage::step; }

    std::optional<Advice> advise(Scene& scene) const override
    {
        const auto set = scene.modelSet();
        const SceneAnswer answer = scene.answer();
        const bool fast = std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const SceneBody& body)
        {
            return flowNumbers(scene.scales(body)).weber > fastest;
        });
        const bool studied = set && set->name == "default" && answer.scene == "sessile" && !fast && scene.relaxation == relaxationOfStudy;
        if (!studied) return std::nullopt;

        const double n = scene.particles(scene.smallest());
        std::vector<double> tried = scene.studies->iterations(answer.scene);
        std::optional<StoredNumber> ofAnswer, ofVolume;
        double best = 0;
        for (auto most = tried.rbegin(); most != tried.rend(); ++most)
        {
            const auto angle = scene.studies->errorOfIterations(answer.scene, answer.parameter, n, *most);
            const auto volume = scene.studies->errorOfIterations("volume", 0, n, *most);
            if (!angle || !volume || std::max(angle->value, volume->value) > scene.tolerance) break;
            best = *most;
            ofAnswer = angle;
            ofVolume = volume;
        }
        if (best == 0)
        {
            return Advice
            {
                "keep", "no stored study tells of drops of " + wholeNumber(n) + " particles within the tolerance",
                "doc/studies/iterations-runs.csv"
            };
        }
        Advice advice
        {
            "keep", "with at most " + wholeNumber(best) + " iterations: error " + percent(ofAnswer->value) + ", volume lost " +
            percent(ofVolume->value), ofAnswer->source + ", " + ofVolume->source
        };
        if (int(best) == scene.maxIterations) return advice;
        advice.verdict = "maxIterations " + std::to_string(scene.maxIterations) + " to " + wholeNumber(best);
        advice.changes = {{"system/solution", "pressure/maxIterations", wholeNumber(best)}};
        scene.maxIterations = int(best);
        return advice;
    }
};

const AdviceRules::Add<Iterations> registered{"iterations"};

}

}
