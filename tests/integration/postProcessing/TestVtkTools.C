// SPDX-License-Identifier: GPL-3.0-or-later
// shizukuToVTK on stored drops.

#include "DropCase.H"

#include "core/dictionary/CalcExpression.H"
#include "support/VtkReading.H"
#include "vtk/TimeSeries.H"

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>

#include <cmath>
#include <map>
#include <set>

using namespace shizuku;
using namespace shizuku::test;
namespace fs = std::filesystem;

TEST_F(DropCase, ShizukuToVtkWritesAnimations)
{
    writeTime("0", {drop(90)}, false);
    writeTime("0.01", {drop(70)});
    writeTime("0.02", {drop(60)});
    const Outcome outcome = call("shizukuToVTK");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const std::map<std::string, std::vector<std::string>> expected
    {
        {"liquid", {"liquid/liquid_0.vtp", "liquid/liquid_1.vtp", "liquid/liquid_2.vtp"}},
        {"surface", {"surface/surface_1.vtp", "surface/surface_2.vtp"}},
        {"solid", {"solid/solid_0.vtp", "solid/solid_0.vtp", "solid/solid_0.vtp"}}
    };
    for (const auto& [name, files] : expected)
    {
        boost::property_tree::ptree json;
        boost::property_tree::read_json((path()/("VTK/" + name + ".vtp.series")).string(), json);
        std::vector<std::string> found;
        for (const auto& [key, entry] : json.get_child("files"))
        {
            found.push_back(entry.get<std::string>("name"));
            EXPECT_TRUE(fs::exists(path()/"VTK"/found.back()));
        }
        EXPECT_EQ(found, files);
        EXPECT_TRUE(fs::exists(path()/("VTK/" + name + ".pvd")));
    }
    EXPECT_TRUE(holds
    (
        read("VTK/liquid/liquid_2.vtp"),
        {"\"U\"", "\"TimeValue\"", "\"particleSpacing\"", "format=\"binary\"", "vtkZLibDataCompressor"}
    ));
    EXPECT_TRUE(holds(read("VTK/solid/solid_0.vtp"), {"\"theta\"", "\"patch\"", "\"normals\""}));
}

// Each file of each animation, opened by VTK's reader: no warning, and the time that the animation gives it (what lies still
// may be older).
TEST_F(DropCase, VtkReadsEveryFileWithItsTime)
{
    writeTime("0", {drop(90)});
    writeTime("0.01", {drop(70)});
    writeTime("0.025", {drop(60)});
    for (const std::string format : {"ascii", "binary", "appended"})
    {
        if (format == "appended" && !readsAppended()) continue;
        ASSERT_EQ(call("shizukuToVTK", "-format " + format).status, 0);
        for (const std::string name : {"liquid", "surface", "solid"})
        {
            boost::property_tree::ptree pvd;
            boost::property_tree::read_xml((path()/("VTK/" + name + ".pvd")).string(), pvd);
            std::vector<double> times;
            for (const auto& [element, set] : pvd.get_child("VTKFile.Collection"))
            {
                times.push_back(set.get<double>("<xmlattr>.timestep"));
                const auto data = readVtp(path()/"VTK"/set.get<std::string>("<xmlattr>.file"));
                EXPECT_GT(data->GetNumberOfPoints(), 0);
                const double time = data->GetFieldData()->GetArray("TimeValue")->GetTuple1(0);
                EXPECT_DOUBLE_EQ(time, name == "solid" ? 0 : times.back());
                EXPECT_DOUBLE_EQ(data->GetFieldData()->GetArray("particleSpacing")->GetTuple1(0), spacing);
                EXPECT_EQ(data->GetPointData()->HasArray("U"), name != "solid");
                EXPECT_EQ(data->GetPointData()->HasArray("theta"), name != "liquid");
                EXPECT_EQ(data->GetPointData()->HasArray("curvature"), name == "surface");
            }
            EXPECT_EQ(times, (std::vector<double>{0, 0.01, 0.025}));
        }
    }
}

// Two drops, the larger one on the left. How numbers go on is TestDrops'.
TEST_F(DropCase, ShizukuToVtkNumbersTheDrops)
{
    writeTime("0", {drop(90, 1000), drop(90, 500, 1.5e-3)});
    writeTime("0.01", {drop(90, 1000), drop(90, 500, 1.5e-3)});
    const auto bodies = [&](const std::string& file)
    {
        const auto data = readVtp(path()/"VTK/surface"/file);
        std::map<int, std::set<bool>> sides;
        for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) sides[int(data->GetPointData()->GetArray("body")->GetTuple1(i))].insert(data->GetPoint(i)[0] > 0);
        return sides;
    };
    ASSERT_EQ(call("shizukuToVTK").status, 0);
    const std::map<int, std::set<bool>> expected{{1, {false}}, {2, {true}}};
    EXPECT_EQ(bodies("surface_0.vtp"), expected);
    EXPECT_EQ(bodies("surface_1.vtp"), expected);
}

// U of the particles grows linearly with height, from 0.005 m/s half a spacing above the floor, by 0.01 m/s a spacing. So it does on the surface, but for what lies beyond
// the particles: a mean of theirs, within the weight's width.
TEST_F(DropCase, ShizukuToVtkPutsTheFieldsOnTheSurface)
{
    writeTime("0", {drop(90)});
    ASSERT_EQ(call("shizukuToVTK").status, 0);
    const auto data = readVtp(path()/"VTK/surface/surface_0.vtp");
    vtkDataArray& velocity = *data->GetPointData()->GetArray("U");
    ASSERT_EQ(velocity.GetNumberOfTuples(), data->GetNumberOfPoints());
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    {
        EXPECT_NEAR(velocity.GetComponent(i, 0), 0.01*data->GetPoint(i)[2]/spacing, 0.0125);
        EXPECT_EQ(velocity.GetComponent(i, 1), 0);
    }
    // On the half of the floor that has 60 degrees.
    vtkDataArray& theta = *data->GetPointData()->GetArray("theta");
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    {
        const double height = data->GetPoint(i)[2]/spacing;
        if (height > 0.7 && height < 0.8) continue;
        if (height < 0.75)
        {
            EXPECT_EQ(theta.GetTuple1(i), 60) << height;
        }
        else EXPECT_TRUE(std::isnan(theta.GetTuple1(i))) << height;
    }
}

