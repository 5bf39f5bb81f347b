// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/TimeStep.H"

#include "caseFiles/VectorField.H"
#include "support/LiquidCase.H"

#include <gtest/gtest.h>

#include <optional>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr double spacing = 1e-3;                    // m

// A ball of water that moves at 0.99 m/s, in steps of 4 ms that the Courant number divides.
class FlyingDrop
{
public:
    FlyingDrop()
    {
        write();
        time.emplace(folder.path());
        setup.emplace(folder.path());
        setup->make(time->value());
        setup->readParticles(*time);
        near.emplace(*setup->liquid);
    }

    std::vector<Vec3> positions() const
    {
        const auto at = vectors(setup->liquid->position.download());
        const auto id = setup->liquid->id.download();
        std::vector<Vec3> result(at.size());
        for (std::size_t i = 0; i < at.size(); ++i) result[id[i]] = at[i];
        return result;
    }

    ScratchFolder folder;
    std::optional<Time> time;
    std::optional<CaseSetup> setup;
    std::optional<Neighbourhood> near;
    static constexpr const char* control = "deltaT 4e-3; endTime 1; writeInterval 1; maxCo 0.5; maxCapillaryCo 1000;";

private:
    void write()
    {
        folder.write("system/controlDict", control);
        folder.write("system/solution", "spacing 1e-3;");
        folder.write("constant/walls", "");
        folder.write("constant/liquidProperties", "rho 1000; nu 1e-6; sigma 0.072;");
        folder.write("constant/models", "pressure pbf; surfaceTension Fujisawa2014; wetting none; viscosity XSPH; bodyForce none;");
        std::vector<Vector3> positions;
        for (const Vec3 p : latticeBall(3)) positions.push_back(spacing * Vector3(p.x, p.y, p.z));
        const std::vector<Vector3> U(positions.size(), {0, 0, -0.99});
        std::filesystem::create_directories(folder.path() / "0/liquid");
        writeField(folder.path() / "0/liquid/positions", toField("positions", dimensions::length, positions), {});
        writeField(folder.path() / "0/liquid/U", toField("U", dimensions::velocity, U), {});
    }
};

}

// Its step is that of as many sub-steps by themselves, to the bit, though the next one is begun meanwhile.
TEST(TimeStep, IsMadeOfItsSubSteps)
{
    FlyingDrop whole, parts;
    TimeStep step(*whole.time, *whole.setup, *whole.near);
    const SubSteps steps = step.divide();
    // 4 ms at 0.99 m/s are 3.96 spacings, in steps of at most half of one.
    EXPECT_EQ(steps.count, 8);
    EXPECT_EQ(steps.limit, "Courant");
    for (int n = 0; n < 2; ++n)
    {
        step.make(steps, 0);
        step.prepareNext(steps);
    }

    CaseSetup& setup = *parts.setup;
    SubStep subStep(*setup.liquid, *parts.near, *setup.walls, *setup.models);
    for (int n = 0; n < 2 * steps.count; ++n) subStep(setup.liquid->units().toScaled(steps.dt, dimensions::time));
    const auto found = whole.positions(), expected = parts.positions();
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
        ASSERT_EQ(found[i].x, expected[i].x) << i;
        ASSERT_EQ(found[i].y, expected[i].y) << i;
        ASSERT_EQ(found[i].z, expected[i].z) << i;
    }
}

TEST(TimeStep, KeepsTheFastestOfItsSubSteps)
{
    FlyingDrop drop;
    TimeStep step(*drop.time, *drop.setup, *drop.near);
    EXPECT_NEAR(step.speeds().now, 0.99, 1e-6);        // read into single precision
    const SubSteps steps = step.divide();
    step.make(steps, 0);
    step.prepareNext(steps);
    EXPECT_GT(step.speeds().now, 0);
    EXPECT_GE(step.speeds().most, step.speeds().now);
    EXPECT_EQ(step.speeds().nonFinite, 0);
}

