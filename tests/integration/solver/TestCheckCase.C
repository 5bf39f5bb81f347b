// SPDX-License-Identifier: GPL-3.0-or-later
// checkCase says what the solver would say, all of it at once, and measures what the case holds.

#include "SolverCase.H"

#include <cmath>
#include <numbers>
#include <sstream>

namespace shizuku::test
{

namespace
{

class CheckCase : public SolverCase
{
protected:
    Outcome check() const { return call("checkCase"); }

    // The number behind a label.
    static double numberBehind(const std::string& text, const std::string& label)
    {
        const std::size_t at = text.find(label);
        EXPECT_NE(at, std::string::npos) << label;
        if (at == std::string::npos) return NAN;
        return std::stod(text.substr(at + label.size()));
    }

    void expectFailures(int count, const std::vector<std::string>& parts) const
    {
        const Contents kept = contents();
        const Outcome outcome = check();
        EXPECT_EQ(outcome.status, 1) << outcome.text;
        EXPECT_TRUE(holds(outcome.text, parts));
        EXPECT_TRUE(holds(outcome.text, {"Failed " + std::to_string(count) + (count == 1 ? " check\n" : " checks\n")}));
        EXPECT_EQ(outcome.text.find("Case OK"), std::string::npos);
        EXPECT_TRUE(same(kept, contents()));
    }
};

INSTANTIATE_TEST_SUITE_P(Devices, CheckCase, testing::ValuesIn(devices()));

}

TEST_P(CheckCase, AGoodCaseIsMeasuredAndLeftAlone)
{
    fill({0, 0, -0.5});
    const Contents kept = contents();
    const Outcome outcome = check();
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(same(kept, contents()));
    const std::string& text = outcome.text;
    EXPECT_TRUE(holds(text, {"Case OK\n", "Liquid: 294 particles", "Solid: 324 particles, floor 324", "separate bodies 1",
        "analytic surfaces 1", "(7 7 6) spacings", "memory on the device", "\nEnd\n"}));
    EXPECT_EQ(text.find("***Error"), std::string::npos) << text;

    // 294 mm3 of water at 0.5 m/s under gravity; six digits are printed, velocities are floats.
    const double D = std::cbrt(6*294e-9/std::numbers::pi), rho = 998, sigma = 0.0728, nu = 1e-6;
    const double digits = 1e-5, U = std::hypot(0.5, 0.003);     // fill() adds 3 mm/s on average, along y
    EXPECT_NEAR(numberBehind(text, "diameter D "), D, digits*D);
    EXPECT_NEAR(numberBehind(text, "rho g D^2/sigma "), rho*9.81*D*D/sigma, digits*rho*9.81*D*D/sigma);
    EXPECT_NEAR(numberBehind(text, "rho U^2 D/sigma "), rho*U*U*D/sigma, 1e-3*rho*U*U*D/sigma);
    const double Oh = nu*std::sqrt(rho/(sigma*D));
    EXPECT_NEAR(numberBehind(text, "nu sqrt(rho/(sigma D)) "), Oh, digits*Oh);
    EXPECT_NEAR(numberBehind(text, "U D/nu "), U*D/nu, 1e-3*U*D/nu);
    EXPECT_NEAR(numberBehind(text, "rho nu U/sigma "), rho*nu*U/sigma, 1e-3*rho*nu*U/sigma);
    EXPECT_NEAR(numberBehind(text, "minimal "), 1, digits);
    EXPECT_NEAR(numberBehind(text, " s capillary "), 0.7*std::sqrt(rho*1e-9/(2*std::numbers::pi*sigma)), 1e-8);
    EXPECT_GT(numberBehind(text, "memory on the device : "), 0);
}

TEST_P(CheckCase, SeparateBodiesAreTold)
{
    // A second, smaller block: read from one list with the first one.
    const std::string positions = read("0/liquid/positions"), U = read("0/liquid/U");
    std::string more, still;
    for (int i = 0; i < 27; ++i)
    {
        std::ostringstream place;
        place << "(" << 1e-3*(i % 3) << " " << 1e-3*(i/3 % 3) << " " << 1e-3*(12 + i/9) << ")\n";
        more += place.str();
        still += "(0 0 1)\n";
    }
    const auto extended = [](std::string text, const std::string& lines)
    {
        text.replace(text.find("294"), 3, "321");
        return text.insert(text.find("(\n") + 2, lines);
    };
    write("0/liquid/positions", extended(positions, more));
    write("0/liquid/U", extended(U, still));
    const Outcome outcome = check();
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Liquid: 321 particles", "separate bodies 2", "Body 2: 27 particles", "(3 3 3) spacings",
        "mean velocity (0 0 1) m/s", "*Warning: body 1 of 2, 294 particles, is coarse, 4.12496 spacings a radius, less than 5, as is the smaller one:"}));
}

