// SPDX-License-Identifier: GPL-3.0-or-later
#include "DropCase.H"
#include "caseFiles/LiquidFiles.H"
#include "support/DropMeshes.H"

#include <numbers>

using namespace shizuku;
using namespace shizuku::test;
namespace fs = std::filesystem;

TEST_F(DropCase, ProbeAngleMeasuresEveryTime)
{
    writeTime("0", {drop(90)});
    writeTime("0.01", {drop(70)});
    writeTime("0.02", {drop(60)});
    const Outcome outcome = call("probeAngle");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"prescribed angle    60.00 deg", "measured angle", "volume drift"}));

    const auto rows = table("postProcessing/probeAngle/0/angle.csv");
    ASSERT_EQ(rows.size(), 3u);
    const std::vector<double> angles{90, 70, 60};
    for (int i = 0; i < 3; ++i)
    {
        EXPECT_NEAR(number(rows[i].at("time")), 0.01*i, 1e-12);
        EXPECT_EQ(rows[i].at("state"), "attached");
        for (const char* column : {"angle", "tangentMean", "tangentMin", "tangentMax"})
        {
            EXPECT_NEAR(number(rows[i].at(column)), angles[i], 0.5) << column;      // what is asked of exact caps
        }
        EXPECT_EQ(rows[i].at("advancing"), "nan");                          // no gravity, no direction
        EXPECT_EQ(rows[i].at("sigma"), "nan");
        EXPECT_EQ(number(rows[i].at("prescribed")), 60);                    // the half of the floor below the drop
        // A lattice cut by a sphere of ten spacings holds its volume to a few per cent of its outer layer.
        EXPECT_NEAR(number(rows[i].at("particles")), 1000, 20);
        EXPECT_NEAR(number(rows[i].at("volumeDrift")), 100*(1000/number(rows[i].at("particles")) - 1), 1);
        // The exact meshes' volumes differ by what the grid cuts off at the rim.
        EXPECT_NEAR(number(rows[i].at("volumeDriftSinceFirst")), 0, 1);
        EXPECT_NEAR(number(rows[i].at("centroidX")), -1.5e-3, 0.1*spacing);
    }
}

TEST_F(DropCase, ProbeAngleKeepsTwoDropsApart)
{
    // The larger one changes: drops keep their numbers by place, not by size.
    writeTime("0", {drop(60, 600, -2e-3), drop(100, 400, 2e-3)});
    writeTime("0.01", {drop(60, 400, -2e-3), drop(100, 600, 2e-3)});
    ASSERT_EQ(call("probeAngle").status, 0);
    const auto rows = table("postProcessing/probeAngle/0/angle.csv");
    ASSERT_EQ(rows.size(), 4u);
    for (const auto& row : rows)
    {
        const bool left = number(row.at("drop")) == 1;
        EXPECT_EQ(number(row.at("centroidX")) < 0, left);
        EXPECT_NEAR(number(row.at("angle")), left ? 60 : 100, 1);           // of some hundred particles
        EXPECT_EQ(number(row.at("prescribed")), left ? 60 : 100);
    }
    EXPECT_NEAR(number(rows[2].at("volumeDriftSinceFirst")), 100*(400.0/600 - 1), 2);
    EXPECT_NEAR(number(rows[3].at("volumeDriftSinceFirst")), 100*(600.0/400 - 1), 2);
}

TEST_F(DropCase, ProbeAngleReportsADropThatLeftTheWall)
{
    writeTime("0", {{floorPlane, {0, 0, 1.2e-3}, 0.9e-3}});
    const Outcome outcome = call("probeAngle");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"detached", "off the wall"}));
    EXPECT_EQ(table("postProcessing/probeAngle/0/angle.csv").at(0).at("angle"), "nan");
}

TEST_F(DropCase, ProbeAngleReportsAFilm)
{
    // A disc of 1.5 mm radius, two spacings high.
    const auto distance = [](const Vector3& p)
    {
        return std::max({std::hypot(p.x, p.y) - 1.5e-3, p.z - 2*spacing, -p.z});
    };
    writeTime("0", {drop(90)});
    writePly
    (
        path()/"0/surface/liquid.ply",
        marchTetrahedra(distance, {-1.7e-3, -1.71e-3, -1.3*spacing}, {1.7e-3, 1.7e-3, 4*spacing}, 0.5*spacing)
    );
    const Outcome outcome = call("probeAngle");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"a film"}));
    const auto row = table("postProcessing/probeAngle/0/angle.csv").at(0);
    EXPECT_EQ(row.at("state"), "film");
    EXPECT_EQ(row.at("angle"), "nan");
    EXPECT_EQ(row.at("tangentMean"), "nan");
    EXPECT_NEAR(number(row.at("height")), 2*spacing, 0.1*spacing);
    EXPECT_NEAR(number(row.at("contactRadius")), 1.5e-3, 0.25*spacing);     // the mesh's rim loses half a cell
}

