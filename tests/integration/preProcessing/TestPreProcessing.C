// SPDX-License-Identifier: GPL-3.0-or-later
// The built sampleSurface, sampleTheta and fillLiquid on small cases: what they write, and how they refuse bad input.

#include "caseFiles/SolidParticles.H"
#include "core/fieldFile/FieldFile.H"
#include "support/Programs.H"
#include "support/ScratchFolder.H"
#include "support/Surfaces.H"

#include <gtest/gtest.h>

namespace shizuku::test
{

namespace
{

// A case of a square floor of 20 x 20 mm and a drop on it, at a spacing of 1 mm.
class PreProcessing : public testing::Test
{
protected:
    PreProcessing()
    {
        folder_.write("system/controlDict", "endTime 1; deltaT 0.1; writeInterval 1; writeFormat ascii;");
        folder_.write("system/solution", "spacing 1e-3;");
        folder_.write("constant/walls", "floor { type particles; surface \"floor.stl\"; scale 0.001; }");
        folder_.write("constant/wettability", "floor { theta 60; }");
        folder_.write("constant/triSurface/floor.stl", stlText(rectangle(20, 20), "floor"));
        fill("drop { type cap; centre (0.01 0.01 0); normal (0 0 1); contactAngle 90; volume 4e-7; velocity (0 0 -1); }");
    }

    void fill(const std::string& bodies) { folder_.write("system/fillLiquidDict", "bodies\n{\n" + bodies + "\n}\n"); }

    Outcome call(const std::string& application) const
    {
        return run(program(application) + " -case '" + casePath().string() + "'");
    }

    void expectSuccess(const std::string& application, const std::vector<std::string>& parts)
    {
        const Outcome outcome = call(application);
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        EXPECT_TRUE(holds(outcome.text, parts));
        EXPECT_TRUE(holds(outcome.text, {"ExecutionTime", "End"}));
    }

    // Refused with status 1 and a message, and the output is not there, not even a part of it.
    void expectRefusal(const std::string& application, const std::vector<std::string>& parts, const std::string& output)
    {
        const Outcome outcome = call(application);
        EXPECT_EQ(outcome.status, 1) << outcome.text;
        EXPECT_TRUE(holds(outcome.text, parts));
        EXPECT_TRUE(holds(outcome.text, {"FATAL IO ERROR"}));
        EXPECT_FALSE(std::filesystem::exists(folder_.path()/output));
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path()))
        {
            EXPECT_EQ(entry.path().string().find(".partial"), std::string::npos) << entry.path();
        }
    }

    const std::filesystem::path& casePath() const { return folder_.path(); }

    ScratchFolder folder_;
};

}

TEST_F(PreProcessing, ChainWritesSolidAnglesAndLiquid)
{
    expectSuccess
    (
        "sampleSurface",
        {
            "floor: 1 open border left open", "1 shell, open, patches floor", "minimal gap", "maximal gap", "largest hole",
            "virtual volumes", "wall density", "density variation"
        }
    );
    const SolidParticles solid = readSolidParticles(casePath());
    // A triangular lattice has 1.155 particles a squared spacing; fitting it to 20 spacings changes that by 5 % at most.
    EXPECT_NEAR(solid.positions.size(), 462, 23);
    EXPECT_EQ(solid.patches, std::vector<std::string>{"floor"});
    for (std::size_t i = 0; i < solid.positions.size(); ++i)
    {
        ASSERT_NEAR(solid.positions[i].z, -0.5e-3, 1e-11);     // nine digits are written
        ASSERT_EQ(solid.normals[i], Vector3(0, 0, 1));
        ASSERT_EQ(solid.patch[i], 0);
    }

    expectSuccess("sampleTheta", {"floor", "60"});
    const FieldData theta = readField(casePath()/"0/solid/theta", FieldType::scalar, dimensions::none);
    EXPECT_TRUE(theta.uniform);
    EXPECT_EQ(theta(0), 60);

    expectSuccess("fillLiquid", {"drop", "particles", "4e-07 m3"});
    const FieldData positions = readField(casePath()/"0/liquid/positions", FieldType::vector, dimensions::length);
    const long count = long(positions.elements());
    EXPECT_EQ(count, 400);      // 4e-7 m3
    const FieldData U = readField(casePath()/"0/liquid/U", FieldType::vector, dimensions::velocity, count);
    for (long i = 0; i < count; ++i)
    {
        ASSERT_GT(positions(i, 2), 0.499e-3);
        ASSERT_EQ(U(i, 2), -1);
    }
}

