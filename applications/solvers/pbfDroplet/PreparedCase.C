// SPDX-License-Identifier: GPL-3.0-or-later
#include "PreparedCase.H"

#include "StepReport.H"

namespace shizuku
{

namespace
{

CaseSetup& made(CaseSetup& setup, const Time& time)
{
    setup.make(time.value());
    return setup;
}

}

PreparedCase::PreparedCase(const std::filesystem::path& casePath, const Communicator& parts, bool withFunctionObjects)
:
    time(casePath, parts.part() == 0), changes(time), setup(casePath), run(parts, made(setup, time)),
    functions(time, setup.liquid->properties().spacing, withFunctionObjects), near(*setup.liquid),
    flow(time, *setup.liquid, near, *setup.walls, *setup.models)
{
    setup.readParticles(time);
    run.cut(near);
    run.showWhole(flow);
    setup.refuseBadStart(time);
    reportRelaxation(setup.relaxOverlap(time, near));
    functions.modelsMade(flow);
}

}
