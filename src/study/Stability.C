// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/Stability.H"

#include <cmath>

namespace shizuku
{

namespace
{

bool holds(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

Stability ofReason(const std::string& reason)
{
    if (holds(reason, "not a finite number")) return Stability::notANumber;
    if (holds(reason, "particle spacings in one step") || holds(reason, "sub-steps (Courant limit)")) return Stability::exploded;
    return holds(reason, "ended by signal") || holds(reason, "the limit of its time") ? Stability::died : Stability::refused;
}

}

std::string nameOf(Stability stability)
{
    switch (stability)
    {
        case Stability::notANumber: return "notANumber";
        case Stability::exploded: return "exploded";
        case Stability::refused: return "refused";
        case Stability::died: return "died";
        case Stability::leaked: return "leaked";
        case Stability::volumeLost: return "volumeLost";
        case Stability::clustered: return "clustered";
        case Stability::frozen: return "frozen";
        case Stability::wrong: return "wrong";
        case Stability::noisy: return "noisy";
        default: return "calm";
    }
}

const std::vector<Stability>& allStabilities()
{
    static const std::vector<Stability> all
    {
        Stability::notANumber, Stability::exploded, Stability::refused, Stability::died, Stability::leaked,
        Stability::clustered, Stability::volumeLost, Stability::frozen, Stability::wrong, Stability::noisy, Stability::calm
    };
    return all;
}

StabilityLimits StabilityLimits::read(const Dictionary& dict)
{
    StabilityLimits limits;
    const auto take = [&](double& limit, const char* name)
    {
        if (dict.found(name)) limit = dict.lookupPositive(name, dimensions::none);
    };
    take(limits.explodedSpeed, "explodedSpeed");
    take(limits.strayShare, "strayShare");
    take(limits.leakedShare, "leakedShare");
    take(limits.volumeLoss, "volumeLoss");
    take(limits.clusteredDistance, "clusteredDistance");
    take(limits.frozenPart, "frozenPart");
    take(limits.noisySpeed, "noisySpeed");
    return limits;
}

Stability classify(const StabilityEvidence& e, const StabilityLimits& limits)
{
    if (!e.finished) return ofReason(e.reason);
    if (e.nonFinite > 0) return Stability::notANumber;
    if (e.speed > limits.explodedSpeed || e.stray > limits.strayShare) return Stability::exploded;
    if (e.behindWalls > limits.leakedShare) return Stability::leaked;
    if (e.nearest < limits.clusteredDistance) return Stability::clustered;
    if (std::abs(e.volumeChange) > limits.volumeLoss) return Stability::volumeLost;
    if (!std::isnan(e.within) && !(std::abs(e.measured - e.reference) <= e.within))
    {
        const double part = (e.measured - e.start)/(e.reference - e.start);
        return part < limits.frozenPart ? Stability::frozen : Stability::wrong;
    }
    return e.speed > limits.noisySpeed ? Stability::noisy : Stability::calm;
}

}