// Liquid is behind the faces of the floor: the message says that it is these, and what turns them.
TEST_F(PreProcessing, FacesThatLookTheWrongWayAreNamedAndTurnedByFlip)
{
    PatchedSurface floor = rectangle(20, 20);
    for (auto& face : floor.mesh.faces) std::swap(face[0], face[1]);
    folder_.write("constant/triSurface/floor.stl", stlText(floor, "floor"));
    expectSuccess("sampleSurface", {});
    expectRefusal("fillLiquid", {"inside a solid, the wall 'floor'", "in front of the faces", "`flip yes;`"}, "0/liquid");

    folder_.write("constant/walls", "floor { type particles; surface \"floor.stl\"; scale 0.001; flip yes; }");
    EXPECT_TRUE(holds(otherSurfaces(casePath()), {"flip of the wall 'floor' has changed", "sampleSurface"}));
    expectSuccess("sampleSurface", {"triangles from floor.stl, turned round"});
    EXPECT_EQ(otherSurfaces(casePath()), "");
    const SolidParticles solid = readSolidParticles(casePath());
    for (std::size_t i = 0; i < solid.positions.size(); ++i)
    {
        ASSERT_NEAR(solid.positions[i].z, -0.5e-3, 1e-11);
        ASSERT_EQ(solid.normals[i], Vector3(0, 0, 1));
    }
    expectSuccess("fillLiquid", {"drop: 400 particles"});
}

TEST_F(PreProcessing, SlipsAreAskedAboutWhereLiquidIsFilled)
{
    expectSuccess("sampleSurface", {});
    folder_.write("constant/liquidProperties", "rho 998; nu 1e-6; sigma 72.8;");
    folder_.write("constant/wettability", "floor { theta 1.2; }");
    fill("drop { type sphere; centre (0.01 0.01 5); radius 4e-3; }");
    expectSuccess("fillLiquid", {"WARNING: sigma is 72.8 N/m", "theta of 'floor' is 1.2 degrees: are these radians?", "m from every wall"});
}

TEST_F(PreProcessing, BinaryFormatGivesTheSame)
{
    expectSuccess("sampleSurface", {});
    const SolidParticles ascii = readSolidParticles(casePath());
    folder_.write("system/controlDict", "endTime 1; deltaT 0.1; writeInterval 1; writeFormat binary;");
    expectSuccess("sampleSurface", {});
    const SolidParticles binary = readSolidParticles(casePath());
    ASSERT_EQ(ascii.positions.size(), binary.positions.size());
    for (std::size_t i = 0; i < ascii.positions.size(); ++i)
    {
        ASSERT_NEAR(length(ascii.positions[i] - binary.positions[i]), 0, 1e-8);     // floats of 0.02
    }
    EXPECT_TRUE(holds(folder_.read("constant/solid/positions"), {"format      binary"}));
}

TEST_F(PreProcessing, SurfacesThatChangedSinceTheyWereSampledAreTold)
{
    const auto toldBy = [&](const std::string& application)
    {
        const Outcome outcome = call(application);
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        const std::string begin = "constant/solid is not of the walls as they are: ";
        const auto at = outcome.text.find(begin);
        return at == std::string::npos ? "" : outcome.text.substr(at + begin.size(), outcome.text.find('\n', at) - at - begin.size());
    };
    const auto walls = [&](const std::string& name, const std::string& entries)
    {
        folder_.write("constant/walls", name + " { type particles; " + entries + " }");
    };
    expectSuccess("sampleSurface", {"Wrote constant/solid"});
    EXPECT_EQ(toldBy("sampleTheta"), "");
    folder_.write("constant/triSurface/floor.stl", stlText(rectangle(20, 19), "floor"));
    EXPECT_EQ(toldBy("sampleTheta"), "floor.stl of the wall 'floor' has changed");
    std::filesystem::remove(casePath()/"constant/triSurface/floor.stl");
    EXPECT_EQ(toldBy("sampleTheta"), "");
    walls("floor", "surface \"floor.stl\"; scale 0.002;");
    EXPECT_EQ(toldBy("sampleTheta"), "the scale of the wall 'floor' has changed");
    walls("floor", "surface \"floor.stl\"; scale 0.001; closeHoles 1e-3;");
    EXPECT_EQ(toldBy("sampleTheta"), "closeHoles of the wall 'floor' has changed");
    walls("floor", "surface \"other.stl\"; scale 0.001;");
    EXPECT_EQ(toldBy("sampleTheta"), "the wall 'floor' was made of floor.stl, not of other.stl");
    walls("ground", "surface \"floor.stl\"; scale 0.001;");
    EXPECT_EQ(toldBy("sampleTheta"), "the wall 'ground' was not sampled");
    std::filesystem::remove(casePath()/"constant/solid/surfaces");         // as of solids that others made
    EXPECT_EQ(toldBy("sampleTheta"), "");
}

