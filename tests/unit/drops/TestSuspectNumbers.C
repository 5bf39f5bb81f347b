// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/SuspectNumbers.H"

#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

namespace shizuku::test
{

namespace
{

// A case of water, with what is changed of it. What is said of it.
std::vector<std::string> said(const std::vector<std::pair<std::string, std::string>>& files)
{
    const ScratchFolder folder;
    folder.write("system/solution", "spacing 1e-4;");
    folder.write("constant/liquidProperties", "rho 998; nu 1e-6; sigma 0.0728;");
    folder.write("constant/models", "surfaceTension laplacePressure;");
    folder.write("constant/wettability", "floor { theta 60; }");
    for (const auto& [file, text] : files) folder.write(file, text);
    std::vector<std::string> texts;
    for (const Suspect& suspect : suspectEntries(folder.path())) texts.push_back(suspect.text);
    return texts;
}

std::vector<std::string> saidOfWalls(const std::string& wettability) { return said({{"constant/wettability", wettability}}); }

void expectOne(const std::vector<std::string>& texts, const std::vector<std::string>& parts)
{
    ASSERT_EQ(texts.size(), 1u);
    EXPECT_TRUE(holds(texts.front(), parts));
}

}

TEST(SuspectNumbers, NothingIsSaidOfWaterNorOfFilesThatAreNotThere)
{
    EXPECT_TRUE(said({}).empty());
    EXPECT_TRUE(suspectEntries(ScratchFolder().path()).empty());
    EXPECT_TRUE(said({{"constant/liquidProperties", "rho water; sigma"}}).empty());         // whoever needs it refuses it
    EXPECT_TRUE(said({{"constant/liquidProperties", "rho 998; nu 0; sigma 0;"}}).empty());
}

TEST(SuspectNumbers, PropertiesOfNoLiquid)
{
    expectOne(said({{"constant/liquidProperties", "rho 998; nu 1e-6; sigma 72.8;"}}), {"sigma is 72.8 N/m: is that meant? Water has 0.0728 N/m"});
    expectOne(said({{"constant/liquidProperties", "rho 0.998; nu 1e-6; sigma 0.0728;"}}), {"rho is 0.998 kg/m3", "998"});
    expectOne(said({{"constant/liquidProperties", "rho 998; nu 1e-9; sigma 0.0728;"}}), {"nu is 1e-09 m2/s"});
}

TEST(SuspectNumbers, AnglesInRadians)
{
    expectOne(saidOfWalls("floor { theta 1.2; }"), {"theta of 'floor' is 1.2 degrees", "radians are 68.75"});
    expectOne(saidOfWalls("floor { theta 2.618; } lid { theta 90; }"), {"'floor' is 2.618", "are 150 degrees"});
    expectOne(saidOfWalls("floor { type stripes; theta (0.5 2); }"), {"'floor' is 2 degrees"});
    expectOne(saidOfWalls("floor { law hysteresis; thetaAdv 2; thetaRec 1; }"), {"thetaAdv of 'floor' is 2 degrees"});
    EXPECT_TRUE(saidOfWalls("floor { theta 0; } a { theta 5; } b { type stripes; theta (2 90); } c { type expression; theta \"60 + x\"; }").empty());
}

// sqrt(0.0728/(998*9.81)) = 2.73 mm.
TEST(SuspectNumbers, SpacingsOfCasesInMillimetres)
{
    expectOne(said({{"system/solution", "spacing 0.1;"}}), {"The spacing of 0.1 m", "0.00272", "millimetres"});
    EXPECT_TRUE(said({{"system/solution", "spacing 0.0027;"}}).empty());
    EXPECT_TRUE(said({{"system/solution", "spacing 0.1;"}, {"constant/models", "surfaceTension none;"}}).empty());
}

// A drop of 2 mm: 50 diameters are 0.1 m.
TEST(SuspectNumbers, ADropFarFromEveryWall)
{
    const auto saidOf = [](double height, const std::string& walls, const std::vector<Vector3>& solid)
    {
        SeparateBody drop;
        drop.low = {-1e-3, -1e-3, height - 1e-3};
        drop.high = {1e-3, 1e-3, height + 1e-3};
        drop.volume = 4.19e-9;
        return suspectPlaces("case", {drop}, readAnalyticSurfaces(Dictionary::parse(walls)), solid);
    };
    const std::string floor = "floor { type plane; point (0 0 0); normal (0 0 1); }";
    const auto far = saidOf(5, floor, {});
    ASSERT_EQ(far.size(), 1u);
    EXPECT_TRUE(holds(far.front().text, {"The liquid is 4.99", "m from every wall, 249", "velocity"}));
    EXPECT_EQ(saidOf(5, "", {{0, 0, 0}}).size(), 1u);
    EXPECT_TRUE(saidOf(0.1, floor, {}).empty());
    EXPECT_TRUE(saidOf(5, floor, {{0, 0, 4.95}}).empty());
    EXPECT_TRUE(saidOf(5, "", {}).empty());
}

}
