// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/SurfaceFile.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <chrono>

using namespace shizuku;
using namespace shizuku::test;

TEST(OffFile, FacesAndCommentsAreRead)
{
    const ScratchFolder folder;
    const PatchedSurface quad = readSurface(folder.write("a.off", "OFF # a quad\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 # its face\n"), "wall");
    EXPECT_EQ(quad.mesh.vertices.size(), 4u);
    EXPECT_EQ(quad.mesh.faces.size(), 2u);
}

TEST(SurfaceFile, PackedIsToldToBeUnpacked)
{
    const ScratchFolder folder;
    EXPECT_TRUE(holds(messageOf([&] { readSurface(folder.write("a.stl.gz", "packed"), "wall"); }), {"a.stl.gz", "packed", "gunzip -k"}));
}

// Believed, each of these takes gigabytes and seconds: they are refused in milliseconds, and in a second on a busy machine.
TEST(OffFile, LengthsThatTheFileHasNoRoomForAreRefusedAtOnce)
{
    const ScratchFolder folder;
    const std::string points = "0 0 0\n1 0 0\n1 1 0\n";
    const auto start = std::chrono::steady_clock::now();
    for (const std::string& text :
        {"OFF\n300000000 1 0\n" + points, "OFF\n3 300000000 0\n" + points, "OFF\n3 1 0\n" + points + "1e9 0 1 2\n", "OFF\n3 1 0\n" + points + "-1 0 1 2\n"})
    {
        const auto file = folder.write("a.off", text);
        EXPECT_TRUE(holds(messageOf([&] { readSurface(file, "wall"); }), {"a.off", "no OFF surface"})) << text;
    }
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 1);
}

// What a header promises behind each vertex, and each face, may be there, be less, or be nothing: none of it is looked at.
TEST(OffFile, ColoursNormalsAndTexturesAreLeftAlone)
{
    const ScratchFolder folder;
    for (const std::string behind : {"", " 7", " 0.5 0.5", " 0 0 1 255 0 0 0.25 0.75", " 999999999"})
    {
        for (const std::string header : {"OFF", "STOFF", "COFF", "NOFF", "STCNOFF"})
        {
            const std::string text = header + "\n3 1 0\n0 0 0" + behind + "\n1 0 0" + behind + "\n1 1 0" + behind + "\n3 0 1 2" + behind + "\n";
            const PatchedSurface triangle = readSurface(folder.write("a.off", text), "wall");
            EXPECT_EQ(triangle.mesh.vertices.size(), 3u) << text;
            EXPECT_EQ(triangle.mesh.faces.size(), 1u) << text;
            EXPECT_EQ(triangle.mesh.vertices[2].y, 1) << text;
        }
    }
}

TEST(OffFile, BinaryIsRefusedByName)
{
    const ScratchFolder folder;
    const std::string counts{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0};       // a vertex, a face, no edge
    EXPECT_TRUE(holds(messageOf([&] { readSurface(folder.write("a.off", "OFF BINARY\n" + counts + std::string(30, '\0')), "wall"); }), {"a.off", "binary", "text"}));
}
