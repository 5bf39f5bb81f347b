// SPDX-License-Identifier: GPL-3.0-or-later
// Does the start have a fault that is known?
//
// The models get some starts wrong at any spacing and step. No change of the case's dictionaries helps: its surfaces have to change.

#include "advice/Rule.H"

namespace shizuku
{

namespace
{

class KnownFaults : public AdviceRule
{
public:
    std::optional<Advice> advise(Scene& scene) const override
    {
        if (scene.faults.empty()) return std::nullopt;
        std::string all;
        for (const std::string& fault : scene.faults) all += (all.empty() ? "" : "\n    ") + fault;
        return Advice{"known to go wrong, -explain tells how", all, "doc/guide/limits.md"};
    }
};

const AdviceRules::Add<KnownFaults> registered{"knownFaults"};

}

}
