// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/StlFile.H"
#include "support/ScratchFolder.H"
#include "support/Surfaces.H"

#include <gtest/gtest.h>

#include <cstdint>

namespace shizuku::test
{

namespace
{

std::string binaryStl(const PatchedSurface& surface, const std::string& header)
{
    std::string bytes = header;
    bytes.resize(80, '\0');
    const auto append = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
    append(std::uint32_t(surface.mesh.faces.size()));
    for (const auto& face : surface.mesh.faces)
    {
        for (int c = 0; c < 3; ++c) append(0.0f);
        for (int v : face) for (int c = 0; c < 3; ++c) append(float(surface.mesh.vertices[v][c]));
        append(std::uint16_t(0));
    }
    return bytes;
}

}

TEST(StlFile, AsciiAndBinaryHoldTheSameTriangles)
{
    const ScratchFolder folder;
    const PatchedSurface box = cube(2);
    const auto ascii = readStl(folder.write("ascii.stl", stlText(box, "box")), "wall");
    // A binary file whose header begins as an ascii one does.
    const auto binary = readStl(folder.write("binary.stl", binaryStl(box, "solid box")), "wall");
    ASSERT_EQ(ascii.mesh.faces.size(), 12u);
    EXPECT_EQ(ascii.mesh.vertices, binary.mesh.vertices);       // small integers: the same in float and text
    EXPECT_DOUBLE_EQ(ascii.mesh.volume(), 8);
    EXPECT_EQ(ascii.patches, std::vector<std::string>{"box"});
    EXPECT_EQ(binary.patches, std::vector<std::string>{"wall"});
}

TEST(StlFile, SolidsBecomePatches)
{
    const ScratchFolder folder;
    const PatchedSurface flat = rectangle(1, 1);
    const std::string text =
        stlText(flat, "floor exported by hand") + stlText(flat, "") + stlText(flat, "a/b") + stlText(flat, "floor");
    const auto surface = readStl(folder.write("a.stl", text), "wall");
    EXPECT_EQ(surface.patches, (std::vector<std::string>{"floor", "wall", "a_b"}));
    EXPECT_EQ(surface.patch, (std::vector<int>{0, 0, 1, 1, 2, 2, 0, 0}));
}

TEST(StlFile, KeywordsInUpperCaseAndAByteOrderMarkAreRead)
{
    const ScratchFolder folder;
    std::string text = stlText(cube(2), "Box");
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const auto surface = readStl(folder.write("a.stl", "\xEF\xBB\xBF" + text), "wall");
    EXPECT_EQ(surface.patches, std::vector<std::string>{"BOX"});
    EXPECT_DOUBLE_EQ(surface.mesh.volume(), 8);
}

TEST(StlFile, EndsOfTwoWordsAndLinesOfCarriageReturnsAreRead)
{
    const ScratchFolder folder;
    std::string text = stlText(cube(2), "box");
    for (const std::string block : {"loop", "facet", "solid"})
    {
        for (std::size_t at = text.find("end" + block); at != std::string::npos; at = text.find("end" + block, at + 1)) text.insert(at + 3, " ");
    }
    ASSERT_NE(text.find("end solid"), std::string::npos);
    EXPECT_DOUBLE_EQ(readStl(folder.write("a.stl", text), "wall").mesh.volume(), 8);
    std::replace(text.begin(), text.end(), '\n', '\r');
    const auto surface = readStl(folder.write("b.stl", text), "wall");
    EXPECT_EQ(surface.patches, std::vector<std::string>{"box"});
    EXPECT_DOUBLE_EQ(surface.mesh.volume(), 8);
}

TEST(StlFile, BadFilesAreRefused)
{
    const ScratchFolder folder;
    const auto message = [&](const std::string& name, const std::string& text)
    {
        const auto file = folder.write(name, text);
        return messageOf([&] { readStl(file, "wall"); });
    };
    EXPECT_TRUE(holds(message("empty.stl", ""), {"empty.stl", "empty"}));
    EXPECT_TRUE(holds(message("text.stl", "Dear reader,\n"), {"no STL", "text.stl"}));
    EXPECT_TRUE(holds(message("none.stl", "solid a\nendsolid a\n"), {"no facet", "Expected: one facet"}));
    EXPECT_TRUE(holds(message("word.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 zero 0\n"), {"'zero'", "4", "a number"}));
    EXPECT_TRUE(holds(message("nan.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 nan 0\n"), {"nan", "finite"}));
    EXPECT_TRUE(holds(message("cut.stl", stlText(cube(1), "a").substr(0, 300)), {"cut.stl"}));
    const std::string whole = stlText(cube(1), "a");
    const std::size_t lastFacet = whole.rfind("facet normal");
    for (const std::size_t size : {lastFacet, whole.find("endsolid")})         // cut off between two facets
    {
        EXPECT_TRUE(holds(message("short.stl", whole.substr(0, size)), {"ends too early", "facet or endsolid"})) << size;
    }
    const std::string binary = binaryStl(cube(1), "binary");
    // 84 + 12*50 bytes announced.
    EXPECT_EQ(readStl(folder.write("tail.stl", binary + "xy"), "wall").mesh.faces.size(), 12u);     // with a warning
    EXPECT_TRUE(holds(message("short.stl", binary.substr(0, 500)), {"500 bytes", "684 bytes", "12 facets"}));
    EXPECT_TRUE(holds(messageOf([&] { readStl(folder.path()/"absent.stl", "wall"); }), {"absent.stl"}));
}

}
