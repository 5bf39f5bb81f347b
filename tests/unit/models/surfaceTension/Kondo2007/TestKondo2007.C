// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/PairForceMeter.H"

using namespace shizuku;
using namespace shizuku::test;

// C (r - d)(h - r): no force at the spacing, attraction beyond, strongest half way to the support; the ratio of two places
// does not need C. Single precision: 1e-5 of the largest.
TEST(Kondo2007, IsTheForceOfThePaper)
{
    LiquidCase drop;
    const auto tension = makeTension(drop, "Kondo2007");
    const double most = attraction(drop, *tension, 1.5);
    EXPECT_GT(most, 0);
    for (const double r : {0.1, 0.5, 0.9, 1.0, 1.2, 1.7, 1.99})
    {
        EXPECT_NEAR(attraction(drop, *tension, r), most * (r - 1) * (2 - r) / 0.25, 1e-5 * most) << r;
    }
    EXPECT_EQ(attraction(drop, *tension, 2.01), 0);
}

// The work of cutting the lattice in two makes two surfaces of tension sigma: the potential by quadrature of the model's
// force, summed over the pairs across the cut. A column of section d^2 on one side holds layers 0, 1, ... below the cut.
TEST(Kondo2007, NeedsTheWorkOfTwoSurfacesToBeCut)
{
    for (const int support : {2, 3})
    {
        LiquidCase drop({.kernel = "type cubicSpline; support " + std::to_string(support) + ";"});
        const auto tension = makeTension(drop, "Kondo2007");
        constexpr int n = 200;
        std::vector<double> distances;
        for (int k = 0; k < n; ++k) distances.push_back(support * (k + 0.5) / n);
        const auto F = attractions(drop, *tension, distances);
        const auto work = [&](double r)                 // from r to beyond the support, J
        {
            double sum = 0;
            for (int k = 0; k < n; ++k)
            {
                const double low = double(support) * k / n, high = double(support) * (k + 1) / n;
                sum += F[k] * 1e-3 * std::max(high - std::max(low, r), 0.0);
            }
            return sum;
        };
        double total = 0;
        for (int below = 0; below < support; ++below)
            for (int above = 1; above <= support; ++above)
                for (int x = -support; x <= support; ++x)
                    for (int y = -support; y <= support; ++y)
                    {
                        total += work(std::sqrt(x * x + y * y + (below + above) * (below + above)));
                    }
        EXPECT_NEAR(total, 2 * 0.072 * 1e-6, 5e-3 * 2 * 0.072 * 1e-6) << support;   // steps of the quadrature: 0.5 %
    }
}
