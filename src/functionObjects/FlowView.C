#include "functionObjects/FlowView.H"

#include "models/density/Density.H"

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
    if (densityIsDue_) computeDensity(liquid_, near, walls);
    densityIsDue_ = false;
    return liquid_;
}

const LiquidState& FlowView::state()
{
    if (!state_) state_ = meter_.measure(liquid());
    return *state_;
}

void FlowView::moved()
{
    densityIsDue_ = true;
    state_.reset();
}

}
