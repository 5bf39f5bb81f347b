// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallMotions/SixDoFBody.H"
#include "support/ScratchFolder.H"
#include "wallMotions/BodyStops.H"
#include "wallMotions/WallMotions.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

namespace shizuku::test
{

namespace
{

constexpr double radius = 0.1, density = 1000;                                  // m, kg/m3
const double volume = 4*std::numbers::pi/3*radius*radius*radius, added = 0.5*density*volume;

std::string sphere(const std::string& motion, const std::string& liquid = "outside")
{
    return "ball\n{\n    type sphere; centre (0 0 1); radius 0.1; liquid " + liquid + ";\n    motion { " + motion + " }\n}\n";
}

std::string sixDoF(double mass, const std::string& more = "")
{
    std::ostringstream text;
    text.precision(17);
    text << "type sixDoF; mass " << mass << "; momentOfInertia 0.5; centreOfMass (0 0 1); " << more;
    return text.str();
}

struct Floating
{
    ScratchFolder folder;
    WallMotions motions;
    SixDoFBody& body;

    explicit Floating(const std::string& motion, const std::string& others = "") : motions(read(folder, others + sphere(motion))), body(*motions.body()) { body.begin(0); }

    static WallMotions read(const ScratchFolder& folder, const std::string& walls)
    {
        folder.write("constant/walls", walls);
        return WallMotions::read(folder.path());
    }
};

std::string refusal(const std::string& walls)
{
    ScratchFolder folder;
    return messageOf([&] { Floating::read(folder, walls); });
}

}

// The added mass has no part in what it comes to: without liquid a body falls as all do. What is left of the start falls by m_a/(m + m_a) = 1/5 a step, 1e-28 after 40.
TEST(SixDoFBody, FallsAsAllDo)
{
    Floating ball(sixDoF(2*density*volume));
    constexpr double dt = 1e-3;
    for (int step = 1; step <= 40; ++step) ball.body.advance(step*dt, dt, {}, {0, 0, -9.81}, 0);
    EXPECT_NEAR(ball.body.state().acceleration.z, -9.81, 1e-14*9.81);
    const double place = ball.body.centre().z, velocity = ball.body.state().velocity.z;
    ball.body.advance(41*dt, dt, {}, {0, 0, -9.81}, added);
    EXPECT_NEAR(ball.body.centre().z, place + dt*velocity, 1e-15);
}

// Liquid that answers to an acceleration a with -M a, as M is for a sphere deep in it, for one on a wall, and for one that hardly touches it: the lightest body that is allowed comes to
// a = F/(m + M). Without the added mass its acceleration would grow by M/m = 25 in each step.
TEST(SixDoFBody, StaysCalmWhereItIsLight)
{
    constexpr double dt = 1e-3, force = 3;
    const double mass = SixDoFBody::least*density*volume;
    for (const double part : {0.05, 0.5, 0.8})
    {
        Floating ball(sixDoF(mass));
        const double M = part*density*volume;
        for (int step = 1; step <= 400; ++step)
        {
            const double now = ball.body.state().acceleration.x;
            ball.body.advance(step*dt, dt, {{force - M*now, 0, 0}, {}}, {}, added);
        }
        EXPECT_NEAR(ball.body.state().acceleration.x, force/(mass + M), 1e-9*force/(mass + M)) << part;
    }
}

// A moment about the origin has that of the force in it.
TEST(SixDoFBody, TurnsAboutItsCentreOfMass)
{
    Floating ball(sixDoF(1e9*density*volume, "omega (0 0 3);"));                // as good as without an added mass
    const Vector3 force{2, 0, 0}, own{0, 0.25, 0};
    ball.body.advance(0.1, 0.1, {force, cross({0, 0, 1}, force) + own}, {}, added);
    EXPECT_NEAR(ball.body.state().omega.y, 0.1*0.25/0.5, 1e-9);
    EXPECT_NEAR(ball.body.state().omega.z, 3, 1e-15);
    const Pose pose = ball.body.state().pose;
    EXPECT_LT(length(pose({0, 0, 1}) - Vector3(0, 0, 1)), 1e-15);
    EXPECT_LT(length(pose({1, 0, 1}) - Vector3(std::cos(0.3), std::sin(0.3), 1)), 1e-15);
}

TEST(SixDoFBody, KeepsToWhatIsFree)
{
    Floating ball(sixDoF(density*volume, "velocity (1 2 3); translations (z); rotations ();"));
    EXPECT_EQ(ball.body.state().velocity, Vector3(0, 0, 3));
    EXPECT_FALSE(ball.motions.walls().at(0).motion->axis());
    ball.body.advance(0.1, 0.1, {{1, 1, 1}, {1, 1, 1}}, {}, added);
    EXPECT_EQ(ball.body.state().velocity.x, 0);
    EXPECT_GT(ball.body.state().velocity.z, 3);
    EXPECT_EQ(ball.body.state().omega, Vector3());
}

// Until start; and from stop on it stays.
TEST(SixDoFBody, IsHeldBeforeAndAfter)
{
    Floating ball(sixDoF(density*volume, "velocity (0 0 1); start 1; stop 2;"));
    EXPECT_EQ(ball.body.at(1).shift, Vector3());
    EXPECT_DOUBLE_EQ(ball.body.at(1.5).shift.z, 0.5);
    EXPECT_DOUBLE_EQ(ball.body.at(7).shift.z, 1);
    ball.body.advance(0.5, 0.5, {{0, 0, 9}, {}}, {}, added);
    EXPECT_EQ(ball.body.state().velocity.z, 1);
    ball.body.advance(2.5, 2, {{0, 0, 9}, {}}, {}, added);
    EXPECT_EQ(ball.body.state().velocity, Vector3());
    EXPECT_DOUBLE_EQ(ball.body.centre().z, 2);
}

// A wall takes what goes on against it, and nothing of what goes away. Of a body that turns about another point than its middle it takes what the middle does.
TEST(SixDoFBody, IsStoppedAtAWall)
{
    Floating ball(sixDoF(density*volume, "velocity (1 0 -2); omega (0 3 0);"));
    const Vector3 middle(0, 0, 1);
    EXPECT_TRUE(ball.body.stopAt(middle, {0, 0, 1}, 0.5, 0.1));
    EXPECT_EQ(ball.body.state().velocity, Vector3(1, 0, -0.5));
    EXPECT_FALSE(ball.body.stopAt(middle, {0, 0, -1}, 0, 0.1));
    EXPECT_FALSE(ball.body.stopAt(middle, {0, 0, 1}, 0.5, 0.1));
    EXPECT_EQ(ball.body.state().velocity, Vector3(1, 0, -0.5));
    EXPECT_TRUE(ball.body.stopAt(middle + Vector3(1, 0, 0), {0, 0, 1}, 0.5, 0.1));        // goes down by 3 m/s more there
    EXPECT_NEAR(ball.body.state().velocity.z, 2.5, 1e-12);
}

// It falls for a second, by 9.8 m/s where nothing stops it. Each scene leaves it a way of 0.1 m, to a gap of 0.02 m.
TEST(SixDoFBody, GoesThroughNoWall)
{
    struct Scene
    {
        std::string walls;
        Vector3 end;
        double tolerance;
    };
    const double slope = std::sqrt(0.5), groove = 0.12/slope;                      // its sides meet 0.12 m/cos 45 below the middle
    const Scene scenes[] =
    {
        {"floor { type plane; point (0 0 0.78); normal (0 0 1); }", {0, 0, 0.9}, 1e-12},
        {"left { type plane; point (0 0 0.73029); normal (1 0 1); }\nright { type plane; point (0 0 0.73029); normal (-1 0 1); }", {0, 0, 0.73029 + groove}, 1e-5},
        {"tank { type box; min (-0.32 -0.12 0.78); max (0.32 0.12 3); }", {0.2, 0, 0.9}, 1e-12},                // into an edge: it has a speed along x
        {"lift { type plane; point (0 0 0.38); normal (0 0 1); motion { type translation; velocity (0 0 0.5); } }", {0, 0, 1}, 1e-12},
        {"bowl { type sphere; centre (0 0 1.78); radius 1; liquid inside; }", {0, 0, 0.9}, 1e-12}
    };
    for (const Scene& scene : scenes)
    {
        const bool isTank = scene.walls.starts_with("tank");
        Floating ball(sixDoF(density*volume, isTank ? "velocity (0.3 0 0);" : ""), scene.walls + "\n");
        const BodyStops stops(readAnalyticSurfaces(Dictionary::read(ball.folder.path()/"constant/walls")), "ball", 0.02);
        constexpr double dt = 1e-3;
        for (int step = 1; step <= 1000; ++step)
        {
            ball.body.advance(step*dt, dt, {}, {0, 0, -9.81}, 0);
            stops.stop(ball.motions, step*dt, dt);
        }
        EXPECT_LT(length(ball.body.centre() - scene.end), scene.tolerance) << scene.walls << ": " << ball.body.centre().x << ' ' << ball.body.centre().z;
    }
}

// Mass and what is free may be edited while it moves: it goes on from where it is, and stands along what is not free any more. How it started may not.
TEST(SixDoFBody, GoesOnWhenItIsEdited)
{
    Floating ball(sixDoF(density*volume, "velocity (1 2 3); omega (1 0 0);"));
    for (int step = 1; step <= 2; ++step) ball.body.advance(step*0.1, 0.1, {{0.7, 0.3, 0.1}, {0.2, 0.9, 0.4}}, {0, 0, -9.81}, added);
    const SixDoFState before = ball.body.state();
    Floating edited(sixDoF(2*density*volume, "velocity (1 2 3); omega (1 0 0); translations (z); rotations ();"));
    edited.body.refuseOtherStart(ball.body);
    edited.body.goOn(before);
    EXPECT_EQ(edited.body.centre(), ball.body.centre());
    EXPECT_EQ(edited.body.state().velocity, Vector3(0, 0, before.velocity.z));
    EXPECT_EQ(edited.body.state().omega, Vector3());
    for (const std::string& start : {"velocity (1 2 4); omega (1 0 0);", "velocity (1 2 3); omega (0 0 0);"})
    {
        const std::string message = messageOf([&] { Floating(sixDoF(density*volume, start)).body.refuseOtherStart(ball.body); });
        EXPECT_NE(message.find("which is that of its start"), std::string::npos) << message;
        EXPECT_NE(message.find("constant/walls at line"), std::string::npos) << message;
    }
}

// The numbers of a time folder, for programs and restarts, are those that were written, to the bit.
TEST(SixDoFBody, GoesOnFromATimeFolder)
{
    Floating ball(sixDoF(density*volume, "velocity (0.1 0.2 0.3); omega (1 2 3);"));
    for (int step = 1; step <= 3; ++step) ball.body.advance(step*0.1, 0.1, {{0.7, 0.3, 0.1}, {0.2, 0.9, 0.4}}, {0, 0, -9.81}, added);
    std::ostringstream text;
    text.precision(17);
    SixDoFState::forEach(ball.body.state(), "ball", [&](const std::string& name, double number) { text << name << ' ' << number << ";\n"; });
    ball.folder.write("0.3/uniform/liquid", text.str());
    const WallMotions motions = WallMotions::read(ball.folder.path());
    SixDoFState again = motions.body()->storedAt(0.3).value();
    std::vector<double> numbers;
    SixDoFState::forEach(again, "", [&](const std::string&, double number) { numbers.push_back(number); });
    std::size_t k = 0;
    SixDoFState::forEach(ball.body.state(), "", [&](const std::string& name, double number) { EXPECT_EQ(numbers.at(k++), number) << name; });
    const std::vector<AnalyticSurface> surfaces = readAnalyticSurfaces(ball.folder.path(), 0.3);
    EXPECT_LT(length(surfaces.at(0).point - ball.body.centre()), 1e-15);
    EXPECT_LT(length(readAnalyticSurfaces(ball.folder.path(), 0.2).at(0).point - Vector3(0.02, 0.04, 1.06)), 1e-15);      // no folder: as it started
}

TEST(SixDoFBody, RefusesWhatCannotBe)
{
    const std::string good = sixDoF(1);
    EXPECT_NE(refusal(sphere("type sixDoF; mass 0; momentOfInertia 1; centreOfMass (0 0 1);")).find("mass"), std::string::npos);
    EXPECT_NE(refusal(sphere("type sixDoF; mass 1; momentOfInertia -1; centreOfMass (0 0 1);")).find("momentOfInertia"), std::string::npos);
    EXPECT_NE(refusal(sphere(good + "translations (x w);")).find("Unknown axis 'w'"), std::string::npos);
    EXPECT_NE(refusal(sphere(good, "inside")).find("a sphere with liquid inside"), std::string::npos);
    const std::string plane = refusal("floor\n{\n    type plane; point (0 0 0); normal (0 0 1);\n    motion { " + good + " }\n}");
    EXPECT_NE(plane.find("of type 'plane'"), std::string::npos) << plane;
    EXPECT_NE(plane.find("constant/walls at line 4"), std::string::npos) << plane;
    const std::string two = refusal(sphere(good) + "other { type sphere; centre (1 0 1); radius 0.1; liquid outside; motion { " + good + " } }");
    EXPECT_NE(two.find("'other' is a second body"), std::string::npos) << two;
    EXPECT_NE(refusal(sphere("type sixDoFRigidBodyMotion;")).find("`type sixDoF;`"), std::string::npos);
    EXPECT_NE(refusal(sphere("type oscillatingLinearMotion;")).find("`type oscillation;`"), std::string::npos);
}

TEST(SixDoFBody, RefusesWhatIsTooLight)
{
    Floating light(sixDoF(0.9*SixDoFBody::least*density*volume)), heavy(sixDoF(1.1*SixDoFBody::least*density*volume));
    const std::string message = messageOf([&] { light.body.refuseLight(density); });
    EXPECT_NE(message.find("a density of 18 kg/m3"), std::string::npos) << message;
    EXPECT_NE(message.find("constant/walls at line 4"), std::string::npos) << message;
    heavy.body.refuseLight(density);
}

}
