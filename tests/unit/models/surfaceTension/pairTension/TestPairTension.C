// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/surfaceTension/SurfaceTension.H"

#include "maths/CohesionSpline.H"
#include "support/PairForceMeter.H"
#include "support/PairReference.H"
#include "support/VectorSum.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

const std::string splineKernel = "type cubicSpline; support 2;", spikyKernel = "type poly6Spiky; support 2.5;";

std::unique_ptr<SurfaceTension> makePairTension(LiquidCase& drop, const std::string& word)
{
    return SurfaceTension::New
    (
        Dictionary::parse("surfaceTension " + word + "; " + word + "Coeffs { gamma 1.5; }"), drop.liquid, drop.walls,
        drop.surface
    );
}

// A particle's sum has some twenty terms of either sign, each rounded to 1e-7, and normals add theirs: 2e-5 of the
// largest acceleration.
constexpr double tolerance = 2e-5;

const auto points = randomPoints(250, {-3, -3, 0.1f}, {3, 3, 5});

}

TEST(PairTension, EqualsTheSumOverAllPairs)
{
    for (const std::string word : {"Akinci2013", "Fujisawa2014"})
    {
        for (const bool spline : {true, false})
        {
            LiquidCase drop({.kernel = spline ? splineKernel : spikyKernel});
            const auto tension = makePairTension(drop, word);
            drop.place(points);
            auto reference = spline ? pairSystem<CubicSpline>(drop, points) : pairSystem<Poly6Spiky>(drop, points);
            reference.prepare();
            EXPECT_TRUE(agree(accelerationsOf(drop, *tension), drop.liquid.units(), reference.tension(), tolerance))
                << word << ", " << (spline ? splineKernel : spikyKernel);
        }
    }
}

// Solids change the densities for both, and the normals by 1 + cos theta for Fujisawa2014.
TEST(PairTension, EqualsTheSumOverAllPairsNearSolidParticles)
{
    const auto solid = latticeBlock(11, 11, 1, 0.8f, {-4, -4, -0.4f});
    for (const bool wallNormals : {false, true})
    {
        LiquidCase drop({.walls = sampledFloor, .solidPositions = solid,
                         .solidTheta = std::vector<double>(solid.size(), 60)});
        const auto tension = makePairTension(drop, wallNormals ? "Fujisawa2014" : "Akinci2013");
        drop.place(points);
        auto reference = pairSystem<CubicSpline>(drop, points, solid);
        reference.solidCosTheta = 0.5;
        reference.wallNormals = wallNormals;
        reference.prepare();
        EXPECT_TRUE(agree(accelerationsOf(drop, *tension), drop.liquid.units(), reference.tension(), tolerance))
            << wallNormals;
    }
}

// The tables of half-spaces are interpolated: 1e-3 of the largest acceleration.
TEST(PairTension, EqualsTheSumOverAllPairsNearAnAnalyticFloor)
{
    for (const bool wallNormals : {false, true})
    {
        LiquidCase drop({.walls = floorPlane,
                         .wettability = "floor { theta 120; }"});
        const auto tension = makePairTension(drop, wallNormals ? "Fujisawa2014" : "Akinci2013");
        drop.place(points);
        auto reference = pairSystem<CubicSpline>(drop, points);
        reference.floor = true;
        reference.floorCosTheta = -0.5;
        reference.wallNormals = wallNormals;
        reference.prepare();
        EXPECT_TRUE(agree(accelerationsOf(drop, *tension), drop.liquid.units(), reference.tension(), 1e-3))
            << wallNormals;
    }
}

// Pair forces are equal and opposite, term by term: what is left are the roundings of 500 sums of some thirty terms.
TEST(PairTension, ConservesMomentum)
{
    for (const std::string word : {"Akinci2013", "Fujisawa2014"})
    {
        LiquidCase drop;
        const auto tension = makePairTension(drop, word);
        drop.place(randomPoints(500, {0, 0, 0}, {7, 7, 7}, 9));
        const VectorSum forces = sumOf(accelerationsOf(drop, *tension));
        for (const double component : forces.components) EXPECT_NEAR(component, 0, 1e-6 * forces.sizes) << word;
    }
}

// Two particles: repelled below 0.273 h, attracted above, along their line.
TEST(PairTension, AttractsAPairFromAfarAndRepelsItInContact)
{
    LiquidCase drop;
    const auto tension = SurfaceTension::New
    (
        Dictionary::parse("surfaceTension Akinci2013; Akinci2013Coeffs { areaWeight 0; }"), drop.liquid, drop.walls,
        drop.surface
    );
    for (const auto& [distance, attracts] : {std::pair{0.5f, false}, {0.6f, true}, {1.9f, true}})
    {
        drop.place({{0, 0, 0}, {distance, 0, 0}});
        const auto a = accelerationsOf(drop, *tension);
        EXPECT_EQ(a[0].x > 0, attracts) << distance;
        EXPECT_EQ(a[0].x, -a[1].x) << distance;
        EXPECT_EQ(a[0].y, 0);
    }
    drop.place({{0, 0, 0}, {2, 0, 0}, {0, 50, 0}, {0, 50, 0}});     // at the support, and two at one place
    for (const Vec3& a : accelerationsOf(drop, *tension)) EXPECT_EQ(norm(a), 0);
}

TEST(PairTension, TakesItsCoefficientFromSigmaUnlessGiven)
{
    LiquidCase drop;
    const double h = drop.liquid.units().toSI(drop.liquid.support(), dimensions::length);
    const auto gammaOf = [&](const std::string& coeffs)
    {
        const auto tension = SurfaceTension::New
        (
            Dictionary::parse("surfaceTension Fujisawa2014; Fujisawa2014Coeffs { " + coeffs + " }"),
            drop.liquid, drop.walls, drop.surface
        );
        return *tension->pairCoefficients();
    };
    const double gammaUnit = drop.liquid.units().of({{-1, 4, -2, 0, 0, 0, 0}});
    const double areaUnit = drop.liquid.units().of(dimensions::acceleration);
    const double fromSigma = cohesionCoefficient(0.072, 1000, h);
    // Stored as scalar: 6e-8.
    EXPECT_NEAR(gammaOf("").cohesion * gammaUnit, fromSigma, 1e-7 * fromSigma);
    EXPECT_NEAR(gammaOf("").area * areaUnit, fromSigma * 1, 1e-7 * fromSigma);              // rho_A = 1e-3 rho
    EXPECT_NEAR(gammaOf("gamma 1.5; areaWeight 0.1;").cohesion * gammaUnit, 1.5, 2e-7);
    EXPECT_NEAR(gammaOf("gamma 1.5; areaWeight 0.1;").area * areaUnit, 150, 2e-5);
    EXPECT_TRUE(holds(messageOf([&] { gammaOf("gamma -1;"); }), {"gamma"}));
    EXPECT_TRUE(holds(messageOf([&] { gammaOf("areaWeight -1;"); }), {"areaWeight"}));
}
