// SPDX-License-Identifier: GPL-3.0-or-later
#include "advice/Rule.H"

namespace shizuku
{

std::vector<Advice> adviseOn(Scene& scene)
{
    std::vector<Advice> result;
    using enum AdviceStage;
    for (const AdviceStage stage : {models, formulation, resolution, step, pressure})
    {
        for (const std::string& word : AdviceRules::words())
        {
            const auto rule = AdviceRules::New("advice", word, {});
            if (rule->stage() != stage) continue;
            auto advice = rule->advise(scene);
            if (!advice) continue;
            advice->rule = word;
            result.push_back(*advice);
        }
    }
    return result;
}

}
