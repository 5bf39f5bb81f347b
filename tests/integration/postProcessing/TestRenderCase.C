// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures that renderCase draws of stored drops.

#include "DropCase.H"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>

#include <cmath>

using namespace shizuku;
using namespace shizuku::test;
namespace fs = std::filesystem;

namespace
{

struct Picture
{
    int width = 0, height = 0;
    double variation = 0;           // standard deviation of all channels' levels (0 to 255)
    vtkNew<vtkPNGReader> reader;

    explicit Picture(const fs::path& file)
    {
        reader->SetFileName(file.c_str());
        reader->Update();
        vtkImageData& image = *reader->GetOutput();
        width = image.GetDimensions()[0];
        height = image.GetDimensions()[1];
        vtkDataArray& pixels = *image.GetPointData()->GetScalars();
        double sum = 0, squares = 0;
        for (vtkIdType i = 0; i < pixels.GetNumberOfTuples(); ++i)
        {
            for (int c = 0; c < 3; ++c)
            {
                sum += pixels.GetComponent(i, c);
                squares += pixels.GetComponent(i, c)*pixels.GetComponent(i, c);
            }
        }
        const double n = 3.0*pixels.GetNumberOfTuples();
        variation = std::sqrt(squares/n - sum/n*sum/n);
    }

    // Blue less red at parts of width and height, from the lower left.
    double blueness(double x, double y) const
    {
        vtkImageData& image = *reader->GetOutput();
        const auto level = [&](int c) { return image.GetScalarComponentAsDouble(int(x*width), int(y*height), 0, c); };
        return level(2) - level(0);
    }

    // Mean of the channels there.
    double brightness(double x, double y) const
    {
        vtkImageData& image = *reader->GetOutput();
        const auto level = [&](int c) { return image.GetScalarComponentAsDouble(int(x*width), int(y*height), 0, c); };
        return (level(0) + level(1) + level(2))/3;
    }
};

}

TEST_F(DropCase, RenderCaseShowsThePlainSurface)
{
    writeTime("0", {drop(90)});
    writeTime("0.01", {drop(100)});
    ASSERT_EQ(call("probeAngle").status, 0);
    for (const std::string view : {"side", "perspective", "above"})
    {
        const fs::path file = path()/(view + ".png");
        const Outcome outcome = call("renderCase", "-look plain -size 320x200 -view " + view + " -output " + file.string());
        ASSERT_EQ(outcome.status, 0) << outcome.text;
        EXPECT_TRUE(holds(outcome.text, {"Time = 0.01", file.string()}));
        const Picture picture(file);
        EXPECT_EQ(picture.width, 320);
        EXPECT_EQ(picture.height, 200);
        // A blank picture varies by nothing, its background alone by some ten levels.
        EXPECT_GT(picture.variation, 20) << view;
        // The liquid stands in the middle: more blue than red. The background and the floor differ by less than 40.
        EXPECT_GT(picture.blueness(0.5, 0.5), 60) << view;
    }
}

// The floor's angles, 60 degrees for x < 0 and 100 beyond, are seen as blue and light; the same angle everywhere as nothing.
TEST_F(DropCase, RenderCaseShowsThePatternOfAFloor)
{
    writeTime("0", {drop(90)});
    double legend = 0;
    const auto difference = [&]
    {
        const Outcome outcome = call("renderCase", "-look plain -size 160x100 -view above");
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        const Picture picture(path()/"case.png");
        legend = picture.blueness(0.905, 0.32) - picture.blueness(0.905, 0.65);
        return picture.blueness(0.5, 0.095) - picture.blueness(0.9, 0.095);       // between the scale bar and its length
    };
    EXPECT_GT(difference(), 20);
    EXPECT_GT(legend, 20);                              // from the least angle to the largest
    writeField(path()/"0/solid/theta", {"theta", FieldType::scalar, dimensions::none, true, {60}}, {});
    EXPECT_NEAR(difference(), 0, 5);
    EXPECT_NEAR(legend, 0, 5);
}

