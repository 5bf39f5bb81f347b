// SPDX-License-Identifier: GPL-3.0-or-later
// Tension in steps that do not resolve the shortest waves: what it leaves alone, what it keeps, and that free liquid at rest stays at rest in such steps.

#include "freeSurface/SemiImplicitTension.H"

#include "stepping/SubStep.H"
#include "support/DisorderedBall.H"
#include "support/LiquidCase.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// A disordered ball without walls, its free surface known.
class Ball : public LiquidCase
{
public:
    explicit Ball(scalar radius = 5)
    {
        surface.requireUsual(liquid);
        place(disorderedBall(radius));
    }

    scalar capillarySteps(double n) const { return liquid.units().toScaled(n * liquid.properties().capillaryStep(), dimensions::time); }

    // What is applied of these accelerations in a step of so many capillary ones, in the order in which particles were placed.
    std::vector<Vec3> applied(std::vector<Vec3> given, double steps)
    {
        const auto id = liquid.id.download();
        std::vector<Vec3> sorted(given.size());
        for (std::size_t i = 0; i < id.size(); ++i) sorted[i] = given[id[i]];
        Buffer<Vec3> acceleration(sorted);
        SemiImplicitTension(liquid).apply(liquid, near, surface, capillarySteps(steps), acceleration);
        return inOrder(acceleration);
    }

    std::vector<Vec3> random()
    {
        RandomNumbers numbers(11);
        std::vector<Vec3> f(liquid.owned());
        for (Vec3& v : f) v = numbers({-1, -1, -1}, {1, 1, 1});
        return f;
    }
};

double product(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += double(dot(a[i], b[i]));
    return sum;
}

}

TEST(SemiImplicitTension, IsForStepsThatDoNotResolveTheShortestWaves)
{
    const Ball ball;
    const SemiImplicitTension tension(ball.liquid);
    EXPECT_FALSE(tension.isNeeded(ball.capillarySteps(1.39)));
    EXPECT_TRUE(tension.isNeeded(ball.capillarySteps(1.41)));
    EXPECT_GT(tension.iterations(ball.capillarySteps(10)), tension.iterations(ball.capillarySteps(2.8)));
}

// All differences vanish. What iterations leave wrong is a fiftieth of what K changes, here of nothing; the rest is the series' own sum, within 2 %.
TEST(SemiImplicitTension, LeavesAnAccelerationOfTheWholeAlone)
{
    Ball ball;
    const std::vector<Vec3> whole(ball.liquid.owned(), Vec3{0.3f, -0.5f, 0.7f});
    for (const double steps : {2.8, 10.0})
    {
        for (const Vec3 a : ball.applied(whole, steps))
        {
            EXPECT_NEAR(a.x, 0.3f, 0.02f * 0.3f);
            EXPECT_NEAR(a.y, -0.5f, 0.02f * 0.5f);
            EXPECT_NEAR(a.z, 0.7f, 0.02f * 0.7f);
        }
    }
}

// The map is that of an inverse of a symmetric matrix that is no smaller than one, but for the fiftieth: it is symmetric, makes nothing larger, and turns nothing against its force.
TEST(SemiImplicitTension, IsSymmetricAndOnlyEverSlower)
{
    Ball ball;
    const std::vector<Vec3> f = ball.random();
    std::vector<Vec3> g(f.rbegin(), f.rend());
    for (const double steps : {2.8, 10.0})
    {
        const std::vector<Vec3> a = ball.applied(f, steps), b = ball.applied(g, steps);
        const double squares = product(f, f);
        EXPECT_NEAR(product(a, g), product(f, b), 1e-5 * squares);         // rounding of single precision over a thousand products
        EXPECT_LT(product(a, a), 1.05 * squares);
        EXPECT_GT(product(a, f), 0);
    }
}

// Random forces differ from particle to particle, as waves do that no step resolves: of their normal part near the surface little is left in long steps.
TEST(SemiImplicitTension, SlowsShortWaves)
{
    Ball ball;
    const std::vector<Vec3> f = ball.random();
    const double all = product(f, f);
    const double some = product(ball.applied(f, 2.8), f), less = product(ball.applied(f, 20), f);
    EXPECT_LT(some, 0.97 * all);
    EXPECT_LT(less, some);
}

// Water, R = 0.94 mm, in steps of 2.8 capillary ones for 0.1 s. With explicit tension it swings itself up from 8e-3 to 0.025 v_c on the way, and to 0.14 later.
TEST(SemiImplicitTension, LetsAFreeBallRestInLongSteps)
{
    LiquidCase ball({.spacing = 1.5e-4, .liquidProperties = "rho 998; nu 1e-6; sigma 0.0728;"});
    ball.folder.write
    (
        "constant/models", "pressure completedPbf; surfaceTension laplacePressure; wetting extendedSurface; viscosity newtonian; bodyForce none;"
    );
    Models models(ball.folder.path(), Dictionary(), ball.liquid, ball.walls);
    models.takeEffect(ball.liquid, ball.walls);
    ball.place(latticeBall(6.667f));
    const LiquidProperties& p = ball.liquid.properties();
    const double step = 2.8 * p.capillaryStep();
    const scalar dt = ball.liquid.units().toScaled(step, dimensions::time);
    settle(ball.liquid, ball.near, ball.walls, models, dt);
    SubStep subStep(ball.liquid, ball.near, ball.walls, models);
    for (double time = 0; time < 0.1; time += step) subStep(dt);
    double squares = 0;
    const auto u = ball.liquid.velocity.download();
    for (const Vec3 v : u) squares += double(squared(v));
    const double speed = std::sqrt(squares / double(u.size())) * ball.liquid.units().of(dimensions::velocity);
    const double capillarySpeed = std::sqrt(p.surfaceTension / (p.density * 1e-3));
    EXPECT_LT(speed, 0.006 * capillarySpeed);           // 0.0024 at 0.08 s, where explicit tension has 0.019 and more from then on
}
