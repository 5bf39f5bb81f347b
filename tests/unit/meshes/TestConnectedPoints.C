// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/ConnectedPoints.H"
#include "drops/MotionWarnings.H"
#include "drops/SeparateBodies.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shizuku::test
{

namespace
{

// n^3 points a distance of 1 apart, the first one at x.
void addCube(std::vector<Vector3>& points, int n, const Vector3& x)
{
    for (int i = 0; i < n; ++i)
    {
        for (int j = 0; j < n; ++j)
        {
            for (int k = 0; k < n; ++k) points.push_back(x + Vector3(i, j, k));
        }
    }
}

}

TEST(ConnectedPoints, GroupsAreFurtherApartThanTheDistance)
{
    std::vector<Vector3> points;
    addCube(points, 2, {0, 0, 0});
    addCube(points, 3, {2.6, 0, 0});        // 1.6 from the first one
    const auto groups = connectedPoints(points, 1.5);
    ASSERT_EQ(groups.size(), 2u);
    EXPECT_EQ(groups[0].size(), 27u);
    EXPECT_EQ(groups[1].size(), 8u);
    for (const int i : groups[1]) EXPECT_LT(i, 8);
    EXPECT_EQ(connectedPoints(points, 1.7).size(), 1u);
    EXPECT_EQ(connectedPoints(points, 0.9).size(), 35u);
    EXPECT_TRUE(connectedPoints({}, 1).empty());
}

TEST(ConnectedPoints, GapsAreThoseToTheNearestOtherPoint)
{
    // On a line: nearest distances 1, 1, 1.5 and nothing within 3 for the last one.
    const PointGaps gaps = measureGaps({{0, 0, 0}, {1, 0, 0}, {2.5, 0, 0}, {9, 0, 0}}, 3);
    EXPECT_DOUBLE_EQ(gaps.least, 1);
    EXPECT_DOUBLE_EQ(gaps.mean, 3.5/3);
    EXPECT_DOUBLE_EQ(gaps.most, 1.5);
    EXPECT_EQ(gaps.alone, 1u);
    EXPECT_EQ(measureGaps({{0, 0, 0}}, 1).mean, 0);
    EXPECT_EQ(measureGaps({{0, 0, 0}, {0, 0, 0}}, 1).least, 0);
}

TEST(SeparateBodies, HaveTheirParticlesBoxAndMotion)
{
    std::vector<Vector3> positions, velocities;
    addCube(positions, 3, {2.6, 0, 0});
    addCube(positions, 2, {0, 0, 0});       // 1.6 from the first one
    velocities.assign(27, {0, 0, 1});
    velocities.insert(velocities.end(), 4, {0, 2, 0});
    velocities.insert(velocities.end(), 4, {0, -2, 1});
    const auto bodies = separateBodies(positions, velocities, 1);
    ASSERT_EQ(bodies.size(), 2u);
    EXPECT_EQ(bodies[0].particles.size(), 27u);
    EXPECT_DOUBLE_EQ(bodies[0].volume, 27);
    EXPECT_NEAR(bodies[0].diameter(), 3*std::cbrt(6/std::numbers::pi), 1e-12);      // of a cube of 3: doubles
    EXPECT_NEAR(length(bodies[0].size() - Vector3(3, 3, 3)), 0, 1e-14);
    EXPECT_NEAR(length(bodies[1].velocity - Vector3(0, 0, 0.5)), 0, 1e-15);
    EXPECT_EQ(bodies[1].low, Vector3(-0.5, -0.5, -0.5));
}

// Cubes that turn as solids do: a cube has the same moment about each axis, so that the spin is exact.
TEST(SeparateBodies, HaveTheirSpin)
{
    std::vector<Vector3> positions, velocities;
    addCube(positions, 4, {7, 1, 2});
    const Vector3 spin(1, -2, 3);
    for (const Vector3& x : positions) velocities.push_back(Vector3(5, 0, 0) + cross(spin, x));
    EXPECT_NEAR(length(separateBodies(positions, velocities, 1)[0].angularVelocity - spin), 0, 1e-13);
}

TEST(MotionWarnings, TellWhatTheViscosityDoesNotDo)
{
    std::vector<Vector3> positions, still, turning;
    addCube(positions, 10, {0, 0, 0});
    for (Vector3& x : positions) x *= 1e-4;
    for (const Vector3& x : positions) turning.push_back(cross({0, 0, 30}, x));
    still.resize(positions.size());
    const auto warnings = [&](const std::string& model, const std::vector<Vector3>& velocities, double nu)
    {
        std::string all;
        for (const std::string& text : motionWarnings(model, separateBodies(positions, velocities, 1e-4), {0, 0, 0, 998, nu, 0.0728})) all += text + "\n";
        return all;
    };
    EXPECT_EQ(warnings("XSPH", still, 1e-6), "");
    EXPECT_TRUE(holds(warnings("XSPH", turning, 1e-6), {"body 1 of 1 turns at 30 rad/s", "viscosity newtonian lets liquid turn"}));
    EXPECT_TRUE(holds(warnings("XSPH", still, 1e-3), {"nu, 0.001 m2/s, does not act with viscosity XSPH"}));
    EXPECT_TRUE(holds(warnings("none", turning, 1e-3), {"does not act with viscosity none"}));
    EXPECT_EQ(warnings("newtonian", turning, 1e-3) + warnings("laminar", turning, 1e-3), "");
}

TEST(SeparateBodies, SayWhatIsResolvedBadly)
{
    std::vector<Vector3> positions;
    for (int i = 0; i < 30*30*2; ++i) positions.push_back({double(i % 30), double(i/30 % 30), i/900 + 100.0});
    addCube(positions, 9, {0, 0, 0});       // (3*729/(4 pi))^(1/3) = 5.58 spacings a radius: resolved
    addCube(positions, 3, {50, 0, 0});      // 1.86
    addCube(positions, 2, {70, 0, 0});
    addCube(positions, 2, {90, 0, 0});
    const std::vector<Vector3> velocities(positions.size());
    const auto warnings = resolutionWarnings(separateBodies(positions, velocities, 1), 1);
    ASSERT_EQ(warnings.size(), 2u);         // one for all that are coarse
    EXPECT_NE(warnings[1].find("less than 5, as are the 2 smaller ones: contact angles"), std::string::npos) << warnings[1];
    EXPECT_NE(warnings[0].find("body 1 of 5, 1800 particles, is thin, 2 spacings"), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[1].find("body 3 of 5, 27 particles, is coarse, 1.86"), std::string::npos) << warnings[1];
}

// A puddle's height 2 l sin(theta/2): l at 60 degrees, 2 l at 180.
TEST(SeparateBodies, SayThatWeightFlattensLiquid)
{
    EXPECT_EQ(puddleWarning(3.001, 60, 1), "");
    EXPECT_EQ(puddleWarning(1.501, 180, 1), "");
    EXPECT_EQ(puddleWarning(1, 0, 1), "");
    const std::string text = puddleWarning(1, 60, 0.5);
    EXPECT_NE(text.find("to 2 spacings or less, the height 1 m of a puddle at 60 degrees"), std::string::npos) << text;
    EXPECT_NE(text.find("a spacing below 0.333333 m"), std::string::npos) << text;
}

}
