// SPDX-License-Identifier: GPL-3.0-or-later
// meshSurface on blocks of liquid, and how it refuses bad input.

#include "SolverCase.H"

#include "meshes/PlyFile.H"

namespace shizuku::test
{

namespace
{

class MeshSurface : public SolverCase
{
protected:
    MeshSurface()
    {
        for (const std::string time : {"0.001", "0.002"}) std::filesystem::copy(path()/"0", path()/time, recursive);
    }

    void expectMeshes(const std::string& arguments, const std::vector<std::string>& times) const
    {
        const Outcome outcome = call("meshSurface", arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        for (const std::string time : {"0", "0.001", "0.002"})
        {
            const bool wanted = std::find(times.begin(), times.end(), time) != times.end();
            EXPECT_EQ(exists(time + "/surface/liquid.ply"), wanted) << time;
            remove(time + "/surface");
        }
    }

    void expectMeshRefusal(const std::vector<std::string>& parts, const std::string& arguments = "") const
    {
        expectRefusal(parts, arguments, "", "meshSurface");
    }

    static constexpr auto recursive = std::filesystem::copy_options::recursive;
};

INSTANTIATE_TEST_SUITE_P(Devices, MeshSurface, testing::ValuesIn(devices()));

}

TEST_P(MeshSurface, EnclosesTheLiquid)
{
    const Outcome outcome = call("meshSurface", "-time 0");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Device : " + device(), "Time = 0 s", "triangles", "volume", "ExecutionTime", "End"}));
    const TriangleMesh mesh = readPly(path()/"0/surface/liquid.ply");
    // The block's eight corners and twelve edges are rounded off at about half a spacing.
    const double block = particles*spacing*spacing*spacing;
    EXPECT_NEAR(mesh.volume(), block, 0.1*block);
    EXPECT_EQ(mesh.normals.size(), mesh.vertices.size());
    // The faces of the block are half a spacing outside of its outer particles.
    for (const Vector3& v : mesh.vertices)
    {
        ASSERT_NEAR(v.x, 0, 4*spacing);
        ASSERT_NEAR(v.y, 0, 4*spacing);
        ASSERT_NEAR(v.z, 3*spacing, 3.5*spacing);
    }
}

TEST_P(MeshSurface, SaysWhatAMeshTakes)
{
    const Outcome outcome = call("meshSurface", "-time 0 -repeats 3");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const std::string count = std::to_string(particles);
    EXPECT_TRUE(holds(outcome.text, {"Repeats : median", "of 3 meshes of " + count + " particles", "ms a mesh", "PlaceVertices", "all"}));
    for (const std::string number : {"-1", "2.5"}) expectMeshRefusal({"-repeats", number, "0 to 1000000"}, "-time 0 -repeats " + number);
}

TEST_P(MeshSurface, MeshesTheTimesAskedFor)
{
    expectMeshes("", {"0", "0.001", "0.002"});
    expectMeshes("-latestTime", {"0.002"});
    expectMeshes("-time 0.001:", {"0.001", "0.002"});
    expectMeshRefusal({"-time 7", "selects no time", "0.001", "0.002"}, "-time 7");
    expectMeshRefusal({"-latestTime and -time"}, "-time 0 -latestTime");
}

TEST_P(MeshSurface, WritesTheFormatsAskedFor)
{
    ASSERT_EQ(call("meshSurface", "-time 0 -formats '(stl obj)'").status, 0);
    EXPECT_TRUE(exists("0/surface/liquid.stl") && exists("0/surface/liquid.obj"));
    EXPECT_FALSE(exists("0/surface/liquid.ply"));
    expectMeshRefusal({"Option -time has the value 'abc'", "a range A:B"}, "-time abc");
    write("system/meshSurfaceDict", "formats (ply obj);");
    const Outcome outcome = call("meshSurface", "-time 0.001");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"against the particles' N d^3", "Memory : ", "bytes a particle"}));
    EXPECT_TRUE(exists("0.001/surface/liquid.ply") && exists("0.001/surface/liquid.obj"));
    EXPECT_FALSE(exists("0.001/surface/liquid.stl"));
}

TEST_P(MeshSurface, ConservesTheVolumeWhereAsked)
{
    write("system/meshSurfaceDict", "conserveVolume yes;");
    const Outcome outcome = call("meshSurface", "-time 0");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"against the particles' N d^3), moved by", "spacings to enclose N d^3"}));
    // Newton's tolerance, and the file's single precision of some thousand vertices.
    const double block = particles*spacing*spacing*spacing;
    EXPECT_NEAR(readPly(path()/"0/surface/liquid.ply").volume(), block, 2e-4*block);

    // A particle alone has no surface that could be moved.
    write("0/liquid/positions", "FoamFile\n{\n    format ascii;\n    class vectorField;\n}\ndimensions [0 1 0 0 0 0 0];\n"
        "internalField nonuniform List<vector> 1((0 0 0));\n");
    EXPECT_TRUE(holds(call("meshSurface", "-time 0").text, {"left there: N d^3 is more than half a spacing away"}));
}

TEST_P(MeshSurface, BadInputIsRefused)
{
    expectMeshRefusal({"Unknown surface format", "'plyy'", "Did you mean 'ply'", "obj", "stl"}, "-formats '(stl plyy)'");
    expectMeshRefusal({"No format is chosen", "ply", "stl"}, "-formats '()'");
    expectMeshRefusal({"Option -time has the value 'abc'", "a range A:B"}, "-time abc");
    write("system/meshSurfaceDict", "formats (ply\nst);");
    expectMeshRefusal({"'st'", "system/meshSurfaceDict at line 1", "stl"});
    write("system/meshSurfaceDict", "\ncell 0;");
    expectMeshRefusal({"cell", "system/meshSurfaceDict at line 2", "0.1 to 2"});
    write("system/meshSurfaceDict", "cel 0.5;");
    expectMeshRefusal({"'cel'", "line 1", "Did you mean 'cell'"});
    write("system/meshSurfaceDict", "support two;");
    expectMeshRefusal({"'support'", "the word 'two'", "line 1", "a number"});
    remove("system/meshSurfaceDict");

    write("system/solution", "spacing -1;");
    expectMeshRefusal({"'spacing' is -1", "system/solution at line 1"});
    write("system/solution", "spacing 1e-3;");

    const std::string positions = read("0/liquid/positions");
    write("0/liquid/positions", positions.substr(0, positions.size()/2));
    expectMeshRefusal({"0/liquid/positions"}, "-time 0");
    remove("0/liquid/positions");
    expectMeshRefusal({"missing", "0/liquid/positions"}, "-time 0");
    remove("0/liquid");
    expectMeshRefusal({"None of the selected times holds liquid", "<time>/liquid/positions"}, "-time 0");
}

TEST_P(MeshSurface, AFullDiskLeavesNothing)
{
    const std::string full = "ulimit -f 16; trap '' XFSZ;";
    expectRefusal({"Cannot write", "liquid.ply", "File too large"}, "-time 0", full, "meshSurface");
}

}
