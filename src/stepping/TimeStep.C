// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/TimeStep.H"

#include <algorithm>

namespace shizuku
{

namespace
{

constexpr double unknown = -1;

}

TimeStep::TimeStep(const Time& time, CaseSetup& setup, Neighbourhood& near)
:
    time_(time), setup_(setup), near_(near), mostCapillaryCo_(setup.liquid->number("mostCapillaryCo", unknown)), control_(time.controlDict()),
    subStep_(*setup.liquid, near, *setup.walls, *setup.models), speeds_(meter_.measure(*setup.liquid))
{
    readControls();
    if (setup.population && setup.population->mayComeIn()) subStep_.hold(setup.population->held());
}

void TimeStep::readControls()
{
    control_ = StepControl(time_.controlDict());
    if (const std::optional<double> most = mostCapillaryCo()) control_.capCapillary(*most);
}

void TimeStep::limitCapillaryCo(double most)
{
    mostCapillaryCo_ = most;
    readControls();
}

std::optional<double> TimeStep::mostCapillaryCo() const
{
    return mostCapillaryCo_ == unknown ? std::nullopt : std::optional(mostCapillaryCo_);
}

void TimeStep::settle()
{
    shizuku::settle(*setup_.liquid, near_, *setup_.walls, *setup_.models, scaled(divide()));
}

SubSteps TimeStep::divide() const
{
    const double ofWalls = setup_.walls->speed(*setup_.liquid, time_.value(), time_.value() + time_.deltaT());
    return control_.divide(time_.deltaT(), std::max(speeds_.now, ofWalls), *setup_.liquid, *setup_.models);
}

void TimeStep::make(const SubSteps& steps, double from)
{
    for (int step = 1; step <= steps.count; ++step)
    {
        subStep_(scaled(steps), from + (step - 1) * steps.dt);
        if (step < steps.count) meter_.watch(*setup_.liquid);
    }
}

void TimeStep::prepareNext(const SubSteps& steps)
{
    meter_.ask(*setup_.liquid);
    subStep_.prepare(scaled(steps), time_.value());
    speeds_ = meter_.take(*setup_.liquid);
}

}