TEST_F(PreProcessing, SheetsThatMeetInAnEdgeAreWrittenDown)
{
    const auto form = [&](const std::string& triangles)
    {
        folder_.write("constant/walls", "fin { type particles; surface \"fin.off\"; }");
        folder_.write("constant/triSurface/fin.off", triangles);
        expectSuccess("sampleSurface", {"Wrote constant/solid"});
        return Dictionary::read(casePath()/"constant/solid/surfaces").subDict("fin").lookup<std::string>("form");
    };
    EXPECT_EQ(form("OFF\n4 2 0\n0 0 0\n.02 0 0\n.02 .02 0\n0 .02 0\n3 0 1 2\n3 0 2 3\n"), "open");
    EXPECT_EQ(form("OFF\n5 3 0\n0 0 0\n.02 0 0\n.02 .02 0\n0 .02 0\n.01 .01 .02\n3 0 1 2\n3 0 2 3\n3 0 2 4\n"), "branching");
    ASSERT_EQ(branchingSheets(casePath()).size(), 1u);
    EXPECT_NE(branchingSheets(casePath())[0].find("The wall 'fin' is of open sheets that meet in an edge"), std::string::npos);
    EXPECT_EQ(form("OFF\n4 4 0\n0 0 0\n.02 0 0\n0 .02 0\n0 0 .02\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"), "closed");
    EXPECT_TRUE(branchingSheets(casePath()).empty());
}

TEST_F(PreProcessing, CasesWithoutSampledWallsNeedNothing)
{
    folder_.write("constant/walls", "lid { type plane; point (0 0 1); normal (0 0 -1); }");
    folder_.write("constant/wettability", "lid { theta 90; }");
    expectSuccess("sampleSurface", {"nothing to sample"});
    expectSuccess("sampleTheta", {"nothing to write"});
    EXPECT_FALSE(std::filesystem::exists(casePath()/"constant/solid"));
    folder_.write("constant/walls", "");
    expectSuccess("sampleTheta", {"nothing to do"});
    expectSuccess("fillLiquid", {"Wrote 0/liquid"});
    folder_.write("0.02/liquid/U", "");
    expectSuccess("fillLiquid", {"Wrote 0/liquid", "later times, up to 0.02 s", "Allclean"});
}

TEST_F(PreProcessing, AThinPlateIsRefusedWithWhatItNeeds)
{
    folder_.write("constant/walls", "plate { type particles; surface \"plate.off\"; }");
    folder_.write
    (
        "constant/triSurface/plate.off",
        "OFF\n8 6 0\n0 0 0\n.01 0 0\n0 .01 0\n.01 .01 0\n0 0 .0012\n.01 0 .0012\n0 .01 .0012\n.01 .01 .0012\n"
        "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n"
    );
    expectRefusal("sampleSurface", {"'plate'", "0.0012 m thin", "1.2 spacings", "0.002 m", "0.0006 m", "a sheet"}, "constant/solid");
}

TEST_F(PreProcessing, OtherSurfaceFormatsAreRead)
{
    folder_.write("constant/walls", "block { type particles; surface \"block.off\"; }");
    folder_.write
    (
        "constant/triSurface/block.off",
        "OFF\n8 6 0\n0 0 0\n.01 0 0\n0 .01 0\n.01 .01 0\n0 0 .01\n.01 0 .01\n0 .01 .01\n.01 .01 .01\n"
        "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n"
    );
    expectSuccess("sampleSurface", {"block: read 12 triangles"});
    EXPECT_EQ(readSolidParticles(casePath()).patches, std::vector<std::string>{"block"});

    folder_.write("constant/walls", "block { type particles; surface \"block.obj\"; }");
    folder_.write("constant/triSurface/block.obj", "v 0 0 0\nv .01 0 0\nv .01 .01 0\nv 0 .01 0\nf 1 2 3 4\n");
    expectSuccess("sampleSurface", {"block: read 2 triangles", "1 open border left open"});
}

