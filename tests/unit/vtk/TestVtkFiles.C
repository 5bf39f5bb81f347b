// SPDX-License-Identifier: GPL-3.0-or-later
// Everything is read back by other programs' readers: VTK's for .vtp, Boost's for the XML and JSON of the animations.
// Appended .vtp files are decoded here (AppendedVtp.H), because not every VTK reads them.

#include "AppendedVtp.H"
#include "meshes/surfaceFormats/SurfaceFormat.H"
#include "support/CapMesh.H"
#include "support/ScratchFolder.H"
#include "support/VtkReading.H"
#include "vtk/VtkSeries.H"
#include "vtk/VtpFile.H"

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkSTLReader.h>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

VtpContent particles(int n = 1000)
{
    VtpContent content;
    for (int i = 0; i < n; ++i) content.points.push_back({1e-3*i, 2e-3/(i + 1), -1e-4*i});
    FieldData u{"U", FieldType::vector, dimensions::velocity, false, {}};
    FieldData id{"id", FieldType::label, dimensions::none, false, {}};
    for (int i = 0; i < n; ++i)
    {
        u.values.insert(u.values.end(), {0.1*i, -0.2*i, 1.0/3});
        id.values.push_back(16777217 + i);      // beyond what a float keeps
    }
    content.pointFields = {u, id, {"density", FieldType::scalar, dimensions::density, true, {998}}};
    content.values = {{"TimeValue", 0.1 + 0.2}, {"particleSpacing", 1.28e-4}};
    return content;
}

}

class VtpEncoding : public testing::TestWithParam<std::string>
{
protected:
    void SetUp() override
    {
        if (GetParam() == "appended" && !readsAppended()) GTEST_SKIP() << "this VTK cannot read appended data";
    }
};

TEST_P(VtpEncoding, ParticlesComeBack)
{
    const ScratchFolder folder;
    const VtpContent content = particles();
    writeVtp(folder.path()/"p.vtp", content, vtkEncodingFrom(GetParam()));
    const auto data = readVtp(folder.path()/"p.vtp");

    ASSERT_EQ(data->GetNumberOfPoints(), 1000);
    EXPECT_EQ(data->GetNumberOfVerts(), 1000);
    vtkDataArray* const u = data->GetPointData()->GetArray("U");
    vtkDataArray* const id = data->GetPointData()->GetArray("id");
    vtkDataArray* const density = data->GetPointData()->GetArray("density");
    ASSERT_TRUE(u && id && density);
    ASSERT_EQ(u->GetNumberOfComponents(), 3);
    EXPECT_EQ(u->GetDataType(), VTK_FLOAT);
    EXPECT_EQ(data->GetPoints()->GetDataType(), VTK_FLOAT);
    for (int i = 0; i < 1000; ++i)
    {
        // VTK's text has eleven digits and the others are bytes: floats come back exactly.
        for (int c = 0; c < 3; ++c)
        {
            EXPECT_EQ(data->GetPoint(i)[c], double(float(content.points[i][c])));
            EXPECT_EQ(u->GetComponent(i, c), double(float(content.pointFields[0](i, c))));
        }
        EXPECT_EQ(id->GetTuple1(i), 16777217 + i);
        EXPECT_EQ(density->GetTuple1(i), 998);
    }
    EXPECT_EQ(std::string(u->GetInformation()->Get(vtkDataArray::UNITS_LABEL())), "m s^-1");
    EXPECT_EQ(std::string(density->GetInformation()->Get(vtkDataArray::UNITS_LABEL())), "kg m^-3");
    EXPECT_FALSE(id->GetInformation()->Has(vtkDataArray::UNITS_LABEL()));
    // Field data are doubles; VTK's text keeps eleven digits of them.
    EXPECT_NEAR(data->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.3, 1e-11);
    EXPECT_NEAR(data->GetFieldData()->GetArray("particleSpacing")->GetTuple1(0), 1.28e-4, 1e-15);
}

TEST_P(VtpEncoding, MeshesComeBackWithTheirNormals)
{
    const ScratchFolder folder;
    TriangleMesh mesh = icosphereMesh(2);
    mesh.normals = mesh.vertices;
    writeVtp(folder.path()/"m.vtp", vtpOf(mesh), vtkEncodingFrom(GetParam()));
    const auto data = readVtp(folder.path()/"m.vtp");

    ASSERT_EQ(data->GetNumberOfPolys(), vtkIdType(mesh.faces.size()));
    EXPECT_EQ(data->GetNumberOfVerts(), 0);
    vtkNew<vtkIdList> corners;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    {
        data->GetCellPoints(vtkIdType(f), corners);
        ASSERT_EQ(corners->GetNumberOfIds(), 3);
        for (int k = 0; k < 3; ++k) EXPECT_EQ(corners->GetId(k), mesh.faces[f][k]);
    }
    vtkDataArray* const normals = data->GetPointData()->GetNormals();
    ASSERT_TRUE(normals);
    EXPECT_EQ(normals->GetComponent(7, 1), double(float(mesh.normals[7].y)));
}

