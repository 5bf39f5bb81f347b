// SPDX-License-Identifier: GPL-3.0-or-later
// mpirun -np N meshSurface|shizukuToVTK|probeAngle -parallel: what one process writes, or pieces of it.

#include "DropCase.H"
#include "meshes/MeshTopology.H"
#include "support/VtkReading.H"
#include "vtk/PvtpFile.H"
#include "vtk/TimeSeries.H"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPPolyDataReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>

using namespace shizuku;
using namespace shizuku::test;
namespace fs = std::filesystem;

namespace
{

// By place, in units that single precision tells apart.
std::map<std::array<long, 3>, double> curvatures(vtkPolyData& data)
{
    constexpr double unit = 1e-8;           // m
    std::map<std::array<long, 3>, double> values;
    for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i)
    {
        const double* x = data.GetPoint(i);
        values[{std::lround(x[0]/unit), std::lround(x[1]/unit), std::lround(x[2]/unit)}] = data.GetPointData()->GetArray("curvature")->GetTuple1(i);
    }
    return values;
}

class ParallelTools : public DropCase
{
protected:
    void SetUp() override
    {
        DropCase::SetUp();
        setenv("OMP_NUM_THREADS", "1", 1);
        setenv("OMPI_MCA_mpi_yield_when_idle", "1", 1);         // ranks that wait by spinning take each other's core
    }

    Outcome callOn(int ranks, const std::string& name, const std::string& arguments = "") const
    {
        return run
        (
            "mpirun --oversubscribe --allow-run-as-root -np " + std::to_string(ranks) + " " + program(name) + " -parallel -case " + path().string()
          + " " + arguments
        );
    }

    // What the log says of times.
    static std::string timesIn(const std::string& text)
    {
        const std::size_t first = text.find("\nTime = ");
        return text.substr(first, text.find("\nWritten: ") - first);
    }

    // Of two pictures, by a level of a colour, 0 to 255.
    static double mostDifference(const fs::path& a, const fs::path& b)
    {
        vtkNew<vtkPNGReader> one, other;
        one->SetFileName(a.c_str());
        other->SetFileName(b.c_str());
        one->Update();
        other->Update();
        vtkDataArray &p = *one->GetOutput()->GetPointData()->GetScalars(), &q = *other->GetOutput()->GetPointData()->GetScalars();
        EXPECT_EQ(p.GetNumberOfTuples(), q.GetNumberOfTuples());
        double most = 0;
        for (vtkIdType i = 0; i < p.GetNumberOfTuples(); ++i)
        {
            for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(p.GetComponent(i, c) - q.GetComponent(i, c)));
        }
        return most;
    }

    static void expectTheSameFaces(const TriangleMesh& a, const TriangleMesh& b)
    {
        ASSERT_EQ(a.faces, b.faces);
        ASSERT_EQ(a.vertices.size(), b.vertices.size());
        for (std::size_t i = 0; i < a.vertices.size(); ++i) ASSERT_LT(length(a.vertices[i] - b.vertices[i]), 1e-3*spacing) << i;
    }

    static void expectTheSamePoints(vtkPolyData& a, vtkPolyData& b)
    {
        ASSERT_EQ(a.GetNumberOfPoints(), b.GetNumberOfPoints());
        for (vtkIdType i = 0; i < a.GetNumberOfPoints(); ++i)
        {
            double x[3], y[3];
            a.GetPoint(i, x);
            b.GetPoint(i, y);
            for (int c = 0; c < 3; ++c) ASSERT_EQ(x[c], y[c]) << i;
        }
    }
};

}

