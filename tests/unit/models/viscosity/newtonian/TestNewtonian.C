// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/viscosity/Viscosity.H"

#include "support/DisorderedBall.H"
#include "support/LiquidCase.H"
#include "support/MotionSums.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

CaseText liquidOf(const std::string& nu, const std::string& walls = {})
{
    return {.liquidProperties = "rho 1000; nu " + nu + "; sigma 0.072;", .walls = walls};
}

// No noise is taken.
const std::string stressAlone = "c 0; perCapillaryStep 0; ";

// Velocities behind one step of dt (scaled), in the order of the points.
std::vector<Vec3> after
(
    LiquidCase& drop, const std::vector<Vec3>& points, const std::vector<Vec3>& velocities, scalar dt, const std::string& coeffs = stressAlone
)
{
    drop.place(points, velocities);
    const auto model = Viscosity::New(Dictionary::parse("viscosity newtonian; newtonianCoeffs { " + coeffs + " }"), drop.liquid);
    EXPECT_EQ(model->stepLimit(drop.liquid.properties()), std::numeric_limits<double>::infinity());
    model->apply(drop.liquid, drop.near, drop.walls, dt);
    return drop.inOrder(drop.liquid.velocity);
}

scalar scaledNu(const LiquidCase& drop)
{
    return drop.liquid.units().toScaled(drop.liquid.properties().viscosity, dimensions::kinematicViscosity);
}

}

TEST(Newtonian, WithoutAViscosityAndNoiseIsTheIdentity)
{
    LiquidCase drop(liquidOf("0", floorPlane));
    const auto points = randomPoints(200, {0, 0, 0.2f}, {5, 5, 5});
    const auto velocities = randomPoints(200, {-1, -1, -1}, {1, 1, 1}, 2);
    const auto result = after(drop, points, velocities, 0.1f);
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(norm(result[i] - velocities[i]), 0);
}

// At any viscosity: with nu dt/d^2 of 0.002, 0.2 and 20.
TEST(Newtonian, LeavesRigidMotionAlone)
{
    const auto points = disorderedBall(5);
    std::vector<Vec3> rigid;
    for (const Vec3& p : points) rigid.push_back(Vec3{0.3f, 0, -0.2f} + cross(Vec3{0.1f, -0.2f, 0.15f}, p));
    for (const std::string nu : {"1e-6", "1e-4", "1e-2"})
    {
        LiquidCase drop(liquidOf(nu));
        const auto result = after(drop, points, rigid, 0.5f);
        // Rates of 0.3 are packed within 2^-15 of it, 1e-5, at both of a pair.
        for (std::size_t i = 0; i < points.size(); ++i) ASSERT_LT(norm(result[i] - rigid[i]), 3e-5f) << nu;
    }
}

TEST(Newtonian, KeepsMomentumAndAngularMomentum)
{
    const auto points = disorderedBall(5);
    const auto velocities = randomPoints(int(points.size()), {-1, -1, -1}, {1, 1, 1}, 2);
    for (const std::string nu : {"1e-5", "1e-3", "1e-1"})
    {
        LiquidCase drop(liquidOf(nu));
        const auto result = after(drop, points, velocities, 0.2f);
        const MotionSums before = motionOf(points, velocities), now = motionOf(points, result);
        EXPECT_LT(now.energy, 0.95 * before.energy) << nu;
        // 500 velocities of order one, rounded to 6e-8 once for each of up to two hundred iterations, 6e-8 200 sqrt(500). What turns is packed within 2^-15 in each of ten
        // that matter, 3e-4 sqrt(500), at distances of up to 5.
        for (int c = 0; c < 3; ++c)
        {
            EXPECT_NEAR(now.momentum[c], before.momentum[c], 2.7e-4) << nu;
            EXPECT_NEAR(now.angular[c], before.angular[c], 3.4e-2) << nu;
        }
    }
}