TEST_P(VtpEncoding, NoParticlesAreWrittenToo)
{
    const ScratchFolder folder;
    writeVtp(folder.path()/"none.vtp", {}, vtkEncodingFrom(GetParam()));
    EXPECT_EQ(readVtp(folder.path()/"none.vtp")->GetNumberOfPoints(), 0);
}

INSTANTIATE_TEST_SUITE_P(Encodings, VtpEncoding, testing::Values("ascii", "binary", "appended"),
    [](const auto& info) { return info.param; });

TEST(AppendedVtp, HoldsTheParticles)
{
    const ScratchFolder folder;
    // Two blocks and a part of a third for the points: VTK's blocks are 32768 bytes.
    const int n = 6000;
    const VtpContent content = particles(n);
    writeVtp(folder.path()/"p.vtp", content, VtkEncoding::appended);
    EXPECT_TRUE(holds(folder.read("p.vtp"), {"NumberOfPoints=\"6000\"", "NumberOfVerts=\"6000\""}));
    const auto arrays = readAppendedVtp(folder.read("p.vtp"));

    const AppendedArray& points = arrays.at("Points/Points");
    const AppendedArray& u = arrays.at("PointData/U");
    const AppendedArray& id = arrays.at("PointData/id");
    const AppendedArray& corner = arrays.at("Verts/connectivity");
    const AppendedArray& end = arrays.at("Verts/offsets");
    EXPECT_EQ(points.type, "Float32");
    EXPECT_EQ(u.type, "Float32");
    EXPECT_EQ(id.type, "Int32");
    EXPECT_EQ(points.components, 3);
    EXPECT_EQ(u.components, 3);
    ASSERT_EQ(points.values.size(), 3u*n);
    ASSERT_EQ(u.values.size(), 3u*n);
    ASSERT_EQ(id.values.size(), 1u*n);
    ASSERT_EQ(corner.values.size(), 1u*n);
    ASSERT_EQ(end.values.size(), 1u*n);
    for (int i = 0; i < n; ++i)
    {
        for (int c = 0; c < 3; ++c)     // bytes: floats come back exactly
        {
            EXPECT_EQ(points.values[3*i + c], double(float(content.points[i][c])));
            EXPECT_EQ(u.values[3*i + c], double(float(content.pointFields[0](i, c))));
        }
        EXPECT_EQ(id.values[i], 16777217 + i);
        EXPECT_EQ(corner.values[i], i);
        EXPECT_EQ(end.values[i], i + 1);
    }
    EXPECT_EQ(arrays.at("PointData/density").values, std::vector<double>(n, 998));
    EXPECT_EQ(arrays.at("FieldData/TimeValue").values, std::vector<double>{0.1 + 0.2});
    EXPECT_EQ(arrays.at("FieldData/particleSpacing").values, std::vector<double>{1.28e-4});
}

TEST(AppendedVtp, HoldsAMeshWithItsNormals)
{
    const ScratchFolder folder;
    TriangleMesh mesh = icosphereMesh(2);
    mesh.normals = mesh.vertices;
    writeVtp(folder.path()/"m.vtp", vtpOf(mesh), VtkEncoding::appended);
    const auto arrays = readAppendedVtp(folder.read("m.vtp"));

    const std::vector<double>& corners = arrays.at("Polys/connectivity").values;
    ASSERT_EQ(corners.size(), 3*mesh.faces.size());
    for (std::size_t i = 0; i < corners.size(); ++i) EXPECT_EQ(corners[i], mesh.faces[i/3][i%3]);
    EXPECT_TRUE(arrays.at("Verts/connectivity").values.empty());
    EXPECT_EQ(arrays.at("PointData/normals").values, arrays.at("Points/Points").values);
    ASSERT_EQ(arrays.at("Points/Points").values.size(), 3*mesh.vertices.size());
    EXPECT_EQ(arrays.at("Points/Points").values[3*7 + 1], double(float(mesh.vertices[7].y)));
}

TEST(AppendedVtp, HoldsNoParticles)
{
    const ScratchFolder folder;
    writeVtp(folder.path()/"none.vtp", {}, VtkEncoding::appended);
    EXPECT_TRUE(readAppendedVtp(folder.read("none.vtp")).at("Points/Points").values.empty());
}

