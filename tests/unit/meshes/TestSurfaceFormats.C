// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/surfaceFormats/SurfaceFormat.H"

#include "meshes/PlyFile.H"
#include "meshes/StlFile.H"
#include "support/CapMesh.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <sstream>

namespace shizuku::test
{

namespace
{

TriangleMesh ballWithNormals()
{
    TriangleMesh mesh = icosphereMesh(2);
    mesh.normals = mesh.vertices;
    return mesh;
}

void write(const std::string& word, const std::filesystem::path& file, const TriangleMesh& mesh)
{
    SurfaceFormatTable::New("surface format", word, {})->write(file, mesh);
}

}

// STL and normals in single precision, 2^-24 of the coordinates.
TEST(SurfaceFormats, StlHoldsEveryFacet)
{
    const ScratchFolder folder;
    const TriangleMesh mesh = ballWithNormals();
    write("stl", folder.path()/"liquid.stl", mesh);
    const PatchedSurface read = readStl(folder.path()/"liquid.stl", "liquid");
    ASSERT_EQ(read.mesh.faces.size(), mesh.faces.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    {
        for (int k = 0; k < 3; ++k)
        {
            const Vector3 difference = read.mesh.vertices[read.mesh.faces[f][k]] - mesh.vertices[mesh.faces[f][k]];
            ASSERT_LT(length(difference), 2e-7);
        }
    }
    // The first facet's normal, behind 80 bytes and the count, looks outward.
    float normal[3];
    folder.read("liquid.stl").copy(reinterpret_cast<char*>(normal), sizeof normal, 84);
    EXPECT_GT(dot({normal[0], normal[1], normal[2]}, mesh.vertices[mesh.faces[0][0]]), 0.9);
}

TEST(SurfaceFormats, ObjHoldsVerticesNormalsAndFaces)
{
    const ScratchFolder folder;
    const TriangleMesh mesh = ballWithNormals();
    write("obj", folder.path()/"liquid.obj", mesh);

    TriangleMesh read;
    std::istringstream text(folder.read("liquid.obj"));
    for (std::string line; std::getline(text, line);)
    {
        std::istringstream words(line);
        std::string keyword;
        words >> keyword;
        Vector3 v;
        std::array<int, 3> corner{}, normal{};
        char slash;
        if (keyword == "v" && words >> v.x >> v.y >> v.z) read.vertices.push_back(v);
        if (keyword == "vn" && words >> v.x >> v.y >> v.z) read.normals.push_back(v);
        if (keyword != "f") continue;
        for (int k = 0; k < 3; ++k) words >> corner[k] >> slash >> slash >> normal[k];
        EXPECT_EQ(corner, normal);
        read.faces.push_back({corner[0] - 1, corner[1] - 1, corner[2] - 1});
    }
    EXPECT_EQ(read.faces, mesh.faces);
    ASSERT_EQ(read.vertices.size(), mesh.vertices.size());
    ASSERT_EQ(read.normals.size(), mesh.normals.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    {
        ASSERT_EQ(read.vertices[i], mesh.vertices[i]);
        ASSERT_LT(length(read.normals[i] - mesh.normals[i]), 2e-7);
    }
}

TEST(SurfaceFormats, PlyIsWhatTheOtherToolsRead)
{
    const ScratchFolder folder;
    const TriangleMesh mesh = ballWithNormals();
    write("ply", folder.path()/"liquid.ply", mesh);
    const TriangleMesh read = readPly(folder.path()/"liquid.ply");
    EXPECT_EQ(read.faces, mesh.faces);
    EXPECT_EQ(read.normals.size(), mesh.normals.size());
}

TEST(SurfaceFormats, NoLiquidIsAnEmptyFile)
{
    const ScratchFolder folder;
    for (const std::string word : {"ply", "stl", "obj"}) write(word, folder.path()/("none." + word), {});
    EXPECT_EQ(folder.read("none.stl").size(), 84u);
    EXPECT_TRUE(readPly(folder.path()/"none.ply").faces.empty());
}

}
