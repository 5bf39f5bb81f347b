// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of the liquid's extension into a wall against sums over the wedge in double precision.

#include "freeSurface/ExtendedLiquid.H"

#include "core/angles/Degrees.H"
#include "support/PointSets.H"
#include "support/ReferenceKernels.H"
#include "walls/HalfSpace.H"

#include <gtest/gtest.h>

#include <algorithm>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// A table on the host. theta in degrees, z and s in supports.
class Table
{
public:
    explicit Table(const ExtendedLiquid& extended) : view_(extended.view()), values_(download(view_.table))
    {
        view_.table = {values_.data(), int(values_.size())};
    }

    WedgeIntegrals operator()(double theta, double z, double s) const
    {
        return view_(scalar(radians(theta)), scalar(z), scalar(s));
    }

private:
    ExtendedLiquidView view_;
    std::vector<WedgeIntegrals> values_;
};

// Which part of the half-space {y : (y - x).m <= s} a sum goes over.
enum class Side { wall, liquid };

struct WedgeSums
{
    double value = 0, tangential = 0, normal = 0;
};

double all(double) { return 1; }

// Midpoint sums of a kernel with support 1 over y - x = u t + v (n x t) + w n on one side of the wall, weighted by the depth; the limits
// of u are exact. part: of the wedge.
template<class Kernel>
WedgeSums bruteForce
(
    double theta, double z, double s, Side side, double (*weight)(double depth) = all, WedgePart part = WedgePart::whole
)
{
    constexpr int n = 40;
    const Reference<Kernel> W{1};
    const double sine = std::sin(radians(theta)), cosine = std::cos(radians(theta));
    const double low = side == Side::wall ? -1 : -z, high = side == Side::wall ? -z : 1;
    WedgeSums sums;
    for (int a = 0; a < n; ++a)
    {
        const double w = low + (high - low) * (a + 0.5) / n, width = std::sqrt(1 - w * w);
        for (int b = 0; b < n; ++b)
        {
            const double v = width * (b + 0.5) / n, reach = std::sqrt(std::max(1 - w * w - v * v, 0.0));
            const double from = -reach;
            double to = reach;
            if (sine > 1e-9) to = std::min(to, (s - w * cosine) / sine);
            else if (w * cosine > s) continue;
            if (from >= to) continue;
            const double volume = (high - low) / n * 2 * width / n * (to - from) / n;
            for (int c = 0; c < n; ++c)
            {
                const double u = from + (to - from) * (c + 0.5) / n;
                if (part == WedgePart::ahead && u * cosine <= w * sine) continue;
                const double r = std::sqrt(u * u + v * v + w * w);
                const double slope = W.slope(r), share = volume * weight(s - u * sine - w * cosine);
                sums.value += share * W.W(r);
                sums.tangential -= share * slope / r * u;
                sums.normal -= share * slope / r * w;
            }
        }
    }
    return sums;
}

// Largest |t . int grad W|: the integral of W over a plane through the particle.
template<class Kernel>
double steepest()
{
    return integrate(0, 1, 400, [](double r) { return 2 * std::numbers::pi * r * Reference<Kernel>{1}.smooth(r); });
}

template<class Kernel>
void expectSums(const Table& table, double tolerance, double theta, double z, double s)
{
    const WedgeIntegrals found = table(theta, z, s);
    const WedgeSums expected = bruteForce<Kernel>(theta, z, s, Side::wall);
    const double gradient = tolerance * steepest<Kernel>();
    EXPECT_NEAR(found.value, expected.value, tolerance) << theta << " " << z << " " << s;
    EXPECT_NEAR(found.tangential, expected.tangential, gradient) << theta << " " << z << " " << s;
    EXPECT_NEAR(found.normal, expected.normal, gradient) << theta << " " << z << " " << s;
}

template<class Type>
class ExtendedLiquidOf : public testing::Test
{
public:
    const Type W{1.7f};                 // the table is for support 1, whatever the kernel's
    const Table& table = shared();      // 30 to 150 degrees

private:
    static const Table& shared()
    {
        static const Table once(ExtendedLiquid(Type(1.7f), {30, 150}));
        return once;
    }
};

using Kernels = testing::Types<CubicSpline, WendlandC2>;
TYPED_TEST_SUITE(ExtendedLiquidOf, Kernels);

}

