// SPDX-License-Identifier: GPL-3.0-or-later
// A ball that the liquid moves: what drops and baths do to it, against figures that can be computed.

#include "SolverCase.H"

#include "core/fieldFile/CsvTable.H"

#include <cmath>
#include <numbers>
#include <sstream>

namespace shizuku::test
{

namespace
{

constexpr double radius = 1.25e-3, density = 1000, gravity = 9.81;                       // m, kg/m3, m/s2
constexpr double volume = 4*std::numbers::pi/3*radius*radius*radius;

class Bodies : public SolverCase
{
protected:
    Bodies()
    {
        write("constant/models", "pressure completedPbf;\nsurfaceTension laplacePressure;\nwetting extendedSurface;\nviscosity newtonian;\nbodyForce gravity;\n");
        remove("0");
        remove("constant/solid");
    }

    // With its middle at z [m] and a density [kg/m3].
    static std::string ball(double z, double own, const std::string& more)
    {
        const double mass = own*volume;
        std::ostringstream text;
        text << "ball { type sphere; centre (0 0 " << z << "); radius " << radius << "; liquid outside; motion { type sixDoF; mass " << mass << "; momentOfInertia "
             << 0.4*mass*radius*radius << "; centreOfMass (0 0 " << z << "); " << more << " } }\n";
        return text.str();
    }

    void solveFor(double spacing, double nu, const std::string& body, double end) const
    {
        std::ostringstream solution, properties, time;
        solution << "spacing " << spacing << ";\npressure { maxIterations 10; }\n";
        properties << "rho " << density << ";\nnu " << nu << ";\nsigma 0.072;\n";
        time << "endTime " << end << "; writeInterval 1000; functions { body { type sixDoFRigidBodyState; } forces { type wallForces; } }";
        write("system/solution", solution.str());
        write("constant/liquidProperties", properties.str());
        write("system/fillLiquidDict", "bodies { liquid { type cylinder; axis (0 0 1); overlaps carve; " + body + " } }\n");
        control(time.str());
        removeResults();
        remove("0");
        remove("postProcessing");
        const Outcome filled = run(program("fillLiquid") + " -case '" + path().string() + "'");
        ASSERT_EQ(filled.status, 0) << filled.text;
        const Outcome solved = solve();
        ASSERT_EQ(solved.status, 0) << solved.text;
    }

    CsvTable table(const std::string& name) const { return CsvTable::read(path()/"postProcessing"/name); }
};

INSTANTIATE_TEST_SUITE_P(Devices, Bodies, testing::ValuesIn(devices()));

}

// A drop between a ceiling and a ball. The bridge pulls by about 2 pi R sigma (cos 60 + cos 60)(1 - D/sqrt(D^2 + V/(pi R))) = 2.6e-4 N, D the gap of 0.5 mm, V 2.4 mm3 (Israelachvili 2011, 17.11).
// A ball of half that weight is drawn to the ceiling, up to a spacing of it, and sticks. One of twice that weight falls: from rest by no more than free fall has it.
TEST_P(Bodies, StickBelowACeiling)
{
    const double z = -radius - 5e-4, pull = 2.6e-4, start = 5e-3, end = 0.03;
    write("constant/wettability", "ceiling { theta 60; }\nball { theta 60; }\n");
    for (const double share : {0.5, 2.0})
    {
        write("constant/walls", "ceiling { type plane; point (0 0 0); normal (0 0 -1); }\n" + ball(z, share*pull/(gravity*volume), "start 5e-3;"));
        solveFor(2.5e-4, 1e-5, "point (0 0 -1.775e-3); radius 1.1e-3; height 1.775e-3;", end);
        const double last = table("body/0/sixDoFRigidBodyState.csv").numbers("centreZ").back();
        const double fall = gravity*(end - start)*(end - start)/2;                     // 3.1 mm
        if (share < 1) { EXPECT_NEAR(last, -radius - 2.5e-4, 1e-7) << "the gap is a spacing where it is stopped"; }
        else { EXPECT_LT(last, z - 0.1*fall) << "half of its weight is held at most"; }
        EXPECT_GT(last, z - 1.01*fall);
    }
}

}
