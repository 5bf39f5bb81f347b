// SPDX-License-Identifier: GPL-3.0-or-later
#include "Divergence.H"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace shizuku
{

namespace
{

struct Suspect
{
    std::uint32_t id = 0;
    double speed = -1;                  // m/s
    Vector3 place;                      // m
};

double orEndless(double value) { return std::isfinite(value) ? value : std::numeric_limits<double>::infinity(); }

// The fastest particle, or one whose velocity is no number.
Suspect suspectOf(const Liquid& liquid)
{
    Suspect worst;
    const double unit = liquid.units().of(dimensions::velocity);
    const auto velocity = liquid.velocity.download();
    const auto id = liquid.id.download();
    const auto places = liquid.positions();
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        const double speed = orEndless(unit*std::sqrt(double(squared(velocity[i]))));
        if (speed > worst.speed) worst = {id[i], speed, places[i]};
    }
    const auto all = liquid.parts().gather(worst);
    return *std::max_element(all.begin(), all.end(), [](const Suspect& a, const Suspect& b) { return a.speed < b.speed; });
}

// Longer steps than the defaults would make are what diverges most often.
std::string advice(const SubSteps& steps, const Time& time, const CaseSetup& setup)
{
    const StepControl usual{Dictionary()};
    std::vector<StepLimit> limits = usual.limits(time.deltaT(), 0, *setup.liquid, *setup.models);
    // Courant's follows deltaT by the weight.
    if (limits.size() > 1) std::erase_if(limits, [](const StepLimit& limit) { return limit.name == "Courant"; });
    const auto shortest = std::min_element(limits.begin(), limits.end(), [](const StepLimit& a, const StepLimit& b) { return a.dt < b.dt; });
    std::ostringstream text;
    if (shortest != limits.end() && steps.dt > 1.01*shortest->dt)
    {
        text << "\n    Steps of " << steps.dt << " s are " << steps.dt/shortest->dt << " times as long as the " << shortest->name << " limit, "
             << shortest->dt << " s.\n    Set adjustTimeStep yes, and maxCo and maxCapillaryCo to their defaults, in system/controlDict.";
    }
    else
    {
        text << "\n    Steps of " << steps.dt << " s are within their limits: look at the liquid and the walls around that place in the last good "
                "state.\n    Edges and gaps narrower than two spacings, or liquid that overlaps, want a smaller spacing; else try a smaller "
                "deltaT, maxCo or maxCapillaryCo in system/controlDict, or more iterations in system/solution.";
    }
    return text.str();
}

// Ends what is being written, in all parts, and throws.
[[noreturn]] void end(const std::string& what, const std::string& advice, const Time& time, const Liquid& liquid, CaseWriter& writer)
{
    const Suspect suspect = suspectOf(liquid);
    writer.finish();
    liquid.parts().any(true);           // part 0 has finished as well
    std::ostringstream text;
    text << what << "\n    The fastest is particle " << suspect.id << ", at " << str(suspect.place) << " m." << advice
         << "\n    The last good state is kept in " << time.lastWritten().string() << ".";
    throw FatalError(text.str());
}

}

void refuseDivergence(const Time& time, const SubSteps& steps, const TimeStep& step, const CaseSetup& setup, CaseWriter& writer)
{
    constexpr double mostSpacings = 10;
    const Speeds& speeds = step.speeds();
    const double moved = speeds.most * steps.dt / setup.liquid->properties().spacing;
    if (speeds.nonFinite == 0 && moved <= mostSpacings) return;

    std::ostringstream text;
    text << "The run diverged at time " << time.name() << " s: ";
    if (speeds.nonFinite > 0) text << "the position or velocity of " << speeds.nonFinite << " particles is not a finite number.";
    else
    {
        text << "a particle moves at " << speeds.most << " m/s, by " << moved << " particle spacings in one step of " << steps.dt << " s.";
    }
    end(text.str(), advice(steps, time, setup), time, *setup.liquid, writer);
}

SubSteps divideOrRefuse(const Time& time, const TimeStep& step, const CaseSetup& setup, CaseWriter& writer)
{
    try
    {
        return step.divide();
    }
    catch (const FatalError& error)
    {
        end(error.what(), "", time, *setup.liquid, writer);
    }
}

}
