// SPDX-License-Identifier: GPL-3.0-or-later
#include "SharedRun.H"

#include "device/Sharing.H"
#include "motion/Motion.H"

#include <iostream>

namespace shizuku
{

SharedRun::SharedRun(const Communicator& parts, CaseSetup& setup)
    : parts_(parts), setup_(setup), controls_(BalanceControls::read(setup.path)), balance_(controls_)
{
    if (!isCut()) return;
    setup.models->refuseGhostBlind(*setup.liquid, "The liquid cannot be cut into parts");
    setup.liquid->ghosts().join(parts);
}

void SharedRun::cut(Neighbourhood& near)
{
    Liquid& liquid = *setup_.liquid;
    if (isCut()) balance_.begin(liquid, near);
    cutWalls(near);
    const Images* images = liquid.ghosts().images();
    if (!images) return;
    std::cout << "Sides  : " << images->sides().description() << std::endl;
    predictPositions(liquid, 0);
    near.search(liquid, 0);
}

void SharedRun::showWhole(FlowView& flow) const
{
    if (isCut()) flow.cut(isFirst() ? setup_.emptyLiquid() : nullptr, controls_.sameBits);
    if (controls_.sameBits) shareAsOf(flow.particles());
}

void SharedRun::lockCase()
{
    if (isFirst()) lock_.emplace(setup_.path);
}

void SharedRun::keepBalance(Neighbourhood& near)
{
    balance_.keep(*setup_.liquid, near);
    cutWalls(near);
}

void SharedRun::cutWalls(const Neighbourhood& near)
{
    if (isCut() && !controls_.sameBits) setup_.walls->cut(balance_.cut().rowsOf(parts_.part()), near.grid().view());
}

void SharedRun::gather(FlowView& flow, FunctionObjects& functions, const Time& time, bool densities) const
{
    if (isCut() && densities) flow.state();
    if (functions.lookAtParticles(time)) flow.gather();
    if (functions.lookAtSurface(time)) flow.gatherSurface(functions.lookAtWholeSurface(time));
}

}
