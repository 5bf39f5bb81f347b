// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/reactions/WallReactions.H"
#include "models/viscosity/Viscosity.H"
#include "stepping/SubStep.H"
#include "support/LiquidCase.H"
#include "support/MotionSums.H"

#include <cmath>
#include <numbers>

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

// A ball that the liquid moves. middle: as text, m; omega: rad/s, about z.
std::string ballThatTurns(const std::string& middle, double radius, double omega)
{
    return "ball { type sphere; centre " + middle + "; radius " + std::to_string(radius) + "; liquid outside; motion { type sixDoF; mass 1; momentOfInertia 1; centreOfMass " + middle
        + "; omega (0 0 " + std::to_string(omega) + "); } }";
}

CaseText bodyIn(const std::string& others, const std::string& ball, const std::string& nu)
{
    return {.liquidProperties = "rho 1000; nu " + nu + "; sigma 0.072;", .walls = others + ball};
}

// A step of the viscosity alone, without what it takes as noise, and what the body got in it, particle by particle.
struct FrictionStep
{
    LiquidCase flow;
    scalar dt;
    std::vector<Vec3> positions, before, behind, given;

    FrictionStep(const CaseText& text, double seconds, const std::vector<Vec3>& points, const std::vector<Vec3>& velocities)
    :
        flow(text), dt(flow.liquid.units().toScaled(seconds, dimensions::time)), before(velocities)
    {
        flow.walls.moveTo(0, seconds);
        flow.place(points, velocities);
        const auto model = Viscosity::New(Dictionary::parse("viscosity newtonian; newtonianCoeffs { tolerance 1e-6; c 0; perCapillaryStep 0; }"), flow.liquid);
        const Buffer<Vec3>* loss = model->keepFriction("ball");
        positions = flow.inOrder(flow.liquid.position);
        model->apply(flow.liquid, flow.near, flow.walls, dt);
        behind = flow.inOrder(flow.liquid.velocity);
        given = flow.inOrder(*loss);
    }
};

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

// What a body gets by friction in short steps, in steps of two halves and in solved ones is what the liquid on it loses, force and moment. Liquid on another wall gives it nothing.
// Velocities of one have 6e-8 each, and solved ones have the tolerance of 1e-6, beside losses of a tenth and more of the momentum.
TEST(FrictionOnBody, IsWhatItsLiquidLoses)
{
    const auto onBody = latticeBlock(5, 5, 3, 1, {-2, -1, 35.5f}), onFloor = latticeBlock(5, 5, 3, 1, {-2, -2, 0.5f});
    auto points = onBody;
    points.insert(points.end(), onFloor.begin(), onFloor.end());
    const auto velocities = randomPoints(int(points.size()), {0, -1, -1}, {2, 1, 1});
    const auto first = [&](const std::vector<Vec3>& all) { return std::vector<Vec3>(all.begin(), all.begin() + onBody.size()); };
    for (const double seconds : {2e-5, 4e-4, 2e-2})
    {
        const FrictionStep step(bodyIn(floorPlane, ballThatTurns("(0 0 0.03)", 5e-3, 10), "1e-4"), seconds, points, velocities);
        const auto x = first(step.positions);
        const MotionSums given = motionOf(x, first(step.given)), before = motionOf(x, first(velocities)), behind = motionOf(x, first(step.behind));
        const double most = std::abs(given.momentum[0]);
        EXPECT_GT(most, 0.01 * before.momentum[0]) << seconds;
        for (int c = 0; c < 3; ++c)
        {
            EXPECT_NEAR(given.momentum[c], before.momentum[c] - behind.momentum[c], 1e-4 * most) << seconds << c;
            EXPECT_NEAR(given.angular[c], before.angular[c] - behind.angular[c], 1e-4 * 36 * step.flow.liquid.spacing() * most) << seconds << c;
        }
        for (std::size_t i = onBody.size(); i < points.size(); ++i) EXPECT_EQ(squared(step.given[i]), 0) << i;
    }
}

