#include "geometry/thetaModels/ThetaField.H"
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
    return thetaField(twoPatches(), walls, Dictionary::parse(wettability, "constant/wettability"));
}

}

TEST(ThetaField, everyParticleHasTheAngleOfItsPatch)
{
    const std::vector<double> expected{60, 120, 60};
    EXPECT_EQ(theta("floor { theta 60; } ramp { type constant; theta 120; }"), expected);
    EXPECT_EQ(theta("\"flo.*\" { theta 60; } ramp { theta 120; }"), expected);
}

TEST(ThetaField, analyticWallsMayHaveAnglesToo)
{
    AnalyticSurface lid;
    lid.name = "lid";
    EXPECT_NO_THROW(theta("floor { theta 0; } ramp { theta 180; } lid { theta 90; }", {lid}));
    EXPECT_TRUE(holds(messageOf([&] { theta("floor { theta 0; } ramp { theta 180; }", {lid}); }), {"'lid'"}));
}

TEST(ThetaField, badEntriesAreRefused)
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

}