// Times that are not selected stay in the animations; what is no time of the case any more goes.
TEST_F(DropCase, ShizukuToVtkKeepsWhatIsStillValid)
{
    for (const char* time : {"0", "0.1", "0.2", "0.3"}) writeTime(time, {drop(90)});
    ASSERT_EQ(call("shizukuToVTK").status, 0);
    const auto animation = [&](const std::string& name)
    {
        std::string text;
        for (const TimeSeriesEntry& entry : readPvd(path()/("VTK/" + name + ".pvd")))
        {
            EXPECT_TRUE(fs::exists(path()/"VTK"/entry.file)) << entry.file;
            text += fs::path(entry.file).stem().string() + "@" + numberText(entry.time) + " ";
        }
        return text;
    };
    const std::string liquid = "liquid_0@0 liquid_1@0.1 liquid_2@0.2 liquid_3@0.3 ";
    EXPECT_EQ(animation("liquid"), liquid);
    ASSERT_EQ(call("shizukuToVTK", "-time 0.1").status, 0);
    EXPECT_EQ(animation("liquid"), liquid);
    EXPECT_EQ(animation("solid"), "solid_0@0 solid_1@0.1 solid_0@0.2 solid_0@0.3 ");

    // Of the last time nothing is left, nor is there a file of it.
    write("VTK/surface/surface_30.vtp", "somebody's own");
    fs::remove_all(path()/"0.3");
    ASSERT_EQ(call("shizukuToVTK", "-time 0.2").status, 0);
    EXPECT_EQ(animation("surface"), "surface_0@0 surface_1@0.1 surface_2@0.2 ");
    EXPECT_FALSE(fs::exists(path()/"VTK/surface/surface_3.vtp"));
    EXPECT_TRUE(fs::exists(path()/"VTK/surface/surface_30.vtp"));

    // The file that 0.1 had is that of 0.2 now, which is the second time of the case.
    fs::remove_all(path()/"0.1");
    ASSERT_EQ(call("shizukuToVTK", "-time 0.2").status, 0);
    EXPECT_EQ(animation("surface"), "surface_0@0 surface_1@0.2 ");
    EXPECT_FALSE(fs::exists(path()/"VTK/surface/surface_2.vtp"));
    fs::remove_all(path()/"0.2/surface");
    fs::remove_all(path()/"0/surface");
    ASSERT_EQ(call("shizukuToVTK").status, 0);
    EXPECT_FALSE(fs::exists(path()/"VTK/surface.pvd"));
    EXPECT_FALSE(fs::exists(path()/"VTK/surface/surface_0.vtp"));
}

TEST_F(DropCase, ShizukuToVtkTakesFieldsTimesAndFormats)
{
    writeTime("0", {drop(90)}, false);
    writeTime("0.01", {drop(70)}, false);
    const std::size_t particles = readField(path()/"0.01/liquid/U").elements();
    const FieldData id{"id", FieldType::label, dimensions::none, false, std::vector<double>(particles, 3)};
    writeField(path()/"0.01/liquid/id", id, {});

    ASSERT_EQ(call("shizukuToVTK", "-latestTime -fields '(id)' -format ascii").status, 0);
    EXPECT_FALSE(fs::exists(path()/"VTK/liquid/liquid_0.vtp"));
    const std::string text = read("VTK/liquid/liquid_1.vtp");       // the same number with all times and without
    EXPECT_TRUE(holds(text, {"\"id\"", "format=\"ascii\""}));
    EXPECT_EQ(text.find("\"U\""), std::string::npos);

    for (const std::string format : {"binary", "appended"})
    {
        ASSERT_EQ(call("shizukuToVTK", "-format " + format).status, 0);
        EXPECT_TRUE(holds(read("VTK/liquid/liquid_1.vtp"), {"\"U\"", "format=\"" + format + "\""}));
    }

    const Outcome unknown = call("shizukuToVTK", "-fields '(vorticity)'");
    EXPECT_NE(unknown.status, 0);
    EXPECT_TRUE(holds(unknown.text, {"vorticity", "U", "id"}));
    EXPECT_NE(call("shizukuToVTK", "-format xml").status, 0);

}

TEST_F(DropCase, ShizukuToVtkRefusesBadInput)
{
    const auto expectRefusal = [&](const std::vector<std::string>& parts)
    {
        const Outcome outcome = call("shizukuToVTK");
        EXPECT_NE(outcome.status, 0);
        EXPECT_TRUE(holds(outcome.text, parts)) << outcome.text;
        EXPECT_FALSE(fs::exists(path()/"VTK/liquid.pvd"));
    };
    fs::remove_all(path()/"constant/solid");
    expectRefusal({"nothing to convert"});

    writeTime("0.01", {drop(70)});
    write("0.01/liquid/U", "nonsense");
    expectRefusal({"0.01/liquid/U"});
    fs::remove(path()/"0.01/liquid/U");
    write("0.01/surface/liquid.ply", "ply\nformat ascii 1.0\n");
    expectRefusal({"0.01/surface/liquid.ply"});
}
