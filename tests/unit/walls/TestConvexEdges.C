// SPDX-License-Identifier: GPL-3.0-or-later
// The solid's share beside convex edges: what replaces the tangent plane, and where.

#include "freeSurface/SampledEdges.H"

#include "support/LiquidCase.H"
#include "walls/HalfSpace.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr scalar edgeSpacing = 1, edgeSupport = 2.5;

// Two faces of solid particles that meet along y in an edge at the origin: the top z = 0, x < 0, and a side turned from it by `turn` degrees; towards the liquid.
// turn below zero: a groove's.
struct Faces
{
    std::vector<Vec3> positions, normals;

    explicit Faces(double turn)
    {
        const double angle = turn * std::numbers::pi / 180;
        const double in = 0.5 * std::tan(angle / 2);                // both layers, half a spacing inside, meet there
        for (double y = -6; y <= 6; ++y)
        {
            for (int i = 0; i < 7; ++i)
            {
                add(-in - i, y, -0.5, 0, 1);
                if (i > 0) add(-in + i * std::cos(angle), y, -0.5 - i * std::sin(angle), std::sin(angle), std::cos(angle));
            }
        }
    }

private:
    void add(double x, double y, double z, double nx, double nz)
    {
        positions.push_back({scalar(x), scalar(y), scalar(z)});
        normals.push_back({scalar(nx), 0, scalar(nz)});
    }
};

// By how much tangent planes do not stand for the solid, at these places; empty where the layer has no edge.
std::vector<scalar> partsAt(const Faces& faces, const std::vector<Vec3>& places)
{
    LiquidCase liquid({.walls = sampledFloor, .solidPositions = faces.positions, .solidNormals = faces.normals});
    liquid.useWalls(3.25f * liquid.liquid.spacing());
    liquid.place(places);
    const auto parts = liquid.walls.view(liquid.liquid).planes.edge;
    if (parts.size == 0) return {};
    const auto values = download(parts);
    const auto id = liquid.liquid.id.download();
    std::vector<scalar> result(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) result[id[i]] = values[i];
    return result;
}

}

// A square lattice of one particle an area d^2 stands for the half-space that begins half a spacing before it. Its sum has the lattice's own waves: 3 % of a half at
// half a spacing, the nearest that liquid comes.
TEST(SampledEdges, BeforeAPlaneLayerTheyAreTheHalfSpace)
{
    const KernelChoice kernel = WendlandC2(edgeSupport);
    const SampledEdges edges(kernel, kernel, edgeSpacing);
    const auto table = download(edges.view().table);
    const auto half = tabulateHalfSpace(kernel);
    const HalfSpaceView plane{{half.data(), int(half.size())}, edgeSupport};
    const double reach = edges.view().reach;
    double volume = 0;                      // V_k of Akinci et al. in that layer
    for (int x = -3; x <= 3; ++x) for (int y = -3; y <= 3; ++y) volume += WendlandC2(edgeSupport).W(std::hypot(scalar(x), scalar(y)));
    volume = 1 / volume;
    for (const double s : {0.5, 0.75, 1.0, 1.5})
    {
        double sum = 0;
        for (int x = -4; x <= 4; ++x)
        {
            for (int y = -4; y <= 4; ++y)
            {
                const double at = std::sqrt(x * x + y * y + (s + 0.5) * (s + 0.5)) / reach * double(table.size() - 1);
                if (at >= double(table.size() - 1)) continue;
                const double f = at - std::floor(at);
                sum += volume * ((1 - f) * table[int(at)].value + f * table[int(at) + 1].value);
            }
        }
        EXPECT_NEAR(sum, plane(scalar(s)).density, 0.03 * 0.5) << s;
    }
}

// A force with a potential: slope is the derivative of value. Differences over two cells of 256 are right to 1 % of the largest slope.
TEST(SampledEdges, TheirGradientIsThatOfTheirValue)
{
    const KernelChoice kernel = WendlandC2(edgeSupport);
    const SampledEdges edges(kernel, kernel, edgeSpacing);
    const auto table = download(edges.view().table);
    const int n = int(table.size()) - 1;
    const double cell = edges.view().reach / n;
    double most = 0;
    for (int k = n / 8; k < n; ++k) most = std::max(most, std::abs(double(table[k].slope) * k * cell));
    for (int k = n / 8; k < n; ++k) EXPECT_NEAR((table[k + 1].value - table[k - 1].value) / (2 * cell), table[k].slope * k * cell, 0.01 * most) << k;
    EXPECT_EQ(table[n].value, 0);
}

TEST(SampledEdges, StandForTheSolidBesideConvexEdgesAlone)
{
    const std::vector<Vec3> places{{-0.5f, 0, 0.5f}, {0.4f, 0, 0.4f}, {-5, 0, 0.5f}};
    const auto square = partsAt(Faces(90), places);
    ASSERT_EQ(square.size(), 3u);
    EXPECT_EQ(square[0], 1);
    EXPECT_EQ(square[1], 1);
    EXPECT_EQ(square[2], 0);
    EXPECT_TRUE(partsAt(Faces(20), places).empty());
    EXPECT_TRUE(partsAt(Faces(0), places).empty());
    EXPECT_TRUE(partsAt(Faces(-90), {{-3, 0, 0.5f}}).empty());       // where two faces meet in a corner of the liquid
}
