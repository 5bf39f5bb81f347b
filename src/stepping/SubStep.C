#include "stepping/SubStep.H"

#include "motion/Motion.H"

namespace shizuku
{

namespace
{

void moveByForces(Liquid& liquid, Neighbourhood& near, Walls& walls, Models& models, float dt)
{
    models.freeSurface->update(liquid, near, walls);
    models.forces.applyBeforeIterations(liquid, near, walls, dt);
}

}

void subStep(Liquid& liquid, Neighbourhood& near, Walls& walls, Models& models, float dt)
{
    models.bodyForce->apply(liquid, dt);
    predictPositions(liquid, dt);

    near.search(liquid, models.freeSurface->support());
    walls.search(liquid);
    moveByForces(liquid, near, walls, models, dt);
    if (near.cutOff() || walls.cutOff())                    // asked late: by then the device has enough to do
    {
        predictPositions(liquid, dt);
        near.lengthen(liquid);
        walls.lengthen(liquid);
        moveByForces(liquid, near, walls, models, dt);
    }
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
