// SPDX-License-Identifier: GPL-3.0-or-later
// meshSurface's meshes as another library sees them: CGAL.

#include "SolverCase.H"

#include "caseFiles/VectorField.H"
#include "meshes/PlyFile.H"
#include "support/PointSets.H"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <numbers>

namespace shizuku::test
{

namespace
{

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
namespace PMP = CGAL::Polygon_mesh_processing;

class MeshTopology : public SolverCase
{
protected:
    // meshSurface on particles at these places, in spacings.
    Mesh meshOf(const std::vector<Vector3>& places) const
    {
        std::vector<Vector3> positions;
        for (const Vector3& p : places) positions.push_back(spacing*p);
        writeField(path()/"0/liquid/positions", toField("positions", dimensions::length, positions), {.binary = true});
        const Outcome outcome = call("meshSurface", "-time 0");
        EXPECT_EQ(outcome.status, 0) << outcome.text;

        const TriangleMesh read = readPly(path()/"0/surface/liquid.ply");
        std::vector<Point> points;
        for (const Vector3& v : read.vertices) points.emplace_back(v.x, v.y, v.z);
        std::vector<std::array<std::size_t, 3>> faces;
        for (const auto& [i, j, k] : read.faces) faces.push_back({std::size_t(i), std::size_t(j), std::size_t(k)});
        // Manifold, and neighbours run along their edge in opposite directions: else it is no polygon mesh to CGAL.
        EXPECT_TRUE(PMP::is_polygon_soup_a_polygon_mesh(faces));
        Mesh mesh;
        PMP::polygon_soup_to_polygon_mesh(points, faces, mesh);
        EXPECT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
        EXPECT_TRUE(CGAL::is_triangle_mesh(mesh));
        EXPECT_TRUE(CGAL::is_closed(mesh));
        return mesh;
    }
};

INSTANTIATE_TEST_SUITE_P(Devices, MeshTopology, testing::ValuesIn(devices()));

}

namespace
{

// A half sphere of so many particles on the floor around (middle 0 0), each moved by up to `disorder` along each axis. In spacings.
std::vector<Vector3> halfSphere(int particles, double middle, scalar disorder)
{
    const double radius = std::cbrt(3*particles/(2*std::numbers::pi));
    std::vector<Vec3> points;
    for (int i = -12; i < 12; ++i)
    {
        for (int j = -12; j < 12; ++j)
        {
            for (int k = 0; k < 12; ++k)
            {
                const Vector3 p(i + 0.3, j + 0.6, k + 0.5);
                if (length(p) < radius) points.push_back({scalar(p.x), scalar(p.y), scalar(p.z)});
            }
        }
    }
    RandomNumbers random(7);
    if (disorder > 0) shizuku::test::disorder(points, disorder, random);
    std::vector<Vector3> places;
    for (const Vec3& p : points) places.emplace_back(p.x + middle, p.y, p.z);
    return places;
}

}

// As the mesher makes it, of a lattice: one closed surface that looks outward, does not meet itself and holds the particles' volume within 1 %.
TEST_P(MeshTopology, OfADrop)
{
    write("system/meshSurfaceDict", "clean no;");
    const std::vector<Vector3> places = halfSphere(2000, 0, 0);
    const Mesh mesh = meshOf(places);
    EXPECT_TRUE(PMP::is_outward_oriented(mesh));
    EXPECT_FALSE(PMP::does_self_intersect(mesh));
    EXPECT_NEAR(PMP::volume(mesh)/(places.size()*spacing*spacing*spacing), 1, 0.01);
}

// Cleaned, of drops between the walls of the case, a lattice and disordered liquid.
TEST_P(MeshTopology, OfACleanedDrop)
{
    for (const scalar disorder : {0.0f, 0.15f})
    {
        const std::vector<Vector3> places = halfSphere(300, 2.5, disorder);
        const Mesh mesh = meshOf(places);
        EXPECT_TRUE(PMP::is_outward_oriented(mesh));
        EXPECT_FALSE(PMP::does_self_intersect(mesh)) << disorder;
        EXPECT_NEAR(PMP::volume(mesh)/(places.size()*spacing*spacing*spacing), 1, 0.02);
    }
}

// Put back between cyclic sides it is in two pieces, of which meshSurface makes one again: the same surface, moved by less than the quantum of places.
TEST_P(MeshTopology, OfADropAcrossACyclicSide)
{
    const double side = 14, period = 2*side;
    std::vector<Vector3> places = halfSphere(300, side - 1.5, 0.15f);
    const double alone = PMP::volume(meshOf(places));
    std::size_t beyond = 0;
    for (Vector3& x : places)
    {
        if (x.x < side) continue;
        x.x -= period;
        ++beyond;
    }
    EXPECT_GT(beyond, 30u);
    write("constant/boundary", "min (-0.014 -1 -1); max (0.014 1 1); sides { xMin cyclic; xMax cyclic; }");
    const Mesh mesh = meshOf(places);
    EXPECT_TRUE(PMP::is_outward_oriented(mesh));
    EXPECT_NEAR(PMP::volume(mesh)/alone, 1, 1e-5);          // single precision of vertices
}

// Scattered, torn liquid of one to twenty particles: every case of cells, and still surfaces that bound a volume.
TEST_P(MeshTopology, OfSpray)
{
    std::vector<Vector3> places;
    for (const Vec3& p : randomPoints(1500, {0, 0, 0}, {14, 14, 14})) places.emplace_back(p.x, p.y, p.z);
    const Mesh mesh = meshOf(places);
    EXPECT_GT(mesh.number_of_faces(), 10000u);
    EXPECT_GT(PMP::volume(mesh), 0);
}

}
