// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/Motion.H"
#include "stepping/SubStep.H"
#include "support/LiquidCase.H"
#include "support/MotionSums.H"
#include "walls/Walls.H"

#include <cstdlib>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// A floor, analytic or sampled, with a motion.
CaseText movingFloor(bool sampled, const std::string& motion)
{
    CaseText text{.walls = "floor { " + std::string(sampled ? "type particles; surface \"floor.stl\";" : "type plane; point (0 0 0); normal (0 0 1);") + " motion { " + motion + " } }"};
    if (sampled) text.solidPositions = latticeBlock(17, 17, 1, 0.9f, {-7.2f, -7.2f, -0.5f});
    return text;
}

struct VelocityAt
{
    int wall;
    WallView walls;
    Span<const Position> at;
    Span<Vec3> velocity;

    HOST_DEVICE void operator()(int i) const
    {
        velocity[i] = walls.velocity(wall, i, at[i]);
    }
};

// Of a wall, in m/s, at the liquid particles.
std::vector<Vec3> velocitiesOfWalls(LiquidCase& drop, int wall = 0)
{
    Buffer<Vec3> velocity(drop.liquid.owned());
    forEach(drop.liquid.owned(), VelocityAt{wall, drop.walls.view(drop.liquid), std::as_const(drop.liquid.predicted).span(), velocity.span()});
    std::vector<Vec3> found = drop.inOrder(velocity);
    for (Vec3& v : found) v = scalar(drop.liquid.units().of(dimensions::velocity)) * v;
    return found;
}

}

// Both kinds of wall are where the motion has them, and as fast: on a floor that turns about an axis 3 mm away, and rises.
TEST(MovingWalls, HaveTheVelocityOfTheirBodies)
{
    for (const bool sampled : {false, true})
    {
        LiquidCase drop(movingFloor(sampled, "type rotation; origin (3e-3 0 0); axis (0 0 1); omega 2;"));
        drop.useWalls(2 * drop.liquid.spacing());
        drop.place({{0, 0, 0.5f}, {0, 2, 0.5f}});
        drop.walls.moveTo(0, 1e-4);
        drop.walls.update(drop.liquid);
        const auto found = velocitiesOfWalls(drop);
        // omega x r. By single precision along the chord of 2e-4 rad; a sampled floor's is the mean of particles around, whose middle is up to a fifth of a spacing away.
        for (const auto& [v, x, y] : {std::tuple{found[0], 0.0, 0.0}, {found[1], 0.0, 2e-3}})
        {
            EXPECT_NEAR(v.x, -2 * y, sampled ? 5e-4 : 1e-6) << sampled;
            EXPECT_NEAR(v.y, 2 * (x - 3e-3), sampled ? 5e-4 : 1e-6) << sampled;
            EXPECT_NEAR(v.z, 0, 1e-7) << sampled;
        }
    }
}

// Behind as many analytic walls as kernels have at hand (WallSurfacesView::few), too.
TEST(MovingWalls, HaveTheirVelocityHoweverManyThereAre)
{
    CaseText text = movingFloor(false, "type translation; velocity (0.3 0 -0.4);");
    std::string others;
    for (int k = 0; k < WallSurfacesView::few; ++k) others += "far" + std::to_string(k) + " { type plane; point (0 0 -1); normal (0 0 1); }\n";
    text.walls = others + text.walls;
    LiquidCase drop(text);
    drop.place({{0, 0, 0.5f}});
    drop.walls.moveTo(0, 1e-4);
    drop.walls.update(drop.liquid);
    const Vec3 v = velocitiesOfWalls(drop, WallSurfacesView::few)[0];
    // Single precision of a way of 5e-5 m.
    EXPECT_NEAR(v.x, 0.3, 1e-5);
    EXPECT_NEAR(v.z, -0.4, 1e-5);
    EXPECT_EQ(norm(velocitiesOfWalls(drop, 0)[0]), 0);
}

// A wall has no memory: how it came to a place does not matter, to the bit and in the order of its particles.
TEST(MovingWalls, AreWhereTheTimeHasThem)
{
    const CaseText text = movingFloor(true, "type oscillation; amplitude (0 2e-3 5e-4); frequency 1;");
    LiquidCase direct(text), onTheWay(text);
    direct.walls.moveTo(0.2, 0.21);
    for (const double t : {0.0, 0.9, 0.1, 0.2}) onTheWay.walls.moveTo(t, t + 0.01);
    const auto a = direct.walls.view(direct.liquid).particles, b = onTheWay.walls.view(onTheWay.liquid).particles;
    const auto x = download(a.position), y = download(b.position);
    ASSERT_EQ(x.size(), 17u * 17);
    for (std::size_t k = 0; k < x.size(); ++k) ASSERT_EQ(norm(x[k] - y[k]), 0) << k;
    EXPECT_EQ(download(a.volume), download(b.volume));
    // sin(2 pi 0.21) = 0.9686; half a spacing below the floor. Quanta are 2e-6 of a spacing.
    for (const Vec3 p : x) ASSERT_NEAR(p.z / direct.liquid.spacing(), -0.5 + 0.9686 * 0.5, 1e-4);
}

