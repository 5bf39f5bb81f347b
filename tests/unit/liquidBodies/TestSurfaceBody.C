// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/Surfaces.H"
#include "unit/liquidBodies/Bodies.H"

namespace shizuku::test
{

namespace
{

// A case with the surface as constant/triSurface/body.stl.
void writeSurface(const ScratchFolder& folder, const PatchedSurface& surface)
{
    folder.write("constant/triSurface/body.stl", stlText(surface, "body"));
}

}

TEST(SurfaceBody, FillsTheInsideOfAClosedSurfaceToItsVolume)
{
    const ScratchFolder folder;
    writeSurface(folder, sphere(8, 3));
    const auto body = makeBody("type surface; file \"body.stl\"; scale 0.5; translate (10 0 0);", folder.path());
    // Nearly the ball of radius 4 around (10 0 0): the 768 facets cut off less than 2 %.
    EXPECT_NEAR(body->volume(), 268.1, 5.4);
    const auto points = fillLattice(*body, 0.5, {});
    EXPECT_NEAR(points.size(), body->volume()/0.125, 0.5);
    // A cell of edge 0.5 that has the larger part inside has its middle at most about half an edge outside.
    for (const Vector3& x : points) EXPECT_LT(length(x - Vector3(10, 0, 0)), 4.25);
}

TEST(SurfaceBody, StandsOnThePlaneUnderIt)
{
    const ScratchFolder folder;
    writeSurface(folder, cube(4));
    const auto points = fillLattice(*makeBody("type surface; file \"body.stl\";", folder.path()), 1, {});
    ASSERT_EQ(points.size(), 64u);
    EXPECT_EQ(points.front(), Vector3(0.5, 0.5, 0.5));
}

TEST(SurfaceBody, InwardFacesAreTheSameAndAShellInsideIsABubble)
{
    const ScratchFolder folder;
    PatchedSurface box = cube(6);
    for (auto& face : box.mesh.faces) std::swap(face[0], face[1]);
    writeSurface(folder, box);
    EXPECT_EQ(fillLattice(*makeBody("type surface; file \"body.stl\";", folder.path()), 1, {}).size(), 216u);

    PatchedSurface hollow = cube(6);
    const PatchedSurface bubble = cube(2);
    const int offset = int(hollow.mesh.vertices.size());
    for (const Vector3& v : bubble.mesh.vertices) hollow.mesh.vertices.push_back(v + Vector3(2, 2, 2));
    for (const auto& [i, j, k] : bubble.mesh.faces) hollow.mesh.faces.push_back({offset + j, offset + i, offset + k});
    hollow.patch.resize(hollow.mesh.faces.size(), 0);
    writeSurface(folder, hollow);
    const auto points = fillLattice(*makeBody("type surface; file \"body.stl\";", folder.path()), 1, {});
    EXPECT_EQ(points.size(), 216u - 8u);
    for (const Vector3& x : points) EXPECT_GT(std::max({std::abs(x.x - 3), std::abs(x.y - 3), std::abs(x.z - 3)}), 1);
}

TEST(SurfaceBody, SurfacesThatEncloseNothingAreRefused)
{
    const ScratchFolder folder;
    const auto message = [&](const std::string& text)
    {
        return messageOf([&] { makeBody("type surface; file \"body.stl\";" + text, folder.path()); });
    };
    EXPECT_TRUE(holds(message(""), {"Cannot read", "body.stl"}));
    writeSurface(folder, rectangle(3, 3));
    EXPECT_TRUE(holds(message(""), {"body.stl", "encloses no body", "4 open edges", "closed surface"}));
    PatchedSurface torn = cube(3);
    torn.mesh.faces.pop_back();
    torn.patch.pop_back();
    writeSurface(folder, torn);
    EXPECT_TRUE(holds(message(""), {"3 open edges"}));
    PatchedSurface twisted = cube(3);
    std::swap(twisted.mesh.faces[0][0], twisted.mesh.faces[0][1]);
    writeSurface(folder, twisted);
    EXPECT_TRUE(holds(message(""), {"3 edges between triangles that are turned against each other"}));
    writeSurface(folder, cube(3));
    EXPECT_TRUE(holds(message("scale 0;"), {"scale"}));
    EXPECT_TRUE(holds(message("translate 3;"), {"translate"}));
}

}
