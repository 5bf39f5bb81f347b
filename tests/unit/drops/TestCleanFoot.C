// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/angles/Degrees.H"
#include "drops/foot/CleanFoot.H"
#include "maths/Kernel.H"
#include "meshes/MeshTopology.H"
#include "support/CapMesh.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr double spacing = 1e-4, support = 2*spacing;

// A cap on the plane z = 0, its particles on the cubic lattice, and its mesh as marching cubes leave it: it ends a part of a spacing above or below the wall, and its
// vertices are off by some hundredths of a spacing.
struct RoughCap
{
    Cap cap;
    std::vector<Vector3> particles;
    TriangleMesh mesh;

    RoughCap(double theta, double volume) : cap(capOfVolume(theta, volume, {{0, 0, 0}, {0, 0, 1}}, {0, 0, 0}))
    {
        for (int i = -60; i < 60; ++i)
            for (int j = -60; j < 60; ++j)
                for (int k = 0; k < 60; ++k)
                {
                    const Vector3 p = spacing*Vector3(i + 0.5, j + 0.5, k + 0.5);
                    if (cap.contains(p)) particles.push_back(p);
                }
        mesh = capMesh(cap, 0.5*spacing);
        mesh.normals.assign(mesh.vertices.size(), {});
        for (const auto& [i, j, k] : mesh.faces)
        {
            const Vector3 area = cross(mesh.vertices[j] - mesh.vertices[i], mesh.vertices[k] - mesh.vertices[i]);
            for (const int v : {i, j, k}) mesh.normals[v] += area;
        }
        for (Vector3& n : mesh.normals) n = normalized(n);
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        {
            const double wave = std::sin(40.0*std::atan2(mesh.vertices[v].y, mesh.vertices[v].x));
            mesh.vertices[v] += 0.1*spacing*wave*mesh.normals[v];
        }
    }
};

class CleanFootTest : public testing::Test
{
protected:
    // The walls of a case with that wall as constant/walls, and its angle.
    std::unique_ptr<WallsNear> walls(const std::string& wall, double theta) const
    {
        folder_.write("constant/walls", "floor { " + wall + " }\n");
        folder_.write("constant/wettability", "floor { theta " + std::to_string(theta) + "; }\n");
        auto near = std::make_unique<WallsNear>(folder_.path(), spacing);
        near->readTheta(0);
        return near;
    }

private:
    ScratchFolder folder_;
};

// Of the vertices on z = 0 that have neighbours above it: the rms of their radius about its mean, and that mean.
struct Line
{
    double radius = 0, roughness = 0;
    int vertices = 0;
};

Line lineOf(const TriangleMesh& mesh)
{
    std::vector<double> radii;
    const auto onWall = [&](int v) { return std::abs(mesh.vertices[v].z) < 1e-9*spacing; };
    std::vector<bool> counted(mesh.vertices.size(), false);
    for (const auto& face : mesh.faces)
    {
        if (std::all_of(face.begin(), face.end(), onWall)) continue;
        for (const int v : face)
        {
            if (!onWall(v) || counted[v]) continue;
            counted[v] = true;
            radii.push_back(std::hypot(mesh.vertices[v].x, mesh.vertices[v].y));
        }
    }
    Line line;
    line.vertices = int(radii.size());
    for (const double r : radii) line.radius += r/line.vertices;
    for (const double r : radii) line.roughness += (r - line.radius)*(r - line.radius)/line.vertices;
    line.roughness = std::sqrt(line.roughness);
    return line;
}

