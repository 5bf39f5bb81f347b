// SPDX-License-Identifier: GPL-3.0-or-later
// All kernels by one set of tests; values are computed on the device. A new kernel is one more type in the list and its
// formula in support/ReferenceKernels.H.

#include "maths/Kernel.H"

#include "device/ForEach.H"
#include "support/PointSets.H"
#include "support/ReferenceKernels.H"

#include <gtest/gtest.h>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr scalar support = 1.7f;

template<class Kernel>
struct EvaluateKernel
{
    Kernel W;
    Span<const scalar> r;
    Span<scalar> value, factor;

    HOST_DEVICE void operator()(int i) const
    {
        value[i] = W.W(r[i]);
        factor[i] = W.g(r[i]);
    }
};

template<class Type>
class Kernel : public testing::Test
{
public:
    // Samples of W and g at n + 1 distances from 0 to beyond the support.
    explicit Kernel(int n = 3400)
    {
        for (int i = 0; i <= n; ++i) r.push_back(1.25f * support * scalar(i) / scalar(n));
        evaluate();
    }

    void evaluate()
    {
        const Buffer<scalar> distances(r);
        Buffer<scalar> values(distances.size()), factors(distances.size());
        forEach(distances.size(), EvaluateKernel<Type>{W, distances.span(), values.span(), factors.span()});
        value = values.download();
        factor = factors.download();
    }

    const Type W{support};
    const Reference<Type> reference{support};
    std::vector<scalar> r, value, factor;
};

using Kernels = testing::Types<CubicSpline, Poly6Spiky, WendlandC2>;
TYPED_TEST_SUITE(Kernel, Kernels);

}

// A few roundings of single precision, 6e-8 each, at the size of the largest value.
TYPED_TEST(Kernel, HasItsPapersValues)
{
    for (std::size_t i = 0; i < this->r.size(); ++i)
    {
        ASSERT_NEAR(this->value[i], this->reference.W(this->r[i]), 5e-7 * this->reference.W(0)) << this->r[i];
    }
}

TYPED_TEST(Kernel, IsPositiveInsideAndZeroFromTheSupportOn)
{
    for (std::size_t i = 0; i < this->r.size(); ++i)
    {
        ASSERT_EQ(this->value[i] > 0, this->r[i] < support) << this->r[i];
        ASSERT_GE(this->value[i], 0) << this->r[i];
        ASSERT_LE(this->factor[i], 0) << this->r[i];
    }
    this->r = {support, 1.0001f * support, 2 * support, 1e6f};
    this->evaluate();
    EXPECT_EQ(this->value, std::vector<scalar>(4, 0));
    EXPECT_EQ(this->factor, std::vector<scalar>(4, 0));
    EXPECT_EQ(this->W.h, support);
}

// Central differences of the closed form over 2e-5 h are off by (1e-5)^2 W'''/6, far less than single precision, which
// leaves a few 1e-7 of the largest slope.
TYPED_TEST(Kernel, GradientIsTheSlopeOfTheKernelItIsTakenOf)
{
    const double step = 1e-5 * support, steepest = 45 / (kernels::pi * std::pow(support, 4));
    for (std::size_t i = 100; i < this->r.size(); ++i)
    {
        const double r = this->r[i];
        const double slope = (this->reference.smooth(r + step) - this->reference.smooth(r - step)) / (2 * step);
        ASSERT_NEAR(this->factor[i] * r, slope, 1e-6 * steepest) << r;
    }
}

// By central differences of g over 2e-3 of the support, from 0.05 of it on: of g'(r), at most 72/(h^5 pi) in size, half a percent at the smallest r, where
// g'' is large beside it, and what single precision leaves of a difference, 1e-6/2e-3 of g.
TEST(CubicSpline, KnowsTheSlopeOfItsFactor)
{
    const CubicSpline W(support);
    const double largest = std::abs(W.g(0)), step = 1e-3 * support;
    for (double r = 0.05 * support; r < 1.1 * support; r += 0.01 * support)
    {
        const double slope = (double(W.g(scalar(r + step))) - double(W.g(scalar(r - step)))) / (2 * step);
        EXPECT_NEAR(W.gSlope(scalar(r)) * r, slope, 5e-3 * largest / support) << r;
    }
    EXPECT_TRUE(std::isfinite(W.gSlope(0)));
    EXPECT_EQ(W.gSlope(support), 0);
}

// Simpson's rule over pieces that are polynomials of degree 8 at most: its own error is 1e-12 here, and
// single-precision values are off by 6e-8 at random.
TYPED_TEST(Kernel, IntegratesToOne)
{
    constexpr double pi = std::numbers::pi;
    const auto& W = this->W;
    const auto ofValue = [&](double r) { return 4 * pi * r * r * W.W(scalar(r)); };
    EXPECT_NEAR(integrate(0, support, 2000, ofValue), 1, 1e-6);
    // By parts: the kernel of the gradient has the integral -4 pi/3 int r^3 W' dr.
    const auto ofGradient = [&](double r) { return -4 * pi / 3 * r * r * r * r * W.g(scalar(r)); };
    EXPECT_NEAR(integrate(0, support, 2000, ofGradient), 1, 1e-6);
}

TYPED_TEST(Kernel, HasNoGradientAtItsCentreAndOnALattice)
{
    const auto& W = this->W;
    EXPECT_TRUE(std::isfinite(W.g(0)));
    Vec3 sum;
    scalar sizes = 0;
    for (const Vec3 p : latticeBlock(9, 9, 9, 0.4f, {-1.6f, -1.6f, -1.6f}))
    {
        const Vec3 gradient = W.g(norm(p)) * p;
        sum += gradient;
        sizes += norm(gradient);
    }
    // Opposite points cancel; what is left is the rounding of the running sum.
    EXPECT_GT(sizes, 1);
    EXPECT_LT(norm(sum), 1e-6f * sizes);
}

TYPED_TEST(Kernel, IsMadeByItsWord)
{
    const KernelChoice choice = makeKernel(TypeParam::word, support);
    EXPECT_TRUE(std::holds_alternative<TypeParam>(choice));
    EXPECT_EQ(supportOf(choice), support);
    const auto words = kernelWords();
    EXPECT_NE(std::find(words.begin(), words.end(), TypeParam::word), words.end());
    EXPECT_EQ(words.size(), std::variant_size_v<KernelChoice>);
}