// A short step takes 2 nu dt D:D of a linear flow's energy for each particle, the outermost ones too, whether it turns or not: a Laplacian would take
// |grad u|^2.
TEST(Newtonian, TakesThePowerOfTheStress)
{
    const auto points = disorderedBall(5);
    const scalar dt = 0.01f;
    for (const Vec3 shear : {Vec3{1, 1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}})
    {
        // u = (shear.x y + shear.z x, shear.y x - shear.z y, 0): strained without turning, sheared, stretched.
        std::vector<Vec3> velocities;
        for (const Vec3& p : points) velocities.push_back({shear.x * p.y + shear.z * p.x, shear.y * p.x - shear.z * p.y, 0});
        LiquidCase drop(liquidOf("1e-5"));
        const auto result = after(drop, points, velocities, dt, stressAlone + "tolerance 1e-5;");
        const double taken = motionOf(points, velocities).energy - motionOf(points, result).energy;
        const double d = drop.liquid.spacing(), offDiagonal = 0.5 * (shear.x + shear.y);
        const double rate = 2 * (2 * offDiagonal * offDiagonal + 2 * double(shear.z) * shear.z);    // 2 D:D, of velocities per spacing
        const double expected = scaledNu(drop) * dt / (d * d) * rate * double(points.size());
        EXPECT_NEAR(taken / expected, 1, 0.01);     // the first order of dt: nu dt/d^2 is 4e-4, and the ball's own decay 0.004 at its rim
    }
}

// Short steps take the stress of the velocities before them, longer ones solve for those behind: where one passes into the other both take as much. A mode of the
// rate s loses 1 - (1 - s dt/2)^4 or 1 - (1 + s dt)^-2 of its energy, which differ by half of s dt: by a quarter at most, and of noise, whose modes are slower, by less than a tenth.
TEST(Newtonian, PassesFromShortStepsToLongOnes)
{
    const auto points = disorderedBall(5);
    const auto velocities = randomPoints(int(points.size()), {-1, -1, -1}, {1, 1, 1}, 2);
    const auto taken = [&](double steps)
    {
        LiquidCase drop(liquidOf("1e-5"));
        // 8 sum_j V k_ij of the spline of two spacings is 24 over the spacing squared.
        const scalar d = drop.liquid.spacing(), edge = 0.5f * d * d / (24 * scaledNu(drop));
        const auto result = after(drop, points, velocities, scalar(steps) * edge, stressAlone + "tolerance 1e-5;");
        return 1 - motionOf(points, result).energy / motionOf(points, velocities).energy;
    };
    EXPECT_NEAR(taken(0.98) / 0.98, taken(1.02) / 1.02, 0.1 * taken(1.02));
    EXPECT_GT(taken(0.98), 0.05);
}

// Where the stress is solved for particles are where the velocities bring them that it has left; else where they were brought.
TEST(Newtonian, MovesParticlesByWhatASolutionLeaves)
{
    const auto points = disorderedBall(5);
    const auto velocities = randomPoints(int(points.size()), {-1, -1, -1}, {1, 1, 1}, 2);
    for (const std::string nu : {"1e-6", "1e-2"})
    {
        LiquidCase drop(liquidOf(nu));
        const scalar dt = 0.1f;
        const auto result = after(drop, points, velocities, dt);
        const auto x = drop.inOrder(drop.liquid.position);
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const scalar moved = nu == "1e-6" ? 0 : dt;
            // Places of up to 5 spacings, in floats here.
            ASSERT_LT(norm(x[i] - drop.liquid.spacing() * points[i] - moved * (result[i] - velocities[i])), 5e-6f) << nu;
        }
    }
}

// The form is never below zero: no velocities gain energy, whatever they are, and however the particles lie.
TEST(Newtonian, NeverGivesEnergy)
{
    LiquidCase drop(liquidOf("1e-4"));
    for (unsigned seed = 1; seed <= 5; ++seed)
    {
        const auto points = randomPoints(300, {0, 0, 0}, seed < 3 ? Vec3{6, 6, 6} : Vec3{14, 14, 0.5f}, seed);
        const auto velocities = randomPoints(300, {-1, -1, -1}, {1, 1, 1}, seed + 10);
        const auto result = after(drop, points, velocities, 0.1f);
        EXPECT_LT(motionOf(points, result).energy, motionOf(points, velocities).energy);
    }
}

