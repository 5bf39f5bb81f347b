// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/PressureReference.H"

#include <algorithm>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr scalar deltaT = 0.05f;

// A ball of radius 5 that shrinks and turns: velocities in scaled units.
const auto ball = latticeBall(5);

std::vector<Vec3> shrinking(scalar rate)
{
    std::vector<Vec3> u;
    for (const Vec3& x : ball) u.push_back(Vec3{-rate * x.x - 0.3f * x.y, -rate * x.y + 0.3f * x.x, -rate * x.z});
    return u;
}

std::vector<Vector3> inMetres(const Units& units, const std::vector<Vec3>& values, const Dimensions& dimensions)
{
    std::vector<Vector3> result;
    for (const Vec3& v : values) result.push_back(units.of(dimensions) * Vector3(v.x, v.y, v.z));
    return result;
}

// sum_j V (u_i - u_j) . grad W_ij over all pairs, 1/s (or the change of rho/rho0 where u is a way).
std::vector<double> densityRates(const PairSystem& system, const std::vector<Vector3>& u)
{
    std::vector<double> rates;
    for (std::size_t i = 0; i < u.size(); ++i)
    {
        rates.push_back(sumOfGradients<double>(system, i, [&](std::size_t, int j, const Vector3& gradient)
        {
            return dot(j < 0 ? u[i] : u[i] - u[j], gradient);
        }));
    }
    return rates;
}

// Average of the positive ones among particles that have a full neighbourhood, nearly.
double averageInside(const std::vector<double>& values)
{
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += norm(ball[i]) < 4 ? std::max(values[i], 0.0) : 0;
    return sum / double(values.size());
}

}

// The rate at which particles are compressed falls from that of the field (nearly three times the rate of shrinking) to the
// tolerance, which is of the average over all particles.
TEST(DFSPH, TakesTheDivergenceOutOfTheVelocities)
{
    LiquidCase drop;
    const auto pressure = makePressure(drop, "DFSPH", "divergence { tolerance 1e-4; maxIterations 200; }");
    drop.place(ball, shrinking(0.5f));
    const auto system = pairSystem<CubicSpline>(drop, ball);
    const auto rates = [&]
    {
        return densityRates(system, inMetres(drop.liquid.units(), drop.inOrder(drop.liquid.velocity), dimensions::velocity));
    };
    const double second = drop.liquid.units().time;
    EXPECT_GT(averageInside(rates()) * second, 0.5);
    pressure->begin(deltaT);
    pressure->correctVelocities(drop.liquid, drop.near, drop.walls);
    EXPECT_LT(averageInside(rates()) * second, 1e-4 / deltaT * 1.01);       // rounding of sums of velocities

    // Turning is left alone: the mean angular velocity about z stays 0.3 to the lattice's errors.
    double turn = 0, inertia = 0;
    const auto u = drop.inOrder(drop.liquid.velocity);
    for (std::size_t i = 0; i < ball.size(); ++i)
    {
        const Vec3 x = drop.liquid.spacing() * ball[i];
        turn += x.x * u[i].y - x.y * u[i].x;
        inertia += x.x * x.x + x.y * x.y;
    }
    EXPECT_NEAR(turn / inertia * drop.liquid.spacing(), 0.3, 1e-3);
}

// The surface may open: liquid that expands is not held back.
TEST(DFSPH, LeavesExpansionAlone)
{
    LiquidCase drop;
    const auto pressure = makePressure(drop, "DFSPH", "");
    drop.place(ball, shrinking(-0.5f));
    const auto before = drop.inOrder(drop.liquid.velocity);
    pressure->begin(deltaT);
    pressure->correctVelocities(drop.liquid, drop.near, drop.walls);
    const auto after = drop.inOrder(drop.liquid.velocity);
    for (std::size_t i = 0; i < ball.size(); ++i) ASSERT_EQ(norm(after[i] - before[i]), 0);
}

