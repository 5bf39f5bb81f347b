// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/Models.H"

#include "device/Device.H"
#include "support/PairForceMeter.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

const Dictionary chosen = Dictionary::parse("wetting adhesionRatio;", "constant/models");

// The acceleration of a lone particle at `place` by the wall, SI.
Vector3 pullOfWall(LiquidCase& drop, const std::string& word, Vec3 place)
{
    const auto tension = makeTension(drop, word);
    const auto wetting = Wetting::New(chosen, drop.liquid, drop.walls, *tension);
    drop.place({place});
    Buffer<Vec3> acceleration(1);
    acceleration.setZero();
    wetting->apply(drop.liquid, drop.near, drop.walls, acceleration);
    const Vec3 a = acceleration.download()[0];
    const double unit = drop.liquid.units().of(dimensions::acceleration);
    return {unit * a.x, unit * a.y, unit * a.z};
}

const std::vector<std::string> words{"Becker2007", "Kondo2007", "Tartakovsky2005"};

}

// A solid particle: (1 + cos theta)/2 of the force of V_k/V liquid particles, where a lone solid particle has V_k = 1/W(0).
TEST(AdhesionRatio, IsTheLiquidsForceTimesTheRatio)
{
    for (const std::string& word : words)
    {
        for (const double theta : {0.0, 60.0, 120.0})
        {
            LiquidCase drop({.walls = sampledFloor, .solidPositions = {{0, 0, 0}},
                             .solidTheta = {theta}});
            const Vector3 found = pullOfWall(drop, word, {0, 0, 1.4f});
            const double V = 1 / Reference<CubicSpline>{2}.W(0);            // over d^3
            LiquidCase pair;
            const auto tension = makeTension(pair, word);
            const double full = V * attraction(pair, *tension, 1.4) / pair.liquid.properties().particleMass();
            const double ratio = 0.5 * (1 + std::cos(theta * std::numbers::pi / 180));
            EXPECT_NEAR(found.z, -ratio * full, 1e-5 * full) << word << ' ' << theta;
            EXPECT_EQ(found.x, 0);
        }
    }
}

// An analytic floor: the half-space's integral of the measured force, 1/V int_s^h pi (r^2 - s^2) F dr. 200 places of the midpoint
// rule there and the interpolated table here: 2e-3 of the pull at a spacing.
TEST(AdhesionRatio, OfAHalfSpaceIsItsIntegral)
{
    for (const std::string& word : words)
    {
        LiquidCase pair;
        const auto tension = makeTension(pair, word);
        const auto integral = [&](double s)
        {
            constexpr int n = 200;
            std::vector<double> distances;
            for (int k = 0; k < n; ++k) distances.push_back(s + (2 - s) * (k + 0.5) / n);
            const auto F = attractions(pair, *tension, distances);
            double sum = 0;
            for (int k = 0; k < n; ++k)
            {
                sum += std::numbers::pi * (std::pow(distances[k], 2) - s * s) * F[k] * (2 - s) / n;
            }
            return sum / pair.liquid.properties().particleMass();
        };
        const double scale = std::abs(integral(1));
        for (const scalar s : {0.5f, 0.8f, 1.3f, 1.9f})
        {
            LiquidCase drop({.walls = floorPlane,
                             .wettability = "floor { theta 60; }"});
            EXPECT_NEAR(pullOfWall(drop, word, {3, 1, s}).z, -0.75 * integral(s), 2e-3 * scale) << word << ' ' << s;
        }
    }
}

TEST(AdhesionRatio, NeedsACentralForceAndAnAngle)
{
    for (const std::string tension : {"none", "Akinci2013", "Mueller2003", "continuumSurfaceForce"})
    {
        LiquidCase drop;
        EXPECT_TRUE(holds(messageOf([&] { pullOfWall(drop, tension, {}); }),
                          {"constant/models", "central pair force", "Kondo2007"})) << tension;
    }
    for (const std::string wetting : {"contactAngle", "extendedSurface"})
    {
        LiquidCase drop;
        const auto tension = makeTension(drop, "Kondo2007");
        const Dictionary models = Dictionary::parse("wetting " + wetting + ";", "constant/models");
        EXPECT_TRUE(holds(messageOf([&] { Wetting::New(models, drop.liquid, drop.walls, *tension); }), {"constant/models"}));
    }
    LiquidCase drop({.walls = floorPlane});
    drop.folder.write("constant/models", "pressure none; surfaceTension Kondo2007; wetting adhesionRatio; viscosity none; bodyForce none;");
    EXPECT_TRUE(holds(messageOf([&] { Models(drop.folder.path(), Dictionary(), drop.liquid, drop.walls); }), {"floor"}));
}

TEST(AdhesionRatio, LaunchesNothingWithoutWalls)
{
    LiquidCase drop;
    const auto tension = makeTension(drop, "Kondo2007");
    const auto wetting = Wetting::New(chosen, drop.liquid, drop.walls, *tension);
    drop.place({{0, 0, 0}});
    Buffer<Vec3> acceleration(1);
    const auto before = deviceCounters().launches;
    wetting->apply(drop.liquid, drop.near, drop.walls, acceleration);
    EXPECT_EQ(deviceCounters().launches, before);
}