// Between two walls, 8 spacings apart, pulled along them by a force until nothing changes any more: u = g z (H - z)/(2 nu). Four steps of H^2/nu leave nothing of
// the slowest decay. The ends, which are free of stress, are as far from what is looked at as one and a half times H.
TEST(Newtonian, FlowsBetweenWallsAsPoiseuilleHasIt)
{
    for (const bool sampled : {false, true})
    {
        CaseText text = liquidOf("1e-3", sampled ? sampledFloor : floorPlane + " lid { type plane; point (0 0 8e-3); normal (0 0 -1); }");
        if (sampled)
        {
            text.solidPositions = latticeBlock(41, 15, 1, 0.9f, {-18, -6.3f, -0.5f});
            text.solidNormals.assign(text.solidPositions.size(), {0, 0, 1});
            for (const Vec3& k : latticeBlock(41, 15, 1, 0.9f, {-18, -6.3f, 8.5f})) text.solidPositions.push_back(k);
            text.solidNormals.resize(text.solidPositions.size(), {0, 0, -1});
        }
        LiquidCase gap(text);
        auto points = latticeBlock(30, 8, 8, 1, {-14.5f, -3.5f, 0.5f});
        RandomNumbers random(3);
        disorder(points, 0.15f, random);
        gap.place(points);
        const auto model = Viscosity::New(Dictionary::parse("viscosity newtonian; newtonianCoeffs { " + stressAlone + "slipLength 0; }"), gap.liquid);
        const scalar nu = scaledNu(gap), height = 8 * gap.liquid.spacing(), dt = height * height / nu;
        const scalar pull = 8 * nu / (height * height);                 // for a velocity of 1 amid the gap
        const auto places = gap.liquid.position.download();              // where they stay, so that steps may be as long
        for (int step = 0; step < 4; ++step)
        {
            auto velocity = gap.liquid.velocity.download();
            for (Vec3& u : velocity) u.x += pull * dt;
            gap.liquid.velocity.upload(velocity);
            model->apply(gap.liquid, gap.near, gap.walls, dt);
            gap.liquid.position.upload(places);
        }
        const auto result = gap.inOrder(gap.liquid.velocity);
        double worst = 0, mean = 0, expected = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            if (std::abs(points[i].x) > 3) continue;
            const double z = points[i].z / 8, exact = 4 * z * (1 - z);
            worst = std::max(worst, std::abs(result[i].x - exact));
            mean += result[i].x;
            expected += exact;
        }
        // Walls that are a fifth of a spacing off are 12 % of the mean.
        EXPECT_NEAR(mean / expected, 1, 0.12) << sampled;
        EXPECT_LT(worst, 0.15) << sampled;
    }
}

// Navier: liquid that slips with the length b is as fast as if the wall were b farther off; without friction a wall takes nothing.
TEST(Newtonian, SlipsAsFarAsTheUserSays)
{
    const auto points = latticeBlock(9, 9, 4, 1, {-4, -4, 0.5f});
    const std::vector<Vec3> along(points.size(), {1, 0, 0});
    const auto lost = [&](const std::string& coeffs)
    {
        LiquidCase flow(liquidOf("1e-6", floorPlane));
        double sum = 0;
        for (const Vec3& u : after(flow, points, along, 0.01f, stressAlone + "tolerance 1e-6; startedLayers no; " + coeffs)) sum += 1 - u.x;
        return sum / 81;
    };
    LiquidCase flow(liquidOf("1e-6", floorPlane));
    const scalar d = flow.liquid.spacing(), nu = scaledNu(flow);
    const auto table = tabulateHalfSpace(flow.liquid.kernel());
    const HalfSpaceView plane{{table.data(), int(table.size())}, flow.liquid.support()};
    const auto expected = [&](scalar slip)
    {
        double sum = 0;
        for (const scalar s : {0.5f, 1.5f}) sum += 2 * plane(s * d).gradient * nu * 0.01f / (s * d + slip * d);
        return sum;
    };
    // Differences of velocities of one, 6e-8 each, beside 0.01 and less; and the step's second order, 1e-4 of it.
    EXPECT_NEAR(lost("slipLength 0;") / expected(0), 1, 1e-2);
    EXPECT_NEAR(lost("slipLength 1e-3;") / expected(1), 1, 1e-2);
    EXPECT_EQ(lost("noSlip no;"), 0);
    EXPECT_EQ(lost("noSlip no; slipLength 0;"), 0);
}

