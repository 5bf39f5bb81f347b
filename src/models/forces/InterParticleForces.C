// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/forces/InterParticleForces.H"

#include "motion/Motion.H"

namespace shizuku
{

InterParticleForces::InterParticleForces(const Dictionary& models, Liquid& liquid, const Walls& walls, FreeSurface& surface)
:
    everyIteration_
    (
        models.lookupChoiceOr("forceCoupling", {"predictor", "everyIteration"}, "predictor") == "everyIteration"
    ),
    tension_(SurfaceTension::New(models, liquid, walls, surface)),
    wetting_(Wetting::New(models, liquid, walls, *tension_)),
    reach_(wetting_->reach())
{
    if (everyIteration_ && tension_->freeSurface())
    {
        throw FatalInputError
        (
            models.where("forceCoupling"), "A tension of the free surface acts once a step, where the surface was found", "predictor, or a tension by forces of pairs"
        );
    }
    if (tension_->freeSurface()) semiImplicit_.emplace(liquid);
    // Iterations move particles on, which are looked for in the cells of the search: of these some are seen that were a cell's diagonal farther.
    if (everyIteration_ && reach_ > 0) reach_ += 1.5f * liquid.support();
}

void InterParticleForces::applyBeforeIterations(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt)
{
    if (!everyIteration_) apply(liquid, near, walls, dt);
}

bool InterParticleForces::applyInIteration(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt)
{
    if (!actInIterations()) return false;
    liquid.ghosts().copy(liquid.predicted);
    apply(liquid, near, walls, dt);
    return true;
}

InternalDisplacement InterParticleForces::displacement(scalar dt) const
{
    if (!isKept_) return {};
    return {acceleration_.span(), dt * dt};
}

void InterParticleForces::commit()
{
    acceleration_ = {};
    isKept_ = false;
    tension_->commit();
    wetting_->commit();
}

void InterParticleForces::apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt)
{
    isKept_ = false;
    if (!active()) return;
    tension_->setStep(dt);
    if (!wetting_->accelerates() && walls.constraints().all() && tension_->move(liquid, near, walls, dt)) return;
    acceleration_.resizeDiscarding(liquid.all());
    acceleration_.setZero();
    tension_->apply(liquid, near, walls, acceleration_);
    wetting_->apply(liquid, near, walls, acceleration_);
    const bool isLong = semiImplicit_ && semiImplicit_->isNeeded(dt) && walls.constraints().none();
    if (isLong) semiImplicit_->apply(liquid, near, *tension_->freeSurface(), dt, acceleration_);
    displace(liquid, acceleration_, dt);
    isKept_ = !everyIteration_ && tension_->isInternal() && !walls.constraints().all();
    if (!isKept_) acceleration_ = {};
}

}