// The density that the paper's (11) predicts from the way made, by all pairs.
TEST(DFSPH, HoldsTheDensityThatTheWayLeadsTo)
{
    for (auto& [drop, system] : pressureCases(randomPoints(250, {-3, -3, 0.1f}, {3, 3, 5})))
    {
        std::vector<Vec3> points;
        for (const Vector3& x : system.liquid) points.push_back({scalar(1e3 * x.x), scalar(1e3 * x.y), scalar(1e3 * x.z)});
        const auto pressure = makePressure(*drop, "DFSPH", "tolerance 1e-3; maxIterations 400;");
        drop->place(points);
        const auto start = drop->inOrder(drop->liquid.position);
        const int iterations = iterate(*pressure, *drop, deltaT);
        EXPECT_GT(iterations, 2);
        EXPECT_LT(iterations, 400);
        auto way = drop->inOrder(drop->liquid.predicted);
        for (std::size_t i = 0; i < way.size(); ++i) way[i] -= start[i];
        const auto change = densityRates(system, inMetres(drop->liquid.units(), way, dimensions::length));
        double compression = 0;
        for (std::size_t i = 0; i < change.size(); ++i) compression += std::max(system.density[i] + change[i] - 1, 0.0);
        EXPECT_LE(compression / double(change.size()), 1.1e-3);     // the half-space's table is interpolated
    }
}

// The first iteration over all pairs: kappa = (rho - rho0) alpha/deltaT^2, alpha of (9); half of it, the relaxation.
TEST(DFSPH, MakesTheFirstIterationOfThePaper)
{
    const auto points = randomPoints(250, {-3, -3, 0.1f}, {3, 3, 5});
    for (auto& [drop, system] : pressureCases(points))
    {
        const auto pressure = makePressure(*drop, "DFSPH", "minIterations 1; maxIterations 1;");
        drop->place(points);
        const auto before = drop->inOrder(drop->liquid.predicted);
        EXPECT_EQ(iterate(*pressure, *drop, deltaT), 1);

        const double seconds = drop->liquid.units().toSI(deltaT, dimensions::time);
        std::vector<double> p;
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const auto sum = sumOfGradients<Vector3>(system, i, [](std::size_t, int, const Vector3& g) { return g; });
            const double squares = sumOfGradients<double>
            (
                system, i, [](std::size_t, int j, const Vector3& g) { return j < 0 ? 0 : squaredLength(g); }
            );
            const double alpha = 1 / (squares + squaredLength(sum));
            p.push_back(0.5 * std::max((system.density[i] - 1) * alpha * system.restDensity / (seconds * seconds), 0.0));
        }
        const auto expected = pressureForces(system, [&](std::size_t i, int j) { return j < 0 ? p[i] : p[i] + p[j]; });
        EXPECT_TRUE(agree(accelerationsSince(before, *drop, deltaT), drop->liquid.units(), expected, system.floor ? 1e-3 : 1e-4));
    }
}

// The same step again needs less of it: the warm start is the last step's result.
TEST(DFSPH, StartsWithWhatTheLastStepCameTo)
{
    int needed[2];
    for (const bool warm : {false, true})
    {
        LiquidCase drop;
        const std::string controls = "minIterations 0; warmStart " + std::string(warm ? "yes;" : "no;");
        const auto pressure = makePressure(drop, "DFSPH", controls);
        drop.place(latticeBlock(7, 7, 7, 0.97f));
        const auto start = vectors(drop.liquid.predicted);
        const int first = iterate(*pressure, drop, deltaT);
        EXPECT_GT(first, 3);
        drop.liquid.predicted.upload(placed(start));
        needed[warm] = iterate(*pressure, drop, deltaT);
        EXPECT_EQ(needed[warm] < first, warm);
    }
    EXPECT_LE(needed[true], 1);
}

TEST(DFSPH, RefusesControlsOutOfRange)
{
    LiquidCase drop;
    for (const std::string entry : {"maxIterations 0;", "tolerance -1;", "divergence { maxIterations 0; }", "warmstart no;"})
    {
        EXPECT_TRUE(holds(messageOf([&] { makePressure(drop, "DFSPH", entry); }), {"system/solution"})) << entry;
    }
}