// Across a line where a surface meets the wall at 90 degrees, what moves is held by C(90) = 4/pi times ln(d/b) more than what b = 0 asks for; far from it by nothing more. Of short
// steps and of solved ones.
TEST(Newtonian, HoldsContactLinesByWhatNoParticleResolves)
{
    const auto points = latticeBlock(16, 9, 7, 1, {-7.5f, -4, 0.5f});
    const std::vector<Vec3> across(points.size(), {1, 0, 0});
    for (const auto& [nu, dt] : {std::pair("1e-6", 1e-3f), std::pair("1e-3", 1e-3f)})
    {
        double atLine = 0, within = 0;
        for (const double sign : {1.0, -1.0})
        {
            LiquidCase flow(liquidOf(nu, floorPlane));
            const auto result = after
            (
                flow, points, across, dt, stressAlone + "tolerance 1e-6; startedLayers no; slipLength " + (sign > 0 ? "1e-9;" : "0;")
            );
            for (std::size_t i = 0; i < points.size(); ++i)
            {
                if (std::abs(points[i].y) > 1.5) continue;      // three rows, far from the block's other ends
                if (points[i].x < -4) continue;                 // the rear
                (points[i].x > 4 ? atLine : within) += sign * (1 - result[i].x);
            }
        }
        LiquidCase flow(liquidOf(nu, floorPlane));
        const double d = flow.liquid.spacing(), expected = 3 * dt * scaledNu(flow) / (d * d) * 4 / std::numbers::pi * std::log(1e-3 / 1e-9);
        // Rows and columns are sums of slopes, at halves of spacings, for integrals. What is thick slows down in the step.
        const bool thick = nu == std::string("1e-3");
        EXPECT_LT(std::abs(within), 0.05 * atLine) << nu;
        EXPECT_GT(atLine, thick ? 0 : 0.9 * expected) << nu;
        EXPECT_LT(atLine, 1.1 * expected) << nu;
    }
}

// Stokes' first problem: liquid that is set going at once has lost 2 sqrt(nu t/pi) of its velocity for each unit of the wall, whatever the steps, as long as
// the layer is thinner than where the particles are; what is set going anew begins anew.
TEST(Newtonian, HoldsWhatHasJustStartedAsStokesDoes)
{
    LiquidCase flow(liquidOf("1e-6", floorPlane));
    flow.place(latticeBlock(9, 9, 4, 1, {-4, -4, 0.5f}), std::vector<Vec3>(324, {1, 0, 0}));
    const auto model = Viscosity::New(Dictionary::parse("viscosity newtonian; newtonianCoeffs { " + stressAlone + "slipLength 0; }"), flow.liquid);
    const scalar d = flow.liquid.spacing(), nu = scaledNu(flow), dt = 2e-4f * d * d / nu;
    const auto lost = [&]
    {
        double sum = 0;
        for (const Vec3& u : flow.inOrder(flow.liquid.velocity)) sum += 1 - u.x;
        return sum / 81 * d;
    };
    for (int step = 1; step <= 100; ++step)
    {
        model->apply(flow.liquid, flow.near, flow.walls, dt);
        // The particles themselves slow down, by 0.16 in the end; and g of two layers adds up to a half within 2 %.
        if (step != 1 && step != 10 && step != 100) continue;
        EXPECT_NEAR(lost() / (2 * std::sqrt(nu * step * dt / std::numbers::pi)), 1, 0.1) << step;
    }
}