// At nodes of the table only the two midpoint rules differ, of 48 and 40 intervals: (1/40)^2/24 times second derivatives of
// up to 20, of values that are one at most.
TYPED_TEST(ExtendedLiquidOf, HoldsTheIntegralsOverTheWedge)
{
    for (const double theta : {30.0, 75.0, 90.0, 150.0})
        for (const double z : {0.0, 3 / 24.0, 12 / 24.0})
            for (const double s : {-12 / 24.0, 0.0, 5 / 24.0, 18 / 24.0})
            {
                expectSums<TypeParam>(this->table, 5e-4, theta, z, s);
            }
}

// Between nodes, linear in z and s (steps of 1/24) and theta (5 degrees): second derivatives of up to ten times the largest
// value or gradient, and (1/24)^2/8 + (1/24)^2/8 + (5 degrees)^2/8 of them.
TYPED_TEST(ExtendedLiquidOf, InterpolatesBetween)
{
    for (const double theta : {37.5, 92.5, 144.0})
        for (const double z : {0.02, 0.19, 0.4375})
            for (const double s : {-0.27, 0.0625, 0.52})
            {
                expectSums<TypeParam>(this->table, 5e-3, theta, z, s);
            }
}

TYPED_TEST(ExtendedLiquidOf, DeepInsideIsTheWholeHalfSpace)
{
    const auto values = tabulateHalfSpace(TypeParam(1));
    const HalfSpaceView halfSpace{{values.data(), int(values.size())}, 1};
    for (const double theta : {30.0, 61.0, 150.0})
    {
        for (const double z : {0.0, 4 / 24.0, 15 / 24.0, 1.0})
        {
            for (const double s : {1.0, 1.8})
            {
                const auto wedge = this->table(theta, z, s);
                const auto whole = halfSpace(scalar(z));
                // The midpoint rule of 48 intervals.
                EXPECT_NEAR(wedge.value, whole.density, 5e-4) << theta << " " << z;
                EXPECT_NEAR(wedge.normal, -whole.gradient, 1e-3 * halfSpace(0).gradient) << theta << " " << z;
                EXPECT_NEAR(wedge.tangential, 0, 1e-6) << theta << " " << z;
            }
        }
        // Out of reach of the wall, or of what is below the interface.
        EXPECT_EQ(this->table(theta, 1, 0).value, 0);
        EXPECT_EQ(this->table(theta, 2.5, 0.3).value, 0);
        EXPECT_EQ(this->table(theta, 0, -1).value, 0);
    }
}

TYPED_TEST(ExtendedLiquidOf, IsEmptyAt180DegreesAndFullAtZero)
{
    const Table empty(ExtendedLiquid(this->W, {180, 180}));
    const Table full(ExtendedLiquid(this->W, {0, 0}));
    const auto values = tabulateHalfSpace(TypeParam(1));
    const HalfSpaceView halfSpace{{values.data(), int(values.size())}, 1};
    for (const double z : {0.0, 2 / 24.0, 0.5})
    {
        // At 180 degrees the interface lies parallel to the wall: before it where s is less than z.
        for (const double s : {-0.5, -1 / 24.0, z - 1 / 24.0})
        {
            const auto wedge = empty(180, z, s);
            EXPECT_EQ(wedge.value, 0) << z << " " << s;
            EXPECT_EQ(wedge.tangential, 0) << z << " " << s;
            EXPECT_EQ(wedge.normal, 0) << z << " " << s;
        }
        for (const double s : {-z, 0.0, 0.5})
        {
            EXPECT_NEAR(full(0, z, s).value, halfSpace(scalar(z)).density, 5e-4) << z << " " << s;
        }
    }
}

// What the liquid in front of the wall and the table have together is the planar half-space, at any distance from the wall:
// a planar interface at the contact angle looks planar. The midpoint rules again.
TYPED_TEST(ExtendedLiquidOf, MakesAPlanarInterfaceLookPlanar)
{
    const auto values = tabulateHalfSpace(TypeParam(1));
    const HalfSpaceView plane{{values.data(), int(values.size())}, 1};
    for (const double theta : {30.0, 60.0, 115.0, 150.0})
    {
        for (const double s : {1 / 24.0, 4 / 24.0, 11 / 24.0})
        {
            for (const double z : {0.0, 2 / 24.0, 8 / 24.0, 20 / 24.0, 1.0})
            {
                const WedgeSums liquid = bruteForce<TypeParam>(theta, z, s, Side::liquid);
                const auto wall = this->table(theta, z, s);
                const auto whole = plane(scalar(s));
                const double gradient = 5e-4 * plane(0).gradient;
                EXPECT_NEAR(liquid.value + wall.value, 1 - whole.density, 5e-4) << theta << " " << s << " " << z;
                EXPECT_NEAR(liquid.tangential + wall.tangential, -whole.gradient * std::sin(radians(theta)), gradient)
                    << theta << " " << s << " " << z;
                EXPECT_NEAR(liquid.normal + wall.normal, -whole.gradient * std::cos(radians(theta)), gradient)
                    << theta << " " << s << " " << z;
            }
        }
    }
}

