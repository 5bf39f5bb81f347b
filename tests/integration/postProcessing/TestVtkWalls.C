// SPDX-License-Identifier: GPL-3.0-or-later
// Analytic walls in files for ParaView and in pictures, and bodies that move in a browser.

#include "DropCase.H"

#include "support/VtkReading.H"

#include <vtkPointData.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

using namespace shizuku;
using namespace shizuku::test;
namespace fs = std::filesystem;

namespace
{

std::string fromBase64(const std::string& text)
{
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned group = 0;
    int bits = 0;
    for (const char digit : text)
    {
        if (digit == '=') break;
        group = group << 6 | unsigned(digits.find(digit));
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += char(group >> bits & 255);
    }
    return bytes;
}

// The lowest x of each message of solid particles in an exported page [m].
std::vector<double> lowestOfSolids(const std::string& page)
{
    std::vector<double> lowest;
    const std::size_t first = page.find("solids:[");
    if (first == std::string::npos) return lowest;
    std::istringstream list(page.substr(first + 8, page.find(']', first) - first - 8));
    for (std::string message; std::getline(list, message, ',');)
    {
        const std::string bytes = fromBase64(message.substr(1, message.size() - 2)), key = "\"low\":[";
        lowest.push_back(std::stod(bytes.substr(bytes.find(key) + key.size())));
    }
    return lowest;
}

}

// In an exported page the floor's particles move with it, by 0.1 m/s; of a floor that stands still they are there once.
TEST_F(DropCase, ShizukuViewExportsBodiesWhereTheyAre)
{
    for (const char* time : {"0", "0.01"}) writeTime(time, {drop(90)}, false);
    const std::string page = (path()/"case.html").string();
    const Outcome still = call("shizukuView", "-export " + page);
    ASSERT_EQ(still.status, 0) << still.text;
    EXPECT_TRUE(holds(read("case.html"), {"solid:\""}));
    EXPECT_TRUE(lowestOfSolids(read("case.html")).empty());
    write("constant/walls", "floor { type particles; surface \"floor.stl\"; motion { type translation; velocity (0.1 0 0); } }\n");
    const Outcome moving = call("shizukuView", "-export " + page);
    ASSERT_EQ(moving.status, 0) << moving.text;
    const std::vector<double> lowest = lowestOfSolids(read("case.html"));
    ASSERT_EQ(lowest.size(), 2u);
    EXPECT_NEAR(lowest[0], -25*spacing, 1e-8);
    EXPECT_NEAR(lowest[1], -25*spacing + 0.1*0.01, 1e-8);
}

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