// Translation, rotation and strain of any kind, up to the free surface.
TEST(NoiseOfNewtonian, LeavesLinearFlowsAlone)
{
    const auto points = disorderedBall(5);
    std::vector<Vec3> linear;
    for (const Vec3& p : points) linear.push_back({0.3f + 0.1f * p.x - 0.2f * p.y, 0.1f * p.z - 0.05f * p.x, 0.2f * p.y + 0.1f * p.x});
    LiquidCase drop(liquidOf("0"));
    const auto result = after(drop, points, linear, 0.02f, "c 1;");
    // Velocities of order one, 6e-8 each, through a fit whose moments differ by tens.
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_LT(norm(result[i] - linear[i]), 1e-5f);
}

TEST(NoiseOfNewtonian, KeepsMomentumAndAngularMomentumAndTakesEnergyAlone)
{
    for (const std::string coeffs : {"c 0.2; perCapillaryStep 0;", "c 1;"})
    {
        for (const bool flat : {false, true})
        {
            const auto points = flat ? randomPoints(300, {0, 0, 0}, {14, 14, 0.3f}) : disorderedBall(5);
            const auto velocities = randomPoints(int(points.size()), {-1, -1, -1}, {1, 1, 1}, 2);
            LiquidCase drop(liquidOf("0"));
            const auto result = after(drop, points, velocities, 0.02f, coeffs);
            const MotionSums before = motionOf(points, velocities), now = motionOf(points, result);
            EXPECT_LT(now.energy, before.energy) << coeffs;
            // 500 velocities of order one, rounded to 6e-8, at distances of up to 20. Where a flat layer leaves the gradient open, pairs of it turn.
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(now.momentum[c], before.momentum[c], 2e-5) << coeffs;
            if (flat) continue;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(now.angular[c], before.angular[c], 1e-4) << coeffs;
        }
    }
}

// One particle that moves among others at rest loses the share c of most of its velocity.
TEST(NoiseOfNewtonian, CalmsSingleParticles)
{
    const auto points = latticeBlock(7, 7, 7, 1);
    std::vector<Vec3> velocities(points.size());
    velocities[171] = {1, 0, 0};                                // the middle
    LiquidCase drop(liquidOf("0"));
    const scalar lost = 1 - after(drop, points, velocities, 0.02f, "c 0.2; perCapillaryStep 0;")[171].x;
    EXPECT_GT(lost, 0.2f * 0.5f);                               // W of the particle itself is a third of all
    EXPECT_LT(lost, 0.2f);
}

// Walls take part with their share of c: of what a particle's velocity differs from those around it, and of nothing else.
TEST(NoiseOfNewtonian, IsHeldBackByWalls)
{
    const auto points = latticeBlock(5, 5, 3, 1, {-2, -2, 0.5f});
    const std::size_t middle = 12;                              // of the lowest layer
    const auto stepped = [&](const std::string& coeffs, const std::vector<Vec3>& velocities)
    {
        LiquidCase flow(liquidOf("0", floorPlane));
        return after(flow, points, velocities, 0.02f, coeffs);
    };
    const std::vector<Vec3> along(points.size(), {1, 0, 0});
    for (const Vec3 u : stepped("c 1; atWalls 1;", along)) EXPECT_LT(norm(u - along[0]), 1e-6);

    std::vector<Vec3> single(points.size());
    single[middle] = {1, 0, 0};
    const auto taken = [&](const std::string& coeffs) { return 1 - stepped(coeffs, single)[middle].x; };
    const scalar free = taken("c 1; atWalls 0;"), whole = taken("c 1; atWalls 1;") - free;
    EXPECT_GT(whole, 0.1f);
    EXPECT_NEAR(taken("c 1; atWalls 0.3;") - free, 0.3f * whole, 1e-6);
}

// A word alone means what the ladder validates.
TEST(NoiseOfNewtonian, WithoutCoefficientsIsWhatWasValidated)
{
    const auto result = [](const std::string& coeffs)
    {
        LiquidCase drop(liquidOf("0", floorPlane));
        return after(drop, latticeBlock(3, 3, 3, 1, {-1, -1, 0.5f}), randomPoints(27, {-1, -1, -1}, {1, 1, 1}, 2), 0.05f, coeffs);
    };
    const auto bare = result(""), said = result("c 0.2; perCapillaryStep 0.98; atWalls 1;");
    for (std::size_t i = 0; i < bare.size(); ++i) EXPECT_EQ(norm(bare[i] - said[i]), 0) << i;
}

