// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/forces/InterParticleForces.H"

#include "motion/Motion.H"

#include <cmath>

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
    // Iterations move particles on, which are looked for in the cells of the search: of these some are seen that were a cell's diagonal farther.
    if (everyIteration_ && reach_ > 0) reach_ += 1.5f * liquid.support();
}

void InterParticleForces::applyBeforeIterations(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt)
{
    if (!everyIteration_) apply(liquid, near, walls, dt);
}

bool InterParticleForces::applyInIteration(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt)
{
    if (left_ > 0)
    {
        moveOn(liquid, dt, 1);
        return true;
    }
    if (!readInIteration()) return false;
    apply(liquid, near, walls, dt);
    return true;
}

void InterParticleForces::finish(Liquid& liquid, scalar dt)
{
    if (left_ > 0) moveOn(liquid, dt, left_);
    if (!isKept_) acceleration_ = {};
}

void InterParticleForces::moveOn(Liquid& liquid, scalar dt, int parts)
{
    displace(liquid, acceleration_, std::sqrt(scalar(parts) / scalar(parts_)) * dt);
    left_ -= parts;
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
    parts_ = tension_->parts(dt);
    left_ = 0;
    const GhostsHave have = everyIteration_ ? GhostsHave::valuesOfIteration : GhostsHave::valuesOfSearch;
    tension_->declareReads(liquid, have);
    if (parts_ == 1 && !wetting_->accelerates() && walls.constraints().all() && tension_->move(liquid, near, walls, dt)) return;
    acceleration_.resizeDiscarding(liquid.all());
    acceleration_.setZero();
    tension_->apply(liquid, near, walls, acceleration_);
    wetting_->declareReads(liquid, have);
    wetting_->apply(liquid, near, walls, acceleration_);
    left_ = parts_;
    moveOn(liquid, dt, 1);
    isKept_ = !everyIteration_ && tension_->isInternal() && !walls.constraints().all();
    if (!isKept_ && left_ == 0) acceleration_ = {};
}

}