TEST_F(DropCase, ProbeAngleMeasuresOnABallAndAlongADirection)
{
    // A ball under the drop, then a drop on the floor that leans by a tenth of its height.
    const DropOnBall ballDrop = dropOnBall(110, 1000*spacing*spacing*spacing, 3e-3, {0, 0, 1});
    fs::remove_all(path()/"constant/solid");
    write("constant/walls", "ball { type sphere; centre (0 0 0); radius 3e-3; liquid outside; }\n");
    write("constant/wettability", "ball { theta 110; }\n");
    writeTime("0", {drop(90)});
    writePly(path()/"0/surface/liquid.ply", dropOnBallMesh(ballDrop, 0.5*spacing));
    ASSERT_EQ(call("probeAngle").status, 0);
    auto row = table("postProcessing/probeAngle/0/angle.csv").at(0);
    EXPECT_EQ(number(row.at("prescribed")), 110);
    EXPECT_NEAR(number(row.at("angle")), 110, 1);
    EXPECT_NEAR(number(row.at("tangentMean")), 110, 1);
    EXPECT_NEAR(number(row.at("contactRadius")), ballDrop.contactRadius, 0.1*spacing);

    write("constant/walls", "floor { type plane; point (0 0 0); normal (0 0 1); }\n");
    write("system/probeAngleDict", "direction (1 0 0);\n");
    TriangleMesh leaning = capMesh(drop(90, 8000), 0.5*spacing);
    for (Vector3& v : leaning.vertices) v.x += 0.1*v.z;
    writePly(path()/"0/surface/liquid.ply", leaning);
    const Outcome outcome = call("probeAngle");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"advancing side", "receding side"}));
    row = table("postProcessing/probeAngle/0/angle.csv").at(0);
    const double lean = std::atan(0.1)*180/std::numbers::pi;
    EXPECT_NEAR(number(row.at("advancing")), 90 + lean, 1);
    EXPECT_NEAR(number(row.at("receding")), 90 - lean, 1);
}

TEST_F(DropCase, ProbeAngleFitsTheSurfaceTensionUnderGravity)
{
    // Gravity that makes the capillary length that of the drop's radius.
    const double volume = 2000*spacing*spacing*spacing, l = std::cbrt(3*volume/(4*std::numbers::pi));
    write("constant/models", "bodyForce gravity;\n");
    write("constant/liquidProperties", "rho 1000;\nnu 1e-6;\nsigma 0.07;\n");
    const auto measure = [&](const std::string& g)
    {
        write("constant/g", "value " + g + ";\n");
        const Outcome outcome = call("probeAngle");
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        return table("postProcessing/probeAngle/0/angle.csv").at(0);
    };
    writeTime("0", {drop(90)});
    const DropProfile profile = bashforthAdamsOfVolume(volume, l, 80, 101);
    writePly(path()/"0/surface/liquid.ply", revolvedMesh(profile, 0.5*spacing));
    const auto upright = measure("(0 0 -10)");
    EXPECT_NEAR(number(upright.at("capillaryLength"))/l, 1, 0.01);
    EXPECT_NEAR(number(upright.at("sigma"))/(1000*10*l*l), 1, 0.02);
    EXPECT_NEAR(number(upright.at("tangentMean")), 80, 2);
    EXPECT_NEAR(number(upright.at("lineRadius")), profile.contactRadius(), 0.1*spacing);
    EXPECT_NEAR(number(upright.at("profileRadius")), profile.contactRadius(), 0.03*spacing);
    EXPECT_NEAR(number(upright.at("profileAngle")), 80, 0.5);
    EXPECT_EQ(upright.at("advancing"), "nan");                  // the wall is no slope
    // The liquid's own l, sqrt(0.07/(1000*10)) = 2.65 mm, is three times the mesh's: the sphere is no worse, and tangents are taken where both are off.
    EXPECT_NE(upright.at("method"), "none");
    // With the sigma of the mesh the answer is the profile's, and the other methods are told where they are asked for.
    std::ostringstream sigma;
    sigma << "rho 1000;\nnu 1e-6;\nsigma " << 1000*10*l*l << ";\n";
    write("constant/liquidProperties", sigma.str());
    const auto known = measure("(0 0 -10)");
    EXPECT_EQ(known.at("method"), "profile");
    EXPECT_NEAR(number(known.at("contactAngle")), 80, 0.5);
    const std::string brief = call("probeAngle").text, all = call("probeAngle", "-methods").text;
    EXPECT_TRUE(holds(brief, {"measured angle      8", "by the profile of a drop under gravity"}));
    EXPECT_EQ(brief.find("by a sphere"), std::string::npos);
    EXPECT_TRUE(holds(all, {"by a sphere", "by tangents", "sigma free"}));
    write("constant/liquidProperties", "rho 1000;\nnu 1e-6;\nsigma 0.07;\n");
    // Neither on a slope nor below a ceiling is the drop axisymmetric about the wall's normal and standing.
    const auto slope = measure("(5 0 -8)");
    EXPECT_EQ(slope.at("sigma"), "nan");
    EXPECT_EQ(slope.at("profileRadius"), "nan");
    EXPECT_NE(slope.at("advancing"), "nan");
    EXPECT_EQ(measure("(0 0 10)").at("capillaryLength"), "nan");
}