TEST_P(CheckCase, AllErrorsAreReportedAtOnce)
{
    control("endTime 4e-3; functions { a { type liquidStat; } }");
    write("constant/liquidProperties", "rho 998;\nnu 1e-6;\nsigma -1;\n");
    write
    (
        "constant/models",
        "pressure pfb;\nsurfaceTension Fujisawa2014;\nwetting contactAngel;\nviscosity XSHP;\nbodyForce gravity;\n"
    );
    write("constant/g", "value down;\n");
    write("constant/walls", "floor { type particles; surface \"floor.stl\"; }\nside { type plain; }\n");
    write("system/meshSurfaceDict", "cell 1\n");
    expectFailures
    (
        7,
        {"'sigma' is -1", "'pfb'", "'XSHP'", "the word 'down'", "'plain'", "'liquidStat'", "system/meshSurfaceDict"}
    );
    // Those of the walls hid those of the wetting model.
    write("constant/walls", "floor { type particles; surface \"floor.stl\"; }\nside { type plane; }\n");
    expectFailures(7, {"'point' is missing"});
    write("constant/walls", "floor { type particles; surface \"floor.stl\"; }\n");
    expectFailures(7, {"'contactAngel'"});
}

TEST_P(CheckCase, MissingParts)
{
    remove("system/solution");
    remove("constant/models");
    expectFailures(2, {"system/solution", "constant/models"});
    write("system/solution", "spacing 1e-3;\n");
    remove("0/liquid");
    remove("constant/solid");
    expectFailures(4, {"constant/models", "run sampleSurface", "'floor.stl' of the wall 'floor' is not in", "run fillLiquid"});
    remove("system/controlDict");
    const Outcome outcome = check();
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(holds(outcome.text, {"not a case"}));
}

// Angles that were edited after sampleTheta ran: the solver, too, warns and keeps those of 0/solid/theta. What sampleTheta would refuse
// before it ran.
TEST_P(CheckCase, ContactAngles)
{
    write("constant/wettability", "floor { theta 200; }\nside { theta 90; }\n");
    Outcome outcome = check();
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"*Warning: ", "wettability/floor is 200", "0 to 180", "0/solid/theta stay in force"}));
    write("constant/wettability", "floor { theta 120; }\nside { theta 90; }\n");
    outcome = check();
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    const std::string text = std::to_string(solids) + " of " + std::to_string(solids) + " solid particles other contact angles";
    EXPECT_TRUE(holds(outcome.text, {"*Warning: constant/wettability gives " + text, "120 degrees instead of 60", "sampleTheta"}));
    EXPECT_TRUE(holds(solve().text, {"--> WARNING: constant/wettability gives " + text}));
    remove("0/solid");
    write("constant/wettability", "flor { theta 60; }\nside { theta 90; }\n");
    expectFailures(2, {"run sampleTheta", "'flor'", "Did you mean 'floor'"});
}

// The weight is not known where the models could not be made.
TEST_P(CheckCase, NoBondNumberWithoutModels)
{
    EXPECT_TRUE(holds(check().text, {"Bond number"}));
    write("constant/models", "pressure pbf;\nsurfaceTension Fujisawa2014;\nwetting contactAngle;\nviscosity XSPH;\nbodyForce gravty;\n");
    const Outcome outcome = check();
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(holds(outcome.text, {"'gravty'", "    Weber number"}));
    EXPECT_EQ(outcome.text.find("Bond number"), std::string::npos) << outcome.text;
}

// Of water XSPH may know nothing; of what is ten thousand times as thick it is told.
TEST_P(CheckCase, AViscosityThatDoesNotActIsTold)
{
    EXPECT_EQ(check().text.find("does not act"), std::string::npos);
    write("constant/liquidProperties", "rho 998;\nnu 1e-2;\nsigma 0.0728;\n");
    EXPECT_TRUE(holds(check().text, {"*Warning: nu, 0.01 m2/s, does not act with viscosity XSPH"}));
}

