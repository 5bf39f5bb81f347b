// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/PointsInside.H"
#include "sampling/SeedMethod.H"
#include "sampling/ThinSolid.H"
#include "support/Shapes.H"
#include "unit/sampling/SampledShapes.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>
#include <vector>

#include <omp.h>

namespace shizuku::test
{

namespace
{

// The least distance between any two of the points, by comparing all pairs.
double leastGap(const std::vector<Vector3>& points)
{
    double least2 = 1e30;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j) least2 = std::min(least2, squaredLength(points[i] - points[j]));
    }
    return std::sqrt(least2);
}

std::vector<double> numbersOf(const LayerQuality& quality)
{
    return
    {
        quality.minGap, quality.meanGap, quality.maxGap, quality.largestHole, quality.minVolume, quality.meanVolume, quality.maxVolume,
        quality.wallDensity, quality.densityVariation
    };
}

std::vector<double> numbersOf(const NarrowPlaces& narrow)
{
    std::vector<double> numbers;
    if (narrow.thin) numbers.insert(numbers.end(), {narrow.thin->thickness, narrow.thin->position.x, narrow.thin->position.y, narrow.thin->position.z});
    if (narrow.sharp) numbers.insert(numbers.end(), {narrow.sharp->angle, narrow.sharp->position.x, narrow.sharp->position.y, narrow.sharp->position.z});
    return numbers;
}

TEST(Sampling, PlaneGetsALatticeHalfASpacingBelow)
{
    const SampledSurface floor = sample(rectangle(47.3, 31.7));
    expectGoodCover(floor.quality);
    EXPECT_LE(floor.quality.densityVariation, 0.02);
    // A triangular lattice has 2/sqrt(3) particles a squared spacing. Fitting it to the sides changes rows and columns
    // by half of one at most: 1/60 + 1/70.
    EXPECT_NEAR(floor.quality.count, 2/std::sqrt(3.0)*47.3*31.7, 0.04*47.3*31.7);
    for (const Vector3& x : floor.particles.positions)
    {
        ASSERT_NEAR(x.z, -0.5, 1e-12);
        // To rounding: a particle may slide along the border.
        ASSERT_TRUE(x.x > -1e-9 && x.x < 47.3 + 1e-9 && x.y > -1e-9 && x.y < 31.7 + 1e-9) << str(x);
    }
    for (const Vector3& n : floor.particles.normals) ASSERT_EQ(n, Vector3(0, 0, 1));
    // Neighbours in a lattice that was fitted to the sides by less than half a row of 30.
    EXPECT_NEAR(floor.quality.maxGap, 1, 0.02);
    // A triangular lattice of spacing 1: V = 1/sum W = 1.24 (cubic spline, support 2), more at the border, which has
    // half of the neighbours.
    EXPECT_NEAR(floor.quality.minVolume, 1.24, 0.02);
    EXPECT_LT(floor.quality.maxVolume, 4*1.24);
    EXPECT_GT(floor.quality.meanVolume, floor.quality.minVolume);
    EXPECT_DOUBLE_EQ(leastGap(floor.particles.positions), floor.quality.minGap);
}

TEST(Sampling, SphereIsCoveredEvenlyByBothMethods)
{
    for (const std::string& method : SeedMethodTable::words())
    {
        SCOPED_TRACE(method);
        const SampledSurface ball = sample(sphere(10, 4), method);
        expectGoodCover(ball.quality);
        EXPECT_NEAR(leastGap(ball.particles.positions), ball.quality.minGap, 1e-12);
        // Defects between patches of lattice, which a sphere must have, vary the density by 3 to 4 percent.
        EXPECT_LE(ball.quality.densityVariation, 0.06);
        for (std::size_t i = 0; i < ball.particles.positions.size(); ++i)
        {
            // The layer has the radius 9.5; facets of 3072 triangles on a sphere of radius 10 lie up to 0.03 deeper.
            ASSERT_NEAR(length(ball.particles.positions[i]), 9.5, 0.03);
            // Smoothed normals are within a degree of the sphere's.
            ASSERT_GT(dot(ball.particles.normals[i], normalized(ball.particles.positions[i])), 0.9998);
        }
    }
}

TEST(Sampling, CubeHasNoParticleNearerToAFaceThanItsOwn)
{
    for (const double edge : {6.0, 8.74, 12.0, 18.33})
    {
        const SampledSurface box = sample(cube(edge));
        expectGoodCover(box.quality);
        for (const Vector3& x : box.particles.positions)
        {
            const double depth = std::min({x.x, x.y, x.z, edge - x.x, edge - x.y, edge - x.z});
            ASSERT_NEAR(depth, 0.5, 0.05 + 1e-9);       // 0.9 of the offset is what beside an edge passes for clear
        }
    }
}

