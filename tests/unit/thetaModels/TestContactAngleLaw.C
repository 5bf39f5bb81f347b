// SPDX-License-Identifier: GPL-3.0-or-later
#include "thetaModels/LineLaws.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <cmath>

namespace shizuku::test
{

namespace
{

// Water on particles of 0.1 mm.
constexpr LineScales water{1e-4, 1e-3, 0.072};

std::unique_ptr<ContactAngleLaw> law(const std::string& entries)
{
    return readLaw(Dictionary::parse("floor\n{\n" + entries + "\n}", "constant/wettability").subDict("floor"), {});
}

ContactAngleLaw::Limits limitsOf(const std::string& entries, double speed)
{
    const auto of = law(entries);
    return of->limits(of->at({}), speed, water);
}

std::string refusal(const std::string& entries)
{
    return messageOf([&] { law(entries); });
}

}

TEST(ContactAngleLaw, ConstantAnglesAskForNone)
{
    EXPECT_EQ(law("theta 60;"), nullptr);
    EXPECT_EQ(law("law constant; type stripes; theta (30 110); direction (1 0 0); period 1;"), nullptr);
}

TEST(ContactAngleLaw, HysteresisHoldsBetweenItsAnglesAtAnySpeed)
{
    for (const double speed : {-1.0, 0.0, 1.0}) EXPECT_EQ(limitsOf("law hysteresis; thetaAdv 100; thetaRec 60;", speed), std::pair(60.0, 100.0));
    // cos theta = (cos 120 + cos 60)/2 = 0
    EXPECT_NEAR(law("law hysteresis; thetaAdv 120; thetaRec 60;")->at({}).theta, 90, 1e-9);
    EXPECT_EQ(law("law hysteresis; thetaAdv 120; thetaRec 60;")->typicalSpeed(water), 0);
}

TEST(ContactAngleLaw, AnglesMayBeDistributions)
{
    const auto of = law("law hysteresis; thetaAdv { type stripes; theta (100 130); direction (1 0 0); period 2; } thetaRec { type expression; theta \"60 + x\"; }");
    EXPECT_FALSE(of->isUniform());
    EXPECT_EQ(of->at({0.5, 0, 0}).advancing, 100);
    EXPECT_EQ(of->at({0.5, 0, 0}).receding, 60.5);
    EXPECT_EQ(of->at({1.5, 0, 0}).advancing, 130);
    EXPECT_TRUE(holds(messageOf([&] { of->at({50.5, 0, 0}); }), {"not in order", "thetaRec 110.5", "thetaAdv 100", "50.5", "wettability"}));
}

// Fast lines reach the angles that are given, each on its own side.
TEST(ContactAngleLaw, DynamicGoesFromRestToItsLimits)
{
    const std::string entries = "law dynamic; theta0 80; thetaAdv 110; thetaRec 70; uTheta 0.1;";
    EXPECT_EQ(limitsOf(entries, 0), std::pair(80.0, 80.0));
    EXPECT_NEAR(limitsOf(entries, 10).second, 110, 1e-9);
    EXPECT_NEAR(limitsOf(entries, -10).first, 70, 1e-9);
    EXPECT_NEAR(limitsOf(entries, 0.1).second, 80 + 30 * std::tanh(1.0), 1e-9);
    EXPECT_NEAR(limitsOf(entries, -0.1).first, 80 - 10 * std::tanh(1.0), 1e-9);
}

// 9 Ca ln(d/b) at Ca = 0.01 and d/b = 1e5: 1.0362 radians cubed.
TEST(ContactAngleLaw, CoxVoinovBendsBySign)
{
    const std::string entries = "law coxVoinov; theta0 60; slipLength 1e-9;";
    const double degree = std::acos(-1.0) / 180, cube = std::pow(60 * degree, 3), more = 0.09 * std::log(1e5);
    EXPECT_NEAR(limitsOf(entries, 0.72).second, std::cbrt(cube + more) / degree, 1e-9);
    EXPECT_NEAR(limitsOf(entries, -0.72).first, std::cbrt(cube - more) / degree, 1e-9);
    EXPECT_EQ(limitsOf(entries, -7.2).first, 0);
    EXPECT_EQ(limitsOf("law coxVoinov; thetaAdv 80; thetaRec 40;", 0), std::pair(40.0, 80.0));
}

// Hoffman's function at Ca = 0.01 and 0.1 from none: 52.464 and 117.412 degrees, from its formula by hand.
TEST(ContactAngleLaw, KistlerIsHoffmansFunction)
{
    EXPECT_NEAR(limitsOf("law kistler; theta0 0;", 0.72).second, 52.4637, 1e-3);
    EXPECT_NEAR(limitsOf("law kistler; theta0 0;", 7.2).second, 117.4117, 1e-3);
    EXPECT_NEAR(limitsOf("law kistler; theta0 52.4637;", 0).second, 52.4637, 1e-6);
    EXPECT_EQ(limitsOf("law kistler; theta0 52.4637;", -0.73).first, 0);
}

TEST(ContactAngleLaw, BadEntriesAreRefused)
{
    EXPECT_TRUE(holds(refusal("law hysteresys; thetaAdv 100; thetaRec 60;"), {"hysteresys", "hysteresis", "coxVoinov", "dynamic", "kistler", "3"}));
    EXPECT_TRUE(holds(refusal("law hysteresis; thetaAdv 60; thetaRec 100;"), {"not in order", "thetaRec 100", "thetaAdv 60", "thetaRec <= thetaAdv", "3"}));
    EXPECT_TRUE(holds(refusal("law hysteresis; thetaAdv 190; thetaRec 100;"), {"190", "0 to 180"}));
    EXPECT_TRUE(holds(refusal("law hysteresis; thetaAdv 100;"), {"thetaRec"}));
    EXPECT_TRUE(holds(refusal("law dynamic; theta0 120; thetaAdv 110; thetaRec 70; uTheta 1;"), {"not in order", "theta0 120", "thetaRec <= theta0 <= thetaAdv"}));
    EXPECT_TRUE(holds(refusal("law dynamic; theta0 90; thetaAdv 110; thetaRec 70; uTheta 0;"), {"uTheta"}));
    EXPECT_TRUE(holds(refusal("law coxVoinov; theta0 60; thetaAdv 70; thetaRec 50;"), {"theta0", "thetaAdv"}));
    EXPECT_TRUE(holds(refusal("law coxVoinov; theta0 60; slipLength -1;"), {"slipLength"}));
}

TEST(ContactAngleLaw, ALawThatIsNamedByTypeIsAnsweredWithTheKeyword)
{
    for (const std::string law : {"hysteresis", "coxVoinov", "kistler", "dynamic"})
    {
        EXPECT_TRUE(holds(refusal("type " + law + "; thetaAdv 80; thetaRec 50;"), {law, "law " + law + "; in place of type"}));
    }
}

TEST(ContactAngleLaw, AnglesOfALawNeedOne)
{
    EXPECT_TRUE(holds(refusal("theta 70; thetaAdv 80;"), {"thetaAdv", "none is named", "law hysteresis"}));
}

TEST(ContactAngleLaw, OpenFOAMsWordsAreAnsweredWithTheLaw)
{
    EXPECT_TRUE(holds(refusal("type dynamicAlphaContactAngle; theta0 90; uTheta 1; thetaA 70; thetaR 110;"), {"OpenFOAM", "law dynamic", "thetaAdv"}));
    for (const std::string type : {"constantAlphaContactAngle", "alphaContactAngle", "temperatureDependentAlphaContactAngle"})
    {
        EXPECT_TRUE(holds(refusal("type " + type + "; theta0 90;"), {"OpenFOAM", "theta 60"}));
    }
    EXPECT_TRUE(holds(refusal("type contactAngle; contactAngle { type constant; theta0 60; }"), {"OpenFOAM", "theta 60"}));
    EXPECT_TRUE(holds(refusal("type dynamicKistlerAlphaContactAngle; theta0 60;"), {"OpenFOAM", "law kistler; theta0 60"}));
}

}
