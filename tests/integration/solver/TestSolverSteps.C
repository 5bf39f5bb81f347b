// SPDX-License-Identifier: GPL-3.0-or-later
// Sub-steps and their limits, controlDict changed while the solver runs, and the options of the command line.

#include "SolverCase.H"

#include "caseFiles/SolidParticles.H"
#include "core/fieldFile/CsvTable.H"
#include "core/fieldFile/FieldFile.H"
#include "support/Surfaces.H"

#include <cmath>
#include <numbers>

namespace shizuku::test
{

namespace
{

class Steps : public SolverCase
{
protected:
    std::vector<LoggedStep> solvedSteps() const
    {
        const Outcome outcome = solve();
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        const auto steps = stepsOf(outcome.text);
        EXPECT_EQ(steps.size(), 4u) << outcome.text;
        return steps;
    }

    void expectFirst(int subSteps, const std::string& limit) const
    {
        const auto steps = solvedSteps();
        ASSERT_FALSE(steps.empty());
        EXPECT_EQ(steps[0].subSteps, subSteps);
        EXPECT_EQ(steps[0].limit, limit);
        // The log has six digits.
        for (const LoggedStep& step : steps) EXPECT_NEAR(step.dt*step.subSteps, 1e-3, 1e-8);
    }

    // Of the speed at the start of each step, with what gravity may add in it.
    static void expectCourant(const std::vector<LoggedStep>& steps, double maxCo)
    {
        for (std::size_t i = 1; i < steps.size(); ++i)
        {
            const double speed = steps[i - 1].maxSpeed + 9.81*steps[i].dt*steps[i].subSteps;
            EXPECT_LE(steps[i].dt*speed/spacing, maxCo*(1 + 1e-5)) << "step " << i;     // six digits of the log
        }
    }
};

INSTANTIATE_TEST_SUITE_P(Devices, Steps, testing::ValuesIn(devices()));

// Shortest capillary wave: sqrt(rho d^3/(2 pi sigma)).
const double capillaryTime = std::sqrt(998*1e-9/(2*std::numbers::pi*0.0728));

}

TEST_P(Steps, TheCapillaryLimitIsNamed)
{
    control("deltaT 2e-3;");
    const auto usual = stepsOf(solve().text);
    ASSERT_FALSE(usual.empty());
    EXPECT_EQ(usual[0].subSteps, int(std::ceil(2e-3/(0.7*capillaryTime))));
    EXPECT_EQ(usual[0].limit, "capillary");
    removeResults();
    control("maxCapillaryCo 0.05;");
    expectFirst(int(std::ceil(1e-3/(0.05*capillaryTime))), "capillary");
}

TEST_P(Steps, TheCourantNumberIsNamedAndObeyed)
{
    fill({1, 0, 0});
    control("maxCo 0.05;");
    const auto steps = solvedSteps();
    ASSERT_FALSE(steps.empty());
    // 0.05 mm at 1 m/s, with 1 % from gravity and less from the small differences.
    EXPECT_EQ(steps[0].subSteps, 21);
    for (const LoggedStep& step : steps) EXPECT_EQ(step.limit, "Courant");
    expectCourant(steps, 0.05);
}

TEST_P(Steps, TheViscousLimitIsNamed)
{
    write("constant/liquidProperties", "rho 998; nu 1e-3; sigma 0.0728;");
    write
    (
        "constant/models",
        "pressure pbf; surfaceTension Fujisawa2014; wetting contactAngle; viscosity laminar; bodyForce gravity;"
    );
    expectFirst(8, "viscous");          // 1e-3 s/(0.125 d^2/nu)
}

TEST_P(Steps, WithoutLimitsDeltaTIsTheStep)
{
    control("deltaT 1e-4; endTime 4e-4;");
    auto steps = solvedSteps();
    ASSERT_FALSE(steps.empty());
    EXPECT_EQ(steps[0].subSteps, 1);
    EXPECT_EQ(steps[0].limit, "deltaT");
    removeResults();
    control("adjustTimeStep no;");
    steps = solvedSteps();
    ASSERT_FALSE(steps.empty());
    EXPECT_EQ(steps[0].subSteps, 1);
    EXPECT_EQ(steps[0].dt, 1e-3);
    EXPECT_EQ(steps[0].limit, "deltaT");
}

// Longer steps of the default's tension make energy (doc/studies.md, longSteps).
TEST_P(Steps, StepsOfTheDefaultAreNoLongerThanFiveCapillaryOnes)
{
    write("constant/models", "pressure completedPbf; surfaceTension laplacePressure; wetting extendedSurface; viscosity newtonian; bodyForce none;");
    control("deltaT 0.03; endTime 0.12; maxCapillaryCo 30;");
    const int five = int(std::ceil(0.03/(5*capillaryTime)));
    EXPECT_TRUE(holds(solve("-dry-run").text, {std::to_string(4*five) + " of ", "limited by tension"}));
    control("deltaT 0.03; endTime 0.12; maxCapillaryCo 4.9;");
    EXPECT_TRUE(holds(solve("-dry-run").text, {"limited by capillary"}));
}

TEST_P(Steps, MaxSubStepsStopsTheRun)
{
    control("maxCapillaryCo 0.3; maxSubSteps 2;");
    expectRefusal({"3 sub-steps", "capillary", "maxSubSteps 2", "a deltaT of ", "system/controlDict at line "});
}

// A run that is started again at its end computes nothing, and tells what to change.
TEST_P(Steps, ARunAtItsEndSaysSo)
{
    EXPECT_TRUE(holds(solve().text, {"Ready for the first step"}));
    const Outcome again = solve();
    EXPECT_EQ(again.status, 0);
    EXPECT_TRUE(holds(again.text, {"Nothing is left to do", "reached its endTime", "set a later endTime", "Allclean"}));
    EXPECT_FALSE(holds(again.text, {"Ready for the first step"}));
}

TEST_P(Steps, EndTimeAndMaxCoMayChangeWhileItRuns)
{
    control("endTime 60; writeInterval 1000000; runTimeModifiable yes; maxCapillaryCo 0.3;");
    Process process(command("pbfDroplet", ""), folder_.path()/"log");
    ASSERT_TRUE(process.runUntil([&] { return stepsOf(process.log()).size() > 2; })) << process.log();
    process.pause();
    const std::size_t before = stepsOf(process.log()).size();
    const double end = 1e-3*double(before + 5);
    control("endTime " + std::to_string(end) + "; writeInterval 1000000; runTimeModifiable yes; maxCo 0.01;");
    process.resume();
    ASSERT_EQ(process.wait(), 0) << process.log();

    EXPECT_TRUE(holds(process.log(), {"controlDict anew"}));
    const auto steps = stepsOf(process.log());
    ASSERT_EQ(steps.size(), before + 5);
    EXPECT_NEAR(steps.back().time, end, 1e-9);
    // The step in which the change came was divided before.
    expectCourant({steps.begin() + long(before) + 1, steps.end()}, 0.01);
    EXPECT_EQ(steps.back().limit, "Courant");
    EXPECT_EQ(steps[before - 1].limit, "capillary");
    EXPECT_EQ(folder_.list("case").size(), 4u);         // 0, constant, system and the last time
}

TEST_P(Steps, WriteNowStopsTheRun)
{
    control("endTime 60; writeInterval 1000000; runTimeModifiable yes;");
    Process process(command("pbfDroplet", ""), folder_.path()/"log");
    ASSERT_TRUE(process.runUntil([&] { return stepsOf(process.log()).size() > 2; })) << process.log();
    control("endTime 60; writeInterval 1000000; runTimeModifiable yes; stopAt writeNow;");
    ASSERT_EQ(process.wait(), 0) << process.log();
    const auto steps = stepsOf(process.log());
    ASSERT_LT(steps.size(), 60000u);
    std::vector<std::string> times;
    for (const std::string& name : folder_.list("case"))
    {
        if (name.starts_with("0.")) times.push_back(name);
    }
    ASSERT_EQ(times.size(), 1u);
    EXPECT_NEAR(std::stod(times[0]), steps.back().time, 1e-9);
    EXPECT_TRUE(exists(times[0] + "/liquid/positions"));
}

TEST_P(Steps, AWrongChangeIsLeftOut)
{
    control("endTime 60; writeInterval 1000000; runTimeModifiable yes;");
    Process process(command("pbfDroplet", ""), folder_.path()/"log");
    ASSERT_TRUE(process.runUntil([&] { return stepsOf(process.log()).size() > 2; })) << process.log();
    control("endTime 60; writeInterval 1000000; runTimeModifiable yes; maxSubSteps 0;");
    const auto warned = [&] { return process.log().find("is left out") != std::string::npos; };
    ASSERT_TRUE(process.runUntil(warned)) << process.log();
    EXPECT_TRUE(process.runUntil([&] { return holds(process.log(), {"maxSubSteps is 0", "former values"}); }));
    control("endTime 60; writeInterval 1000000; runTimeModifiable yes; stopAt noWriteNow;");
    EXPECT_EQ(process.wait(), 0) << process.log();
    EXPECT_EQ(folder_.list("case"), (std::vector<std::string>{"0", "constant", "system"}));
}

TEST_P(Steps, DryRunChangesNothing)
{
    write(".0.002.partial/liquid/positions", "what another run may be writing");
    control("maxCapillaryCo 0.3; functions { drop { type liquidState; } }");
    const Contents before = contents();
    const Outcome outcome = solve("-dry-run");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(same(before, contents()));
    EXPECT_TRUE(holds
    (
        outcome.text,
        {
            "Liquid particles 294, solid particles 324, analytic surfaces 1", "Dry run", "MiB of ",
            "steps                : 12 of 0.000333333 s, limited by capillary", "time a step", "estimated time", "End"
        }
    ));
    EXPECT_TRUE(stepsOf(outcome.text).empty());
}

TEST_P(Steps, TheLogTellsOverWhatContactLinesSlip)
{
    const auto log = [&](const std::string& coefficients)
    {
        write
        (
            "constant/models",
            "pressure pbf; surfaceTension Fujisawa2014; wetting contactAngle; viscosity newtonian; bodyForce gravity; newtonianCoeffs { " + coefficients + " }"
        );
        return solve("-dry-run").text;
    };
    EXPECT_TRUE(holds(log(""), {"Slip length 1e-09 m (slipLength), below the spacing: the drag on contact lines is modelled\n"}));
    EXPECT_TRUE(holds(log("slipLength 0;"), {"Contact lines slip freely, over up to a spacing of 0.001 m: set slipLength in newtonianCoeffs to model their drag\n"}));
    EXPECT_TRUE(holds(log("slipLength 1e-8;"), {"Slip length 1e-08 m (slipLength), below the spacing"}));
    EXPECT_TRUE(holds(log("slipLength 0.002;"), {"Slip length 0.002 m (slipLength)\n"}));
    EXPECT_EQ(log("noSlip no;").find("Slip length"), std::string::npos);
}

TEST_P(Steps, DryRunFindsErrors)
{
    write("constant/wettability", "floor { theta 60; }\nside { theta 181; }\n");
    expectRefusal({"181", "0 to 180", "constant/wettability at line 2"}, "-dry-run");
}

TEST_P(Steps, FunctionObjectsMayBeLeftOut)
{
    control("functions { drop { type liquidState; executeInterval 2; } }");
    ASSERT_EQ(solve().status, 0);
    const std::string table = read("postProcessing/drop/0/liquidState.csv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3) << table;        // a head and every second of four steps
    removeResults();
    ASSERT_EQ(solve("-noFunctionObjects").status, 0);
    EXPECT_TRUE(exists("0.004/liquid/positions"));
    EXPECT_FALSE(exists("postProcessing"));
}

TEST_P(Steps, HelpTellsTheOptions)
{
    const Contents before = contents();
    const Outcome outcome = solve("-help");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(holds
    (
        outcome.text, {"Usage: pbfDroplet", "-case <DIR>", "-device <auto|cuda|cpu>", "-dry-run", "-noFunctionObjects"}
    ));
    EXPECT_EQ(outcome.text.find("PID"), std::string::npos);
    EXPECT_TRUE(same(before, contents()));
}

TEST_P(Steps, TheHeaderNamesDeviceAndCase)
{
    const Outcome outcome = solve();
    EXPECT_TRUE(holds
    (
        outcome.text,
        {
            "Shizuku ", ", host ", ", PID ", "Case   : " + path().string(), "Device : " + device(), "(100 %",
            "kinetic energy", "volume = ", "density error average", "ExecutionTime = ", "ClockTime = ", "\nEnd\n"
        }
    ));
}

TEST_P(Steps, ACaseThatIsMovedAwayEndsTheRun)
{
    control("endTime 10; writeInterval 1000000;");
    Process process(command("pbfDroplet", ""), folder_.path()/"out");
    ASSERT_TRUE(process.runUntil([&] { return process.log().find("Time = 0.002") != std::string::npos; })) << process.log();
    std::filesystem::rename(path(), folder_.path()/"moved");
    EXPECT_EQ(process.wait(), 1);
    EXPECT_TRUE(holds(process.log(), {"was removed or moved while it ran"}));
    EXPECT_FALSE(std::filesystem::exists(path()));
}

// Eight particles would burst at 2 m/s in steps of 2.8 capillary ones; all of their surface energy would give 1.7.
TEST_P(Steps, ABlobOfFewParticlesStaysCalm)
{
    write("constant/walls", "");
    write("constant/wettability", "");
    write
    (
        "constant/models",
        "pressure completedPbf;\nsurfaceTension laplacePressure;\nwetting none;\nviscosity XSPH;\nbodyForce none;\n"
    );
    std::vector<double> places;
    for (int i = 0; i < 8; ++i) for (const int bit : {1, 2, 4}) places.push_back((i & bit ? 0.5 : -0.5)*spacing);
    writeField(path()/"0/liquid/positions", {"positions", FieldType::vector, dimensions::length, false, places}, {});
    writeField(path()/"0/liquid/U", {"U", FieldType::vector, dimensions::velocity, true, {0, 0, 0}}, {});
    control("endTime 0.2; deltaT 1e-2; writeInterval 1000; maxCapillaryCo 2.8;");
    const Outcome outcome = solve();
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"No body of liquid had more than 20 particles", "maxCapillaryCo is at most 1.4"}));
    // Its capillary speed sqrt(sigma/(rho R)), R of a sphere of 8 particles, 0.24 m/s: as fast as it may swing.
    for (const LoggedStep& each : stepsOf(outcome.text)) EXPECT_LT(each.maxSpeed, 0.24) << each.time;
}

