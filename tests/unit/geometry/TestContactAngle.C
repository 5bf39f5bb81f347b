#include "geometry/ContactAngle.H"
#include "geometry/MeshTopology.H"
#include "support/CapMesh.H"

#include <gtest/gtest.h>

#include <numbers>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

const Plane floorPlane{{0, 0, 0}, {0, 0, 1}};
constexpr double spacing = 1.28e-4;

// A drop of so many particles on the wall, meshed with cells of half a spacing.
Cap dropOf(int particles, double theta, const Plane& wall = floorPlane)
{
    return capOfVolume(theta, particles*spacing*spacing*spacing, wall, wall.point);
}

TriangleMesh meshOf(const Cap& cap) { return capMesh(cap, 0.5*spacing); }

}

class ExactCap : public testing::TestWithParam<int>
{
protected:
    void check(int particles, double tolerance)
    {
        const double theta = GetParam();
        const Cap cap = dropOf(particles, theta);
        const TriangleMesh mesh = meshOf(cap);
        ASSERT_TRUE(findDefects(mesh).none());
        const ContactAngle measured = measureContactAngle(mesh, floorPlane, spacing);
        ASSERT_EQ(measured.state, DropState::attached);
        EXPECT_NEAR(measured.angle, theta, tolerance);
        // The mesh cuts corners by its sagitta, cell^2/(8 R), below a hundredth of a spacing; ten times that.
        EXPECT_NEAR(measured.contactRadius, cap.contactRadius(theta), 0.1*spacing);
        EXPECT_NEAR(measured.height, cap.height(), 0.1*spacing);
        EXPECT_LT(measured.residual, 0.02);
        const double widest = theta < 90 ? cap.contactRadius(theta) : cap.radius;
        // The mesh loses the rim where it is thinner than a cell, no more.
        const double cell = 0.5*spacing, steepness = theta < 90 ? std::tan(theta*std::numbers::pi/180) : 1;
        EXPECT_NEAR(std::sqrt(measured.coveredArea/std::numbers::pi), widest, cell/std::min(1.0, steepness));
    }
};

// Tolerances: what is asked of the tool; the fit on exact meshes is far better than that.
TEST_P(ExactCap, TenThousandParticles) { check(10000, 0.5); }
TEST_P(ExactCap, TwoThousandParticles) { check(2000, 1.0); }

INSTANTIATE_TEST_SUITE_P(Theta, ExactCap, testing::Range(15, 166, 15));

TEST(ContactAngle, IsTheSameOnATiltedPlane)
{
    const Plane wall{{1e-3, 2e-3, -5e-4}, normalized({0.3, -0.5, 0.8})};
    for (const double theta : {30.0, 90.0, 150.0})
    {
        const ContactAngle measured = measureContactAngle(meshOf(dropOf(10000, theta, wall)), wall, spacing);
        EXPECT_EQ(measured.state, DropState::attached);
        EXPECT_NEAR(measured.angle, theta, 0.5) << theta;
    }
}

TEST(ContactAngle, IgnoresADistortedFoot)
{
    // Below 1.25 spacings the surface flares out by half a spacing, as layers of particles make it do.
    const Cap cap = dropOf(2000, 90);
    TriangleMesh mesh = meshOf(cap);
    for (Vector3& v : mesh.vertices)
    {
        if (v.z < 1.2*spacing) v += 0.5*spacing*normalized({v.x, v.y, 1e-9});
    }
    EXPECT_NEAR(measureContactAngle(mesh, floorPlane, spacing).angle, 90, 1);
    // Fitted as well, the foot pulls the angle away: the height above which is fitted does act.
    EXPECT_GT(std::abs(measureContactAngle(mesh, floorPlane, spacing, {.fitAbove = 0}).angle - 90), 2);
}

TEST(ContactAngle, TouchingSphereHas180Degrees)
{
    const Cap sphere{{{0, 0, 0}, {0, 0, 1}}, {0, 0, 1e-3 + 0.5*spacing}, 1e-3};
    const ContactAngle measured = measureContactAngle(meshOf(sphere), floorPlane, spacing);
    EXPECT_EQ(measured.state, DropState::attached);
    EXPECT_EQ(measured.angle, 180);
    EXPECT_EQ(measured.contactRadius, 0);
}

TEST(ContactAngle, DropThatLeftTheWallIsDetached)
{
    const Cap sphere{{{0, 0, 0}, {0, 0, 1}}, {0, 0, 1e-3 + 2*spacing}, 1e-3};
    const ContactAngle measured = measureContactAngle(meshOf(sphere), floorPlane, spacing);
    EXPECT_EQ(measured.state, DropState::detached);
    EXPECT_EQ(word(measured.state), "detached");
    EXPECT_TRUE(std::isnan(measured.angle));
    EXPECT_NEAR(measured.height, 2e-3 + 2*spacing, 0.1*spacing);
}

TEST(ContactAngle, FlatLayerIsAFilm)
{
    // A disc of 2 mm radius, two spacings high.
    const auto distance = [](const Vector3& p)
    {
        return std::max({std::hypot(p.x, p.y) - 2e-3, p.z - 2*spacing, -p.z});
    };
    const TriangleMesh film = marchTetrahedra
    (
        distance, {-2.2e-3, -2.21e-3, -1.3*spacing}, {2.2e-3, 2.2e-3, 4*spacing}, 0.5*spacing
    );
    const ContactAngle measured = measureContactAngle(film, floorPlane, spacing);
    EXPECT_EQ(measured.state, DropState::film);
    EXPECT_TRUE(std::isnan(measured.angle));
    EXPECT_NEAR(measured.height, 2*spacing, 0.1*spacing);
    // The mesh's rim loses at most half a cell of the radius.
    EXPECT_NEAR(measured.coveredArea, std::numbers::pi*4e-6, 2*std::numbers::pi*2e-3*0.25*spacing);
    EXPECT_NEAR(measured.contactRadius, 2e-3, 0.25*spacing);
}

TEST(ContactAngle, TwoDropsAreToldApart)
{
    const Cap left = capOfVolume(60, 1e-9, floorPlane, {-2e-3, 0, 0});
    const Cap right = capOfVolume(120, 2e-9, floorPlane, {2e-3, 0, 0});
    const auto drops = connectedComponents(joined(meshOf(left), meshOf(right)));
    ASSERT_EQ(drops.size(), 2u);
    EXPECT_NEAR(measureContactAngle(drops[0], floorPlane, spacing).angle, 60, 1);
    EXPECT_NEAR(measureContactAngle(drops[1], floorPlane, spacing).angle, 120, 1);
    // The volume of the mesh against the cap's: chords and the cut rim lose below 2 %.
    EXPECT_NEAR(drops[0].volume(), 1e-9, 0.02e-9);
    EXPECT_NEAR(drops[1].volume(), 2e-9, 0.04e-9);
}
