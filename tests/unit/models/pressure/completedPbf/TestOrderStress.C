#include "support/PressureReference.H"
#include "support/ReferenceKernels.H"

#include <algorithm>
#include <array>
#include <map>

using namespace shizuku;
using namespace shizuku::test;

// Deep in a compressed, disordered block, in the second step at the same positions: the displacement has the pairs' part of the
// pressure's increase, and that of the stress p D, whose pressure is the first step's.
TEST(OrderStress, IsTakenOutOfThePressure)
{
    constexpr float dt = 0.5f;
    LiquidCase drop;
    const auto pressure = makePressure(drop, "completedPbf", "maxIterations 1; minIterations 1; ordering 1;");
    RandomNumbers random(7);
    auto points = latticeBlock(13, 13, 13, 0.97f);
    disorder(points, 0.1f, random);
    drop.place(points);
    std::vector<float> p;
    for (int step = 0; step < 2; ++step)
    {
        pressure->begin(dt);
        ASSERT_TRUE(pressure->violated(drop.liquid, drop.near, drop.walls));
        p = drop.inOrder(*pressure->keepPressure());
    }
    pressure->correct(drop.liquid, drop.near, drop.walls);
    const auto moved = drop.inOrder(drop.liquid.predicted);

    const Reference<CubicSpline> W{2};              // in spacings, in which V = 1
    const double d = drop.liquid.spacing(), strength = dt * dt / (drop.liquid.restDensity() * d * d);
    const Vec3 middle{5.82f, 5.82f, 5.82f};
    const auto gradient = [&](std::size_t i, std::size_t j)
    {
        const Vec3 r = points[i] - points[j];
        return W.slope(norm(r)) / norm(r) * Vector3(r.x, r.y, r.z);
    };
    using Tensor = std::array<std::array<double, 3>, 3>;
    std::map<std::size_t, Tensor> stress;           // p D of those in the middle and of their neighbours
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        if (norm(points[i] - middle) > 3.5) continue;
        Tensor D{};
        for (std::size_t j = 0; j < points.size(); ++j)
        {
            if (j == i || norm(points[i] - points[j]) >= 2) continue;
            const Vec3 r = points[i] - points[j];
            const double arm[3] = {r.x, r.y, r.z};
            const Vector3 slope = gradient(i, j);
            for (int a = 0; a < 3; ++a)
            {
                for (int b = 0; b < 3; ++b) D[a][b] -= arm[a] * slope[b];
            }
        }
        const double third = (D[0][0] + D[1][1] + D[2][2]) / 3;
        for (int a = 0; a < 3; ++a) D[a][a] -= third;
        for (auto& row : D) for (double& value : row) value *= std::max(p[i], 0.0f);
        stress[i] = D;
    }
    int compared = 0;
    double largest = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        if (norm(points[i] - middle) > 1.2) continue;
        ++compared;
        Vector3 pairs(0, 0, 0), taken(0, 0, 0);
        for (std::size_t j = 0; j < points.size(); ++j)
        {
            if (j == i || norm(points[i] - points[j]) >= 2) continue;
            const Vector3 slope = gradient(i, j);
            pairs += (p[i] + p[j]) * slope;
            for (int a = 0; a < 3; ++a)
            {
                for (int b = 0; b < 3; ++b) taken[a] += (stress[i][a][b] + stress[j][a][b]) * slope[b];
            }
        }
        // Thirty terms of up to 0.05 spacings, each rounded to 1e-7, and positions of up to twelve units to 1e-6.
        EXPECT_NEAR(moved[i].x / d - points[i].x, -strength * (pairs.x - taken.x), 1e-5) << i;
        EXPECT_NEAR(moved[i].y / d - points[i].y, -strength * (pairs.y - taken.y), 1e-5) << i;
        EXPECT_NEAR(moved[i].z / d - points[i].z, -strength * (pairs.z - taken.z), 1e-5) << i;
        largest = std::max(largest, std::abs(strength * taken.x));
    }
    EXPECT_GT(compared, 5);
    EXPECT_GT(largest, 1e-4);                       // ten times the tolerance
}
