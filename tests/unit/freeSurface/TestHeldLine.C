// SPDX-License-Identifier: GPL-3.0-or-later
// Contact lines that walls hold: a block on a floor, whose faces in front and behind meet it along straight lines.

#include "freeSurface/HeldLine.H"

#include "core/angles/Degrees.H"
#include "models/Models.H"
#include "support/LiquidCase.H"

#include <gtest/gtest.h>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr int along = 14, across = 15, layers = 8;

// Degrees that a line of that angle turns by where the surface moves by so many spacings: l + z/sin^2 theta of HeldLine.C.
double turned(double theta, double by) { return degrees(by/(0.1 + 0.8/std::pow(std::sin(radians(theta)), 2))); }

class HeldBlock : public LiquidCase
{
public:
    explicit HeldBlock(bool sampled, const std::string& law) : LiquidCase(textOf(sampled, law)), line(liquid)
    {
        surface.require(liquid, 3.25f, 0);
        surface.hold(line.angle());
        useWalls();
        place(latticeBlock(along, across, layers, 1, {-0.5f * (along - 1), -0.5f * (across - 1), 0.5f}));
    }

    // A step in which all of it moves along x by so many spacings.
    void move(scalar by)
    {
        constexpr scalar dt = 0.01f;
        liquid.velocity.upload(std::vector<Vec3>(liquid.owned(), Vec3{by * liquid.spacing() / dt, 0, 0}));
        line.advance(liquid, near, walls, surface, dt);
    }

    // Degrees, of the lowest particle in the middle of the line in front, or behind.
    double angle(bool front) const
    {
        const auto angles = inOrder(line.angle());
        const auto places = inOrder(liquid.position);
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            const Vec3 p = 1 / liquid.spacing() * places[i];
            if (fabs(p.y) < 0.1f && p.z < 0.6f && fabs(p.x - (front ? 0.5f : -0.5f) * (along - 1)) < 0.1f) return degrees(double(angles[i]));
        }
        return -1;
    }

    HeldLine line;

private:
    static CaseText textOf(bool sampled, const std::string& law)
    {
        CaseText text = caseOnWettedFloor(sampled, 35, 35);
        text.wettability = "floor { " + law + " }";
        return text;
    }
};

const std::string hysteresis = "law hysteresis; thetaAdv 100; thetaRec 60;";
// Of a line that nothing has moved: 60 on the floor of solid particles, whose file says so; the middle of the cosines of both on a plane.
double atRest(bool sampled) { return sampled ? 60 : degrees(std::acos(0.5 * (std::cos(radians(100.0)) + std::cos(radians(60.0))))); }

}

// By the way over the length of the spring. Neighbours along the line move alike; those of corners are farther than they are read.
TEST(HeldLine, AnglesFollowTheWayOfTheLine)
{
    HeldBlock block(false, hysteresis);
    block.move(0.03f);
    const double by = turned(atRest(false), 0.03);
    EXPECT_NEAR(block.angle(true), atRest(false) + by, 0.02 * by);
    EXPECT_NEAR(block.angle(false), atRest(false) - by, 0.02 * by);
}

TEST(HeldLine, WhatIsHeldComesBackToItsPlace)
{
    HeldBlock block(false, hysteresis);
    block.move(0);
    const double before = block.angle(true);
    EXPECT_NEAR(before, atRest(false), 1e-4);
    block.move(0.05f);
    EXPECT_GT(block.angle(true), before + 2);
    block.move(-0.05f);
    EXPECT_NEAR(block.angle(true), before, 0.05);       // the step back is by the sine at its own start, 1.4 % off 3 degrees
}

// Far beyond both limits; then the way back begins at the limit.
TEST(HeldLine, SlipsAtItsLimits)
{
    for (const bool sampled : {false, true})
    {
        HeldBlock block(sampled, hysteresis);
        for (int step = 0; step < 3; ++step) block.move(1);
        EXPECT_NEAR(block.angle(true), 100, 1e-3) << sampled;
        EXPECT_NEAR(block.angle(false), 60, 1e-3) << sampled;
        block.move(-0.03f);
        EXPECT_NEAR(block.angle(true), 100 - turned(100, 0.03), 0.04) << sampled;
    }
}

TEST(HeldLine, BordersOfSampledWallsAreThoseOfTheirSolidParticles)
{
    HeldBlock block(true, "law hysteresis; thetaAdv { type expression; theta \"x > 0 ? 120 : 100\"; } thetaRec { type expression; theta \"x > 0 ? 80 : 40\"; }");
    for (int step = 0; step < 3; ++step) block.move(1);
    EXPECT_NEAR(block.angle(true), 120, 1e-3);
    EXPECT_NEAR(block.angle(false), 40, 1e-3);
}

// uTheta is a tenth of the speed at which it moves: but for the filter the limit is that of fast lines, tanh(10) of the way.
TEST(HeldLine, LimitsFollowTheSpeed)
{
    HeldBlock still(false, "law dynamic; theta0 80; thetaAdv 110; thetaRec 60; uTheta 1e-3;");
    for (int step = 0; step < 5; ++step) still.move(0);
    EXPECT_NEAR(still.angle(true), 80, 1e-3);
    for (int step = 0; step < 200; ++step) still.move(1);
    EXPECT_NEAR(still.angle(true), 110, 0.1);
    EXPECT_NEAR(still.angle(false), 60, 0.1);
}

// The wall's own angle counts inside of the liquid and far away from the line.
TEST(HeldLine, OthersHaveNone)
{
    HeldBlock block(false, hysteresis);
    block.move(0.03f);
    const auto angles = block.inOrder(block.line.angle());
    const auto places = block.inOrder(block.liquid.position);
    int none = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        const Vec3 p = 1 / block.liquid.spacing() * places[i];
        if (p.z < 5.1f) continue;                   // a support of the surface and more away from the floor
        EXPECT_EQ(angles[i], 0);
        ++none;
    }
    EXPECT_EQ(none, along * across * 3);
}

// Models hold lines where walls have laws, need a surface that goes on into walls, and ask for nothing else.
TEST(HeldLine, IsMadeWhereWallsHaveLaws)
{
    const auto made = [](const std::string& wettability, const std::string& tensionAndWetting)
    {
        LiquidCase block({.walls = floorPlane, .wettability = wettability});
        block.folder.write("constant/models", "pressure completedPbf; viscosity none; bodyForce none; " + tensionAndWetting);
        const Models models(block.folder.path(), Dictionary::parse("pressure { maxIterations 3; }"), block.liquid, block.walls);
        return models.heldLine.has_value() && block.liquid.fields().find("contactLineAngle");
    };
    const std::string continued = "surfaceTension laplacePressure; wetting extendedSurface;", pairs = "surfaceTension Fujisawa2014; wetting contactAngle;";
    EXPECT_FALSE(made("floor { theta 60; }", continued));
    EXPECT_TRUE(made("floor { " + hysteresis + " }", continued));
    EXPECT_TRUE(holds(messageOf([&] { made("floor { " + hysteresis + " }", pairs); }), {"constant/models", "extendedSurface", "constant"}));
}