// Beside the floor, 0.06 m in a step: after two it is a hundred spacings of 1 mm below all that there was, for the rest of the run.
TEST_P(Steps, LiquidThatFallsFarBelowTheSceneIsNamedOnce)
{
    fill({0, 0, -60});
    FieldData positions = readField(path()/"0/liquid/positions");
    for (std::size_t k = 1; k < positions.values.size(); k += 3) positions.values[k] += 20e-3;
    writeField(path()/"0/liquid/positions", positions, {});
    control("writeInterval 4;");
    const std::string text = "m below all that there was at the start";
    const Outcome outcome = solve();
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {text, "constant/outlets"}));
    const std::size_t first = outcome.text.find(text);
    EXPECT_EQ(outcome.text.find(text, first + 1), std::string::npos) << outcome.text;

    removeResults();
    write("constant/outlets", "below { type plane; point (0 0 -1); normal (0 0 -1); }\n");
    const Outcome watched = solve();
    ASSERT_EQ(watched.status, 0) << watched.text;
    EXPECT_EQ(watched.text.find(text), std::string::npos) << watched.text;
}

// Liquid that falls on a knife of 60 degrees. Planes fitted to both flanks at once would throw it off at a hundred times its speed.
TEST_P(Steps, ASharpEdgeOfTheWallThrowsNoLiquid)
{
    SolidParticles solid;
    solid.patches = {"knife"};
    const double below = 1, step = std::sqrt(0.75), sine = 0.5, cosine = std::sqrt(0.75);     // in spacings; of half of the edge
    for (int row = 0; row < 12; ++row)
    {
        for (int place = 0; place < 18; ++place)
        {
            const double y = place - 8.5 + 0.5*(row % 2);
            for (const int side : {-1, 1})
            {
                if (row == 0 && side != (place % 2 == 0 ? -1 : 1)) continue;        // the edge's own belong to both in turn
                const double along = step*row;
                solid.positions.push_back(spacing*Vector3(side*along*sine, y, -0.2 - below - along*cosine));
                solid.normals.push_back({side*cosine, 0, sine});
            }
        }
    }
    solid.patch.assign(solid.positions.size(), 0);
    writeSolidParticles(path(), solid, {});
    const std::vector theta(solid.positions.size(), 90.0);
    writeField(path()/"0/solid/theta", {"theta", FieldType::scalar, dimensions::none, false, theta}, {});
    write("constant/walls", "knife { type particles; surface \"knife.stl\"; }\n");
    write("constant/wettability", "knife { theta 90; }\n");
    write
    (
        "constant/models",
        "pressure completedPbf;\nsurfaceTension laplacePressure;\nwetting extendedSurface;\nviscosity XSPH;\nbodyForce gravity;\n"
    );
    control("endTime 3e-2; writeInterval 30; maxCapillaryCo 2.8;");
    const double speed = 0.3;
    fill({0, 0, -speed});

    const Outcome outcome = solve();
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const auto steps = stepsOf(outcome.text);
    ASSERT_EQ(steps.size(), 30u);
    // Its own speed, what it falls besides, and its capillary speed sqrt(sigma/(rho R)), 0.13 m/s; as much again for single particles.
    const double most = 2*(speed + 9.81*3e-2 + 0.13);
    for (const LoggedStep& each : steps) EXPECT_LT(each.maxSpeed, most) << each.time;
}

