#include "models/viscosity/Viscosity.H"

#include "support/LiquidCase.H"
#include "support/ReferenceKernels.H"

using namespace shizuku;
using namespace shizuku::test;

// u_i += c sum_j V (u_j - u_i) W_ij over all pairs in double precision.
TEST(XSPH, SmoothsVelocitiesByItsFormula)
{
    LiquidCase drop;
    const auto points = randomPoints(300, {0, 0, 0}, {6, 6, 6});
    const auto velocities = randomPoints(300, {-1, -1, -1}, {1, 1, 1}, 2);
    drop.place(points, velocities);
    const auto model = Viscosity::New(Dictionary::parse("viscosity XSPH; XSPHCoeffs { c 0.2; }"), drop.liquid);
    model->apply(drop.liquid, drop.near, drop.walls, 0.02f);
    EXPECT_EQ(model->stepLimit(drop.liquid.properties()), std::numeric_limits<double>::infinity());

    const auto smoothed = drop.inOrder(drop.liquid.velocity);
    const Reference<CubicSpline> W{2};                  // in spacings, in which V = 1
    for (int i = 0; i < 300; ++i)
    {
        double expected = velocities[i].x;
        for (int j = 0; j < 300; ++j)
        {
            expected += 0.2 * (double(velocities[j].x) - velocities[i].x) * W.W(norm(points[i] - points[j]));
        }
        ASSERT_NEAR(smoothed[i].x, expected, 2e-6) << i;        // some twenty terms of order 0.1, each rounded to 6e-8
    }
}

TEST(XSPH, RefusesACoefficientOutOfRange)
{
    LiquidCase drop;
    for (const std::string c : {"-0.1", "1.5"})
    {
        const Dictionary models = Dictionary::parse("viscosity XSPH; XSPHCoeffs { c " + c + "; }", "constant/models");
        EXPECT_TRUE(holds(messageOf([&] { Viscosity::New(models, drop.liquid); }), {"constant/models", "0 to 1"}));
    }
}