TEST_P(CheckCase, ModelsAreListed)
{
    remove("system/controlDict");
    for (const std::string program : {"checkCase", "pbfDroplet"})
    {
        const Outcome outcome = call(program, "-listModels");
        EXPECT_EQ(outcome.status, 0);
        EXPECT_TRUE(holds(outcome.text, {"pressure\n", "    completedPbf            position based fluids", "wetting\n", "functions (system/controlDict)\n"}));
    }
}

TEST_P(CheckCase, ParticlesOfAnotherSpacing)
{
    write("system/solution", "spacing 0.5e-3;\n");
    expectFailures
    (
        2,
        {"solid particles are 2 spacings apart", "run sampleSurface", "liquid's particles are 2 spacings apart", "run fillLiquid"}
    );
}

TEST_P(CheckCase, OverlappingLiquid)
{
    write("system/solution", "spacing 1.25e-3;\n");
    expectFailures(1, {"overlapping itself", "0.8 spacings", "0/liquid/positions"});
    write("system/solution", "spacing 1.25e-3;\noverlaps relax;\n");
    const Outcome outcome = check();
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"*Warning: the liquid overlaps itself", "Case OK"}));
}

// 294 particles: (3*294/(4 pi))^(1/3) = 4.12 spacings a radius. The solver says once what checkCase does.
TEST_P(CheckCase, CoarseLiquidIsSaidByTheSolverToo)
{
    const std::string text = "body 1 of 1, 294 particles, is coarse, 4.12";
    EXPECT_TRUE(holds(check().text, {"*Warning: " + text}));
    const std::string log = solve().text;
    EXPECT_TRUE(holds(log, {"--> WARNING: " + text, "system/solution"}));
    EXPECT_EQ(log.find("WARNING"), log.rfind("WARNING")) << log;
    // On with it: nothing new to say.
    control("endTime 5e-3;");
    EXPECT_EQ(solve().text.find("WARNING"), std::string::npos);
}

TEST_P(CheckCase, ATensionInAnotherUnitIsAskedAbout)
{
    EXPECT_EQ(check().text.find("is that meant?"), std::string::npos);
    write("constant/liquidProperties", "rho 998;\nnu 1e-6;\nsigma 72.8;\n");
    const std::string text = "sigma is 72.8 N/m: is that meant? Water has 0.0728 N/m";
    EXPECT_TRUE(holds(check().text, {"*Warning: " + text}));
    const std::string log = solve().text;
    EXPECT_TRUE(holds(log, {"--> WARNING: " + text, "constant/liquidProperties at line 3"}));
    EXPECT_EQ(log.find(text), log.rfind(text)) << log;
}

// The block's edge is half a spacing from two sides of the box.
TEST_P(CheckCase, KnownFaultsAreSaidByTheSolverToo)
{
    write("constant/walls", "floor { type particles; surface \"floor.stl\"; }\nside { type box; min (-3.5e-3 -3.5e-3 -0.02); max (0.02 0.02 0.02); }\n");
    const std::string text = "The liquid stands in the vertical edges of the box 'side'. Known fault";
    EXPECT_TRUE(holds(check().text, {"*Warning: " + text}));
    EXPECT_TRUE(holds(solve().text, {"--> WARNING: " + text, "constant/walls at line 2"}));
}

// A lid 20 mm above the floor, at 10 m/s, in a run of 4 ms.
TEST_P(CheckCase, MotionsThroughWallsAreRefused)
{
    write("constant/walls", "floor { type particles; surface \"floor.stl\"; }\nside { type plane; point (0 0 0.02); normal (0 0 -1); motion { type translation; velocity (0 0 -10); } }\n");
    const std::vector<std::string> message{"The motion of the wall 'side' takes it through the wall 'floor': at 0.00", "constant/walls at line 2", "'stop'"};
    expectFailures(1, message);
    expectRefusal(message);
}

TEST_P(CheckCase, UtilitiesDictionariesAndSteps)
{
    write("system/fillLiquidDict", "bodies { drop { type sphere; centre (0 0 0); raduis 1; } }");
    expectFailures(1, {"Entry 'raduis' in dictionary", "did you mean 'radius'? That is missing"});
    remove("system/fillLiquidDict");
    control("deltaT 10; endTime 100;");
    expectFailures(1, {"more than maxSubSteps 1000", "system/controlDict at line ", "a deltaT of "});
}

}
