// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/WallView.H"

#include "support/PointSets.H"

#include <gtest/gtest.h>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr scalar range = 2;

class WallSurfaces : public testing::Test
{
public:
    WallSurfacesView planes(const std::vector<Vec3>& normals) const
    {
        WallSurfacesView view;
        view.halfSpace = {{table.data(), int(table.size())}, range};
        for (const Vec3& n : normals) view.surface[view.count++] = {WallSurface::plane, -1, {}, {n.x, n.y, n.z}, 0, 1, 0};
        return view;
    }

    const CubicSpline W{range};
    const std::vector<HalfSpaceValues> table = tabulateHalfSpace(W);
};

}

TEST_F(WallSurfaces, OneOrNoneIsWhatItsTableSays)
{
    const auto none = planes({}).density(placeAt(0.3f, 0, 0));
    EXPECT_EQ(none.value, 0);
    EXPECT_EQ(norm(none.gradient), 0);

    const WallSurfacesView floor = planes({{0, 0, 1}});
    for (const scalar z : {-0.4f, 0.0f, 0.3f, 1.1f})
    {
        const auto density = floor.density(placeAt(5, -3, z));
        EXPECT_NEAR(density.value, floor.halfSpace(z).density, 1e-6);
        EXPECT_NEAR(density.gradient.z, -floor.halfSpace(z).gradient, 1e-6);
        EXPECT_EQ(density.gradient.x, 0);
    }
    EXPECT_EQ(floor.density(placeAt(0, 0, range)).value, 0);
}

// By symmetry the solid of two perpendicular planes fills 3/4 around their edge, that of three 7/8 around their corner.
TEST_F(WallSurfaces, FillEdgesAndCornersBySymmetry)
{
    EXPECT_NEAR(planes({{1, 0, 0}, {0, 0, 1}}).density(placeAt(0, 4, 0)).value, 0.75, 1e-6);
    EXPECT_NEAR(planes({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).density(placeAt(0, 0, 0)).value, 0.875, 1e-6);
}

// The union's volume by a midpoint sum over a grid of h/40. A spline is not separable, so the product is an
// approximation: it is off by 1.5e-3 of the full density at most, and the sum by as much again.
TEST_F(WallSurfaces, ApproachTheUnionOfTwoPerpendicularPlanes)
{
    const WallSurfacesView edge = planes({{1, 0, 0}, {0, 0, 1}});
    constexpr int n = 40;
    constexpr scalar step = range / n, first = step / 2 - range;
    const auto around = latticeBlock(2 * n, 2 * n, 2 * n, step, {first, first, first});
    for (const scalar x : {0.25f, 0.5f, 0.75f, 1.25f})
    {
        for (const scalar z : {0.25f, 0.5f, 1.0f})
        {
            double sum = 0;
            for (const Vec3& r : around)
            {
                if (x + r.x < 0 || z + r.z < 0) sum += W.W(norm(r)) * step * step * step;
            }
            EXPECT_NEAR(edge.density(placeAt(x, 0, z)).value, sum, 0.003) << x << " " << z;
        }
    }
}

// Against central differences of the value. The tables' densities and gradients are interpolated apart, and the value
// has kinks at the table's nodes: 1 % of the largest gradient.
TEST_F(WallSurfaces, GradientIsThatOfTheUnion)
{
    const WallSurfacesView corner = planes({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    const scalar step = range / 64, largest = corner.halfSpace(0).gradient;
    for (const Vec3 x : randomPoints(200, {0, 0, 0}, {1.5f, 1.5f, 1.5f}))
    {
        const auto at = [&](Vec3 p) { return corner.density(placeAt(p.x, p.y, p.z)); };
        const Vec3 gradient = at(x).gradient;
        const auto difference = [&](Vec3 by)
        {
            return (at(x + by).value - at(x - by).value) / (2 * step);
        };
        EXPECT_NEAR(gradient.x, difference({step, 0, 0}), 0.01f * largest);
        EXPECT_NEAR(gradient.y, difference({0, step, 0}), 0.01f * largest);
        EXPECT_NEAR(gradient.z, difference({0, 0, step}), 0.01f * largest);
    }
}