// Closed column of that radius [m] as a function of the azimuth, on z = 0, with a flat top.
TriangleMesh column(double height, const std::function<double(double)>& radius)
{
    constexpr int around = 150;
    const int up = int(height/(0.5*spacing)), inwards = 30;
    TriangleMesh mesh;
    const auto ring = [&](double z, double part)
    {
        for (int k = 0; k < around; ++k)
        {
            const double azimuth = 2*std::numbers::pi*k/around;
            mesh.vertices.push_back({part*radius(azimuth)*std::cos(azimuth), part*radius(azimuth)*std::sin(azimuth), z});
        }
    };
    for (int i = 1; i <= inwards; ++i) ring(0, double(i)/inwards);
    for (int i = 1; i < up; ++i) ring(height*i/up, 1);
    for (int i = inwards; i > 0; --i) ring(height, double(i)/inwards);
    const int rings = int(mesh.vertices.size())/around, low = rings*around, high = low + 1;
    mesh.vertices.push_back({0, 0, 0});
    mesh.vertices.push_back({0, 0, height});
    for (int k = 0; k < around; ++k)
    {
        const int l = (k + 1) % around;
        mesh.faces.push_back({low, l, k});
        mesh.faces.push_back({high, (rings - 1)*around + k, (rings - 1)*around + l});
        for (int i = 0; i + 1 < rings; ++i)
        {
            mesh.faces.push_back({i*around + k, i*around + l, (i + 1)*around + l});
            mesh.faces.push_back({i*around + k, (i + 1)*around + l, (i + 1)*around + k});
        }
    }
    mesh.normals.assign(mesh.vertices.size(), {});
    for (const auto& [i, j, k] : mesh.faces)
    {
        const Vector3 area = cross(mesh.vertices[j] - mesh.vertices[i], mesh.vertices[k] - mesh.vertices[i]);
        for (const int v : {i, j, k}) mesh.normals[v] += area;
    }
    for (Vector3& n : mesh.normals) n = normalized(n);
    return mesh;
}

// Of the vertices higher than that [m]: rms of their distance from the middle of their heights' sphere, a cap's.
double lumps(const TriangleMesh& mesh, const Vector3& centre)
{
    double n = 0, sum = 0, squares = 0;
    for (const Vector3& x : mesh.vertices)
    {
        if (x.z < 3*spacing) continue;
        const double r = length(x - centre);
        ++n;
        sum += r;
        squares += r*r;
    }
    return std::sqrt(std::max(0.0, squares/n - sum*sum/(n*n)));
}

}

TEST(WedgeLevel, IsTheAnglesPartAtTheLineAndHalfFarAway)
{
    const WedgeLevel level(support);
    for (const double theta : {30.0, 60.0, 90.0, 120.0, 150.0})
    {
        EXPECT_NEAR(level(0, theta), theta/360, 1e-12) << theta;
        EXPECT_NEAR(level(support, theta), theta < 90 ? level(10*support, theta) : 0.5, 0.02) << theta;
        EXPECT_NEAR(level(10*support, theta), 0.5, 1e-9) << theta;
    }
    // Of a wedge of 90 degrees half of what a half space has as high above the wall.
    const CubicSpline W(1);
    for (const double height : {0.1, 0.3, 0.6})
    {
        double above = 0;                   // by slices along the height, each by rings
        constexpr int n = 400;
        for (int i = 0; i < n; ++i)
        {
            const double z = -height + (1 + height)*(i + 0.5)/n;
            for (int k = 0; k < n; ++k)
            {
                const double r = (k + 0.5)/n;
                above += W.W(scalar(std::hypot(r, z)))*2*std::numbers::pi*r/n*(1 + height)/n;
            }
        }
        EXPECT_NEAR(level(height*support, 90), 0.5*above, 2e-3) << height;
    }
}

