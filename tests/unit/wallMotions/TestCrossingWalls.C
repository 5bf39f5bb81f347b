// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallMotions/CrossingWalls.H"

#include "caseFiles/SolidParticles.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <cstdlib>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr double d = 0.1;           // m, the spacing
const std::string nothing = "no error";

const std::string bottom = "bottom { type plane; point (0 0 0); normal (0 0 1); }\n";

std::string lid(const std::string& motion) { return "lid { type plane; point (0 0 2); normal (0 0 -1);\nmotion { " + motion + " } }\n"; }

std::string ball(const std::string& motion) { return "ball { type sphere; centre (0 0 2); radius 1; liquid outside;\nmotion { " + motion + " } }\n"; }

std::string translation(const std::string& velocity) { return "type translation; velocity " + velocity + ";"; }

class Crossing : public testing::Test
{
protected:
    // What refuses walls from 0 to so many seconds.
    std::string refusal(const std::string& walls, double to, double from = 0) const
    {
        folder_.write("constant/walls", walls);
        return messageOf([&] { refuseCrossingWalls(folder_.path(), from, to, d); });
    }

    // Upright squares of solid particles at these x, from z = low on, 21 of them wide and 10 high.
    void writePlates(const std::vector<std::string>& names, const std::vector<double>& places, double low) const
    {
        SolidParticles solid;
        solid.patches = names;
        for (std::size_t wall = 0; wall < names.size(); ++wall)
        {
            for (int j = -10; j <= 10; ++j)
            {
                for (int k = 0; k < 10; ++k)
                {
                    solid.positions.push_back({places[wall], j*d, low + (k + 0.5)*d});
                    solid.normals.push_back({1, 0, 0});
                    solid.patch.push_back(int(wall));
                }
            }
        }
        writeSolidParticles(folder_.path(), solid, {});
    }

    static std::string plate(const std::string& name, const std::string& motion = "")
    {
        return name + " { type particles; surface \"" + name + ".stl\";" + (motion.empty() ? "" : "\nmotion { " + motion + " }") + " }\n";
    }

    ScratchFolder folder_;
};

// Steps are a quarter of a spacing: 0.025 s at 1 m/s. So is the tolerance of times, behind the exact one.
constexpr double step = 0.025;

// In a refusal.
void expectTime(const std::string& message, double exact)
{
    const auto at = message.find(": at ");
    ASSERT_NE(at, std::string::npos) << message;
    const double time = std::atof(message.c_str() + at + 5);
    EXPECT_GE(time, exact - 1e-5) << message;           // of six digits
    EXPECT_LE(time, exact + step + 1e-5) << message;
}

}

// 2 m apart: at half a spacing behind the bottom after 2.05 s.
TEST_F(Crossing, OfPlanesThatFaceEachOther)
{
    const std::string walls = bottom + lid(translation("(0 0 -1)"));
    const std::string message = refusal(walls, 5);
    EXPECT_TRUE(holds(message, {"constant/walls", "line 3", "'lid'", "'bottom'", "half a spacing", "stop"})) << message;
    expectTime(message, 2.05);
    EXPECT_EQ(refusal(walls, 2), nothing);                                                       // the run ends before
    EXPECT_EQ(refusal(bottom + lid(translation("(0 0 -1)") + " stop 2;"), 5), nothing);          // they touch
    EXPECT_EQ(refusal(bottom + lid(translation("(3 0 0)")), 5), nothing);
    EXPECT_EQ(refusal(bottom + lid("type oscillation; amplitude (0 0 1.9); frequency 7;"), 5), nothing);
    EXPECT_TRUE(holds(refusal(bottom + lid("type oscillation; amplitude (0 0 2.1); frequency 7;"), 5), {"'lid'"}));
    EXPECT_EQ(refusal(bottom + "side { type plane; point (2 0 0); normal (-1 0 0); motion { " + translation("(-1 0 0)") + " } }", 5), nothing);      // an edge

    // A run that goes on says the same.
    expectTime(refusal(walls, 5, 1), 2.05);
    EXPECT_TRUE(holds(refusal(walls, 5, 4), {": at 4 s"}));
}

