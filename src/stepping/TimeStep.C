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
    time_(time), setup_(setup), near_(near), mostCapillaryCo_(setup.liquid->number("mostCapillaryCo", unknown)),
    capillaryCo_(setup.liquid->number("capillaryCo", 0)), control_(time.controlDict()),
    subStep_(*setup.liquid, near, *setup.walls, *setup.models), speeds_(meter_.measure(*setup.liquid))
{
    applyControls();
    if (setup.body)
    {
        countWallReactions();
        setup.body->begin(*setup.liquid);
    }
    if (setup.population && setup.population->mayComeIn()) subStep_.hold(setup.population->held());
}

void TimeStep::readControls()
{
    applyControls();
    if (sleep_) sleep_->end();
}

void TimeStep::applyControls()
{
    const Dictionary& dict = time_.controlDict();
    control_ = StepControl(dict);
    if (const std::optional<double> most = mostCapillaryCo()) control_.capCapillary(*most);
    control_.setCapillaryCo(capillaryCo_);
    const bool mayCome = setup_.population && setup_.population->mayComeIn();
    sleep_.reset();
    if (dict.found("sleep") && !mayCome) sleep_.emplace(dict, *setup_.liquid);
}

void TimeStep::dropPrepared()
{
    subStep_.dropPrepared();
    if (sleep_) sleep_->end();
}

void TimeStep::countViscousWork()
{
    subStep_.count(work_.emplace());
}

void TimeStep::countWallReactions()
{
    if (!reactions_) subStep_.count(reactions_.emplace(setup_.path, *setup_.liquid, *setup_.walls));
}

void TimeStep::limitCapillaryCo(double most)
{
    mostCapillaryCo_ = most;
    applyControls();
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
    const double ofWalls = speedOfWalls(time_.value(), time_.value() + time_.deltaT());
    if (sleep_ && sleep_->hasCome() && ofWalls == 0) return {0, time_.deltaT(), "sleep"};
    return control_.divide(time_.deltaT(), std::max(speeds_.now, ofWalls), *setup_.liquid, *setup_.models);
}

double TimeStep::speedOfWalls(double from, double to) const
{
    return setup_.walls->speed(*setup_.liquid, from, to);
}

void TimeStep::make(const SubSteps& steps, double from)
{
    for (int step = 1; step <= steps.count; ++step)
    {
        subStep_(scaled(steps), from + (step - 1) * steps.dt);
        if (setup_.body)
        {
            reactions_->addTo(*setup_.liquid);
            setup_.body->follow(*setup_.liquid, *setup_.walls, *setup_.models, from + step * steps.dt, steps.dt);
        }
        if (step < steps.count) meter_.watch(*setup_.liquid);
    }
    if (steps.count == 0) return;
    if (work_) work_->addTo(*setup_.liquid);
    if (reactions_) reactions_->addTo(*setup_.liquid);
    if (sleep_) sleep_->look(*setup_.liquid, time_.value() - from, speedOfWalls(from, time_.value()) > 0);
}

void TimeStep::prepareNext(const SubSteps& steps)
{
    if (steps.count == 0) return;
    meter_.ask(*setup_.liquid);
    subStep_.prepare(scaled(steps), time_.value());
    speeds_ = meter_.take(*setup_.liquid);
    capillaryCo_ = control_.follow(capillaryCo_, speeds_.now, setup_.liquid->properties());
    control_.setCapillaryCo(capillaryCo_);
}

}
