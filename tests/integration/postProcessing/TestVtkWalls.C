// SPDX-License-Identifier: GPL-3.0-or-later
// Analytic walls in files for ParaView and in pictures.

#include "DropCase.H"

#include "support/VtkReading.H"

#include <vtkPointData.h>

#include <algorithm>

using namespace shizuku;
using namespace shizuku::test;
namespace fs = std::filesystem;

// Analytic walls are meshes about the first liquid, where they are at each time: a ball that rises by 0.1 m/s, and a floor. The mesh is of single precision.
TEST_F(DropCase, ShizukuToVtkShowsAnalyticWallsWhereTheyAre)
{
    fs::remove_all(path()/"constant/solid");
    write("constant/walls", "floor { type plane; point (0 0 0); normal (0 0 1); }\n"
        "ball { type sphere; centre (0 0 1e-3); radius 5e-4; liquid outside; motion { type translation; velocity (0 0 0.1); } }\n");
    for (const char* time : {"0", "0.01"}) writeTime(time, {drop(90)});
    ASSERT_EQ(call("shizukuToVTK").status, 0);
    for (int index = 0; index < 2; ++index)
    {
        const auto data = readVtp(path()/("VTK/walls/walls_" + std::to_string(index) + ".vtp"));
        ASSERT_NE(data->GetPointData()->GetArray("wall"), nullptr);
        EXPECT_GT(data->GetNumberOfPolys(), 100);
        double lowest = 1, highest = -1;
        for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
        {
            const double z = data->GetPoint(i)[2];
            if (data->GetPointData()->GetArray("wall")->GetTuple1(i) == 0) EXPECT_NEAR(z, 0, 1e-9);
            else std::tie(lowest, highest) = std::pair(std::min(lowest, z), std::max(highest, z));
        }
        EXPECT_NEAR(lowest, 5e-4 + 1e-3*index, 1e-8);
        EXPECT_NEAR(highest, 15e-4 + 1e-3*index, 1e-8);
    }
    write("constant/walls", "floor { type plane; point (0 0 0); normal (0 0 1); }\n");
    ASSERT_EQ(call("shizukuToVTK").status, 0);
    EXPECT_FALSE(fs::exists(path()/"VTK/walls/walls_1.vtp"));           // it stands still: one file
}

// A ball that has come to a place is drawn as one that stands there.
TEST_F(DropCase, RenderCaseShowsABallWhereItIs)
{
    fs::remove_all(path()/"constant/solid");
    writeTime("0.01", {drop(90)});
    const auto rendered = [&](const std::string& centre, const std::string& motion)
    {
        write("constant/walls", "floor { type plane; point (0 0 0); normal (0 0 1); }\n"
            "ball { type sphere; centre " + centre + "; radius 5e-4; liquid outside; " + motion + " }\n");
        const Outcome outcome = call("renderCase", "-view side -size 160x100 -look plain -centre '(0 0 1e-3)' -width 8e-3");
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        return read("case.png");
    };
    const std::string moving = "motion { type translation; velocity (0.2 0 0); }", there = rendered("(2e-3 0 1e-3)", "");
    EXPECT_EQ(rendered("(0 0 1e-3)", moving), there);
    EXPECT_NE(rendered("(0 0 1e-3)", ""), there);
}
