// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a case as the solver does, and says everything that is wrong with it and what it would cost; writes nothing.

#include "Findings.H"
#include "LiquidReport.H"
#include "SolidReport.H"
#include "SolvedCase.H"
#include "core/arguments/runApplication.H"
#include "device/DeviceApplication.H"
#include "drops/SuspectNumbers.H"
#include "functionObjects/ModelList.H"
#include "motion/SpeedMeter.H"
#include "stepping/DryRun.H"

#include <iostream>

namespace shizuku
{

namespace
{

void reportSteps(SolvedCase& solved, const DeviceInfo& device, Findings& findings)
{
    const double speed = SpeedMeter().measure(*solved.liquid).now;
    const StepControl control(solved.time->controlDict());
    std::cout << "Time: from " << solved.time->value() << " to " << solved.time->endTime() << " s, deltaT "
              << solved.time->deltaT() << " s; limits of a sub-step:";
    for (const StepLimit& limit : control.limits(solved.time->deltaT(), speed, *solved.liquid, *solved.models))
    {
        std::cout << " " << limit.name << " " << limit.dt << " s";
    }
    std::cout << std::endl;
    findings.attempt([&]
    {
        Neighbourhood near(*solved.liquid);
        reportDryRun(*solved.time, control, *solved.liquid, near, *solved.walls, *solved.models, device, speed);
    });
}

void checkCase(const Arguments& args)
{
    const DeviceInfo device = openNamedDevice();

    Findings findings;
    SolvedCase solved(args.casePath(), findings);
    for (const Suspect& suspect : suspectEntries(solved.path)) findings.warn(suspect.text);
    if (solved.liquid && solved.liquid->owned() > 0)
    {
        reportLiquid(solved.path, *solved.liquid, solved.models.get(), findings);
    }
    if (solved.walls)
    {
        std::cout << "Walls: solid particles " << solved.walls->particles() << ", analytic surfaces "
                  << solved.walls->surfaces() << "\n";
        if (solved.walls->particles() > 0)
        {
            findings.attempt([&] { reportSolid(solved.path, solved.liquid->properties().spacing, findings); });
        }
    }
    if (solved.complete()) reportSteps(solved, device, findings);

    if (findings.errors() > 0)
    {
        const std::string plural = findings.errors() > 1 ? " checks" : " check";
        throw FatalError("Failed " + std::to_string(findings.errors()) + plural);
    }
    std::cout << "\nCase OK" << std::endl;
}

}

}

extern "C" int runOnDevice(int argc, char** argv)
{
    using namespace shizuku;
    return runApplication
    (
        argc, argv,
        {
            .name = "checkCase",
            .summary = "Read a case as the solver does. Print errors, resolution, dimensionless numbers, memory and time step.",
            .options = {deviceOption(), precisionOption()},
            .models = modelList
        },
        checkCase
    );
}
