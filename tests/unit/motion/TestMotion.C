// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/Motion.H"

#include "motion/LiquidState.H"
#include "motion/QuantisedLiquid.H"
#include "motion/SpeedMeter.H"
#include "motion/ViscousWork.H"
#include "support/LiquidCase.H"

#include <limits>

using namespace shizuku;
using namespace shizuku::test;

// Numbers that single precision holds exactly, so that the step is exact: p = x + dt u, p += dt^2 a, u = (p - x)/dt.
TEST(Motion, PredictsDisplacesAndReadsTheVelocityOff)
{
    LiquidCase drop;
    drop.liquid.resize(2);
    drop.liquid.position.upload(placed({{1, 2, 3}, {-1, 0, 0}}));
    drop.liquid.velocity.upload({{4, 0, -8}, {0, 0, 0}});
    predictPositions(drop.liquid, 0.25f, {0, 4, 8});
    EXPECT_EQ(vectors(drop.liquid.predicted)[0].y, 3);
    EXPECT_EQ(vectors(drop.liquid.predicted)[1].z, 2);
    predictPositions(drop.liquid, 0.25f);
    EXPECT_EQ(vectors(drop.liquid.predicted)[0].x, 2);
    EXPECT_EQ(vectors(drop.liquid.predicted)[0].z, 1);
    displace(drop.liquid, Buffer<Vec3>(std::vector<Vec3>{{0, 16, 0}, {0, 0, 32}}), 0.25f);
    EXPECT_EQ(vectors(drop.liquid.predicted)[0].y, 3);
    EXPECT_EQ(vectors(drop.liquid.predicted)[1].z, 2);
    updateVelocities(drop.liquid, 0.25f);
    const auto x = vectors(drop.liquid.position), u = drop.liquid.velocity.download();
    EXPECT_EQ(x[0].x, 2);
    EXPECT_EQ(x[0].y, 3);
    EXPECT_EQ(u[0].x, 4);
    EXPECT_EQ(u[0].y, 4);
    EXPECT_EQ(u[0].z, -8);
    EXPECT_EQ(u[1].z, 8);
}

TEST(LiquidState, SumsTheLiquidInSIUnits)
{
    LiquidCase drop;            // 1e-6 kg and 1e-9 m3 a particle
    drop.liquid.resize(3);
    const Units& units = drop.liquid.units();
    const auto length = [&](double si) { return units.toScaled(si, dimensions::length); };
    const auto speed = [&](double si) { return units.toScaled(si, dimensions::velocity); };
    drop.liquid.position.upload(placed({{length(1), 0, 0}, {length(2), 0, length(3)}, {0, length(-6), 0}}));
    drop.liquid.velocity.upload({{speed(3), 0, speed(4)}, {0, 0, 0}, {0, speed(-1), 0}});
    drop.liquid.density.upload({1.25f, 1, 0.5f});
    const LiquidState state = LiquidStateMeter().measure(drop.liquid);
    // Stored in single precision: 1e-7 of each number.
    EXPECT_NEAR(state.volume, 2.8e-9, 1e-15);                   // 1/1.25 + 1 + 1
    EXPECT_NEAR(state.kineticEnergy, 13e-6, 1e-11);             // (25 + 1)/2
    EXPECT_NEAR(state.maxSpeed, 5, 1e-6);
    EXPECT_NEAR(state.averageDensityError, 0.25 / 3, 1e-7);
    EXPECT_EQ(state.maxDensityError, 0.25);
    EXPECT_NEAR(state.centroid[0], 1, 1e-6);
    EXPECT_NEAR(state.centroid[1], -2, 1e-6);
    EXPECT_NEAR(state.centroid[2], 1, 1e-6);
    EXPECT_NEAR(state.momentum[0], 3e-6, 1e-12);
    EXPECT_NEAR(state.momentum[1], -1e-6, 1e-12);
    EXPECT_NEAR(state.momentum[2], 4e-6, 1e-12);
}