TEST_F(PreProcessing, BadSurfacesAreRefused)
{
    const std::string stl = "constant/triSurface/floor.stl", output = "constant/solid";
    folder_.write(stl, "");
    expectRefusal("sampleSurface", {"floor.stl", "empty"}, output);
    folder_.write(stl, "not a surface");
    expectRefusal("sampleSurface", {"floor.stl", "no STL"}, output);
    folder_.write(stl, stlText(rectangle(20, 0), "line"));
    expectRefusal("sampleSurface", {"floor.stl", "degenerate"}, output);
    std::filesystem::remove(casePath()/stl);
    folder_.write("constant/triSurface/flour.stl", "");
    expectRefusal
    (
        "sampleSurface", {"'floor.stl' of the wall 'floor' is not in", "constant/walls at line ", "Did you mean 'flour.stl'"}, output
    );
}

TEST_F(PreProcessing, SurfacesInOtherUnitsAreRefusedWithAHint)
{
    folder_.write("constant/triSurface/floor.stl", stlText(rectangle(20, 20), "floor"));
    folder_.write("constant/walls", "floor { type particles; surface \"floor.stl\"; }");
    // 20 m x 20 m at 1 mm: 4.6e8 particles.
    expectRefusal("sampleSurface", {"20 x 20", "4.6188e+08", "scale 0.001", "constant/walls"}, "constant/solid");
    folder_.write("constant/walls", "floor { type particles; surface \"floor.stl\"; scale 1e-6; }");
    expectRefusal("sampleSurface", {"less than one particle", "scale"}, "constant/solid");
    // 20 mm at 1 mm is usual, a tenth of that is suspicious but possible.
    folder_.write("constant/walls", "floor { type particles; surface \"floor.stl\"; scale 1e-4; }");
    expectSuccess("sampleSurface", {"WARNING", "2 times as long as a particle", "scale 0.001", "wall density       not measured"});
    std::filesystem::remove_all(casePath()/"constant/solid");
    folder_.write("constant/walls", "floor { type particles; surface \"floor.stl\"; scale -1; }");
    expectRefusal("sampleSurface", {"scale", "-1"}, "constant/solid");
}

TEST_F(PreProcessing, HolesAreClosedUpToTheWidthThatIsAskedFor)
{
    // A frame: 8 x 8 mm are missing in the middle of the floor.
    folder_.write
    (
        "constant/triSurface/frame.obj",
        "v 0 0 0\nv 20 0 0\nv 20 20 0\nv 0 20 0\nv 6 6 0\nv 14 6 0\nv 14 14 0\nv 6 14 0\n"
        "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
    );
    const std::string wall = "frame { type particles; surface \"frame.obj\"; scale 0.001;";
    folder_.write("constant/walls", wall + " }");
    expectSuccess("sampleSurface", {"2 open borders left open, the widest 0.0282"});
    folder_.write("constant/walls", wall + " closeHoles 12e-3; }");
    expectSuccess("sampleSurface", {"1 small hole closed", "1 open border left open"});
    std::filesystem::remove_all(casePath()/"constant/solid");
    folder_.write("constant/walls", wall + " closeHoles -1; }");
    expectRefusal("sampleSurface", {"closeHoles", "-1"}, "constant/solid");
}

TEST_F(PreProcessing, BadSamplingEntriesAreRefused)
{
    folder_.write("system/sampleSurfaceDict", "method belle;");
    expectRefusal("sampleSurface", {"belle", "bell", "poissonDisk"}, "constant/solid");
    folder_.write("system/sampleSurfaceDict", "methood bell;");
    expectRefusal("sampleSurface", {"methood", "method"}, "constant/solid");
    folder_.write("system/sampleSurfaceDict", "offset -1.5;");
    expectRefusal("sampleSurface", {"The offset is -1.5 spacings", "-1 to 1"}, "constant/solid");
    std::filesystem::remove(casePath()/"system/sampleSurfaceDict");
    folder_.write("system/solution", "spacing 0;");
    expectRefusal("sampleSurface", {"spacing"}, "constant/solid");
}

