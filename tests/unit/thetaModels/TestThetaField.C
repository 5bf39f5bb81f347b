// SPDX-License-Identifier: GPL-3.0-or-later
#include "thetaModels/ThetaField.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

namespace shizuku::test
{

namespace
{

SolidParticles twoPatches()
{
    SolidParticles solid;
    solid.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    solid.normals.assign(3, {0, 0, 1});
    solid.patch = {0, 1, 0};
    solid.patches = {"floor", "ramp"};
    return solid;
}

std::vector<double> theta(const std::string& wettability, const std::vector<AnalyticSurface>& walls = {})
{
    return thetaField(twoPatches(), walls, Dictionary::parse(wettability, "constant/wettability"), {});
}

// At places of the x axis [m], on a patch with the given entries.
std::vector<double> along(const std::vector<double>& places, const std::string& entries)
{
    SolidParticles solid;
    for (const double x : places) solid.positions.emplace_back(x, 0, 0);
    solid.normals.assign(places.size(), {0, 0, 1});
    solid.patch.assign(places.size(), 0);
    solid.patches = {"floor"};
    return thetaField(solid, {}, Dictionary::parse("floor\n{\n" + entries + "\n}", "constant/wettability"), {});
}

using Angles = std::vector<double>;

}

TEST(ThetaField, EveryParticleHasTheAngleOfItsPatch)
{
    const std::vector<double> expected{60, 120, 60};
    EXPECT_EQ(theta("floor { theta 60; } ramp { type constant; theta 120; }"), expected);
    EXPECT_EQ(theta("\"flo.*\" { theta 60; } ramp { theta 120; }"), expected);
}

TEST(ThetaField, AnalyticWallsMayHaveAnglesToo)
{
    AnalyticSurface lid;
    lid.name = "lid";
    EXPECT_NO_THROW(theta("floor { theta 0; } ramp { theta 180; } lid { theta 90; }", {lid}));
    EXPECT_TRUE(holds(messageOf([&] { theta("floor { theta 0; } ramp { theta 180; }", {lid}); }), {"'lid'"}));
    EXPECT_TRUE(holds
    (
        messageOf([&] { theta("floor { theta 0; } ramp { theta 180; }\nlid { type expression; theta x; }", {lid}); }),
        {"'lid'", "type expression", "type particles", "2"}
    ));
}

TEST(ThetaField, BadEntriesAreRefused)
{
    const std::string good = "floor { theta 60; }\n";
    EXPECT_TRUE(holds(messageOf([&] { theta(good); }), {"'ramp'", "wettability"}));
    EXPECT_TRUE(holds
    (
        messageOf([&] { theta(good + "ramp { theta 1; }\nrmap { theta 1; }"); }), {"'rmap'", "floor", "ramp", "3"}
    ));
    EXPECT_TRUE(holds(messageOf([&] { theta(good + "ramp { theta 181; }"); }), {"181", "0 to 180", "2"}));
    EXPECT_TRUE(holds(messageOf([&] { theta(good + "ramp { theta -1; }"); }), {"-1", "0 to 180"}));
    EXPECT_TRUE(holds(messageOf([&] { theta(good + "ramp { type striped; theta 1; }"); }), {"striped", "constant"}));
    EXPECT_TRUE(holds(messageOf([&] { theta(good + "ramp { theta 1; angle 2; }"); }), {"angle"}));
}

TEST(ThetaField, StripesHaveDirectionPeriodDutyAndPhase)
{
    const std::string stripes = "type stripes; theta (30 110); direction (2 0 0); period 4;";
    EXPECT_EQ(along({0, 1.9, 2, 3.9, 4, -0.1, -2.1}, stripes), (Angles{30, 30, 110, 110, 30, 110, 30}));
    EXPECT_EQ(along({0, 0.9, 1, 3.9, 4}, stripes + "duty 0.25;"), (Angles{30, 30, 110, 110, 30}));
    // A stripe in the middle of x = 0.
    EXPECT_EQ(along({-1.1, -0.9, 0.9, 1.1}, stripes + "phase -0.25;"), (Angles{110, 30, 30, 110}));
    EXPECT_EQ(along({0, 2}, stripes + "duty 1;"), (Angles{30, 30}));
    // Across the diagonal of x and y: sqrt(2) times as long on the x axis.
    const std::string diagonal = "type stripes; theta (30 110); direction (1 1 0); period 4;";
    EXPECT_EQ(along({2.8, 2.9, 5.6, 5.7}, diagonal), (Angles{30, 110, 110, 30}));

    EXPECT_TRUE(holds(messageOf([&] { along({0}, "type stripes; theta 30; direction (1 0 0); period 1;"); }), {"theta"}));
    EXPECT_TRUE(holds
    (
        messageOf([&] { along({0}, "type stripes;\ntheta (30 60 90); direction (1 0 0); period 1;"); }),
        {"3 angles", "two of them", "4"}
    ));
    EXPECT_TRUE(holds
    (
        messageOf([&] { along({0}, "type stripes;\ntheta (30 200); direction (1 0 0); period 1;"); }), {"200", "0 to 180"}
    ));
    EXPECT_TRUE(holds(messageOf([&] { along({0}, stripes + "duty 1.5;"); }), {"duty", "1.5", "0 to 1"}));
    EXPECT_TRUE(holds(messageOf([&] { along({0}, stripes + "width 1;"); }), {"width", "period"}));
    EXPECT_TRUE(holds
    (
        messageOf([&] { along({0}, "type stripes; theta (3 4); direction (0 0 0); period 1;"); }), {"no direction"}
    ));
    EXPECT_TRUE(holds
    (
        messageOf([&] { along({0}, "type stripes; theta (3 4); direction (1 0 0); period 0;"); }), {"period", "> 0"}
    ));
}

TEST(ThetaField, ChecksAreStripesThatCross)
{
    SolidParticles solid;
    for (const double y : {0.5, 1.5})
    {
        for (const double x : {0.5, 1.5, 2.5}) solid.positions.emplace_back(x, y, 0);
    }
    solid.normals.assign(6, {0, 0, 1});
    solid.patch.assign(6, 0);
    solid.patches = {"floor"};
    const std::string text =
        "floor { type checks; theta (30 110); rows { direction (0 1 0); period 2; }"
        " columns { direction (1 0 0); period 2; } }";
    EXPECT_EQ(thetaField(solid, {}, Dictionary::parse(text), {}), (Angles{30, 110, 30, 110, 30, 110}));
    EXPECT_TRUE(holds
    (
        messageOf([&] { along({0}, "type checks; theta (1 2); rows { direction (0 1 0); period 2; }"); }), {"'columns'"}
    ));
}

TEST(ThetaField, RegionsAreShapesAndTheLastOneCounts)
{
    const std::string regions =
        "type regions; theta 90; regions { band { type box; min (1 -1 -1); max (3 1 1); theta 60; }"
        " spot { type sphere; centre (3 0 0); radius 0.5; theta 30; } }";
    EXPECT_EQ(along({0, 1.5, 2.4, 2.6, 3.4, 3.6}, regions), (Angles{90, 60, 60, 30, 30, 90}));
    EXPECT_TRUE(holds
    (
        messageOf([&] { along({0}, "type regions; theta 9; regions { a { type ball; } }"); }),
        {"Unknown region model 'ball'", "sphere", "cylinder", "ellipsoid"}
    ));
    EXPECT_TRUE(holds(messageOf([&] { along({0}, "type regions; theta 9; regions { }"); }), {"no region"}));
    EXPECT_TRUE(holds
    (
        messageOf([&] { along({0}, "type regions; theta 9; regions { a { type sphere; centre (0 0 0); radius 1; } }"); }),
        {"'theta' is missing"}
    ));
}

TEST(ThetaField, ExpressionsAreFormulasOfThePlace)
{
    EXPECT_EQ(along({0, 0.25, 0.5}, "type expression; theta \"90 + $swing*sin(2*pi*x)\"; swing 30;"), (Angles{90, 120, 90}));
    EXPECT_EQ(along({-1, 3}, "type expression; theta \"if(x < 0, 20, min(60*x, 150))\";"), (Angles{20, 150}));
    const std::string bad = "type expression;\ntheta ";
    EXPECT_TRUE(holds
    (
        messageOf([&] { along({0, 2}, bad + "\"100*x\";"); }), {"is 200 at (2 0 0)", "100*x", "0 to 180", "line 4"}
    ));
    EXPECT_TRUE(holds(messageOf([&] { along({0}, bad + "\"100*u\";"); }), {"Unknown name 'u'", "line 4"}));
    EXPECT_TRUE(holds(messageOf([&] { along({0}, bad + "\"1/x\";"); }), {"Division by zero", "1/x"}));
    EXPECT_TRUE(holds(messageOf([&] { along({0}, bad + "\"100*x +\";"); }), {"too early"}));
    EXPECT_TRUE(holds(messageOf([&] { along({0}, bad + "\"$swing*x\";"); }), {"'swing' is missing"}));
    EXPECT_TRUE(holds(messageOf([&] { along({0}, bad + "\"x\"; swing 1;"); }), {"swing"}));
}

}