// A ball of 0.8 mm beside the drop, in a picture 10 mm wide: matte, and lit from the upper left, where the sky is blue without it.
TEST_F(DropCase, RenderCaseDrawsBallsThatLiquidIsOutsideOf)
{
    writeTime("0", {drop(90)});
    const auto bluenessOfPlace = [&]
    {
        const Outcome outcome = call("renderCase", "-look plain -size 160x100 -view side -width 0.01 -centre '(0 0 1e-3)'");
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        return Picture(path()/"case.png").blueness(0.8, 0.65);
    };
    const double sky = bluenessOfPlace();
    write("constant/walls", "floor { type particles; surface \"floor.stl\"; }\nball { type sphere; centre (3e-3 0 2e-3); radius 8e-4; liquid outside; }\n");
    // The ball's colour has less blue than red; the sky has more.
    EXPECT_GT(sky, 5);
    EXPECT_LT(bluenessOfPlace(), 0);
}

// A floor below which there is more of its solid is a face of a body: it has no pattern, nor goes on beyond its edges.
TEST_F(DropCase, RenderCaseTakesNoFaceOfABodyForAFloor)
{
    writeTime("0", {drop(90)});
    SolidParticles solid;
    solid.patches = {"floor", "rim"};
    for (int i = -25; i <= 25; ++i)
    {
        for (int j = -25; j <= 25; ++j)
        {
            const bool isRim = std::max(std::abs(i), std::abs(j)) == 25;
            for (int k = 0; k < (isRim ? 5 : 1); ++k)
            {
                solid.positions.push_back(spacing*Vector3(i, j, -0.5 - k));
                solid.normals.push_back({0, 0, 1});
                solid.patch.push_back(k > 0);
            }
        }
    }
    writeSolidParticles(path(), solid, {});
    std::vector<double> theta;
    for (const Vector3& x : solid.positions) theta.push_back(x.x < 0 ? 60 : 100);
    writeField(path()/"0/solid/theta", {"theta", FieldType::scalar, dimensions::none, false, theta}, {});
    const Outcome outcome = call("renderCase", "-look plain -size 160x100 -view above");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const Picture picture(path()/"case.png");
    EXPECT_NEAR(picture.blueness(0.5, 0.05), picture.blueness(0.65, 0.05), 12);      // 20 and more with the pattern of a floor
}

// The drop is 2 mm wide and stands at x = -1.5 mm: a tenth of a picture 20 mm wide, in the middle or where `centre` puts it.
TEST_F(DropCase, RenderCaseLooksWhereItIsTold)
{
    writeTime("0", {drop(90)});
    constexpr double water = 60, none = 40;             // as above
    ASSERT_EQ(call("renderCase", "-look plain -size 160x100 -width 0.02 -azimuth 70").status, 0);
    const Picture small(path()/"case.png");
    EXPECT_GT(small.blueness(0.5, 0.5), water);
    EXPECT_LT(small.blueness(0.4, 0.5), none);
    ASSERT_EQ(call("renderCase", "-look plain -size 160x100 -width 0.02 -centre '(3e-3 0 5e-4)'").status, 0);
    const Picture beside(path()/"case.png");
    EXPECT_LT(beside.blueness(0.5, 0.5), none);
    EXPECT_GT(beside.blueness(0.5 - 4.5/20, 0.5), water);
    for (const std::string bad : {"-width 0", "-width -1", "-centre '(0 0)'", "-centre '(0 0 a)'", "-azimuth a"})
    {
        EXPECT_NE(call("renderCase", bad).status, 0) << bad;
    }
}

