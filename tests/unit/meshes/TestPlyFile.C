// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/messages/Error.H"
#include "meshes/PlyFile.H"
#include "support/CapMesh.H"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

using namespace shizuku;
using namespace shizuku::test;
namespace fs = std::filesystem;

namespace
{

class PlyFile : public testing::Test
{
protected:
    void SetUp() override
    {
        folder_ = fs::temp_directory_path()
          /("shizukuPly-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path file(const std::string& text) const
    {
        std::ofstream(folder_/"mesh.ply", std::ios::binary) << text;
        return folder_/"mesh.ply";
    }

    // The message of the error that reading this text throws.
    std::string errorOf(const std::string& text) const
    {
        try { readPly(file(text)); }
        catch (const FatalInputError& error) { return error.what(); }
        return "no error";
    }

    fs::path folder_;
};

const std::string triangleHeader =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

void expectContains(const std::string& text, const std::string& part)
{
    EXPECT_NE(text.find(part), std::string::npos) << "no '" << part << "' in: " << text;
}

}

TEST_F(PlyFile, BothFormatsGiveBackWhatWasWritten)
{
    TriangleMesh mesh = icosphereMesh(2);
    mesh.normals = mesh.vertices;
    for (Vector3& v : mesh.vertices) v = 1e-3*v + Vector3(1, 2, 3);
    for (const PlyFormat format : {PlyFormat::ascii, PlyFormat::binary})
    {
        writePly(folder_/"deep/mesh.ply", mesh, format);
        const TriangleMesh back = readPly(folder_/"deep/mesh.ply");
        EXPECT_EQ(back.faces, mesh.faces);
        ASSERT_EQ(back.vertices.size(), mesh.vertices.size());
        ASSERT_EQ(back.normals.size(), mesh.normals.size());
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        {
            for (int c = 0; c < 3; ++c)
            {
                // Text has 14 digits; doubles pass unchanged.
                EXPECT_NEAR(back.vertices[i][c], mesh.vertices[i][c], format == PlyFormat::ascii ? 1e-13 : 0);
                EXPECT_EQ(back.normals[i][c], double(float(mesh.normals[i][c])));
            }
        }
    }
}

TEST_F(PlyFile, BigEndianFilesAreRead)
{
    std::string bytes = "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string one("\x3f\x80\0\0", 4), zero(4, '\0');
    bytes += zero + zero + zero + one + zero + zero + zero + one + zero + '\3' + zero
        + std::string("\0\0\0\1\0\0\0\2", 8);
    const TriangleMesh mesh = readPly(file(bytes));
    EXPECT_EQ(mesh.vertices[1], Vector3(1, 0, 0));
    EXPECT_EQ(mesh.faces.at(0), (std::array<int, 3>{0, 1, 2}));
}

TEST_F(PlyFile, NothingElseIsLeftBeside)
{
    writePly(folder_/"mesh.ply", cubeMesh(1));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(PlyFile, ReadsForeignFiles)
{
    // Double coordinates, other properties, another element between, a quadrangle, Windows line ends in the header.
    const TriangleMesh mesh = readPly(file(
        "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nelement vertex 4\r\n"
        "property double x\r\nproperty double y\r\n"
        "property uchar red\r\nproperty double z\r\nelement material 1\r\nproperty list uchar float shine\r\n"
        "element face 1\r\nproperty list uchar uint vertex_index\r\nend_header\r\n"
        "0 0 255 0\n1 0 255 0\n1 1 255 0\n0 1 255 0.5\n2 0.1 0.2\n4 0 1 2 3\n"));
    ASSERT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(mesh.vertices[3], Vector3(0, 1, 0.5));
    EXPECT_TRUE(mesh.normals.empty());
    const std::vector<std::array<int, 3>> expected{{0, 1, 2}, {0, 2, 3}};
    EXPECT_EQ(mesh.faces, expected);
}

TEST_F(PlyFile, BadFilesAreRefusedWithTheirReason)
{
    expectContains(errorOf("solid floor\n"), "not 'ply'");
    expectContains(errorOf("ply\nformat ascii 1.0\nelement vertex 3\n"), "end_header");
    expectContains(errorOf("ply\nformat binary_middle_endian 1.0\nend_header\n"), "binary_big_endian");
    expectContains(errorOf("ply\nformat ascii 1.0\nelement vertex 1\nproperty flaot x\nend_header\n0\n"), "flaot");
    expectContains(errorOf(triangleHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), "names vertex 3");
    expectContains(errorOf(triangleHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -2\n"), "out of range");
    expectContains(errorOf(triangleHeader + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"), "vertex 1");
    expectContains(errorOf(triangleHeader + "0 0 0\n1 blue 0\n0 1 0\n3 0 1 2\n"), "'blue'");
    expectContains(errorOf(triangleHeader + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n"), "fewer than three");
    expectContains(errorOf(triangleHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n"), "ends within element face 0");
    EXPECT_THROW(readPly(folder_/"absent.ply"), FatalInputError);
}

TEST_F(PlyFile, CountsThatTheFileHasNoRoomForAreRefusedWithTheLine)
{
    expectContains(errorOf("ply\nformat ascii 1.0\nproperty float x\nend_header\n"), "before any element");
    const std::string huge = "18446744073709551615";
    for (const std::string format : {"ascii", "binary_little_endian"})
    {
        const std::string begin = "ply\nformat " + format + " 1.0\nelement foo " + huge + "\n";
        expectContains(errorOf(begin + "end_header\n"), "without a property");
        expectContains(errorOf(begin + "property float x\nend_header\n"), huge);
        expectContains(errorOf(begin + "property list uchar int x\nend_header\n"), "room");
        expectContains(errorOf(begin + "end_header\n"), "3");
    }
    expectContains(errorOf("ply\nformat ascii 1.0\nelement vertex -3\nproperty float x\nend_header\n"), "room");
}

TEST_F(PlyFile, TruncatedBinaryFileIsRefused)
{
    writePly(folder_/"whole.ply", cubeMesh(1));
    std::ostringstream whole;
    whole << std::ifstream(folder_/"whole.ply", std::ios::binary).rdbuf();
    expectContains(errorOf(whole.str().substr(0, whole.str().size() - 3)), "ends within element face 11");
}