// A cube with square edges inside a bath of six times the earth's gravity. What edges drive has no end: with a half-space beyond each tangent plane the bath keeps
// 1e-8 J from 5 ms on. What a bath from a lattice has at its start falls below 3e-10 J here; twice that is asked.
TEST_P(Steps, SquareEdgesInsideLiquidDriveNoFlow)
{
    std::filesystem::remove_all(path());
    write("system/solution", "spacing 2.4e-4;\n");
    write("system/controlDict", "application pbfDroplet;\nendTime 0.015;\ndeltaT 1e-3;\nmaxCapillaryCo 2.8;\nwriteInterval 15;\nfunctions { drop { type liquidState; } }\n");
    write("system/fillLiquidDict", "bodies { bath { type box; min (-1.4e-3 -1.4e-3 -0.5e-3); max (2.6e-3 2.6e-3 1.7e-3); overlaps carve; } }\n");
    write("constant/liquidProperties", "rho 998; nu 5e-6; sigma 0.0728;\n");
    write("constant/g", "value (0 0 -60);\n");
    write
    (
        "constant/models",
        "pressure completedPbf;\nsurfaceTension laplacePressure;\nwetting extendedSurface;\nviscosity newtonian;\nbodyForce gravity;\n"
    );
    write
    (
        "constant/walls",
        "block { type particles; surface \"block.stl\"; }\nbath { type box; min (-1.5e-3 -1.5e-3 -0.6e-3); max (2.7e-3 2.7e-3 4e-3); }\n"
    );
    write("constant/wettability", "block { theta 90; }\nbath { theta 90; }\n");
    write("constant/triSurface/block.stl", stlText(cube(1.2e-3), "block"));
    for (const std::string tool : {"sampleSurface", "sampleTheta", "fillLiquid"})
    {
        const Outcome outcome = run(program(tool) + " -case '" + path().string() + "'");
        ASSERT_EQ(outcome.status, 0) << outcome.text;
    }
    const Outcome outcome = solve();
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_LT(CsvTable::read(path()/"postProcessing/drop/0/liquidState.csv").numbers("kineticEnergy").back(), 6e-10);
}

}