// Ends at 0.97 of the width. 20 mm have a bar of 5, 30 mm too, and 50 mm one of 10.
TEST_F(DropCase, RenderCaseDrawsAScaleBar)
{
    writeTime("0", {drop(90)});
    for (const auto& [width, bar] : {std::pair("0.02", 5.0/20), std::pair("0.03", 5.0/30), std::pair("0.05", 10.0/50)})
    {
        ASSERT_EQ(call("renderCase", std::string("-look plain -size 240x150 -width ") + width).status, 0);
        const Picture picture(path()/"case.png");
        constexpr double row = (0.03*240 + 1.5)/150, pixel = 1.0/240;
        constexpr double dark = 90, light = 150;
        EXPECT_LT(picture.brightness(0.97 - 2*pixel, row), dark) << width;
        EXPECT_LT(picture.brightness(0.97 - bar + 2*pixel, row), dark) << width;
        EXPECT_GT(picture.brightness(0.97 + 2*pixel, row), light) << width;
        EXPECT_GT(picture.brightness(0.97 - bar - 2*pixel, row), light) << width;
    }
}

// A drop at x = -1.5 mm, later at 1.5 mm: pictures of both times show the same place, 3 mm and two halves of a drop wide.
TEST_F(DropCase, RenderCaseFramesASeriesOnce)
{
    writeTime("0", {drop(90)});
    writeTime("0.01", {drop(90, 1000, 1.5e-3)});
    constexpr double water = 60, none = 40;             // as above
    ASSERT_EQ(call("renderCase", "-look plain -size 160x100 -view above -time 0:").status, 0);
    const Picture first(path()/"case_0.png"), last(path()/"case_0.01.png");
    for (const Picture* picture : {&first, &last}) EXPECT_LT(picture->blueness(0.5, 0.5), none);
    // The frame's width fills 0.64 of the picture; the drops' middles are 1.5 of its 2.5 mm from the middle.
    const double away = 0.32*1.5/2.5;
    EXPECT_GT(first.blueness(0.5 - away, 0.5), water);
    EXPECT_LT(first.blueness(0.5 + away, 0.5), none);
    EXPECT_GT(last.blueness(0.5 + away, 0.5), water);
    EXPECT_LT(last.blueness(0.5 - away, 0.5), none);
}

// Gravity upwards: what was the floor is the ceiling, and the viewer stands below it.
TEST_F(DropCase, RenderCaseLooksUpAtWhatHangs)
{
    writeTime("0", {drop(90)});
    write("constant/models", "bodyForce gravity;\n");
    write("constant/g", "dimensions [0 1 -2 0 0 0 0];\nvalue (0 0 9.81);\n");
    ASSERT_EQ(call("renderCase", "-look plain -size 160x100 -view above").status, 0);
    EXPECT_GT(Picture(path()/"case.png").blueness(0.5, 0.5), 60);
}

// The floor's angles are 60 and 100 degrees: a drop on the seam has a mean of 80, which nobody prescribed.
TEST_F(DropCase, RenderCaseTellsAnglesThatWerePrescribed)
{
    write("constant/models", "wetting contactAngle;\n");
    for (const auto& [x, told] : {std::pair(-1.5e-3, true), std::pair(0.0, false)})
    {
        writeTime("0", {drop(90, 1000, x)});
        ASSERT_EQ(call("probeAngle").status, 0);
        const Outcome outcome = call("renderCase", "-look plain -size 64x64");
        EXPECT_TRUE(holds(outcome.text, {"contact angle "}));
        EXPECT_EQ(outcome.text.find("(prescribed 60") != std::string::npos, told) << outcome.text;
        EXPECT_EQ(outcome.text.find("prescribed") != std::string::npos, told) << outcome.text;
    }
    write("constant/models", "wetting none;\n");
    writeTime("0", {drop(90)});
    ASSERT_EQ(call("probeAngle").status, 0);
    EXPECT_EQ(call("renderCase", "-look plain -size 64x64").text.find("prescribed"), std::string::npos);
}

TEST_F(DropCase, RenderCaseShowsParticlesWhereThereIsNoSurface)
{
    writeTime("0", {drop(90)}, false);
    const Outcome outcome = call("renderCase", "-look plain -size 320x200");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const Picture picture(path()/"case.png");       // named after the case
    EXPECT_GT(picture.variation, 20);
    EXPECT_GT(picture.blueness(0.5, 0.5), 60);
}

