// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/LineState.H"

#include "core/angles/Degrees.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr double spacing = 1e-4, lineRadius = 1e-3;

// A circle in 36 parts of the same length. A particle is half a spacing inside and above each.
struct Circle
{
    std::vector<LineTangent> line;
    std::vector<Vector3> particles;

    Circle()
    {
        for (int k = 0; k < 36; ++k)
        {
            const double azimuth = radians(10.0*k + 5);
            const Vector3 outward{std::cos(azimuth), std::sin(azimuth), 0};
            line.push_back({lineRadius*outward, outward, 90, lineRadius*radians(10.0)});
            particles.push_back((lineRadius - 0.5*spacing)*outward + Vector3{0, 0, 0.5*spacing});
        }
    }

    // Degrees at the azimuth of each particle.
    template<class Angle>
    HeldAngles held(const Angle& angle) const
    {
        std::vector<double> angles;
        for (int k = 0; k < 36; ++k) angles.push_back(radians(angle(10.0*k + 5)));
        return HeldAngles::of(particles, angles);
    }
};

class LineStateCase : public testing::Test
{
protected:
    LineLaw lawOf(const std::string& entries) const
    {
        folder_.write("constant/wettability", "floor { " + entries + " }\n");
        LineLaw law(folder_.path(), "floor");
        law.read();
        return law;
    }

    LineState stateOf(const std::string& entries, double angle) const
    {
        return lawOf(entries).stateOf(circle_.line, circle_.held([&](double) { return angle; }), spacing);
    }

    ScratchFolder folder_;
    Circle circle_;
};

const std::string hysteresis = "law hysteresis; thetaAdv 100; thetaRec 60;";

}

// A quarter at 100, a third at 60, the rest between: sums of equal lengths, to rounding.
TEST_F(LineStateCase, SharesAreThoseOfItsLength)
{
    const auto angle = [](double azimuth) { return azimuth < 90 ? 100.0 : azimuth < 210 ? 60.0 : 80.0; };
    const LineState state = lawOf(hysteresis).stateOf(circle_.line, circle_.held(angle), spacing);
    EXPECT_NEAR(state.advancing, 0.25, 1e-12);
    EXPECT_NEAR(state.receding, 1.0/3, 1e-12);
    EXPECT_NEAR(state.held, 1 - 0.25 - 1.0/3, 1e-12);
    EXPECT_NEAR(state.theta, 0.25*100 + 60.0/3 + 80*(1 - 0.25 - 1.0/3), 1e-9);
}

// A degree inside of limits that are apart, a degree outside of the one angle of a law without hysteresis.
TEST_F(LineStateCase, ADegreeIsNoise)
{
    EXPECT_EQ(stateOf(hysteresis, 99.1).advancing, 1);
    EXPECT_EQ(stateOf(hysteresis, 98.9).held, 1);
    EXPECT_EQ(stateOf(hysteresis, 60.9).receding, 1);
    EXPECT_EQ(stateOf(hysteresis, 61.1).held, 1);
    const std::string one = "law kistler; theta0 60;";
    EXPECT_EQ(stateOf(one, 61.1).advancing, 1);
    EXPECT_EQ(stateOf(one, 60.9).held, 1);
    EXPECT_EQ(stateOf(one, 58.9).receding, 1);
    EXPECT_EQ(stateOf("law coxVoinov; thetaAdv 100; thetaRec 60;", 120).advancing, 1);
    EXPECT_EQ(stateOf("law dynamic; theta0 80; thetaAdv 100; thetaRec 60; uTheta 1;", 90).advancing, 1);
}

// Where limits depend on the place, those at the line count: half of it has 100, the other 120.
TEST_F(LineStateCase, LimitsAreThoseAtThePlace)
{
    const LineLaw law = lawOf("law hysteresis; thetaRec 60; thetaAdv { type stripes; theta (100 120); direction (1 0 0); period 10e-3; }");
    const LineState state = law.stateOf(circle_.line, circle_.held([](double) { return 100.0; }), spacing);
    EXPECT_NEAR(state.advancing + state.held, 1, 1e-12);
    EXPECT_GT(state.advancing, 0.3);
    EXPECT_GT(state.held, 0.3);
}

TEST_F(LineStateCase, UnknownWithoutALawOrAngles)
{
    const LineLaw constant = lawOf("theta 60;"), law = lawOf(hysteresis);
    EXPECT_FALSE(constant.isThere());
    EXPECT_TRUE(law.isThere());
    const HeldAngles all = circle_.held([](double) { return 80.0; });
    EXPECT_TRUE(std::isnan(constant.stateOf(circle_.line, all, spacing).held));
    EXPECT_TRUE(std::isnan(law.stateOf(circle_.line, circle_.held([](double) { return 0.0; }), spacing).held));
    EXPECT_TRUE(std::isnan(law.stateOf({}, all, spacing).held));

    // Zero is no angle: the half of the line without particles does not count, but for what two spacings reach, 12 degrees at either end.
    const LineState half = law.stateOf(circle_.line, circle_.held([](double azimuth) { return azimuth < 180 ? 100.0 : 0.0; }), spacing);
    EXPECT_EQ(half.advancing, 1);
    EXPECT_NEAR(half.theta, 100, 1e-9);
}