// Liquid on either side of an edge has to find solid particles of its own side; one beyond the edge, outside of the solid, would hold
// the liquid a spacing off the other side.
TEST(Sampling, SharpEdgesBelongToBothSidesAndNothingStandsOutOfThem)
{
    for (const double degrees : {20.0, 30.0, 45.0, 60.0, 68.0, 90.0})
    {
        SCOPED_TRACE(degrees);
        const PatchedSurface surface = wedge(degrees);
        const SampledSurface sampled = sample(surface);
        expectGoodCover(sampled.quality);
        const auto& [x, n] = std::tie(sampled.particles.positions, sampled.particles.normals);
        int left = 0, right = 0;
        for (const int w : windingNumbers(surface.mesh, x)) ASSERT_EQ(w, 1);
        for (std::size_t i = 0; i < x.size(); ++i)
        {
            // The row below the edge, where both layers meet.
            const double depth = 0.5/std::sin(0.5*degrees*std::numbers::pi/180);
            if (std::abs(x[i].z + depth) > 0.05 || std::abs(x[i].x) > 0.05 || std::abs(x[i].y - 20) > 18) continue;
            ++(n[i].x < 0 ? left : right);
        }
        EXPECT_GT(left + right, 30);                // 36 long, a particle every 0.95 to 1.2
        EXPECT_NEAR(left, right, 3);                // in turn, but for the ends of rows
    }
}

TEST(Sampling, ThinPlateIsCoveredByParticlesThatBothSidesShare)
{
    expectGoodCover(sample(plate(0.6)).quality);
}

TEST(Sampling, TipsGetARingAndNothingAboveIt)
{
    for (const double degrees : {30, 45, 60})
    {
        SCOPED_TRACE(degrees);
        const SampledSurface sampled = sample(cone(degrees));
        expectGoodCover(sampled.quality);
        std::vector<std::size_t> order(sampled.particles.positions.size());
        std::iota(order.begin(), order.end(), 0u);
        const auto& x = sampled.particles.positions;
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x[a].z > x[b].z; });
        // A layer half a spacing inside of a cone of the angle 2h is r wide where it is 0.5/sin h + r/tan h deep.
        const double half = 0.5*degrees*std::numbers::pi/180, deep = 0.5/std::sin(half) + 0.45/std::tan(half);
        for (int i = 0; i < 3; ++i)
        {
            const Vector3& at = x[order[i]];
            const Vector3& n = sampled.particles.normals[order[i]];
            EXPECT_NEAR(std::hypot(at.x, at.y), 0.45, 0.05);        // normals of three of 48 facets do not meet the axis exactly
            EXPECT_NEAR(at.z, -deep, 0.15);
            EXPECT_GT(at.x*n.x + at.y*n.y, 0.4*std::cos(half));     // looks away from the axis
        }
        EXPECT_LT(x[order[3]].z, x[order[2]].z - 0.2);
    }
}

TEST(Sampling, FacesThatLieOnEachOtherHaveNoRowBetweenThem)
{
    PatchedSurface folded = joined(rectangle(20, 20), turnedOver(rectangle(20, 20)));
    folded.mesh.faces[2] = {0, 2, 1};
    folded.mesh.faces[3] = {0, 3, 2};
    folded.mesh.vertices.resize(4);
    for (const Vector3& x : sample(folded).particles.positions) ASSERT_TRUE(std::isfinite(squaredLength(x)));
}

TEST(Sampling, SameInputGivesTheSameParticles)
{
    const PatchedSurface ball = sphere(6, 3);
    EXPECT_EQ(sample(ball).particles.positions, sample(ball).particles.positions);
}

TEST(Sampling, AnyNumberOfThreadsGivesTheSameParticles)
{
    struct Case
    {
        PatchedSurface surface;
        std::string method;
    };
    const int threads = omp_get_max_threads();
    for (const Case& it : {Case{sphere(12, 3), "poissonDisk"}, Case{sphere(8, 3), "bell"}, Case{wedge(60), "poissonDisk"}, Case{cone(60), "poissonDisk"}, Case{rectangle(60, 45), "bell"}})
    {
        omp_set_num_threads(1);
        const SampledSurface one = sample(it.surface, it.method);
        const NarrowPlaces narrow = findNarrowPlaces(it.surface, 1);
        for (const int several : {2, 5})
        {
            omp_set_num_threads(several);
            const SampledSurface same = sample(it.surface, it.method);
            EXPECT_EQ(same.particles.positions, one.particles.positions);
            EXPECT_EQ(same.particles.normals, one.particles.normals);
            EXPECT_EQ(same.particles.patch, one.particles.patch);
            EXPECT_EQ(numbersOf(same.quality), numbersOf(one.quality));
            EXPECT_EQ(numbersOf(findNarrowPlaces(it.surface, 1)), numbersOf(narrow));
        }
    }
    omp_set_num_threads(threads);
}

TEST(Sampling, PatchesAreKept)
{
    PatchedSurface surface = rectangle(20, 20);
    surface.patches = {"left", "right"};
    surface.patch = {0, 1};
    const SampledSurface sampled = sample(surface);
    expectGoodCover(sampled.quality);
    const auto right = std::count(sampled.particles.patch.begin(), sampled.particles.patch.end(), 1);
    // Half of the particles, but for those along the diagonal of 28 spacings.
    EXPECT_NEAR(double(right), 0.5*sampled.quality.count, 28);
}

}

}
