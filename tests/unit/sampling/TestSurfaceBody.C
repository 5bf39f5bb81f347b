// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/PlyFile.H"
#include "support/Shapes.H"
#include "support/Surfaces.H"
#include "unit/liquidBodies/Bodies.H"

#include <cmath>
#include <sstream>

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

// Of surfaces whose union is known. Volumes are constructed in double precision.
TEST(SurfaceBody, ShellsMeanTheirUnionHoweverTheyLook)
{
    const ScratchFolder folder;
    const auto expect = [&](const PatchedSurface& surface, double volume, const std::vector<Vector3>& inside, const std::vector<Vector3>& outside)
    {
        writeSurface(folder, surface);
        const auto body = makeBody("type surface; file \"body.stl\";", folder.path());
        EXPECT_NEAR(body->volume(), volume, 1e-9*volume) << body->describe();
        EXPECT_EQ(body->fill(0.25, {}).size(), std::size_t(std::llround(volume/0.015625)));
        for (const Vector3& x : inside) EXPECT_TRUE(body->contains(x)) << str(x);
        for (const Vector3& x : outside) EXPECT_FALSE(body->contains(x)) << str(x);
    };
    const PatchedSurface first = box({0, 0, 0}, {4, 4, 4}), second = box({2, 2, 2}, {6, 6, 6}), inner = box({1, 1, 1}, {3, 3, 3});
    const PatchedSurface apart = box({10, 0, 0}, {12, 4, 4});
    for (const bool firstTurned : {false, true}) for (const bool secondTurned : {false, true})
    {
        SCOPED_TRACE(std::to_string(firstTurned) + std::to_string(secondTurned));
        const auto turned = [](const PatchedSurface& surface, bool is) { return is ? turnedOver(surface) : surface; };
        expect(joined(turned(first, firstTurned), turned(second, secondTurned)), 64 + 64 - 8, {{1, 1, 1}, {3, 3, 3}, {5, 5, 5}}, {{5, 1, 1}});
        expect(joined(turned(first, firstTurned), turned(apart, secondTurned)), 64 + 32, {{1, 1, 1}, {11, 1, 1}}, {{7, 1, 1}});
        // Inside of another one: a bubble where it looks the other way, else nothing new.
        const bool isBubble = firstTurned != secondTurned;
        const std::vector<Vector3> middle{{2, 2, 2}};
        const std::vector<Vector3> none;
        expect(joined(turned(first, firstTurned), turned(inner, secondTurned)), isBubble ? 64 - 8 : 64, isBubble ? none : middle, isBubble ? middle : none);
    }
    // Two bubbles that cross, and a drop in a bubble.
    const PatchedSurface large = box({0, 0, 0}, {8, 8, 8});
    const PatchedSurface bubbles = joined(turnedOver(box({1, 1, 1}, {4, 4, 4})), turnedOver(box({3, 3, 3}, {6, 6, 6})));
    expect(joined(large, bubbles), 512 - 27 - 27 + 1, {{5, 2, 2}}, {{2, 2, 2}, {3.5, 3.5, 3.5}, {5, 5, 5}});
    const PatchedSurface hollow = joined(large, turnedOver(box({1, 1, 1}, {7, 7, 7})));
    expect(joined(hollow, box({3, 3, 3}, {5, 5, 5})), 512 - 216 + 8, {{4, 4, 4}, {0.5, 4, 4}}, {{2, 4, 4}});
    // Of three in a row each crosses the next one alone; two share a part of a face.
    expect(joined(joined(box({0, 0, 0}, {2, 2, 2}), box({1, 1, 1}, {4, 3, 3})), box({3, 2, 2}, {6, 5, 5})), 8 + 12 - 1 + 27 - 1, {{4.5, 3, 3}}, {{5, 1, 1}});
    expect(joined(box({0, 0, 0}, {2, 2, 2}), turnedOver(box({2, 1, 1}, {4, 3, 3}))), 16, {{1, 1, 1}, {3, 2, 2}}, {{3, 0.5, 0.5}});

    writeSurface(folder, joined(joined(large, turnedOver(box({1, 1, 1}, {4, 4, 4}))), box({3, 3, 3}, {6, 6, 6})));
    const std::string refusal = messageOf([&] { makeBody("type surface; file \"body.stl\";", folder.path()); });
    EXPECT_TRUE(holds(refusal, {"body.stl", "a bubble and a body of liquid", "cross each other"}));
}

// Every facet has corners of its own, which differ by what a format of seven digits rounds.
TEST(SurfaceBody, SeamsThatDifferByRoundingAreWelded)
{
    const ScratchFolder folder;
    PatchedSurface ball = soupOf(sphere(4, 3));
    const double volume = ball.mesh.volume();
    for (const double rounding : {1e-16, 1e-8, 3e-7})
    {
        PatchedSurface rounded = ball;
        unsigned lot = 1;
        for (Vector3& v : rounded.mesh.vertices)
        {
            for (int c = 0; c < 3; ++c) v[c] += rounding*(double((lot = lot*1664525u + 1013904223u) >> 16)/65536 - 0.5);
        }
        std::ostringstream obj;
        obj.precision(17);
        for (const Vector3& v : rounded.mesh.vertices) obj << "v " << v.x << " " << v.y << " " << v.z << "\n";
        for (const auto& [i, j, k] : rounded.mesh.faces) obj << "f " << i + 1 << " " << j + 1 << " " << k + 1 << "\n";
        folder.write("constant/triSurface/body.obj", obj.str());
        EXPECT_NEAR(makeBody("type surface; file \"body.obj\";", folder.path())->volume(), volume, 1e-6*volume) << rounding;
    }
}

TEST(SurfaceBody, TakesTheFormatsOfWalls)
{
    const ScratchFolder folder;
    const TriangleMesh mesh = cube(4).mesh;
    std::string vertices, obj, off;
    for (const Vector3& v : mesh.vertices)
    {
        const std::string place = std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + "\n";
        vertices += place;
        obj += "v " + place;
    }
    for (const auto& [i, j, k] : mesh.faces)
    {
        obj += "f " + std::to_string(i + 1) + " " + std::to_string(j + 1) + " " + std::to_string(k + 1) + "\n";
        off += "3 " + std::to_string(i) + " " + std::to_string(j) + " " + std::to_string(k) + "\n";
    }
    folder.write("constant/triSurface/body.obj", obj);
    folder.write("constant/triSurface/body.off", "OFF\n" + std::to_string(mesh.vertices.size()) + " " + std::to_string(mesh.faces.size()) + " 0\n" + vertices + off);
    writePly(folder.path()/"constant/triSurface/body.ply", mesh);
    for (const std::string extension : {"obj", "off", "ply"})
    {
        const auto body = makeBody("type surface; file \"body." + extension + "\";", folder.path());
        EXPECT_NEAR(body->volume(), 64, 1e-9) << extension;
        EXPECT_EQ(body->fill(1, {}).size(), 64u) << extension;
    }
    EXPECT_TRUE(holds(messageOf([&] { makeBody("type surface; file \"body.step\";", folder.path()); }), {"Unknown surface format '.step'", ".stl", ".obj"}));
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
    EXPECT_NEAR(makeBody("type surface; file \"body.stl\";", folder.path())->volume(), 27, 1e-9);       // turned, as a wall's would be
    writeSurface(folder, cube(3));
    EXPECT_TRUE(holds(message("scale 0;"), {"scale"}));
    EXPECT_TRUE(holds(message("translate 3;"), {"translate"}));
}

}