TEST_F(ParallelTools, ProbeAngleLeavesTheTableAndTheLogOfOneProcess)
{
    writeTime("0", {drop(60, 600, -2e-3), drop(100, 400, 2e-3)});
    writeTime("0.01", {drop(60, 400, -2e-3), drop(100, 600, 2e-3)});
    writeTime("0.02", {drop(100, 700, 2e-3)});
    writeTime("0.03", {drop(100, 500, 2e-3), drop(60, 500, -2e-3)});
    const Outcome alone = call("probeAngle");
    ASSERT_EQ(alone.status, 0) << alone.text;
    const std::string table = read("postProcessing/probeAngle/0/angle.csv");
    for (const int ranks : {2, 3})
    {
        fs::remove_all(path()/"postProcessing");
        const Outcome outcome = callOn(ranks, "probeAngle");
        ASSERT_EQ(outcome.status, 0) << outcome.text;
        EXPECT_EQ(read("postProcessing/probeAngle/0/angle.csv"), table);
        EXPECT_EQ(timesIn(outcome.text), timesIn(alone.text));
    }
    const Outcome listed = callOn(2, "probeAngle", "-listTimes");
    EXPECT_EQ(listed.status, 0) << listed.text;
    EXPECT_TRUE(holds(listed.text, {"\n0.01\n0.02\n"}));
}

// With more parts than there are layers, too. Sums over particles may come in another order where others lie elsewhere: what that moves vertices by is below 1e-3 spacings.
TEST_F(ParallelTools, MeshSurfaceLeavesTheMeshOfOneProcess)
{
    writeTime("0", {drop(60, 600, -2e-3), drop(100, 1000, 2e-3)}, false);
    writeTime("0.01", {drop(120, 1000)}, false);
    for (const std::string conserve : {"no", "yes"})
    {
        write("system/meshSurfaceDict", "formats (ply stl);\nconserveVolume " + conserve + ";\n");
        const Outcome alone = call("meshSurface", "-device cpu");
        ASSERT_EQ(alone.status, 0) << alone.text;
        std::vector<TriangleMesh> expected;
        for (const char* time : {"0", "0.01"}) expected.push_back(readPly(path()/time/"surface/liquid.ply"));
        const std::size_t size = read("0.01/surface/liquid.stl").size();
        for (const int ranks : {2, 3, 7})
        {
            for (const char* time : {"0", "0.01"}) fs::remove_all(path()/time/"surface");
            const Outcome outcome = callOn(ranks, "meshSurface", "-device cpu");
            ASSERT_EQ(outcome.status, 0) << outcome.text;
            expectTheSameFaces(readPly(path()/"0/surface/liquid.ply"), expected[0]);
            expectTheSameFaces(readPly(path()/"0.01/surface/liquid.ply"), expected[1]);
            EXPECT_EQ(read("0.01/surface/liquid.stl").size(), size);
            EXPECT_TRUE(conserve == "no" || holds(outcome.text, {"spacings to enclose N d^3"}));
        }
    }
}

// The pieces' triangles behind each other are those of one process, and close up at the seams. Pieces are not cleaned.
TEST_F(ParallelTools, MeshSurfaceWritesPiecesThatJoin)
{
    writeTime("0", {drop(100, 1000, 2e-3), drop(60, 600, -2e-3)}, false);
    write("system/meshSurfaceDict", "conserveVolume yes;\nclean no;\n");
    ASSERT_EQ(call("meshSurface", "-device cpu").status, 0);
    const TriangleMesh whole = readPly(path()/"0/surface/liquid.ply");
    fs::remove(path()/"0/surface/liquid.ply");
    for (const int ranks : {1, 2, 3})
    {
        const Outcome outcome = callOn(ranks, "meshSurface", "-device cpu -formats pvtp");
        ASSERT_EQ(outcome.status, 0) << outcome.text;
        const auto file = path()/"0/surface/liquid.pvtp";
        const auto pieces = piecesOfPvtp(file);
        EXPECT_EQ(pieces.size(), std::size_t(ranks));
        std::size_t files = 0;
        for (const auto& entry : fs::directory_iterator(path()/"0/surface/liquid")) files += entry.is_regular_file();
        EXPECT_EQ(files, pieces.size());                        // none of a run before
        EXPECT_FALSE(fs::exists(path()/"0/surface/.liquid.partial"));

        const auto read = readByVtk<vtkXMLPPolyDataReader>(file);
        EXPECT_EQ(read->GetNumberOfPolys(), vtkIdType(whole.faces.size()));
        EXPECT_TRUE(read->GetPointData()->GetNormals());
        const TriangleMesh mesh = readPieces(pieces), joined = withSharedVertices(mesh);
        EXPECT_EQ(joined.vertices.size(), whole.vertices.size());
        EXPECT_TRUE(findDefects(joined).none());
        std::set<int> used;
        for (const auto& face : mesh.faces) used.insert(face.begin(), face.end());
        EXPECT_EQ(used.size(), mesh.vertices.size());           // those of seams that no triangle of a piece needs are not there
        ASSERT_EQ(mesh.faces.size(), whole.faces.size());
        for (std::size_t f = 0; f < whole.faces.size(); ++f)
        {
            for (int k = 0; k < 3; ++k) ASSERT_LT(length(mesh.vertices[mesh.faces[f][k]] - whole.vertices[whole.faces[f][k]]), 1e-3*spacing) << f;
        }
    }
}

