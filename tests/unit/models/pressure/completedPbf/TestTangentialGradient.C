// SPDX-License-Identifier: GPL-3.0-or-later
// A pressure that changes along a plane, as the outermost layer of a lattice feels it.

#include "models/pressure/completedPbf/TangentialGradient.H"

#include "support/PointSets.H"
#include "support/ReferenceKernels.H"

#include <gtest/gtest.h>

#include <vector>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// sum_j (p_j - p_i) grad W_ij of p = x for the particle at the origin, over the lattice from `lowest` to `highest` layer.
Vec3 differencesOf(int lowest, int highest)
{
    const Reference<CubicSpline> W{2};
    Vec3 sum;
    for (const Vec3& other : latticeBlock(5, 5, highest - lowest + 1, 1, {-2, -2, scalar(lowest)}))
    {
        const double r = norm(other);
        if (r == 0 || r >= 2) continue;
        sum += scalar(other.x * W.slope(r) / r) * (-1.0f * other);
    }
    return sum;
}

// Where particles are near the surface, and nothing else of it.
FreeSurfaceView at(const std::vector<std::uint32_t>& place)
{
    FreeSurfaceView view{};
    view.place = {place.data(), int(place.size())};
    return view;
}

double beyond(double s)
{
    const Reference<CubicSpline> W{2};
    return integrate(s, 2, 400, [&](double r) { return 2 * std::numbers::pi * r * (r - s) * W.W(r); });
}

}

// The lattice's sums are not integrals: inside it has 1.02, in its outermost layer 0.86, where a plane leaves 0.81. So a sixth is missing, and what is
// completed is 4 % more than inside.
TEST(TangentialGradient, CompletesWhatTheOutermostLayerMisses)
{
    const scalar lost = scalar(beyond(0.5));
    const std::vector<std::uint32_t> place{0, 1};           // the particle is near the surface
    std::vector<BoundingPlane> surface(2), wall(1);
    const TangentialGradient gradient{at(place), {surface.data(), 2}, {wall.data(), 1}};
    const Vec3 whole = differencesOf(-2, 2), part = differencesOf(-2, 0);
    EXPECT_LT(part.x, 0.86f * whole.x);

    SurfaceState own{};
    own.gradient = {0, 0, -3};
    gradient.store(0, {}, own, lost, WallView{}, 2, 0);
    EXPECT_NEAR(part.x + gradient.more(0, part).x, whole.x, 0.05f * whole.x);

    // Across the surface nothing is added, and along it in proportion.
    const Vec3 more = gradient.more(0, {0.3f, -0.2f, 5});
    EXPECT_NEAR(more.x, 0.3f * lost / (1 - lost), 1e-6f);
    EXPECT_NEAR(more.y, -0.2f * lost / (1 - lost), 1e-6f);
    EXPECT_NEAR(more.z, 0, 1e-6f);
}

// Deep inside the surface has no normal and loses nothing, and where no wall is near there is nothing to hold.
TEST(TangentialGradient, AddsNothingDeepInside)
{
    const std::vector<std::uint32_t> place{0, 0};
    std::vector<BoundingPlane> surface{BoundingPlane{{1, 0, 0, 1}}}, wall(1); // as somebody left it
    const TangentialGradient gradient{at(place), {surface.data(), 1}, {wall.data(), 1}};
    gradient.store(0, {}, SurfaceState{}, 0, WallView{}, 2, 0);
    EXPECT_EQ(norm(gradient.more(0, {1, 2, 3})), 0);
}
