// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/ObjFile.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

namespace shizuku::test
{

TEST(ObjFile, FacesGroupsAndPolygonsAreRead)
{
    const ScratchFolder folder;
    const auto file = folder.write
    (
        "a.obj",
        "# a square and a triangle\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n"
        "g left side\nf -4 -3 -2\no ignored behind a group\nf 1/1 2/2 4/3\n"
    );
    const PatchedSurface surface = readObj(file, "wall");
    EXPECT_EQ(surface.mesh.vertices.size(), 4u);
    EXPECT_EQ(surface.patches, (std::vector<std::string>{"wall", "left"}));
    EXPECT_EQ(surface.patch, (std::vector<int>{0, 0, 1, 1}));
    EXPECT_EQ(surface.mesh.faces[0], (std::array<int, 3>{0, 1, 2}));
    EXPECT_EQ(surface.mesh.faces[1], (std::array<int, 3>{0, 2, 3}));
    EXPECT_EQ(surface.mesh.faces[2], (std::array<int, 3>{0, 1, 2}));
    EXPECT_DOUBLE_EQ(surface.mesh.area(), 2);
}

TEST(ObjFile, LinesGoOnBehindABackslashAndEndBeforeAComment)
{
    const ScratchFolder folder;
    const auto file = folder.write
    (
        "a.obj", "v 0 0 0 # first\nv 2 0 0\nv 2 2 \\\n0\nv 0 2 0\r\ng part#1 # the left one\nf 1 2 \\\r\n3 \\\n4\nf 1 2 3 # comment\n"
    );
    const PatchedSurface surface = readObj(file, "wall");
    EXPECT_EQ(surface.mesh.vertices.size(), 4u);
    EXPECT_EQ(surface.mesh.faces.size(), 3u);
    EXPECT_DOUBLE_EQ(surface.mesh.area(), 4 + 2);
    EXPECT_EQ(surface.patches, (std::vector<std::string>{"part_1"}));
}

TEST(ObjFile, ConcavePolygonsKeepTheirNotch)
{
    const ScratchFolder folder;
    // An L of three unit squares, its inner corner (1 1): from each corner as the first one.
    for (int first = 0; first < 6; ++first)
    {
        std::string text = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf";
        for (int k = 0; k < 6; ++k) text += " " + std::to_string((first + k)%6 + 1);
        const TriangleMesh mesh = readObj(folder.write("a.obj", text + "\n"), "wall").mesh;
        EXPECT_EQ(mesh.faces.size(), 4u);
        EXPECT_NEAR(mesh.area(), 3, 1e-12);     // a fan from most of its corners has more
    }
}

TEST(ObjFile, NamesThatAreAlikeAsWordsAreKeptApart)
{
    const ScratchFolder folder;
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (const char* name : {"a/b", "a_b", "wall one", "wall two", "床", "壁", "a/b"}) text += std::string("g ") + name + "\nf 1 2 3\n";
    const PatchedSurface surface = readObj(folder.write("a.obj", text), "wall");
    EXPECT_EQ(surface.patches, (std::vector<std::string>{"a_b", "a_b_2", "wall", "wall_two", "床", "壁"}));
    EXPECT_EQ(surface.patch, (std::vector<int>{0, 1, 2, 3, 4, 5, 0}));
}

TEST(ObjFile, BadFilesAreRefusedWithTheLine)
{
    const ScratchFolder folder;
    const auto message = [&](const std::string& text)
    {
        const auto file = folder.write("a.obj", text);
        return messageOf([&] { readObj(file, "wall"); });
    };
    const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_TRUE(holds(message(""), {"a.obj", "empty"}));
    EXPECT_TRUE(holds(message(three), {"no face"}));
    EXPECT_TRUE(holds(message(three + "f 1 2 4\n"), {"'4'", "line 4", "1 to 3"}));
    EXPECT_TRUE(holds(message(three + "f 1 2 0\n"), {"'0'", "1 to 3"}));
    EXPECT_TRUE(holds(message(three + "f 1 2 3x\n"), {"'3x'"}));
    EXPECT_TRUE(holds(message(three + "f 1 2\n"), {"2 vertices", "three"}));
    EXPECT_TRUE(holds(message("v 0 zero 0\n"), {"'zero'", "line 1", "finite"}));
    EXPECT_TRUE(holds(message("v 0 0 inf\n"), {"'inf'", "finite"}));
    EXPECT_TRUE(holds(message("v 0 0\n"), {"line 1", "finite"}));
    EXPECT_TRUE(holds(messageOf([&] { readObj(folder.path()/"absent.obj", "wall"); }), {"absent.obj", "Cannot read"}));
}

}