TEST_F(ParallelTools, ShizukuToVtkWritesPiecesOfWhatOneProcessWrites)
{
    writeTime("0", {drop(90)}, false);
    writeTime("0.01", {drop(70)});
    ASSERT_EQ(call("shizukuToVTK").status, 0);
    const auto liquid = readVtp(path()/"VTK/liquid/liquid_1.vtp");
    const auto surface = read("VTK/surface/surface_1.vtp"), solid = read("VTK/solid/solid_0.vtp");

    const Outcome outcome = callOn(3, "shizukuToVTK");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const std::vector<TimeSeriesEntry> entries = readPvd(path()/"VTK/liquid.pvd");
    ASSERT_EQ(entries.size(), 2u);
    EXPECT_EQ(entries[1].file, "liquid/liquid_1.pvtp");
    EXPECT_EQ(entries[1].time, 0.01);
    EXPECT_EQ(piecesOfPvtp(path()/"VTK/liquid/liquid_1.pvtp").size(), 3u);
    const auto inPieces = readByVtk<vtkXMLPPolyDataReader>(path()/"VTK/liquid/liquid_1.pvtp");
    expectTheSamePoints(*inPieces, *liquid);
    EXPECT_EQ(inPieces->GetNumberOfVerts(), liquid->GetNumberOfVerts());
    vtkDataArray& u = *inPieces->GetPointData()->GetArray("U");
    for (vtkIdType i = 0; i < inPieces->GetNumberOfPoints(); ++i) ASSERT_EQ(u.GetComponent(i, 0), liquid->GetPointData()->GetArray("U")->GetComponent(i, 0));
    const auto piece = readVtp(path()/"VTK/liquid/liquid_1/liquid_1_2.vtp");
    EXPECT_DOUBLE_EQ(piece->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.01);
    EXPECT_EQ(read("VTK/surface/surface_1.vtp"), surface);
    EXPECT_EQ(read("VTK/solid/solid_0.vtp"), solid);
    EXPECT_TRUE(fs::exists(path()/"VTK/liquid.pvtp.series"));
    EXPECT_FALSE(fs::exists(path()/"VTK/liquid.vtp.series") || fs::exists(path()/"VTK/liquid/liquid_1.vtp"));

    ASSERT_EQ(call("shizukuToVTK").status, 0);
    EXPECT_TRUE(fs::exists(path()/"VTK/liquid.vtp.series"));
    EXPECT_FALSE(fs::exists(path()/"VTK/liquid.pvtp.series") || fs::exists(path()/"VTK/liquid/liquid_1.pvtp") || fs::exists(path()/"VTK/liquid/liquid_1"));
}