// The mesh ends on the wall, in a circle as large as the cap's, at its angle, and encloses what it did.
TEST_F(CleanFootTest, EndsOnTheWallInASmoothLineAtTheContactAngle)
{
    for (const double theta : {45.0, 60.0, 90.0, 120.0})
    {
        const auto near = walls("type plane; point (0 0 0); normal (0 0 1);", theta);
        RoughCap drop(theta, 2000*std::pow(spacing, 3));
        TriangleMesh mesh = drop.mesh;
        const double volume = mesh.volume();
        const double offset = CleanFoot(*near, spacing, support).clean(mesh, drop.particles, volume);
        EXPECT_LT(std::abs(offset), 0.1*spacing) << theta;
        EXPECT_NEAR(mesh.volume(), volume, 1e-4*volume) << theta;
        EXPECT_TRUE(findDefects(mesh).none()) << theta;
        double lowest = 1;
        for (const Vector3& x : mesh.vertices) lowest = std::min(lowest, x.z);
        EXPECT_NEAR(lowest, 0, 1e-9*spacing) << theta;

        const Line line = lineOf(mesh);
        const double exact = drop.cap.contactRadius(theta);
        EXPECT_GT(line.vertices, 50) << theta;
        EXPECT_NEAR(line.radius, exact, 0.35*spacing) << theta;         // a lattice's steps, of one spacing, averaged
        // The lattice's own outline deviates from a circle by 0.2 spacings rms. A saw-tooth of every other vertex would be as large again.
        EXPECT_LT(line.roughness, 0.25*spacing) << theta;
        // At the line the normals are those of the free surface there: the contact angle, but for the passes that smooth it and the lattice.
        double sum = 0;
        int count = 0;
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        {
            const double r = std::hypot(mesh.vertices[v].x, mesh.vertices[v].y);
            if (std::abs(mesh.vertices[v].z) > 1e-9*spacing || std::abs(r - line.radius) > 2*line.roughness || mesh.normals[v].z < -0.99) continue;
            sum += degrees(std::acos(std::clamp(mesh.normals[v].z, -1.0, 1.0)));
            ++count;
        }
        EXPECT_NEAR(sum/count, theta, 10) << theta;
    }
}

// Far from walls the mesh is smoothed and no more.
TEST_F(CleanFootTest, SmoothsAndKeepsTheVolumeWhereThereIsNoWall)
{
    const auto near = walls("type plane; point (0 0 -1); normal (0 0 1);", 60);
    RoughCap drop(150, 2000*std::pow(spacing, 3));
    TriangleMesh mesh = drop.mesh;
    const double area = mesh.area();
    CleanFoot(*near, spacing, support).clean(mesh, drop.particles, 1.01*drop.mesh.volume());
    EXPECT_NEAR(mesh.volume(), 1.01*drop.mesh.volume(), 1e-4*mesh.volume());
    EXPECT_LT(mesh.area(), area);               // waves are gone
    EXPECT_EQ(mesh.faces, drop.mesh.faces);
}

// What would take more than half a spacing is not done.
TEST_F(CleanFootTest, RefusesVolumesThatAreFarAway)
{
    const auto near = walls("type plane; point (0 0 -1); normal (0 0 1);", 60);
    RoughCap drop(150, 2000*std::pow(spacing, 3));
    TriangleMesh mesh = drop.mesh;
    const double volume = mesh.volume();
    EXPECT_TRUE(std::isnan(CleanFoot(*near, spacing, support).clean(mesh, drop.particles, 2*volume)));
    EXPECT_NEAR(mesh.volume(), volume, 0.02*volume);
}

// Inside of a ball: the foot lies on the curved wall.
TEST_F(CleanFootTest, EndsOnCurvedWalls)
{
    const double radius = 30*spacing;
    const auto near = walls("type sphere; centre (0 0 " + std::to_string(radius) + "); radius " + std::to_string(radius) + "; liquid inside;", 90);
    RoughCap drop(90, 2000*std::pow(spacing, 3));
    // Put onto the ball's lowest part: the floor's places move up as the ball does.
    const auto lifted = [&](Vector3 x)
    {
        x.z += radius - std::sqrt(radius*radius - x.x*x.x - x.y*x.y);
        return x;
    };
    TriangleMesh mesh = drop.mesh;
    for (Vector3& x : mesh.vertices) x = lifted(x);
    for (Vector3& x : drop.particles) x = lifted(x);
    CleanFoot(*near, spacing, support).clean(mesh, drop.particles, mesh.volume());
    double deepest = 0;
    int onWall = 0;
    for (const Vector3& x : mesh.vertices)
    {
        const double height = radius - length(x - Vector3(0, 0, radius));
        deepest = std::max(deepest, -height);
        if (std::abs(height) < 1e-6*spacing) ++onWall;
    }
    EXPECT_LT(deepest, 0.01*spacing);           // of the free surface beside the line
    EXPECT_GT(onWall, 200);
}