// meshSurface's formats.
TEST(SurfaceFormats, AreWhatVtkReads)
{
    const ScratchFolder folder;
    TriangleMesh mesh = icosphereMesh(1);
    mesh.normals = mesh.vertices;
    const std::map<std::string, vtkSmartPointer<vtkPolyData> (*)(const std::filesystem::path&)> readers
    {
        {"vtp", readVtp}, {"stl", readByVtk<vtkSTLReader>}, {"obj", readByVtk<vtkOBJReader>}, {"ply", readByVtk<vtkPLYReader>}
    };
    for (const auto& [word, read] : readers)
    {
        const auto file = folder.path()/("liquid." + word);
        SurfaceFormatTable::New("surface format", word, {})->write(file, mesh);
        const auto data = read(file);
        // VTK joins the corners of STL facets where they coincide.
        EXPECT_EQ(data->GetNumberOfPolys(), vtkIdType(mesh.faces.size())) << word;
        EXPECT_EQ(data->GetNumberOfPoints(), vtkIdType(mesh.vertices.size())) << word;
        EXPECT_EQ(data->GetPointData()->GetNormals() != nullptr, word != "stl") << word;
    }
}

TEST(VtpFile, BinaryAndAppendedFilesAreCompressed)
{
    const ScratchFolder folder;
    writeVtp(folder.path()/"a.vtp", particles(), VtkEncoding::ascii);
    const auto asciiSize = std::filesystem::file_size(folder.path()/"a.vtp");
    for (const VtkEncoding encoding : {VtkEncoding::binary, VtkEncoding::appended})
    {
        writeVtp(folder.path()/"c.vtp", particles(), encoding);
        EXPECT_TRUE(holds(folder.read("c.vtp"), {"vtkZLibDataCompressor"}));
        EXPECT_LT(std::filesystem::file_size(folder.path()/"c.vtp"), asciiSize/2);
    }
}

TEST(VtpFile, RefusesAFieldOfAnotherLengthAndLeavesNothing)
{
    const ScratchFolder folder;
    VtpContent content = particles();
    content.pointFields[1].values.pop_back();
    const std::string message = messageOf<FatalError>
    (
        [&] { writeVtp(folder.path()/"p.vtp", content, VtkEncoding::binary); }
    );
    EXPECT_TRUE(holds(message, {"id", "999", "1000"}));
    EXPECT_TRUE(folder.list().empty());
}

TEST(VtpFile, UnknownEncodingIsRefusedWithTheChoices)
{
    const std::string message = messageOf([] { vtkEncodingFrom("apended"); });
    EXPECT_TRUE(holds(message, {"apended", "appended", "ascii", "binary"}));
}

TEST(VtkSeries, AnimationNamesEveryFileWithItsTime)
{
    const ScratchFolder folder;
    VtkSeries series(folder.path(), "solid", VtkEncoding::binary);
    series.add(0, 0, particles(), 1.28e-4);
    series.repeat(1e-3);
    series.add(0.1 + 0.2, 2, particles(), 1.28e-4);
    series.finish();

    const std::vector<double> times{0, 1e-3, 0.3};
    const std::vector<std::string> files{"solid/solid_0.vtp", "solid/solid_0.vtp", "solid/solid_2.vtp"};

    boost::property_tree::ptree pvd;
    boost::property_tree::read_xml((folder.path()/"VTK/solid.pvd").string(), pvd);
    EXPECT_EQ(pvd.get<std::string>("VTKFile.<xmlattr>.type"), "Collection");
    std::size_t n = 0;
    for (const auto& [name, set] : pvd.get_child("VTKFile.Collection"))
    {
        ASSERT_LT(n, times.size());
        EXPECT_EQ(set.get<double>("<xmlattr>.timestep"), times[n]);     // fifteen digits: 0.3 again
        EXPECT_EQ(set.get<std::string>("<xmlattr>.file"), files[n]);
        EXPECT_TRUE(std::filesystem::exists(folder.path()/"VTK"/files[n]));
        ++n;
    }
    EXPECT_EQ(n, times.size());

    boost::property_tree::ptree json;
    boost::property_tree::read_json((folder.path()/"VTK/solid.vtp.series").string(), json);
    EXPECT_EQ(json.get<std::string>("file-series-version"), "1.0");
    n = 0;
    for (const auto& [name, entry] : json.get_child("files"))
    {
        ASSERT_LT(n, times.size());
        EXPECT_EQ(entry.get<double>("time"), times[n]);
        EXPECT_EQ(entry.get<std::string>("name"), files[n]);
        ++n;
    }
    EXPECT_EQ(n, times.size());

    const auto last = readVtp(folder.path()/"VTK/solid/solid_2.vtp");
    EXPECT_NEAR(last->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.3, 1e-15);
    EXPECT_EQ(last->GetFieldData()->GetArray("particleSpacing")->GetTuple1(0), 1.28e-4);
}

TEST(VtkSeries, WithoutAFileWritesNothing)
{
    const ScratchFolder folder;
    VtkSeries(folder.path(), "liquid", VtkEncoding::ascii).finish();
    EXPECT_TRUE(folder.list().empty());
}
