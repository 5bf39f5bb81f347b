// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/FlowView.H"

#include "models/density/Density.H"
#include "neighbours/WholeLiquid.H"
#include "surface/CaseSurface.H"

namespace shizuku
{

FlowView::FlowView
(
    const Time& time, Liquid& liquid, const Neighbourhood& near, const Walls& walls, const Models& models
)
:
    time(time), near(near), walls(walls), models(models), liquid_(liquid)
{}

const Liquid& FlowView::liquid()
{
    if (!whole_) computeDensities();
    return seen();
}

const Liquid& FlowView::part()
{
    computeDensities();
    return liquid_;
}

void FlowView::computeDensities()
{
    if (densityIsDue_)
    {
        liquid_.ghosts().copy(liquid_.position);
        computeDensity(liquid_, liquid_.position, near, walls);
    }
    densityIsDue_ = false;
}

void FlowView::cut(std::unique_ptr<Liquid> whole)
{
    whole_ = std::move(whole);
    allParticles_ = liquid_.parts().count(liquid_.owned());
}

void FlowView::recount()
{
    if (allParticles_) allParticles_ = liquid_.parts().count(liquid_.owned());
}

void FlowView::gather()
{
    if (allParticles_) gatherLiquid(liquid_, near, whole_.get());
}

const LiquidState& FlowView::state()
{
    computeDensities();
    if (!state_) state_ = meter_.measure(liquid_);
    return *state_;
}

const std::vector<Vector3>& FlowView::positions()
{
    if (!positions_) positions_ = seen().positions();
    return *positions_;
}

LiquidSurface& FlowView::builtSurface()
{
    if (!mesher_) mesher_.emplace(readSurfaceParameters(time.casePath(), liquid_.spacing()));
    if (surfaceIsDue_) mesher_->build({seen().position.span().data, seen().owned()});
    surfaceIsDue_ = false;
    return *mesher_;
}

const TriangleMesh& FlowView::surface()
{
    if (!surface_) surface_ = toTriangleMesh(builtSurface().download(), liquid_.units().length);
    return *surface_;
}

double FlowView::surfaceVolume()
{
    const double unit = liquid_.units().length;
    return builtSurface().volume() * unit * unit * unit;
}

int FlowView::particlesOutsideSurface()
{
    return builtSurface().particlesOutside();
}

void FlowView::moved(double dt)
{
    dt_ = dt;
    densityIsDue_ = true;
    state_.reset();
    positions_.reset();
    surface_.reset();
    surfaceIsDue_ = true;
}

}