// Between a sphere of four spacings and one of ten around it: the one that turns feels a moment against that, and the one at rest one along with it, of 8 pi mu omega R1^3 R2^3/(R2^3 - R1^3)
// (Lamb 1932, article 334). One long step comes to Stokes' flow. Walls hold liquid as flat ones do: on a sphere that is (1 + s/R)^2 too much at a distance s, 27 % in the first layer here.
TEST(FrictionOnBody, TurnsSpheresAsStokesHasIt)
{
    std::vector<Vec3> points;
    for (int layer = 4; layer < 10; ++layer)
    {
        const int n = int(std::lround(4 * std::numbers::pi / 3 * (3 * layer * (layer + 1) + 1)));
        for (int i = 0; i < n; ++i)
        {
            const double z = 1 - (2 * i + 1.0) / n, turn = i * std::numbers::pi * (3 - std::sqrt(5)) + layer, across = std::sqrt(1 - z * z), r = layer + 0.5;
            points.push_back({scalar(r * across * std::cos(turn)), scalar(r * across * std::sin(turn)), scalar(r * z)});
        }
    }
    const double seconds = 1e-2, omega = 1;                     // nu t is a hundred times R2^2
    const double exact = 8 * std::numbers::pi * 64 * 1000 / (1000 - 64.0);
    for (const bool own : {true, false})
    {
        const std::string motion = own ? "" : "motion { type rotation; origin (0 0 0); axis (0 0 1); omega 1; } ";
        const std::string bath = "bath { type sphere; centre (0 0 0); radius 0.01; liquid inside; " + motion + "}";
        const FrictionStep step(bodyIn(bath, ballThatTurns("(0 0 0)", 4e-3, own ? omega : 0), "1"), seconds, points, {});
        const double nu = step.flow.liquid.units().toScaled(step.flow.liquid.properties().viscosity, dimensions::kinematicViscosity);
        const double ratio = motionOf(step.positions, step.given).angular[2] / (nu * omega * seconds) / (own ? -exact : exact);
        EXPECT_GT(ratio, 1) << own;
        EXPECT_LT(ratio, 1.27) << own;
    }
}

// Beside a floor that holds its own liquid a body gets its own friction and no other's, to rounding, and all walls together what the liquid loses.
TEST(FrictionOnBody, IsNoShareOfOtherWalls)
{
    CaseText text = bodyIn(floorPlane, ballThatTurns("(0 0 0.0068)", 5e-3, 10), "1e-4");
    text.wettability = "floor { theta 90; } ball { theta 90; }";
    Steps steps(text, usualModels);
    steps.drop.place(latticeBlock(8, 8, 2, 1, {-3.5f, -2.5f, 0.5f}), std::vector<Vec3>(128, {0.1f, 0, 0}));
    const double dt = 0.3 * steps.drop.liquid.properties().capillaryStep();
    const scalar scaled = steps.drop.liquid.units().toScaled(dt, dimensions::time);
    steps.subStep(scaled, 0);
    steps.reactions.addTo(steps.drop.liquid);
    const Units& units = steps.drop.liquid.units();
    const MotionSums given = motionOf(steps.drop.inOrder(steps.drop.liquid.position), steps.drop.inOrder(*steps.models.viscosity->keepFriction("ball")));
    const double unit = steps.drop.liquid.properties().particleMass() * units.of(dimensions::velocity);
    EXPECT_GT(given.momentum[0], 0);
    for (int c = 0; c < 3; ++c)
    {
        EXPECT_NEAR(steps.of("ball", WallReactions::friction, c), unit * given.momentum[c], 1e-6 * unit * given.momentum[0]);
        EXPECT_NEAR(steps.of("ball", WallReactions::friction, c + 3), unit * units.length * given.angular[c], 1e-5 * unit * units.length * given.momentum[0]);
    }
}

// In liquid at rest of a hydrostatic pressure a sphere of five spacings is lifted by the weight of what it displaces (Archimedes), far from a floor and with a gap of a spacing to it, in which the weight
// of the liquid ends at the floor. The points are a lattice, so that what is left is of the sums alone: three and a half times that weight less two and a half, of 1,800 points, each 1 to 2 % uneven.
// With the weight for many layers the gap has 1.32.
TEST(BodyReaction, LiftsByWhatIsDisplaced)
{
    constexpr double R = 5, g = 1e-3;
    for (const double gap : {6.0, 1.0})
    {
        const double z = R + gap;
        std::vector<Vec3> points;
        for (const Vec3 x : latticeBlock(22, 22, 22, 1, {-10.3f, -10.6f, 0.5f}))
        {
            if (norm(x - Vec3{0, 0, scalar(z)}) > R) points.push_back(x);
        }
        LiquidCase flow(bodyIn(floorPlane, ballThatTurns("(0 0 " + std::to_string(1e-3 * z) + ")", 1e-3 * R, 0), "1e-6"));
        flow.place(points);
        const Liquid& liquid = flow.liquid;
        const scalar d = liquid.spacing(), dt = 1;
        std::vector<scalar> values;
        for (const Position x : liquid.position.download()) values.push_back(scalar(liquid.restDensity() * g * (22 * d - vectors({x})[0].z)));
        Buffer<scalar> pressure;
        pressure.upload(values);
        BodyReaction reaction(flow.walls.surfaceOfBody(), 1e-3 * R);
        reaction.begin(liquid, flow.walls, {0, 0, -dt * g});
        reaction.pressed(liquid);
        reaction.end(liquid, flow.walls, flow.surface, std::as_const(pressure).span(), dt);
        const double lift = reaction.take(liquid).of[2] / (dt * g * 4 * std::numbers::pi / 3 * R * R * R);
        EXPECT_NEAR(lift, 1, 0.07) << gap;
    }
}