TEST_F(DropCase, ProbeAngleTakesAnalyticPlanesAndSelectedTimes)
{
    fs::remove_all(path()/"constant/solid");
    write
    (
        "constant/walls",
        "floor { type plane; point (0 0 0); normal (0 0 1); }\n"
        "top { type plane; point (0 0 1); normal (0 0 -1); }\n"
    );
    write("constant/wettability", "floor { theta 75; }\n");
    write("system/probeAngleDict", "wall floor;\nfitAbove 1.5;\n");
    writeTime("0", {drop(90)});
    writeTime("0.01", {drop(75)});
    const Outcome outcome = call("probeAngle", "-latestTime");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const auto rows = table("postProcessing/probeAngle/0.01/angle.csv");
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(number(rows[0].at("prescribed")), 75);
    EXPECT_NEAR(number(rows[0].at("angle")), 75, 0.5);
    EXPECT_EQ(rows[0].at("method"), "cap");
    EXPECT_EQ(rows[0].at("contactAngle"), rows[0].at("angle"));
}

TEST_F(DropCase, ProbeAngleRefusesBadInput)
{
    writeTime("0", {drop(60)}, false);
    const auto expectError = [&](const std::vector<std::string>& parts)
    {
        const Outcome outcome = call("probeAngle");
        EXPECT_NE(outcome.status, 0);
        EXPECT_TRUE(holds(outcome.text, parts));
        EXPECT_FALSE(fs::exists(path()/"postProcessing"));
    };
    expectError({"surface mesh", "meshSurface"});

    writeTime("0", {drop(60)});
    write("system/probeAngleDict", "wall flor;\n");
    expectError({"probeAngleDict", "flor", "floor"});
    write("system/probeAngleDict", "wall floor;\nfitAbov 1;\n");
    expectError({"probeAngleDict", "fitAbov", "fitAbove"});
    write("system/probeAngleDict", "wall floor;\nfitAbove -1;\n");
    expectError({"fitAbove", "-1"});
    write("system/probeAngleDict", "wall floor;\ndirection (0 0 0);\n");
    expectError({"direction", "(0 0 0)"});
    write("system/probeAngleDict", "wall floor;\n");
    write("constant/models", "bodyForce gravity;\n");
    expectError({"constant/g"});
    write("constant/g", "value (0 0 -9.81);\n");
    write("constant/liquidProperties", "rho -1;\n");
    expectError({"rho", "-1"});
    write("constant/liquidProperties", "rho 1000;\n");

    TriangleMesh open = capMesh(drop(60), 0.5*spacing);
    open.faces.pop_back();
    writePly(path()/"0/surface/liquid.ply", open);
    expectError({"liquid.ply", "open"});
    write("0/surface/liquid.ply", "solid\n");
    expectError({"liquid.ply", "'ply'"});
}

// A drop over the border between both halves of the floor: half of its line is on each, but for a few tangents.
TEST_F(DropCase, ProbeAngleTellsTheAngleAlongTheLine)
{
    writeTime("0", {drop(90, 1000, 0)});
    ASSERT_EQ(call("probeAngle").status, 0);
    const std::string file = "postProcessing/probeAngle/0/angle.csv";
    auto row = table(file).at(0);
    EXPECT_NEAR(number(row.at("localAngle")), 80, 3);
    for (const char* column : {"lineHeld", "lineAdvancing", "lineReceding"}) EXPECT_EQ(row.at(column), "nan") << column;       // no law

    // One half at the advancing angle, the other half in between.
    write("constant/wettability", "floor { law hysteresis; thetaAdv 110; thetaRec 50; }\n");
    const std::vector<Vector3> positions = readLiquidPositions(path()/"0");
    FieldData angles{"contactLineAngle", FieldType::scalar, dimensions::none, false, {}};
    for (const Vector3& x : positions) angles.values.push_back((x.y < 0 ? 110 : 70)*std::numbers::pi/180);
    writeField(path()/"0/liquid/contactLineAngle", angles, {});
    const Outcome outcome = call("probeAngle");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"local angle", "contact line", "held "}));
    row = table(file).at(0);
    EXPECT_NEAR(number(row.at("localAngle")), 90, 2);
    EXPECT_NEAR(number(row.at("lineHeld")), 50, 4);
    EXPECT_NEAR(number(row.at("lineAdvancing")), 50, 4);
    EXPECT_EQ(number(row.at("lineReceding")), 0);
    EXPECT_EQ(row.at("prescribed"), "nan");
}
