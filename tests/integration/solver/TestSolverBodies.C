// SPDX-License-Identifier: GPL-3.0-or-later
// A ball that the liquid moves: what drops and baths do to it, against figures that can be computed.

#include "SolverCase.H"

#include "core/fieldFile/CsvTable.H"

#include <sstream>

namespace shizuku::test
{

namespace
{

constexpr double radius = 1.25e-3, gravity = 9.81;                       // m, m/s2
constexpr double start = 5e-3, end = 0.03, top = -5e-4;                                 // s; m

class Bodies : public SolverCase
{
protected:
    // A drop between a ceiling and a ball below it.
    Bodies()
    {
        write("constant/models", "pressure completedPbf;\nsurfaceTension laplacePressure;\nwetting extendedSurface;\nviscosity newtonian;\nbodyForce gravity;\n");
        write("constant/liquidProperties", "rho 1000;\nnu 1e-5;\nsigma 0.072;\n");
        write("constant/wettability", "ceiling { theta 60; }\nball { theta 60; }\n");
        write("system/solution", "spacing 2.5e-4;\npressure { maxIterations 10; }\n");
        write("system/fillLiquidDict", "bodies { liquid { type cylinder; axis (0 0 1); overlaps carve; point (0 0 -1.775e-3); radius 1.1e-3; height 1.775e-3; } }\n");
        control("endTime 0.03; writeInterval 1000; functions { body { type sixDoFRigidBodyState; } }");
        remove("constant/solid");
    }

    // Where the middle of a ball of that weight [N] ends, m.
    double heightAtEnd(double weight) const
    {
        std::ostringstream walls;
        walls << "ceiling { type plane; point (0 0 0); normal (0 0 -1); }\nball { type sphere; centre (0 0 " << top - radius << "); radius " << radius << "; liquid outside; motion { type sixDoF; mass "
            << weight/gravity << "; momentOfInertia " << 0.4*weight/gravity*radius*radius << "; centreOfMass (0 0 " << top - radius << "); start " << start << "; } }\n";
        write("constant/walls", walls.str());
        removeResults();
        remove("0");
        remove("postProcessing");
        const Outcome filled = run(program("fillLiquid") + " -case '" + path().string() + "'");
        EXPECT_EQ(filled.status, 0) << filled.text;
        const Outcome solved = solve();
        EXPECT_EQ(solved.status, 0) << solved.text;
        return CsvTable::read(path()/"postProcessing/body/0/sixDoFRigidBodyState.csv").numbers("centreZ").back();
    }
};

INSTANTIATE_TEST_SUITE_P(Devices, Bodies, testing::ValuesIn(devices()));

}

// A drop between a ceiling and a ball. The bridge pulls by about 2 pi R sigma (cos 60 + cos 60)(1 - D/sqrt(D^2 + V/(pi R))) = 2.6e-4 N, D the gap of 0.5 mm, V 2.4 mm3 (Israelachvili 2011, 17.11).
// A ball of half that weight is drawn to the ceiling, up to a spacing of it, and sticks. One of twice that weight falls: from rest by no more than free fall has it.
TEST_P(Bodies, StickBelowACeiling)
{
    constexpr double pull = 2.6e-4, fall = gravity*(end - start)*(end - start)/2;       // N; 3.1 mm
    EXPECT_NEAR(heightAtEnd(pull/2), -radius - 2.5e-4, 1e-7) << "the gap is a spacing where it is stopped";
    const double last = heightAtEnd(2*pull);
    EXPECT_LT(last, top - radius - 0.1*fall) << "half of its weight is held at most";
    EXPECT_GT(last, top - radius - 1.01*fall);
}

}