TEST_F(ParallelTools, ASurfaceInPiecesIsConvertedAndDrawn)
{
    writeTime("0.01", {drop(90)}, false);
    write("system/meshSurfaceDict", "clean no;\n");
    ASSERT_EQ(call("meshSurface", "-device cpu -time 0.01 -formats '(ply vtp)'").status, 0);
    const std::string options = "-time 0.01 -look plain -size 200x120 -output ";
    ASSERT_EQ(call("renderCase", options + (path()/"mesh.png").string()).status, 0);
    const vtkIdType triangles = readVtp(path()/"0.01/surface/liquid.vtp")->GetNumberOfPolys();
    ASSERT_EQ(call("shizukuToVTK").status, 0);
    const std::map<std::array<long, 3>, double> whole = curvatures(*readVtp(path()/"VTK"/readPvd(path()/"VTK/surface.pvd").at(0).file));
    fs::remove_all(path()/"0.01/surface");

    ASSERT_EQ(callOn(2, "meshSurface", "-device cpu -time 0.01 -formats pvtp").status, 0);
    const Outcome drawn = call("renderCase", options + (path()/"pieces.png").string());
    ASSERT_EQ(drawn.status, 0) << drawn.text;
    // In single precision, and with vertices in another order; a seam that shows would differ by more.
    EXPECT_LE(mostDifference(path()/"mesh.png", path()/"pieces.png"), 8);
    for (const int ranks : {1, 3})
    {
        ASSERT_EQ((ranks == 1 ? call("shizukuToVTK") : callOn(ranks, "shizukuToVTK")).status, 0);
        const std::vector<TimeSeriesEntry> entries = readPvd(path()/"VTK/surface.pvd");
        ASSERT_EQ(entries.size(), 1u);
        const auto file = path()/"VTK"/entries[0].file;
        const auto data = ranks == 1 ? readVtp(file) : readByVtk<vtkXMLPPolyDataReader>(file);
        EXPECT_EQ(data->GetNumberOfPolys(), triangles);
        for (const char* name : {"normals", "curvature", "theta", "U", "body"}) ASSERT_TRUE(data->GetPointData()->HasArray(name)) << name;
        for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
        {
            EXPECT_EQ(data->GetPointData()->GetArray("body")->GetTuple1(i), 1);
            EXPECT_NEAR(data->GetPointData()->GetArray("U")->GetComponent(i, 0), 0.01*data->GetPoint(i)[2]/spacing, 0.0125);
        }
        // Those of the mesh in one piece; at the seam of two pieces, a hundredth of the vertices or two, means of their neighbours.
        const std::map<std::array<long, 3>, double> pieces = curvatures(*data);
        std::size_t same = 0;
        for (const auto& [place, value] : pieces)
        {
            const auto found = whole.find(place);
            same += found != whole.end() && std::abs(found->second - value) < 1e-2/spacing;
        }
        EXPECT_GT(double(same), 0.95*double(whole.size()));
        EXPECT_NEAR(double(pieces.size()), double(whole.size()), 0.01*double(whole.size()));
    }
}

// Only one part reads what is wrong: all say so once, and what was there stays.
TEST_F(ParallelTools, WhatOnePartCannotReadEndsAllAndLeavesTheFiles)
{
    writeTime("0.01", {drop(90)});
    ASSERT_EQ(callOn(2, "shizukuToVTK").status, 0);
    const std::string pieces = read("VTK/liquid/liquid_0.pvtp"), piece = read("VTK/liquid/liquid_0/liquid_0_1.vtp"), mesh = read("0.01/surface/liquid.ply");
    const FieldData positions = readField(path()/"0.01/liquid/positions");
    std::string bytes;
    for (std::size_t k = 0; k < positions.values.size(); ++k)
    {
        const double value = k + 1 == positions.values.size() ? std::numeric_limits<double>::quiet_NaN() : positions.values[k];
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    write
    (
        "0.01/liquid/positions",
        "FoamFile { version 2.0; format binary; arch \"LSB;label=32;scalar=64\"; class vectorField; object positions; }\n"
        "dimensions [0 1 0 0 0 0 0];\ninternalField nonuniform List<vector> " + std::to_string(positions.elements()) + "(" + bytes + ");\n"
    );
    for (const char* tool : {"shizukuToVTK", "meshSurface"})
    {
        const Outcome outcome = callOn(2, tool, std::string(tool) == "meshSurface" ? "-device cpu" : "");
        EXPECT_EQ(outcome.status, 1) << outcome.text;
        EXPECT_TRUE(holds(outcome.text, {"Part 1 of 2", "of element " + std::to_string(positions.elements() - 1) + " is NaN"}));
        const std::size_t first = outcome.text.find("--> FATAL");
        EXPECT_EQ(outcome.text.find("--> FATAL", first + 1), std::string::npos) << outcome.text;
    }
    EXPECT_EQ(read("VTK/liquid/liquid_0.pvtp"), pieces);
    EXPECT_EQ(read("VTK/liquid/liquid_0/liquid_0_1.vtp"), piece);
    EXPECT_EQ(read("0.01/surface/liquid.ply"), mesh);
}