TEST_F(PreProcessing, BadWettabilityIsRefused)
{
    expectRefusal("sampleTheta", {"sampleSurface first"}, "0/solid/theta");
    expectSuccess("sampleSurface", {});
    folder_.write("constant/wettability", "");
    expectRefusal("sampleTheta", {"'floor'", "wettability"}, "0/solid/theta");
    folder_.write("constant/wettability", "floor { theta 60; }\nflour { theta 60; }");
    expectRefusal("sampleTheta", {"'flour'", "floor", "wettability", "2"}, "0/solid/theta");
    folder_.write("constant/wettability", "floor { theta 200; }");
    expectRefusal("sampleTheta", {"200", "0 to 180"}, "0/solid/theta");

    // Angles go by the solids of the surface's file, which are not the walls.
    PatchedSurface surface = rectangle(20, 20);
    surface.patches = {"left", "right"};
    surface.patch.back() = 1;
    folder_.write("constant/triSurface/floor.stl", stlText(surface));
    expectSuccess("sampleSurface", {});
    folder_.write("constant/wettability", "floor { theta 60; }");
    expectRefusal("sampleTheta", {"no patch or wall 'floor'", "wall 'floor' has the patches left, right"}, "0/solid/theta");
}

TEST_F(PreProcessing, BadBodiesAreRefused)
{
    const std::string output = "0/liquid";
    fill("drop { type ball; centre (0 0 0.01); radius 5e-3; }");
    expectRefusal("fillLiquid", {"ball", "sphere", "cap", "fillLiquidDict"}, output);
    fill("drop { type sphere; centre (0 0 0.01); radius -5e-3; }");
    expectRefusal("fillLiquid", {"radius", "-0.005"}, output);
    fill("drop { type sphere; centre (0 0 0.01); radius 5e-3; colour blue; }");
    expectRefusal("fillLiquid", {"colour"}, output);
    fill("");
    expectRefusal("fillLiquid", {"no body"}, output);
    // Counted before any is made: a sphere of 5 m has 5.2e11.
    fill("drop { type sphere; centre (0 0 10); radius 5; }");
    expectRefusal("fillLiquid", {"5.23599e+11 particles", "up to 2e+09", "0.00639719 m", "fillLiquidDict"}, output);
}

TEST_F(PreProcessing, LiquidInsideASolidIsRefused)
{
    expectSuccess("sampleSurface", {});
    fill("drop { type sphere; centre (0.01 0.01 0.003); radius 5e-3; }");
    expectRefusal("fillLiquid", {"Liquid inside a solid", "'floor'", "'drop'", "first one at"}, "0/liquid");
    folder_.write
    (
        "constant/walls",
        "floor { type particles; surface \"floor.stl\"; } lid { type plane; point (0 0 5e-3); normal (0 0 -1); }"
    );
    fill("drop { type box; min (0 0 0); max (0.01 0.01 0.01); }");
    // Five layers of a hundred are above the lid.
    expectRefusal("fillLiquid", {"plane 'lid'", "500 of the 1000"}, "0/liquid");
    fill("a { type box; min (0 0 0); max (4e-3 4e-3 4e-3); } b { type box; min (2e-3 0 0); max (6e-3 4e-3 4e-3); }");
    expectRefusal("fillLiquid", {"Liquid inside of other liquid", "'a'", "'b'"}, "0/liquid");
}

