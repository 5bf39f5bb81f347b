// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallMotions/WallMotions.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shizuku::test
{

namespace
{

WallMotions motionsOf(const std::string& walls)
{
    ScratchFolder folder;
    folder.write("constant/walls", walls);
    return WallMotions::read(folder.path());
}

const std::string plane = "type plane; point (0 0 0); normal (0 0 1);";

Vector3 moved(const std::string& motion, double time, const Vector3& from)
{
    const WallMotions motions = motionsOf("wall { " + plane + " motion { " + motion + " } }");
    return motions.walls().at(0).motion->at(time)(from);
}

std::string refusal(const std::string& motion, const std::string& wall = plane)
{
    return messageOf([&] { motionsOf("wall\n{\n" + wall + "\nmotion { " + motion + " }\n}"); });
}

// Double precision of lengths of about one.
void expectNear(const Vector3& found, const Vector3& expected) { EXPECT_LT(length(found - expected), 1e-12) << str(found) << ", not " << str(expected); }

}

TEST(WallMotions, TranslationGoesFromStartToStop)
{
    const std::string motion = "type translation; velocity (2 0 -1); start 0.5; stop 1.5;";
    expectNear(moved(motion, 0.4, {1, 1, 1}), {1, 1, 1});
    expectNear(moved(motion, 1, {1, 1, 1}), {2, 1, 0.5});
    expectNear(moved(motion, 1.5, {1, 1, 1}), {3, 1, 0});
    expectNear(moved(motion, 9, {1, 1, 1}), {3, 1, 0});
}

TEST(WallMotions, RotationTurnsAboutItsAxis)
{
    const std::string motion = "type rotation; origin (1 0 0); axis (0 0 2); omega " + std::to_string(0.5) + ";";
    const double quarter = std::numbers::pi;            // s
    expectNear(moved(motion, quarter, {2, 0, 5}), {1, 1, 5});
    expectNear(moved(motion, 2*quarter, {2, 0, 5}), {0, 0, 5});
}

// A phase moves the oscillation on, not the wall at its start.
TEST(WallMotions, OscillationsBeginWhereTheWallIs)
{
    for (const double phase : {0, 90, -30})
    {
        const std::string motion = "type oscillation; amplitude (0 0 3); frequency 2; phase " + std::to_string(phase) + ";";
        const double begin = std::sin(phase*std::numbers::pi/180);
        expectNear(moved(motion, 0, {}), {});
        for (const double t : {0.05, 0.2}) expectNear(moved(motion, t, {}), {0, 0, 3*(std::sin(4*std::numbers::pi*t + phase*std::numbers::pi/180) - begin)});
    }
    // From one end, -90 degrees, to the other in half a period.
    expectNear(moved("type angularOscillation; origin (0 0 0); axis (0 0 1); amplitude 45; frequency 1; phase -90;", 0.5, {1, 0, 0}), {0, 1, 0});
}

TEST(WallMotions, TablesAreLinearBetweenTheirTimes)
{
    const std::string motion = "type table; start 1; times (0 1 3); displacements ((0 0 0) (2 0 0) (2 0 4));";
    expectNear(moved(motion, 1.5, {}), {1, 0, 0});
    expectNear(moved(motion, 2.5, {}), {2, 0, 1});
    expectNear(moved(motion, 7, {}), {2, 0, 4});
}

// What one pose is against another: the same for a point of the body.
TEST(WallMotions, PosesFollowEachOther)
{
    const Pose before = Pose::rotation({1, 2, 3}, normalized({1, 1, 0}), 0.4), now = Pose::rotation({0, 1, 0}, {0, 0, 1}, -1.1);
    const Vector3 x{0.3, -2, 5};
    expectNear(now.since(before)(before(x)), now(x));
    expectNear(now.turnedBack(now.turned(x)), x);
}

TEST(WallMotions, RefuseWhatCannotBe)
{
    EXPECT_TRUE(holds(refusal("type translatoin; velocity (1 0 0);"), {"constant/walls at line", "translatoin", "translation", "angularOscillation"}));
    EXPECT_TRUE(holds(refusal("type translation; velocity (1 0 0); speed 3;"), {"constant/walls at line", "speed"}));
    EXPECT_TRUE(holds(refusal("type translation; velocity (1 0 0); start -1;"), {"starts at -1 s", "0 s or later"}));
    EXPECT_TRUE(holds(refusal("type translation; velocity (1 0 0); start 2; stop 1;"), {"stops at 1 s and starts at 2 s"}));
    EXPECT_TRUE(holds(refusal("type rotation; origin (0 0 0); axis (0 0 0); omega 1;"), {"constant/walls at line", "axis"}));
    EXPECT_TRUE(holds(refusal("type oscillation; amplitude (0 0 1); frequency 0;"), {"constant/walls at line", "frequency"}));
    EXPECT_TRUE(holds(refusal("type table; times (0 1); displacements ((0 0 0));"), {"2 times and 1 displacements"}));
    EXPECT_TRUE(holds(refusal("type table; times (0 2 1); displacements ((0 0 0) (1 0 0) (2 0 0));"), {"not sorted", "1 s follows 2 s"}));
    EXPECT_TRUE(holds(refusal("type table; times (0 1); displacements ((1 0 0) (2 0 0));"), {"begins at 0 s with (1 0 0) m"}));
    const std::string box = "type box; min (0 0 0); max (1 1 1);";
    EXPECT_TRUE(holds(refusal("type rotation; origin (0 0 0); axis (0 0 1); omega 1;", box), {"constant/walls at line", "a box", "six walls of type plane"}));
    EXPECT_EQ(refusal("type translation; velocity (1 0 0);", box), "no error");
}

// Of several patches of a wall that was sampled, as constant/solid/surfaces says.
TEST(WallMotions, MoveThePatchesOfTheirWall)
{
    ScratchFolder folder;
    folder.write("constant/walls", "plate { type particles; surface \"plate.stl\"; motion { type translation; velocity (0 0 2); } } floor { " + plane + " motion { type translation; velocity (1 0 0); } }"
        " still { type particles; surface \"still.stl\"; }");
    SolidParticles solid;
    solid.positions = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    solid.normals.assign(3, {0, 0, 1});
    solid.patch = {0, 1, 2};
    solid.patches = {"lower", "upper", "still"};
    writeSolidParticles(folder.path(), solid, {});
    EXPECT_TRUE(holds(messageOf([&] { readSolidParticles(folder.path(), 1); }), {"'plate' moves", "run sampleSurface again"}));
    SurfaceMark plate, still;
    plate.wall = "plate", plate.patches = {"lower", "upper"};
    still.wall = "still", still.patches = {"still"};
    solid.marks = {plate, still};
    std::filesystem::remove_all(folder.path()/"constant/solid");
    writeSolidParticles(folder.path(), solid, {});
    const SolidParticles found = readSolidParticles(folder.path(), 0.5);
    expectNear(found.positions[0], {1, 0, 1});
    expectNear(found.positions[1], {2, 0, 1});
    expectNear(found.positions[2], {3, 0, 0});
    expectNear(readAnalyticSurfaces(folder.path(), 0.5).at(0).point, {0.5, 0, 0});
    EXPECT_EQ(readCaseWalls(folder.path(), 0.5).analytic.at(0).point, Vector3(0.5, 0, 0));
}

}
