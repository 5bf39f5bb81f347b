// SPDX-License-Identifier: GPL-3.0-or-later
// Which pressure, tension and wetting does this scene need?
//
// The default's, unless the stored studies have a smaller error for the case's own model set at the same resolution.

#include "advice/Rule.H"

namespace shizuku
{

namespace
{

class Formulation : public AdviceRule
{
public:
    AdviceStage stage() const override { return AdviceStage::formulation; }

    std::optional<Advice> advise(Scene& scene) const override
    {
        const auto own = scene.modelSet();
        const SceneAnswer answer = scene.answer();
        const ModelSet& standard = scene.studies->standard();
        if (!scene.hasTension() || answer.scene.empty()) return std::nullopt;
        if (own && own->name == standard.name) return std::nullopt;
        const auto error = [&](const ModelSet& set)
        {
            return scene.studies->error
            (
                answer.scene, answer.parameter, set.name, scene.particles(scene.smallest()), set.maxCapillaryCo
            );
        };
        const auto best = error(standard), present = own ? error(*own) : std::nullopt;
        if (!best) return std::nullopt;
        Advice advice
        {
            "keep", "error of the " + answer.text + ": the default " + percent(best->value) + ", the case's models " +
            (present ? percent(present->value) : "in no stored study"),
            best->source + (present && present->source != best->source ? ", " + present->source : "")
        };
        if (present && present->value <= best->value) return advice;
        advice.verdict = "take the default's models";
        const std::vector<std::pair<std::string, std::string>> models
        {
            {"pressure", standard.pressure}, {"surfaceTension", standard.surfaceTension}, {"wetting", standard.wetting}
        };
        for (const auto& [kind, model] : models)
        {
            if (scene.models[kind] == model || scene.models[kind] == "none") continue;
            advice.changes.push_back({"constant/models", kind, model});
            scene.models[kind] = model;
        }
        return advice;
    }
};

const AdviceRules::Add<Formulation> registered{"formulation"};

}

}