TEST_F(Crossing, OfABallWithAnyWall)
{
    expectTime(refusal(bottom + ball(translation("(0 0 -1)")), 5), 1.05);
    const std::string tank = "tank { type box; min (-3 -3 -3); max (3 3 3); }\n", tube = "tube { type cylinder; point (0 0 0); axis (0 0 1); radius 3; liquid inside; }\n";
    expectTime(refusal(tank + ball(translation("(1 0 0)")), 5), 2.05);
    expectTime(refusal(tube + ball(translation("(1 0 0)")), 5), 2.05);
    EXPECT_EQ(refusal(tube + ball(translation("(0 0 1)")), 5), nothing);
    // Both move: the gap closes at 2 m/s.
    const std::string message = refusal("bottom { type plane; point (0 0 0); normal (0 0 1); motion { " + translation("(0 0 1)") + " } }\n" + ball(translation("(0 0 -1)")), 5);
    expectTime(message, 0.525);
    // Together they stay apart.
    EXPECT_EQ(refusal("bottom { type plane; point (0 0 0); normal (0 0 1); motion { " + translation("(0 0 -1)") + " } }\n" + ball(translation("(0 0 -1)")), 5), nothing);
}

TEST_F(Crossing, OfCylindersThatAreParallel)
{
    const std::string rods = "a { type cylinder; point (0 0 0); axis (0 1 0); radius 1; liquid outside; }\n"
        "b { type cylinder; point (4 0 0); axis (0 -1 0); radius 1; liquid outside; motion { " + translation("(-1 0 0)") + " } }\n";
    expectTime(refusal(rods, 5), 2.05);
    const std::string over = "rod { type cylinder; point (0 0 2); axis (1 0 0); radius 1; liquid outside; motion { " + translation("(0 0 -1)") + " } }\n";
    expectTime(refusal(bottom + over, 5), 1.05);
}

// The lowest particles are half a spacing inside of the plate, whose edge is 1 m above the floor.
TEST_F(Crossing, OfSolidParticlesWithASurface)
{
    writePlates({"blade"}, {0}, 1);
    expectTime(refusal(bottom + plate("blade", translation("(0 0 -1)")), 5), 1.05);
    EXPECT_EQ(refusal(bottom + plate("blade", translation("(2 0 0)")), 5), nothing);
    // It turns about its upper edge, 2 m above the floor, which it does not reach; then about its lower one, with corners 1.5 m away.
    EXPECT_EQ(refusal(bottom + plate("blade", "type rotation; origin (0 0 2); axis (0 1 0); omega 3;"), 5), nothing);
    EXPECT_TRUE(holds(refusal(bottom + plate("blade", "type rotation; origin (0 0 0.9); axis (1 0 0); omega 3;"), 5), {"'blade'", "'bottom'"}));
    // One that reaches in from the start goes on along the floor, and deeper.
    writePlates({"blade"}, {0}, -0.02);
    EXPECT_EQ(refusal(bottom + plate("blade", translation("(2 0 -0.5)")), 5), nothing);
}

// Layers 2 m apart. Their surfaces touch a spacing before the layers meet; half a spacing further after 1.95 s.
TEST_F(Crossing, OfSolidParticlesWithOthers)
{
    writePlates({"left", "right"}, {0, 2}, 0);
    expectTime(refusal(plate("left") + plate("right", translation("(-1 0 0)")), 5), 1.95);
    EXPECT_EQ(refusal(plate("left", translation("(-1 0 0)")) + plate("right", translation("(-1 0 0)")), 5), nothing);
    EXPECT_EQ(refusal(plate("left") + plate("right", translation("(0 0 1)")), 5), nothing);
}

// A fast and long motion: steps are as many as can be afforded, and it is seen.
TEST_F(Crossing, OfLongMotions)
{
    EXPECT_TRUE(holds(refusal("tank { type box; min (-3 -3 -3); max (3 3 3); }\n" + ball("type oscillation; amplitude (2.5 0 0); frequency 1000;"), 1000), {"'ball'", "'tank'"}));
}

TEST_F(Crossing, NothingMoves)
{
    EXPECT_EQ(refusal(bottom + "lid { type plane; point (0 0 -1); normal (0 0 -1); }", 5), nothing);
}