// 5 m/s in the first sub-step, 2 m/s in the second: `most` keeps the first, `now` is the second.
TEST(SpeedMeter, KeepsTheFastestOfTheSubSteps)
{
    LiquidCase drop;
    drop.liquid.resize(2);
    const auto speed = [&](double si) { return drop.liquid.units().toScaled(si, dimensions::velocity); };
    SpeedMeter meter;
    drop.liquid.velocity.upload({{speed(3), 0, speed(4)}, {0, 0, 0}});
    meter.watch(drop.liquid);
    drop.liquid.velocity.upload({{0, 0, 0}, {0, speed(-2), 0}});
    meter.watch(drop.liquid);
    const Speeds speeds = meter.measure(drop.liquid);
    EXPECT_NEAR(speeds.most, 5, 1e-6);              // stored in single precision
    EXPECT_NEAR(speeds.now, 2, 1e-6);
    EXPECT_EQ(speeds.nonFinite, 0);
    EXPECT_NEAR(meter.measure(drop.liquid).most, 2, 1e-6);      // the first sub-step is of a former step now
}

TEST(SpeedMeter, CountsWhatIsNotANumber)
{
    LiquidCase drop;
    drop.liquid.resize(4);
    const scalar bad = std::numeric_limits<scalar>::quiet_NaN(), far = std::numeric_limits<scalar>::infinity();
    drop.liquid.velocity.upload({{0, bad, 0}, {0, 0, bad}, {far, 0, 0}, {0, 2, 0}});
    SpeedMeter meter;
    EXPECT_EQ(meter.measure(drop.liquid).nonFinite, 3);
    EXPECT_TRUE(std::isfinite(meter.measure(drop.liquid).now));             // the others are measured
    EXPECT_GT(meter.measure(drop.liquid).now, 0);
    meter.watch(drop.liquid);
    drop.liquid.velocity.setZero();
    EXPECT_EQ(meter.measure(drop.liquid).nonFinite, 3);                     // it was, even where it no longer shows
}

// A way that is not a number, or endless, becomes one of 2^11 units, which no step may make: what follows from it is a speed that shows that the run diverged.
TEST(Motion, WaysWithoutANumberShowAsSpeeds)
{
    LiquidCase drop;
    drop.place({{0, 0, 0}, {1, 0, 0}});
    const scalar bad = std::numeric_limits<scalar>::quiet_NaN(), far = std::numeric_limits<scalar>::infinity();
    displace(drop.liquid, Buffer<Vec3>(std::vector<Vec3>{{bad, 0, 0}, {0, -far, 0}}), 1);
    updateVelocities(drop.liquid, 1);
    for (const Vec3& u : drop.liquid.velocity.download())
    {
        EXPECT_TRUE(std::isfinite(norm(u)));
        EXPECT_GT(norm(u), 1000);
    }
}

// Of two sub-steps: what velocities lose between before() and behind(), and nothing of what they lose elsewhere.
TEST(ViscousWork, IsWhatVelocitiesLose)
{
    LiquidCase drop;            // 1e-6 kg a particle
    drop.liquid.resize(2);
    drop.liquid.position.upload(placed({{0, 0, 0}, {1, 0, 0}}));
    const auto set = [&](double first, double second)
    {
        const auto scaled = [&](double si) { return drop.liquid.units().toScaled(si, dimensions::velocity); };
        drop.liquid.velocity.upload({{scaled(first), 0, 0}, {0, scaled(second), 0}});
    };
    ViscousWork work;
    for (int k = 0; k < 2; ++k)
    {
        set(4, 3);
        work.before(drop.liquid);
        set(2, 3);
        work.behind(drop.liquid, std::nullopt);
    }
    work.addTo(drop.liquid);
    EXPECT_NEAR(drop.liquid.number(ViscousWork::number, 0), 12e-6, 1e-11);      // 2 times 1e-6 (16 - 4)/2; velocities have single precision
    set(1, 0);
    work.before(drop.liquid);
    set(0, 0);
    work.behind(drop.liquid, std::nullopt);
    work.addTo(drop.liquid);
    EXPECT_NEAR(drop.liquid.number(ViscousWork::number, 0), 12.5e-6, 1e-11);
    EXPECT_EQ(drop.liquid.number(ViscousWork::ofFilter, 0), 0);
    // A model that tells of 3/4 of u^2 = 1 that viscosity took it: the rest is the filter's.
    set(1, 0);
    work.before(drop.liquid);
    set(0, 0);
    const double unit = drop.liquid.units().of(dimensions::velocity);
    work.behind(drop.liquid, Buffer<scalar>(std::vector<scalar>{scalar(0.75/(unit*unit)), 0}));
    work.addTo(drop.liquid);
    EXPECT_NEAR(drop.liquid.number(ViscousWork::number, 0), 12.875e-6, 1e-11);
    EXPECT_NEAR(drop.liquid.number(ViscousWork::ofFilter, 0), 0.125e-6, 1e-11);
}