TEST_F(DropCase, RenderCaseNeedsNoDisplay)
{
    writeTime("0", {drop(90)});
    const Outcome outcome = run("env -u DISPLAY " + program("renderCase") + " -size 64x64 -case " + path().string());
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(fs::exists(path()/"case.png"));
}

// Clear water shows the floor, honey is yellow, ink dark, mercury grey and as bright as the studio.
TEST_F(DropCase, RenderCaseShowsLiquidsAsTheyAre)
{
    writeTime("0", {drop(90)});
    const auto seen = [&](const std::string& look)
    {
        const Outcome outcome = call("renderCase", "-size 160x100 -view above -look " + look);
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        return std::make_unique<Picture>(path()/"case.png");
    };
    const auto water = seen("water"), honey = seen("honey"), mercury = seen("mercury"), ink = seen("ink");
    // Levels of 255. Red light loses an eighth on its way through as much water as the drop is wide; honey leaves 4 % of blue light, ink 2 % of red.
    EXPECT_LT(std::abs(water->blueness(0.5, 0.5)), 50);
    EXPECT_LT(honey->blueness(0.5, 0.5), -80);
    EXPECT_LT(std::abs(mercury->blueness(0.5, 0.5)), 25);
    EXPECT_LT(ink->brightness(0.5, 0.5), water->brightness(0.5, 0.5) - 60);
    EXPECT_NE(call("renderCase", "-look milk").status, 0);
}

// By density and viscosity, where none is asked for.
TEST_F(DropCase, RenderCaseKnowsLiquidsByTheirProperties)
{
    writeTime("0", {drop(90)});
    write("constant/liquidProperties", "rho 1420;\nnu 7e-3;\nsigma 0.055;\n");
    ASSERT_EQ(call("renderCase", "-size 160x100 -view above").status, 0);
    EXPECT_LT(Picture(path()/"case.png").blueness(0.5, 0.5), -80);
    write("constant/liquidProperties", "rho 998;\nnu 1e-6;\nsigma 0.0728;\n");
    ASSERT_EQ(call("renderCase", "-size 160x100 -view above").status, 0);
    EXPECT_LT(std::abs(Picture(path()/"case.png").blueness(0.5, 0.5)), 50);
}

// Beside a run the surfaces end before the times do: the latest one is shown, with a word.
TEST_F(DropCase, RenderCaseShowsTheLatestSurface)
{
    writeTime("0", {drop(90)});
    writeTime("0.01", {drop(100)});
    writeTime("0.02", {drop(100)}, false);
    for (const std::string options : {"", "-latestTime "})
    {
        const Outcome outcome = call("renderCase", options + "-size 64x64");
        ASSERT_EQ(outcome.status, 0) << outcome.text;
        EXPECT_TRUE(holds(outcome.text, {"The latest time 0.02 does not hold a surface mesh. The latest one that does is 0.01", "Time = 0.01"})) << outcome.text;
    }
    EXPECT_TRUE(holds(call("renderCase", "-time 0.02 -size 64x64").text, {"Time = 0.02", "No surface: particles are drawn"}));
    EXPECT_TRUE(holds(call("probeAngle", "-latestTime").text, {"The latest one that does is 0.01", "Time = 0.01: 1 drop"}));
}

TEST_F(DropCase, RenderCaseRefusesBadInput)
{
    Outcome outcome = call("renderCase");
    EXPECT_NE(outcome.status, 0);
    EXPECT_TRUE(holds(outcome.text, {"holds liquid"}));

    writeTime("0", {drop(90)});
    for (const std::string size : {"12", "0x100", "99999x10", "axb", "-5x10"})
    {
        outcome = call("renderCase", "-size " + size);
        EXPECT_NE(outcome.status, 0) << size;
        EXPECT_FALSE(fs::exists(path()/"case.png"));
    }
    EXPECT_NE(call("renderCase", "-view top").status, 0);
    EXPECT_NE(call("renderCase", "-time 5").status, 0);
    EXPECT_NE(call("renderCase", "-size 64x64 -output /proc/none/p.png").status, 0);
}