TEST_F(PreProcessing, BodiesAreCarvedTurnedAndTakenFromSurfaces)
{
    expectSuccess("sampleSurface", {});
    folder_.write("constant/triSurface/body.stl", stlText(cube(8), "body"));
    // The block stands on the floor; of the ball the part below it and the part in the block are left out.
    fill
    (
        "block { type surface; file \"body.stl\"; scale 0.001; translate (2e-3 2e-3 0); angularVelocity (0 0 10); }\n"
        "ball { type sphere; centre (0.012 6e-3 2e-3); radius 5e-3; overlaps carve; velocity (1 0 0); }"
    );
    expectSuccess
    (
        "fillLiquid",
        {"block: 512 particles, volume 5.12e-07 m3, of the shape 5.12e-07 m3 (", "angular velocity (0 0 10) rad/s",
         "left out", "Liquid inside a solid, the wall 'floor'", "Liquid inside of other liquid, the body 'block'"}
    );
    const FieldData positions = readField(casePath()/"0/liquid/positions", FieldType::vector, dimensions::length);
    const FieldData U = readField(casePath()/"0/liquid/U", FieldType::vector, dimensions::velocity, positions.elements());
    for (std::size_t i = 0; i < positions.elements(); ++i)
    {
        ASSERT_GT(positions(i, 2), 0.39e-3);
        if (i >= 512)
        {
            ASSERT_EQ(U(i, 0), 1);
            ASSERT_FALSE(positions(i, 0) < 0.01 && std::abs(positions(i, 1) - 6e-3) < 4e-3 && positions(i, 2) < 8e-3);
        }
        else ASSERT_NEAR(U(i, 1), 10*(positions(i, 0) - 6e-3), 1e-9);
    }

    folder_.write("constant/triSurface/body.stl", stlText(rectangle(8, 8), "body"));
    std::filesystem::remove_all(casePath()/"0/liquid");
    expectRefusal("fillLiquid", {"body.stl", "encloses no body", "4 open edges", "fillLiquidDict", "3"}, "0/liquid");
    fill("ball { type sphere; centre (0.01 0.01 0.01); radius 2e-3; overlaps cut; }");
    expectRefusal("fillLiquid", {"'cut'", "carve", "refuse"}, "0/liquid");
}

TEST_F(PreProcessing, PatternsReachTheParticles)
{
    expectSuccess("sampleSurface", {});
    const SolidParticles solid = readSolidParticles(casePath());
    const auto theta = [&] { return readField(casePath()/"0/solid/theta", FieldType::scalar, dimensions::none); };
    folder_.write
    (
        "constant/wettability", "floor { type stripes; theta (30 110); direction (1 0 0); period 5e-3; phase 0.1; }"
    );
    expectSuccess("sampleTheta", {"theta 30 to 110"});
    const FieldData stripes = theta();
    for (std::size_t i = 0; i < solid.positions.size(); ++i)
    {
        const double periods = solid.positions[i].x/5e-3 - 0.1;
        if (std::abs(2*periods - std::round(2*periods)) < 1e-6) continue;       // on an edge, but for nine digits
        ASSERT_EQ(stripes(i), periods - std::floor(periods) < 0.5 ? 30 : 110) << solid.positions[i].x;
    }
    folder_.write("constant/wettability", "floor { type expression; theta \"90 + 1e3*x\"; }");
    expectSuccess("sampleTheta", {});
    const FieldData slope = theta();
    for (std::size_t i = 0; i < solid.positions.size(); ++i) ASSERT_NEAR(slope(i), 90 + 1e3*solid.positions[i].x, 1e-6);
}

// The tutorial's image, a black cross of a fifth of its width on white; a build without VTK has no images.
TEST_F(PreProcessing, AnImageReachesTheParticles)
{
    const std::filesystem::path build = environment("SHIZUKU_BUILD"), source = environment("SHIZUKU_DIR");
    if (!std::filesystem::exists(build/"bin/renderCase")) GTEST_SKIP() << "built without VTK";
    expectSuccess("sampleSurface", {});
    const SolidParticles solid = readSolidParticles(casePath());
    std::filesystem::copy(source/"tutorials/patternedSurface/constant/cross.png", casePath()/"constant/cross.png");
    folder_.write
    (
        "constant/wettability",
        "floor { type image; file \"cross.png\"; theta (20 130); origin (0 0 0); width (0.02 0 0); height (0 0.02 0); }"
    );
    expectSuccess("sampleTheta", {"theta 20 to 130"});
    const FieldData cross = readField(casePath()/"0/solid/theta", FieldType::scalar, dimensions::none);
    int black = 0;
    for (std::size_t i = 0; i < solid.positions.size(); ++i) black += cross(i) == 20;
    // Two arms of 0.2 x 0.9 of the image, less the middle that they share: 32 % of it, to the row at their edges.
    EXPECT_NEAR(black/double(solid.positions.size()), 0.32, 0.03);
    folder_.write("constant/cross.png", "no image");
    std::filesystem::remove(casePath()/"0/solid/theta");
    expectRefusal("sampleTheta", {"neither PNG nor JPEG", "cross.png"}, "0/solid/theta");
}

}