// Places within half of a word, which is the box over 65535; 0.51 leaves room for the quanta of places. Half a word of the speed, too.
TEST(QuantisedLiquid, PlacesAndSpeedsAreWithinHalfAWord)
{
    constexpr int particles = 1000;
    LiquidCase drop;
    drop.liquid.resize(particles);
    const Units& units = drop.liquid.units();
    const double length = units.length, speed = units.of(dimensions::velocity);
    std::vector<Vec3> x, u;
    for (int i = 0; i < particles; ++i)
    {
        x.push_back({scalar(3 + 0.01*i), scalar(-0.02*i), 5});
        u.push_back({0, scalar(0.5*i), 0});
    }
    drop.liquid.position.upload(placed(x));
    drop.liquid.velocity.upload(u);
    QuantisedLiquid quantised;
    quantised.ask(drop.liquid, 10'000);
    const auto all = quantised.take();
    ASSERT_EQ(all.shown, std::size_t(particles));
    EXPECT_NEAR(all.low.x, 3*length, 1e-5*length);
    EXPECT_NEAR(all.high.x, 12.99*length, 1e-5*length);
    EXPECT_NEAR(all.low.y, -19.98*length, 1e-5*length);
    EXPECT_NEAR(all.mostSpeed, 499.5*speed, 1e-4*speed);
    for (int i = 0; i < particles; ++i)
    {
        EXPECT_NEAR(all.words[i].x*9.99/65535, 0.01*i, 0.51*9.99/65535);
        EXPECT_NEAR(all.words[i].y*19.98/65535, 19.98 - 0.02*i, 0.51*19.98/65535);
        EXPECT_EQ(all.words[i].z, 0);           // the box is flat
        EXPECT_NEAR(all.words[i].speed*499.5/65535, 0.5*i, 0.51*499.5/65535);
    }

    quantised.ask(drop.liquid, 100);            // every tenth
    const auto some = quantised.take();
    ASSERT_EQ(some.shown, 100u);
    EXPECT_EQ(some.particles, std::size_t(particles));
    for (int k = 0; k < 100; ++k) EXPECT_NEAR(some.words[k].x*9.99/65535, 0.1*k, 0.51*9.99/65535);
}

TEST(QuantisedLiquid, WhatIsNoNumberIsZeroAndNoLiquidIsNone)
{
    LiquidCase drop;
    QuantisedLiquid quantised;
    quantised.ask(drop.liquid, 10);
    EXPECT_EQ(quantised.take().shown, 0u);
    drop.liquid.resize(2);
    drop.liquid.position.upload(placed({{1, 2, 3}, {1, 2, 3}}));
    drop.liquid.velocity.upload({{std::numeric_limits<scalar>::quiet_NaN(), 0, 0}, {2, 0, 0}});
    quantised.ask(drop.liquid, 10);
    const auto two = quantised.take();
    EXPECT_EQ(two.words[0].speed, 0);
    EXPECT_EQ(two.words[1].speed, 65535);
}
