#include "stepping/SubStep.H"

#include "motion/Motion.H"

namespace shizuku
{

void subStep(Liquid& liquid, Neighbourhood& near, Walls& walls, Models& models, float dt)
{
    models.bodyForce->apply(liquid, dt);
    predictPositions(liquid, dt);

    near.update(liquid, models.freeSurface->support());
    walls.update(liquid);
    models.freeSurface->update(liquid, near, walls);
    models.forces.applyBeforeIterations(liquid, near, walls, dt);
    walls.project(liquid);

    models.pressure->begin(dt);
    while (models.pressure->violated(liquid, near, walls))
    {
        models.forces.applyInIteration(liquid, near, walls, dt);
        models.pressure->correct(liquid, near, walls);
        if (!models.pressure->stopsAtWalls()) walls.project(liquid);
    }

    updateVelocities(liquid, dt);
    models.pressure->correctVelocities(liquid, near, walls);
    models.netMotion.takeBack
    (
        liquid, models.pressure->takeDisplacement(), models.forces.takeDisplacement(dt), walls,
        models.freeSurface->support(), dt
    );
    models.viscosity->apply(liquid, near, walls, dt);
}

}