// A lattice leaves half a spacing of room at a tube, in sixteen steps around it: the mesh is smooth, does not fill the room, and stays inside of the tube and on the floor.
TEST_F(CleanFootTest, LeavesTheRoomThatALatticeLeavesAtATube)
{
    const double radius = 8*spacing, height = 12*spacing;
    for (const double theta : {30.0, 150.0})
    {
        const auto near = walls("type cylinder; point (0 0 0); axis (0 0 1); radius 8e-4; liquid inside; } base { type plane; point (0 0 0); normal (0 0 1);", theta);
        TriangleMesh mesh = column(height, [&](double azimuth) { return radius - spacing*(0.4 + 0.3*std::cos(16*azimuth)); });
        std::vector<Vector3> particles;
        for (int i = -8; i < 8; ++i)
            for (int j = -8; j < 8; ++j)
                for (int k = 0; k < 12; ++k)
                {
                    const Vector3 p = spacing*Vector3(i + 0.5, j + 0.5, k + 0.5);
                    if (std::hypot(p.x, p.y) < radius - 0.5*spacing) particles.push_back(p);
                }
        const double volume = mesh.volume(), tube = std::numbers::pi*radius*radius*height;
        ASSERT_LT(volume, 0.92*tube);
        const double offset = CleanFoot(*near, spacing, support).clean(mesh, particles, volume);
        EXPECT_LE(std::abs(offset), 0.5*spacing) << theta;              // what is not taken is NaN
        EXPECT_NEAR(mesh.volume(), volume, 1e-3*volume) << theta;       // the last projection on curved walls is not corrected
        EXPECT_TRUE(findDefects(mesh).none()) << theta;
        double widest = 0, lowest = 1, narrowest = 1;
        for (const Vector3& x : mesh.vertices)
        {
            const double r = std::hypot(x.x, x.y);
            lowest = std::min(lowest, x.z);
            widest = std::max(widest, r);
            if (x.z > 3*spacing && x.z < 8*spacing) narrowest = std::min(narrowest, r);
        }
        EXPECT_LT(widest, radius + 1e-6*spacing) << theta;
        EXPECT_GT(lowest, -1e-6*spacing) << theta;
        EXPECT_GT(narrowest, radius - 0.5*spacing) << theta;            // steps of 0.6 spacings are smooth now
    }
}

// Lumps of four spacings, as the steps of a lattice are: out where particles stand on one, and left where they have flowed.
TEST_F(CleanFootTest, TakesTheStepsOfALatticeOut)
{
    const auto near = walls("type plane; point (0 0 0); normal (0 0 1);", 90);
    const RoughCap drop(90, 4000*std::pow(spacing, 3));
    const double radius = length(drop.mesh.vertices.front() - drop.cap.centre);
    TriangleMesh lumpy = capMesh(drop.cap, 0.5*spacing);
    lumpy.normals = drop.mesh.normals;
    for (Vector3& x : lumpy.vertices)
    {
        const Vector3 s = 2*std::numbers::pi/(4*spacing)*x;
        x += 0.2*spacing*std::sin(s.x)*std::sin(s.y)*std::cos(s.z)/radius*(x - drop.cap.centre);
    }
    const double before = lumps(lumpy, drop.cap.centre);
    ASSERT_GT(before, 0.05*spacing);
    std::vector<Vector3> flowed = drop.particles;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> off(-0.1*spacing, 0.1*spacing);
    for (Vector3& x : flowed) x += {off(random), off(random), off(random)};
    TriangleMesh still = lumpy, moved = lumpy;
    CleanFoot(*near, spacing, support).clean(still, drop.particles, lumpy.volume());
    CleanFoot(*near, spacing, support).clean(moved, flowed, lumpy.volume());
    EXPECT_LT(lumps(still, drop.cap.centre), 0.6*before);             // steps reach over several such waves
    EXPECT_GT(lumps(moved, drop.cap.centre), 0.8*before);
    EXPECT_NEAR(still.volume(), lumpy.volume(), 1e-4*still.volume());
}