TEST(TimeStep, FollowsControlDict)
{
    FlyingDrop drop;
    TimeStep step(*drop.time, *drop.setup, *drop.near);
    drop.folder.write("system/controlDict", "deltaT 4e-3; endTime 1; writeInterval 1; adjustTimeStep no;");
    drop.time.emplace(drop.folder.path());
    EXPECT_EQ(step.divide().count, 8);
    step.readControls();
    EXPECT_EQ(step.divide().count, 1);
}

// What moves less than `below` for `for` sleeps: two steps of 4 ms for 6 ms. Then there are no sub-steps, and nothing moves, until controlDict or a model changes.
TEST(TimeStep, SleepsAtRestAndWakes)
{
    FlyingDrop drop;
    drop.folder.write("system/controlDict", std::string(FlyingDrop::control) + " sleep { below 1e6; for 6e-3; }");
    drop.time.emplace(drop.folder.path());
    TimeStep step(*drop.time, *drop.setup, *drop.near);
    for (const bool sleeps : {false, false, true, true})
    {
        const SubSteps steps = step.divide();
        EXPECT_EQ(steps.count == 0, sleeps);
        EXPECT_EQ(steps.limit == "sleep", sleeps);
        const double from = drop.time->value();
        const auto before = drop.positions();
        drop.time->advance();
        step.make(steps, from);
        step.prepareNext(steps);
        const auto after = drop.positions();
        EXPECT_EQ(before.front().z == after.front().z, sleeps);
    }
    step.dropPrepared();
    EXPECT_GT(step.divide().count, 0);

    // The number of the liquid that tells it crosses restarts.
    drop.setup->liquid->number("calmFor", 0) = 1;
    EXPECT_EQ(TimeStep(*drop.time, *drop.setup, *drop.near).divide().count, 0);
    step.readControls();
    EXPECT_GT(step.divide().count, 0);

    drop.folder.write("system/controlDict", std::string(FlyingDrop::control) + " sleep { below 1e-9; for 6e-3; }");
    drop.time.emplace(drop.folder.path());
    TimeStep never(*drop.time, *drop.setup, *drop.near);
    drop.setup->liquid->number("calmFor", 0) = 1;
    drop.time->advance();
    never.make({1, 1e-5, ""}, 0);
    EXPECT_EQ(drop.setup->liquid->number("calmFor", 0), 0);
}

TEST(TimeStep, IsLongerAtRest)
{
    FlyingDrop drop;
    const LiquidProperties& p = drop.setup->liquid->properties();
    const StepControl control(Dictionary::parse("maxCapillaryCo 0.5; restCapillaryCo 4;", "controlDict"));
    const double little = 0.0125 * spacing / (4 * p.capillaryStep());           // m/s: an eightieth of a spacing in a long step
    EXPECT_EQ(control.follow(0.5, 0.99 * little, p), 4);
    EXPECT_EQ(control.follow(0.5, 1.01 * little, p), 0.5);
    EXPECT_EQ(control.follow(4, 3.9 * little, p), 4);
    EXPECT_EQ(control.follow(4, 4.1 * little, p), 0.5);
    StepControl resting = control;
    resting.setCapillaryCo(4);
    const auto capillary = [&](const StepControl& any) { return any.limits(1, 0, *drop.setup->liquid, *drop.setup->models).front().dt / p.capillaryStep(); };
    EXPECT_NEAR(capillary(control), 0.5, 1e-12);
    EXPECT_NEAR(capillary(resting), 4, 1e-12);
    resting.capCapillary(1.4);
    EXPECT_NEAR(capillary(resting), 1.4, 1e-12);
    // Without the entry all is as maxCapillaryCo says.
    EXPECT_EQ(StepControl(Dictionary::parse("maxCapillaryCo 0.5;", "controlDict")).follow(0, 0, p), 0.5);
}