TEST(MovingWalls, TellTheirSpeedWhereLiquidIs)
{
    LiquidCase drop(movingFloor(false, "type translation; velocity (0.3 0 -0.4); start 0.5;"));
    drop.place({{0, 0, 0.5f}});
    EXPECT_EQ(drop.walls.speed(drop.liquid, 0, 0.1), 0);
    EXPECT_NEAR(drop.walls.speed(drop.liquid, 0.6, 0.7), 0.5, 1e-9);
    LiquidCase turning(movingFloor(false, "type rotation; origin (0 0 0); axis (0 0 1); omega 3;"));
    turning.place({{4, 0, 0.5f}, {0, 3, 9}});
    EXPECT_NEAR(turning.walls.speed(turning.liquid, 0, 0.1), 3 * 4e-3, 1e-8);
    LiquidCase still;
    still.place({{0, 0, 0.5f}});
    EXPECT_EQ(still.walls.speed(still.liquid, 0, 1), 0);
    EXPECT_FALSE(still.walls.move());
}

namespace
{

// How a drop on a floor has moved against the floor after some steps: floor and drop go at `speed` (m/s) along x and up together.
std::vector<Vec3> against(const std::string& models, double nu, bool sampled, double speed)
{
    CaseText text = movingFloor(sampled, "type translation; velocity (" + std::to_string(speed) + " 0 " + std::to_string(0.5 * speed) + ");");
    text.liquidProperties = "rho 1000; nu " + std::to_string(nu) + "; sigma 0.072;";
    if (sampled) text.solidTheta.assign(text.solidPositions.size(), 60);
    else text.wettability = "floor { theta 60; }";
    LiquidCase drop(text);
    drop.folder.write("constant/models", models);
    Models made(drop.folder.path(), Dictionary(), drop.liquid, drop.walls);
    made.takeEffect(drop.liquid, drop.walls);
    const scalar v = drop.liquid.units().toScaled(speed, dimensions::velocity);
    const auto points = latticeBlock(6, 6, 4, 1, {-2.5f, -2.5f, 0.5f});
    std::vector<Vec3> velocities;
    for (const Vec3 p : points) velocities.push_back(Vec3{v, 0, 0.5f * v} + 0.02f * Vec3{p.x, 0.3f * p.z, -0.2f * p.z});
    drop.place(points, velocities);
    const double capillary = drop.liquid.properties().capillaryStep();
    const scalar dt = drop.liquid.units().toScaled(0.3 * capillary, dimensions::time);
    SubStep subStep(drop.liquid, drop.near, drop.walls, made);
    constexpr int steps = 6;
    for (int step = 0; step < steps; ++step) subStep(dt, step * drop.liquid.units().toSI(dt, dimensions::time));
    std::vector<Vec3> ways = drop.inOrder(drop.liquid.position);
    for (Vec3& x : ways) x = (1 / drop.liquid.spacing()) * (x - steps * dt * Vec3{v, 0, 0.5f * v});
    return ways;
}

}

// Galilei: what a liquid does on its walls does not depend on how fast both go. Places are rounded to quanta, 2e-6 spacings, in each of six steps, and what is summed in
// single precision: 2 to 9e-5 spacings were found. DFSPH takes gradients at a step's beginning with sampled walls at its end, which lie a hundredth of a spacing farther by then.
TEST(MovingWalls, TakeTheirLiquidAlong)
{
    const std::string newtonian = "pressure completedPbf; surfaceTension laplacePressure; wetting extendedSurface; viscosity newtonian; bodyForce none;";
    const std::string xsph = "pressure completedPbf; surfaceTension continuumSurfaceForce; wetting extendedSurface; viscosity XSPH; bodyForce none;";
    const std::string dfsph = "pressure DFSPH; surfaceTension none; wetting none; viscosity laminar; bodyForce none;";
    for (const bool sampled : {false, true})
    {
        // An explicit step and an implicit one of the same model.
        for (const auto& [models, nu] : {std::pair{newtonian, 5e-6}, {newtonian, 1e-4}, {xsph, 1e-6}, {dfsph, 5e-6}})
        {
            const auto still = against(models, nu, sampled, 0), going = against(models, nu, sampled, 0.025);
            ASSERT_EQ(still.size(), going.size());
            double most = 0;
            for (std::size_t i = 0; i < still.size(); ++i) most = std::max(most, double(norm(still[i] - going[i])));
            EXPECT_LT(most, models == dfsph && sampled ? 0.015 : 2e-4) << models << nu << sampled;
        }
    }
}

// A floor that comes up at 1 m/s, half a spacing a step, takes a drop along and lets nothing through.
TEST(MovingWalls, LetNothingThroughAtAMetreASecond)
{
    for (const bool sampled : {false, true})
    {
        CaseText text = movingFloor(sampled, "type translation; velocity (0 0 1);");
        if (sampled) text.solidTheta.assign(text.solidPositions.size(), 90);
        else text.wettability = "floor { theta 90; }";
        LiquidCase drop(text);
        drop.folder.write("constant/models", "pressure completedPbf; surfaceTension laplacePressure; wetting extendedSurface; viscosity newtonian; bodyForce none;");
        Models made(drop.folder.path(), Dictionary(), drop.liquid, drop.walls);
        made.takeEffect(drop.liquid, drop.walls);
        drop.place(latticeBlock(6, 6, 4, 1, {-2.5f, -2.5f, 1.5f}));
        const scalar dt = drop.liquid.units().toScaled(5e-4, dimensions::time);
        SubStep subStep(drop.liquid, drop.near, drop.walls, made);
        constexpr int steps = 40;
        for (int step = 0; step < steps; ++step) subStep(dt, step * 5e-4);
        scalar lowest = 1e9f;
        for (const Vec3 x : vectors(drop.liquid.position)) lowest = std::min(lowest, x.z / drop.liquid.spacing());
        // The floor is 20 spacings up. A quarter of a spacing is what solid particles keep free, to which a particle that comes back in a step adds as much.
        EXPECT_GT(lowest, 20) << sampled;
    }
}
