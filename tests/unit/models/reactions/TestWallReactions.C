// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/reactions/WallReactions.H"
#include "stepping/SubStep.H"
#include "support/LiquidCase.H"
#include "support/MotionSums.H"

#include <cmath>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

using Six = std::array<double, 6>;

const std::string usualModels = "pressure completedPbf; surfaceTension laplacePressure; wetting extendedSurface; viscosity newtonian; bodyForce gravity;";

// Liquid between a floor that slides and rises, and a ceiling 8 spacings above it, both wetted.
CaseText betweenPlates(bool sampled, double nu)
{
    CaseText text;
    text.walls = "floor { " + std::string(sampled ? "type particles; surface \"floor.stl\"; " : "type plane; point (0 0 0); normal (0 0 1); ")
        + "motion { type translation; velocity (0.05 0 0.01); } }\nceiling { type plane; point (0 0 8e-3); normal (0 0 -1); }";
    text.wettability = "ceiling { theta 110; }" + std::string(sampled ? "" : " floor { theta 60; }");
    text.liquidProperties = "rho 1000; nu " + std::to_string(nu) + "; sigma 0.072;";
    text.g = "value (2 0 -9.81);";
    if (!sampled) return text;
    text.solidPositions = latticeBlock(17, 17, 1, 0.9f, {-7.2f, -7.2f, -0.5f});
    text.solidTheta.assign(text.solidPositions.size(), 60);
    return text;
}

struct Steps
{
    LiquidCase drop;
    Models models;
    WallReactions reactions;
    SubStep subStep;

    Steps(const CaseText& text, const std::string& words)
    :
        drop(text), models((drop.folder.write("constant/models", words), drop.folder.path()), Dictionary(), drop.liquid, drop.walls), reactions(drop.folder.path(), drop.liquid, drop.walls),
        subStep(drop.liquid, drop.near, drop.walls, models)
    {
        models.takeEffect(drop.liquid, drop.walls);
        subStep.count(reactions);
    }

    // Momentum and angular momentum, kg m/s and kg m2/s.
    Six motion() const
    {
        const Units& units = drop.liquid.units();
        const MotionSums sums = motionOf(drop.inOrder(drop.liquid.position), drop.inOrder(drop.liquid.velocity));
        const double unit = drop.liquid.properties().particleMass() * units.of(dimensions::velocity);
        Six all;
        for (int c = 0; c < 3; ++c)
        {
            all[c] = unit * sums.momentum[c];
            all[c + 3] = unit * units.length * sums.angular[c];
        }
        return all;
    }

    // Of gravity in a time [s], from where the liquid is.
    Six gravity(double dt) const
    {
        const double mass = drop.liquid.properties().particleMass(), g[3] = {2, 0, -9.81};
        Six all{};
        for (const Vec3 x : drop.inOrder(drop.liquid.position))
        {
            const double length = drop.liquid.units().length, at[3] = {length * x.x, length * x.y, length * x.z};
            for (int c = 0; c < 3; ++c)
            {
                const int a = (c + 1) % 3, b = (c + 2) % 3;
                all[c] += dt * mass * g[c];
                all[c + 3] += dt * mass * (at[a] * g[b] - at[b] * g[a]);
            }
        }
        return all;
    }

    double of(const std::string& wall, WallReactions::Part part, int c) const
    {
        const auto found = drop.liquid.numbers().find(WallReactions::number(wall, part, c));
        return found == drop.liquid.numbers().end() ? 0 : found->second;
    }

    double of(const std::string& wall, int c) const
    {
        double sum = 0;
        for (int part = 0; part < WallReactions::parts; ++part) sum += of(wall, WallReactions::Part(part), c);
        return sum;
    }
};

}

// Liquid, walls and gravity: what one gets the others lose, explicit and implicit friction, analytic and sampled walls, one of which moves. The liquid's momentum is
// summed here in another way, and positions in single precision, 6e-8 of what they are: that is the tolerance, of the largest of the three. Momentum has no positions.
TEST(WallReactions, BalanceMomentum)
{
    for (const auto& [sampled, nu] : {std::pair{false, 1e-4}, {true, 1e-6}})
    {
        Steps steps(betweenPlates(sampled, nu), usualModels);
        steps.drop.place(latticeBlock(6, 6, 8, 1, {-2.5f, -1.5f, 0.5f}));
        const double dt = 0.3 * steps.drop.liquid.properties().capillaryStep();
        const scalar scaled = steps.drop.liquid.units().toScaled(dt, dimensions::time);
        const Six first = steps.motion();
        Six pulled{};
        for (int step = 0; step < 6; ++step)
        {
            const Six g = steps.gravity(steps.drop.liquid.units().toSI(scaled, dimensions::time));
            for (int c = 0; c < 6; ++c) pulled[c] += g[c];
            steps.subStep(scaled, step * dt);
            steps.reactions.addTo(steps.drop.liquid);
        }
        const Six now = steps.motion();
        for (int c = 0; c < 6; ++c)
        {
            const double ofWalls = steps.of("floor", c) + steps.of("ceiling", c);
            const double scale = std::abs(pulled[0]) + std::abs(pulled[2]);
            EXPECT_NEAR(now[c] - first[c] + ofWalls, pulled[c], (c < 3 ? 1e-6 : 1e-6 * 8e-3) * scale) << sampled << c;
        }
        // Both walls are touched, and the one that moves is held back by the liquid that it takes along.
        EXPECT_LT(steps.of("floor", WallReactions::friction, 0), 0) << sampled;
        EXPECT_NE(steps.of("ceiling", WallReactions::pressure, 2), 0) << sampled;
    }
}

// A wall that no liquid touches gets nothing, and the other all: with one wall at work nothing is estimated but the line's part.
TEST(WallReactions, LeaveOutWallsThatAreFar)
{
    CaseText text = betweenPlates(false, 1e-6);
    Steps steps(text, usualModels);
    steps.drop.place(latticeBlock(6, 6, 4, 1, {-2.5f, -1.5f, 0.5f}));
    const double dt = 0.3 * steps.drop.liquid.properties().capillaryStep();
    steps.subStep(steps.drop.liquid.units().toScaled(dt, dimensions::time), 0);
    steps.reactions.addTo(steps.drop.liquid);
    for (int c = 0; c < 6; ++c) EXPECT_EQ(steps.of("ceiling", c), 0) << c;
    EXPECT_NE(steps.of("floor", 2), 0);
}
