// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/wetting/Wetting.H"

#include "support/LiquidCase.H"
#include "support/ReferenceKernels.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

std::vector<Vec3> adhesionOf(LiquidCase& drop, const std::string& models)
{
    const Dictionary dict = Dictionary::parse(models);
    const auto tension = SurfaceTension::New(dict, drop.liquid, drop.walls, drop.surface);
    const auto wetting = Wetting::New(dict, drop.liquid, drop.walls, *tension);
    Buffer<Vec3> acceleration(drop.liquid.all());
    acceleration.setZero();
    wetting->apply(drop.liquid, drop.near, drop.walls, acceleration);
    return drop.inOrder(acceleration);
}

// A(r) in SI, with the root's argument as the paper writes it.
double adhesion(double r, double h)
{
    if (r <= h / 2 || r > h) return 0;
    return 0.007 / std::pow(h, 3.25) * std::pow(std::max(-4 * r * r / h + 6 * r - 2 * h, 0.0), 0.25);
}

}

// One solid particle and liquid at all distances. At h/2 and h the root's argument is a difference of numbers of order
// one, whose rounding, 5e-7, comes out of the fourth root as 0.03: there only that it is a number, and small.
TEST(Akinci2013Wetting, EqualsItsFormulaAndIsANumberEverywhere)
{
    LiquidCase drop({.walls = sampledFloor, .solidPositions = {{0, 0, 0}}});
    const scalar h = 2;                                         // in spacings
    std::vector<Vec3> points;
    for (int i = 1; i < 220; ++i) points.push_back({0.01f * scalar(i), 0, 0});
    for (const scalar border : {0.5f * h, h})
    {
        scalar below = border, above = border;
        for (int i = 0; i < 40; ++i)
        {
            points.push_back({0, below, 0});
            points.push_back({0, above, 0});
            below = std::nextafter(below, 0.0f);
            above = std::nextafter(above, 10.0f);
        }
    }
    drop.place(points);
    const auto found = adhesionOf(drop, "surfaceTension none; wetting Akinci2013; Akinci2013Coeffs { beta 1.2; }");

    const double si = 1e-3, hSI = h * si, volume = 1 / Reference<CubicSpline>{hSI}.W(0);
    const double scale = 1.2 * 1000 * volume / drop.liquid.units().of(dimensions::acceleration);
    const double largest = scale * adhesion(0.75 * hSI, hSI);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        const double r = norm(points[i]);
        ASSERT_TRUE(std::isfinite(norm(found[i]))) << r;
        const bool atBorder = std::min(std::abs(r - 0.5 * h), std::abs(r - h)) < 1e-4;
        const double expected = scale * adhesion(r * si, hSI), along = -dot(found[i], points[i]) / r;
        ASSERT_NEAR(along, expected, atBorder ? 0.1 * largest : 2e-5 * largest) << r;
        ASSERT_NEAR(norm(found[i]), std::abs(along), 1e-6 * largest) << r;
    }
}

// Where the case gives no beta: (1 + cos theta)/2 of the cohesion's work.
TEST(Akinci2013Wetting, TakesItsStrengthFromTheContactAngle)
{
    const auto pullAt = [](double theta)
    {
        LiquidCase drop({.walls = sampledFloor, .solidPositions = {{0, 0, 0}}, .solidTheta = {theta}});
        drop.place({{0, 0, 1.5f}});
        return -adhesionOf(drop, "surfaceTension Akinci2013; Akinci2013Coeffs { gamma 1.5; } wetting Akinci2013;")[0].z;
    };
    EXPECT_GT(pullAt(0), 0);
    // cos theta is stored in single precision.
    EXPECT_NEAR(pullAt(90), 0.5 * pullAt(0), 1e-6 * pullAt(0));
    EXPECT_NEAR(pullAt(60), 0.75 * pullAt(0), 1e-6 * pullAt(0));
    EXPECT_NEAR(pullAt(180), 0, 1e-6 * pullAt(0));
}

// At theta = 0 adhesion separates with the work of cohesion: int C q^4 = int beta/gamma A q^4. The integrals are taken here in
// double precision from the papers' formulas.
TEST(Akinci2013Wetting, DoesTheWorkOfCohesionAtFullWetting)
{
    constexpr int n = 200000;
    double cohesion = 0, pull = 0;
    for (int i = 0; i < n; ++i)
    {
        const double q = (i + 0.5) / n, cubes = std::pow(1 - q, 3) * std::pow(q, 3);
        cohesion += 32 / M_PI * (q > 0.5 ? cubes : 2 * cubes - 1.0 / 64) * std::pow(q, 4) / n;
        pull += adhesion(q, 1) * std::pow(q, 4) / n;
    }
    const auto pullWith = [](const std::string& coeffs)
    {
        LiquidCase drop({.walls = sampledFloor, .solidPositions = {{0, 0, 0}}, .solidTheta = {0}});
        drop.place({{0, 0, 1.5f}});
        return -adhesionOf(drop, "surfaceTension Akinci2013; wetting Akinci2013; Akinci2013Coeffs { " + coeffs + " }")[0].z;
    };
    const scalar expected = pullWith("gamma 1.5; beta " + std::to_string(1.5 * cohesion / pull) + ";");
    // Profiles in single precision: 1e-6 a value; the root is steep at its ends, where the midpoint rule differs by 1e-5.
    EXPECT_NEAR(pullWith("gamma 1.5;"), expected, 1e-4 * expected);
}

TEST(Akinci2013Wetting, RefusesWhatItCannotDo)
{
    const auto refusal = [](const CaseText& text, const std::string& models)
    {
        LiquidCase drop(text);
        drop.place({{0, 0, 5}});
        return messageOf([&] { adhesionOf(drop, models); });
    };
    EXPECT_TRUE(holds(refusal({.walls = floorPlane},
                              "surfaceTension none; wetting Akinci2013; Akinci2013Coeffs { beta 1; }"),
                      {"analytic walls", "type particles"}));
    const std::string alone = "surfaceTension none; wetting Akinci2013;";
    EXPECT_TRUE(holds(refusal({}, alone), {"surfaceTension Akinci2013 or Fujisawa2014"}));
    EXPECT_TRUE(holds(refusal({}, alone + " Akinci2013Coeffs { beta -1; }"), {"beta"}));
}
