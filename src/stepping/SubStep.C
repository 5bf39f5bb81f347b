// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/SubStep.H"

#include "device/HostBuffer.H"
#include "motion/Motion.H"
#include "stepping/PressureIterations.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

// Neighbours and walls around the predicted positions. Lists that find no room are cut off, which is asked for later.
void listNeighbours(Liquid& liquid, Neighbourhood& near, Walls& walls, const Models& models)
{
    models.freeSurface->dropParticles();
    near.search(liquid, models.freeSurface->support(), models.forces.reach());
    walls.search(liquid);
}

// Where something was cut off, longer lists, and once more what needs them: `predict` the positions and `move` them. Called late: the
// device shall have enough to do until the host has looked.
template<class Predict, class Move>
void lengthenLists(Liquid& liquid, Neighbourhood& near, Walls& walls, const Models& models, const Predict& predict, const Move& move)
{
    const bool listsCutOff = near.cutOff(), wallsCutOff = walls.cutOff(), surfaceCutOff = models.freeSurface->cutOff();
    if (!liquid.parts().any(listsCutOff || wallsCutOff || surfaceCutOff)) return;
    predict();
    near.lengthen(liquid);
    walls.lengthen(liquid);
    move();
    while (liquid.parts().any(models.freeSurface->cutOff()))        // longer lists show more of the surface
    {
        predict();
        move();
    }
}

// The verb of a model that changes what a step has made, with the ghosts that it declares to need, and its end.
template<class Kind, class... More>
void applyOnce(Kind& model, Liquid& liquid, const Neighbourhood& near, const Walls& walls, More... more)
{
    model.declareReads(liquid, GhostsHave::nothing);
    model.apply(liquid, near, walls, more...);
    liquid.ghosts().dropDeclared();
    model.commit();
}

// The first step makes a velocity of what is left of the way to where the pressure wants the particles, the larger the shorter it is. A round leaves
// two fifths of it, later ones more. One does for steps down to a seventh of the particles' own time, about a third of the capillary step.
int settlingRounds(const Liquid& liquid, scalar dt)
{
    const double own = liquid.units().toScaled(liquid.properties().characteristicTime(), dimensions::time);
    return 1 + std::max(0, int(1.5 * std::log2(own / (7 * dt))));
}

}

void SubStep::operator()(scalar dt, double from)
{
    if (prepared_ != Prepared{dt, from}) prepare(dt, from);
    prepared_.reset();
    if (held_) held_->begin(liquid_);
    lengthenLists(liquid_, near_, walls_, models_, [&] { predict(dt); }, [&] { force(dt); });
    if (reactions_) reactions_->begin(liquid_, walls_, models_, dt);
    constrain(dt);
    update(dt);
}

void SubStep::prepare(scalar dt, double from)
{
    walls_.moveTo(from, from + liquid_.units().toSI(dt, dimensions::time));
    predict(dt);
    search();
    force(dt);
    prepared_ = Prepared{dt, from};
}

void SubStep::predict(scalar dt)
{
    models_.bodyForce->predict(liquid_, dt);
}

void SubStep::search()
{
    listNeighbours(liquid_, near_, walls_, models_);
    models_.velocityCorrection->notePrediction(liquid_);
}

void SubStep::force(scalar dt)
{
    models_.freeSurface->search(liquid_, near_, walls_);
    models_.forces.applyBeforeIterations(liquid_, near_, walls_, dt);
    liquid_.ghosts().dropDeclared();
}

void SubStep::constrain(scalar dt)
{
    if (!isBorne()) models_.rigidMotion.begin(liquid_, walls_, dt);
    dropVelocities(liquid_);
    models_.freeSurface->dropPositions();
    walls_.project(liquid_);
    models_.pressure->requireIterations(models_.forces.partsInIterations());
    iterate(liquid_, near_, walls_, *models_.pressure, dt, [&]
    {
        if (models_.forces.readInIteration()) liquid_.ghosts().copy({placesOf(liquid_.predicted)});
        const bool moved = models_.forces.applyInIteration(liquid_, near_, walls_, dt);
        liquid_.ghosts().dropDeclared();
        return moved;
    });
    models_.forces.finish(liquid_, dt);
}

void SubStep::update(scalar dt)
{
    updateVelocities(liquid_, dt);
    models_.pressure->correctVelocities(liquid_, near_, walls_);
    if (!isBorne())
    {
        models_.rigidMotion.remove
        (
            liquid_, models_.pressure->displacement(), models_.forces.displacement(dt), walls_, models_.freeSurface->support(), dt
        );
    }
    models_.pressure->commit();
    models_.forces.commit();
    if (reactions_) reactions_->pressed(liquid_);
    applyOnce(*models_.velocityCorrection, liquid_, near_, walls_, dt);
    if (work_) work_->before(liquid_);
    applyOnce(*models_.viscosity, liquid_, near_, walls_, dt);
    if (work_) work_->behind(liquid_, models_.viscosity->dissipation(liquid_, near_, walls_, dt));
    applyOnce(*models_.particleShifting, liquid_, near_, walls_);
    if (reactions_) reactions_->end(liquid_, walls_, models_, dt);
    if (models_.heldLine) models_.heldLine->advance(liquid_, near_, walls_, *models_.freeSurface, dt);
    if (held_) held_->end(liquid_, dt);
}

void settle(Liquid& liquid, Neighbourhood& near, Walls& walls, Models& models, scalar dt)
{
    if (!models.pressure->settles()) return;
    HostBuffer<Vec3> velocities;                        // their memory on the device is the pressure's, as in a step
    for (int rounds = settlingRounds(liquid, dt); rounds > 0; --rounds)
    {
        const auto predict = [&] { predictPositions(liquid, 0); };
        const auto findSurface = [&] { models.freeSurface->search(liquid, near, walls); };
        predict();
        listNeighbours(liquid, near, walls, models);
        findSurface();
        lengthenLists(liquid, near, walls, models, predict, findSurface);
        models.freeSurface->dropPositions();
        const int kept = liquid.velocity.size();
        velocities.resizeDiscarding(kept);
        liquid.velocity.download(velocities.data(), kept);
        dropVelocities(liquid);
        walls.project(liquid);
        iterate(liquid, near, walls, *models.pressure, dt, [] { return false; });
        takePredicted(liquid);
        models.pressure->forget();
        liquid.velocity.upload(velocities.data(), kept);
    }
}

}