TEST(Newtonian, RefusesCoefficientsOutOfRange)
{
    LiquidCase drop;
    const auto make = [&](const std::string& coeff)
    {
        Viscosity::New(Dictionary::parse("viscosity newtonian; newtonianCoeffs { " + coeff + "; }", "constant/models"), drop.liquid);
    };
    EXPECT_TRUE(holds(messageOf([&] { make("slipLength -1e-6"); }), {"constant/models", "slipLength", "0 m or more"}));
    EXPECT_TRUE(holds(messageOf([&] { make("tolerance 1"); }), {"constant/models", "tolerance", "below 1"}));
    EXPECT_TRUE(holds(messageOf([&] { make("maxIterations 0"); }), {"constant/models", "maxIterations", "1 or more"}));
}

TEST(NoiseOfNewtonian, RefusesCoefficientsOutOfRange)
{
    LiquidCase drop(liquidOf("0"));
    for (const std::string coeff : {"c -0.1", "c 1.5", "perCapillaryStep 1.5", "atWalls 2"})
    {
        const Dictionary models = Dictionary::parse("viscosity newtonian; newtonianCoeffs { " + coeff + "; }", "constant/models");
        EXPECT_TRUE(holds(messageOf([&] { Viscosity::New(models, drop.liquid); }), {"constant/models", "out of range"})) << coeff;
    }
    LiquidCase slack(CaseText{.liquidProperties = "rho 1000; nu 1e-6; sigma 0;"});
    const Dictionary models = Dictionary::parse("viscosity newtonian; newtonianCoeffs { perCapillaryStep 0.5; }", "constant/models");
    EXPECT_TRUE(holds(messageOf([&] { Viscosity::New(models, slack.liquid); }), {"surface tension", "perCapillaryStep 0"}));
}

// In a shear flow u = S z the stress takes nu S^2 dt of a particle's mass, 2 nu S^2 dt of its u^2; no noise is in it. So deep inside; where neighbours lie nearly in a plane at
// the surface the model leaves stress out (f of PairStress.H), at most half of it in this ball. The model tells it where it takes noise besides, and changes nothing by telling.
TEST(Newtonian, TellsWhatOfItIsNotNoise)
{
    LiquidCase drop(liquidOf("1e-4"));
    const auto points = disorderedBall(5);
    constexpr scalar shear = 0.1f, dt = 0.01f;
    std::vector<Vec3> flow;
    for (const Vec3& p : points) flow.push_back({shear * p.z, 0, 0});
    drop.place(points, flow);
    const auto model = Viscosity::New(Dictionary::parse("viscosity newtonian;"), drop.liquid);
    const auto told = model->dissipation(drop.liquid, drop.near, drop.walls, dt);
    ASSERT_TRUE(told);
    const scalar rate = shear / drop.liquid.spacing(), expected = 2 * scaledNu(drop) * rate * rate * dt;
    Buffer<Vec3> values(int(points.size()));
    values.upload([&]
    {
        std::vector<Vec3> each;
        for (const scalar taken : told->download()) each.push_back({taken, 0, 0});
        return each;
    }());
    const auto taken = drop.inOrder(values);
    int deep = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        ASSERT_LT(taken[i].x, 1.001f * expected);           // single precision, of sums of some 30 neighbours
        ASSERT_GT(taken[i].x, 0.5f * expected);
        if (norm(points[i]) > 2.5f) continue;               // half of the ball's radius: a support away from the surface
        ASSERT_NEAR(taken[i].x, expected, 1e-3f * expected);
        ++deep;
    }
    EXPECT_GT(deep, 20);
    const auto velocities = drop.inOrder(drop.liquid.velocity);
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(norm(velocities[i] - flow[i]), 0);

    // Without noise all that it takes is of viscosity.
    const auto alone = Viscosity::New(Dictionary::parse("viscosity newtonian; newtonianCoeffs { " + stressAlone + " }"), drop.liquid);
    EXPECT_FALSE(alone->dissipation(drop.liquid, drop.near, drop.walls, dt));
}
