#include "stepping/SubStep.H"

#include "motion/Motion.H"
#include "stepping/PressureIterations.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

// Predicts the positions after dt, and lists what lies around them. move: what needs the lists and may have to be done again with
// longer ones.
template<class Move>
void predict(Liquid& liquid, Neighbourhood& near, Walls& walls, const Models& models, scalar dt, const Move& move)
{
    predictPositions(liquid, dt);
    models.freeSurface->forget();
    near.search(liquid, models.freeSurface->support());
    walls.search(liquid);
    move();
    // Asked late: by then the device has enough to do.
    const bool listsCutOff = near.cutOff(), wallsCutOff = walls.cutOff(), surfaceCutOff = models.freeSurface->cutOff();
    if (!listsCutOff && !wallsCutOff && !surfaceCutOff) return;
    predictPositions(liquid, dt);
    near.lengthen(liquid);
    walls.lengthen(liquid);
    move();
    while (models.freeSurface->cutOff())        // longer lists show more of the surface
    {
        predictPositions(liquid, dt);
        move();
    }
}

// The first step makes a velocity of what is left of the way to where the pressure wants the particles, the larger the shorter it is. A round leaves
// two fifths of it, later ones more. One does for steps down to a seventh of the particles' own time, about a third of the capillary step.
int settlingRounds(const Liquid& liquid, scalar dt)
{
    const double own = liquid.units().toScaled(liquid.properties().characteristicTime(), dimensions::time);
    return 1 + std::max(0, int(1.5 * std::log2(own / (7 * dt))));
}

}

void subStep(Liquid& liquid, Neighbourhood& near, Walls& walls, Models& models, scalar dt)
{
    models.bodyForce->apply(liquid, dt);
    predict(liquid, near, walls, models, dt, [&]
    {
        models.freeSurface->search(liquid, near, walls);
        models.forces.applyBeforeIterations(liquid, near, walls, dt);
    });
    liquid.velocity = {};                                   // is computed anew: its memory serves the pressure
    walls.project(liquid);
    iterate(liquid, near, walls, *models.pressure, dt, [&] { models.forces.applyInIteration(liquid, near, walls, dt); });

    updateVelocities(liquid, dt);
    models.pressure->correctVelocities(liquid, near, walls);
    models.netMotion.takeBack
    (
        liquid, models.pressure->takeDisplacement(), models.forces.takeDisplacement(dt), walls,
        models.freeSurface->support(), dt
    );
    models.viscosity->apply(liquid, near, walls, dt);
    models.particleShifting->apply(liquid, near, walls);
}

void settle(Liquid& liquid, Neighbourhood& near, Walls& walls, Models& models, scalar dt)
{
    if (!models.pressure->settles()) return;
    for (int rounds = settlingRounds(liquid, dt); rounds > 0; --rounds)
    {
        predict(liquid, near, walls, models, 0, [&] { models.freeSurface->search(liquid, near, walls); });
        walls.project(liquid);
        iterate(liquid, near, walls, *models.pressure, dt, [] {});
        liquid.position.swap(liquid.predicted);
        models.pressure->forget();
    }
}

}
