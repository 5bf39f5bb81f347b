// Central forces are equal and opposite; the curvature of the colour field has no such pairs.

#include "support/PairForceMeter.H"

using namespace shizuku;
using namespace shizuku::test;

TEST(SurfaceTension, ConservesMomentumWhereItsForcesArePairs)
{
    for (const std::string word : {"Becker2007", "Kondo2007", "Tartakovsky2005", "Mueller2003"})
    {
        LiquidCase drop;
        const auto tension = makeTension(drop, word);
        drop.place(randomPoints(500, {0, 0, 0}, {7, 7, 7}, 9));
        double sum[3] = {0, 0, 0}, sizes = 0;
        for (const Vec3& a : accelerationsOf(drop, *tension))
        {
            sum[0] += a.x;
            sum[1] += a.y;
            sum[2] += a.z;
            sizes += norm(a);
        }
        // What is left are the roundings of 500 sums of some thirty terms.
        double left = 0;
        for (const double component : sum) left += std::abs(component);
        EXPECT_EQ(left < 3e-6 * sizes, word != "Mueller2003") << word << ' ' << left / sizes;
    }
}
