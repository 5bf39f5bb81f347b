// SPDX-License-Identifier: GPL-3.0-or-later
#include "linearSolvers/ConjugateGradients.H"

#include "device/ForEach.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace shizuku;

namespace
{

// A chain: (A u)_i = (1 + c) u_i - c/2 (u_(i-1) + u_(i+1)). Its eigenvalues are 1 to 1 + 2 c.
struct Chain
{
    int n;
    scalar c;
    Span<const Vec3> u;
    Span<Vec3> product;

    HOST_DEVICE void operator()(int i) const
    {
        Vec3 sum = (1 + c) * u[i];
        if (i > 0) sum -= 0.5f * c * u[i - 1];
        if (i + 1 < n) sum -= 0.5f * c * u[i + 1];
        product[i] = sum;
    }
};

struct Solution
{
    std::vector<Vec3> u;
    int products;
};

constexpr int n = 300;

// From zero, of b that is one at both ends.
Solution solve(ConjugateGradients& solver, scalar c)
{
    ParticleSet particles("chain");
    particles.resize(n);
    std::vector<Vec3> b(n);
    b.front() = {1, 2, 3};
    b.back() = {-1, 0, 1};
    Buffer<Vec3> u(n);
    u.setZero();
    int products = 0;
    solver.solve
    (
        particles,
        [&](Buffer<Vec3>& vector, Buffer<Vec3>& product)
        {
            ++products;
            forEach(n, Chain{n, c, std::as_const(vector).span(), product.span()});
        },
        Buffer<Vec3>(b), u
    );
    return {u.download(), products};
}

}

// Far from the ends of the chain u_i falls as the root q < 1 of (1 + c) q = c/2 (1 + q^2) says.
TEST(ConjugateGradients, SolvesAChain)
{
    constexpr scalar c = 4;
    ConjugateGradients solver({.tolerance = 1e-5, .maxIterations = 200});
    const auto [u, products] = solve(solver, c);
    const double q = (1 + c - std::sqrt(1 + 2 * c)) / c;
    const double first = 1 / (1 + c - 0.5 * c * q);            // of b = 1
    // The residual is 1e-5 of b, whose norm is 4, and no eigenvalue is below one.
    for (int i = 0; i < 20; ++i) ASSERT_NEAR(u[i].y, 2 * first * std::pow(q, i), 4e-5) << i;
    // k iterations leave 2 q^k of the error in the norm of A, q = (sqrt(9) - 1)/(sqrt(9) + 1), the residual up to sqrt(9) more: 1e-5 after 20. The last product tells that it is enough.
    EXPECT_LE(products, 21);
    EXPECT_GE(products, 10);
}

// What the host looks at does not matter: the solution after it looks as late as the one before it ended, and after one that took more iterations.
TEST(ConjugateGradients, IsTheSameWhereverTheHostLooks)
{
    const ConjugateGradients::Controls controls{.tolerance = 1e-5, .maxIterations = 200};
    ConjugateGradients fresh(controls), used(controls);
    const Solution expected = solve(fresh, 1);
    const Solution longer = solve(used, 16), second = solve(used, 1), third = solve(used, 1);
    EXPECT_GT(longer.products, expected.products);
    EXPECT_EQ(second.products, longer.products);
    EXPECT_EQ(third.products, expected.products);
    for (int i = 0; i < n; ++i)
    {
        ASSERT_EQ(norm(second.u[i] - expected.u[i]), 0) << i;
        ASSERT_EQ(norm(third.u[i] - expected.u[i]), 0) << i;
    }
}

// One that does not end is followed by one that the host looks at from the first iteration on.
TEST(ConjugateGradients, EndsAtTheMostIterations)
{
    ConjugateGradients solver({.tolerance = 1e-5, .maxIterations = 7});
    EXPECT_EQ(solve(solver, 100).products, 7);
    EXPECT_LT(solve(solver, 0).products, 4);                    // A is one: an iteration, and what tells that it is enough
}