// A step along t lowers s by its sin(theta), one along n raises z and lowers s by its cos(theta). Central differences over
// two nodes are off by (1/24)^2/6 of the third derivative, which is below 30 steepest slopes.
TYPED_TEST(ExtendedLiquidOf, GradientIsThatOfTheValue)
{
    constexpr double step = 1 / 24.0;
    for (const double theta : {30.0, 65.0, 90.0, 140.0})
        for (const double z : {2 / 24.0, 7 / 24.0, 14 / 24.0})
            for (const double s : {-8 / 24.0, 0.0, 3 / 24.0, 16 / 24.0})
            {
                const auto at = [&](double dz, double ds) { return double(this->table(theta, z + dz, s + ds).value); };
                const double byDepth = (at(0, step) - at(0, -step)) / (2 * step);
                const double byDistance = (at(step, 0) - at(-step, 0)) / (2 * step);
                const auto wedge = this->table(theta, z, s);
                const double sine = std::sin(radians(theta)), cosine = std::cos(radians(theta));
                const double tolerance = 0.008 * steepest<TypeParam>();
                EXPECT_NEAR(wedge.tangential, -sine * byDepth, tolerance) << theta << " " << z << " " << s;
                EXPECT_NEAR(wedge.normal, byDistance - cosine * byDepth, tolerance) << theta << " " << z << " " << s;
            }
}

// A weight that falls from one at the interface to nothing half a support below it. The midpoint rules again; the largest value is one.
TYPED_TEST(ExtendedLiquidOf, WeighsByDepth)
{
    const Table table(ExtendedLiquid(this->W, {45, 120}, {1, 0, 0}));
    const auto weight = [](double depth) { return std::max(1 - 2 * depth, 0.0); };
    for (const double theta : {45.0, 60.0, 90.0, 120.0})
        for (const double z : {0.0, 4 / 24.0, 10 / 24.0})
            for (const double s : {-6 / 24.0, 2 / 24.0, 9 / 24.0})
            {
                const auto found = table(theta, z, s);
                const WedgeSums expected = bruteForce<TypeParam>(theta, z, s, Side::wall, weight);
                const double gradient = 5e-4 * steepest<TypeParam>();
                EXPECT_NEAR(found.value, expected.value, 5e-4) << theta << " " << z << " " << s;
                EXPECT_NEAR(found.tangential, expected.tangential, gradient) << theta << " " << z << " " << s;
                EXPECT_NEAR(found.normal, expected.normal, gradient) << theta << " " << z << " " << s;
            }
}

// What lies ahead alone: the sums are cut in the middle of intervals, of 1/48 and 1/40, and lose or gain half of one; of a right angle, where all is
// ahead, nothing is cut.
TYPED_TEST(ExtendedLiquidOf, LeavesOutWhatDoesNotLieAhead)
{
    const Table ahead(ExtendedLiquid(TypeParam(1.7f), {0, 150}, {1, 1}, WedgePart::ahead));
    for (const double theta : {0.0, 30.0, 60.0, 90.0, 150.0})
    {
        for (const double z : {0.0, 3 / 24.0, 12 / 24.0})
        {
            const WedgeIntegrals found = ahead(theta, z, 5 / 24.0);
            const WedgeSums expected = bruteForce<TypeParam>(theta, z, 5 / 24.0, Side::wall, all, WedgePart::ahead);
            const double gradient = 0.02 * steepest<TypeParam>();
            EXPECT_NEAR(found.value, expected.value, 0.02) << theta << " " << z;
            EXPECT_NEAR(found.tangential, expected.tangential, gradient) << theta << " " << z;
            EXPECT_NEAR(found.normal, expected.normal, gradient) << theta << " " << z;
            if (theta != 90) continue;
            const WedgeIntegrals whole = this->table(theta, z, 5 / 24.0);
            EXPECT_NEAR(found.value, whole.value, 1e-6) << z;
            EXPECT_NEAR(found.tangential, whole.tangential, 1e-5) << z;
        }
    }
    // The whole wedge of 0 degrees has as much on either side.
    EXPECT_GT(ahead(0, 3 / 24.0, 0).tangential, 0.1 * steepest<TypeParam>());
}
