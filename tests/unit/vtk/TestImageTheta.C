// SPDX-License-Identifier: GPL-3.0-or-later
// Contact angles out of pictures, and the reading of those.

#include "support/ScratchFolder.H"
#include "thetaModels/ThetaField.H"
#include "vtk/GreyImage.H"

#include <vtkImageData.h>
#include <vtkJPEGWriter.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include <boost/crc.hpp>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace shizuku::test
{

namespace
{

// Pixels row by row, the lowest row first, `components` numbers each.
template<class Writer, class Pixel>
void writeImage(const std::filesystem::path& file, int width, int components, const std::vector<Pixel>& values)
{
    std::filesystem::create_directories(file.parent_path());
    vtkNew<vtkImageData> image;
    const int height = int(values.size())/(width*components);
    image->SetDimensions(width, height, 1);
    image->AllocateScalars(sizeof(Pixel) == 1 ? VTK_UNSIGNED_CHAR : VTK_UNSIGNED_SHORT, components);
    std::copy(values.begin(), values.end(), static_cast<Pixel*>(image->GetScalarPointer()));
    vtkNew<Writer> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(image);
    writer->Write();
}

using Bytes = std::vector<unsigned char>;

// A PNG file of grey values of 8 bits, one chunk after the other as they are given: name and content.
std::string pngOf(const std::vector<std::pair<std::string, std::string>>& chunks)
{
    const auto number = [](std::uint32_t n)
    {
        return std::string{char(n >> 24), char(n >> 16), char(n >> 8), char(n)};
    };
    std::string file = "\x89PNG\r\n\x1a\n";
    for (const auto& [name, content] : chunks)
    {
        boost::crc_32_type checksum;
        checksum.process_bytes((name + content).data(), name.size() + content.size());
        file += number(std::uint32_t(content.size())) + name + content + number(checksum.checksum());
    }
    return file;
}

// A case whose constant/image.png is two pixels wide and three high, from black to white in equal steps.
class ImageTheta : public testing::Test
{
protected:
    ImageTheta() { writeImage<vtkPNGWriter>(file(), 2, 1, Bytes{0, 51, 102, 153, 204, 255}); }

    std::filesystem::path file() const { return folder_.path()/"constant/image.png"; }

    // The middle of the pixels is at x = 0.5, 1.5 and y = 0.5, 1.5, 2.5.
    std::vector<double> at(const std::vector<Vector3>& places, const std::string& entries) const
    {
        SolidParticles solid;
        solid.positions = places;
        solid.normals.assign(places.size(), {0, 0, 1});
        solid.patch.assign(places.size(), 0);
        solid.patches = {"floor"};
        const std::string text = "floor\n{\n    type image;\n    " + entries + "\n}";
        return thetaField(solid, {}, Dictionary::parse(text, "constant/wettability"), folder_.path());
    }

    const std::string rectangle_ = "file \"image.png\"; theta (20 120); origin (0 0 5); width (2 0 0); height (0 3 0);";
    ScratchFolder folder_;
};

// Grey values are floats.
void expectAngles(const std::vector<double>& found, const std::vector<double>& expected)
{
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-5) << i;
}

}

TEST_F(ImageTheta, PixelsAreProjectedOnThePlane)
{
    expectAngles
    (
        at({{0.1, 0.1, 0}, {1.9, 0.9, 5}, {0.5, 1.5, 9}, {1.5, 1.5, 0}, {0.5, 2.5, 0}, {1.5, 2.5, 0}}, rectangle_),
        {20, 40, 60, 80, 100, 120}
    );
    // Turned by 90 degrees about z, and on the wall x = 0 instead of a floor.
    expectAngles
    (
        at({{7, 0.5, 0.5}, {7, 1.5, 0.5}, {7, 0.5, -1.5}},
            "file \"image.png\"; theta (20 120); origin (0 2 0); width (0 -2 0); height (0 0 3); outside clamp;"),
        {40, 20, 40}
    );
}

TEST_F(ImageTheta, OutsideItIsClampedOrTiled)
{
    const std::vector<Vector3> places{{-0.5, 0.5, 0}, {2.5, 0.5, 0}, {0.5, -1.5, 0}, {0.5, 7.5, 0}, {2, 3, 0}};
    expectAngles(at(places, rectangle_), {20, 40, 20, 100, 120});
    expectAngles(at(places, rectangle_ + "outside tile;"), {40, 20, 60, 60, 20});
}

TEST_F(ImageTheta, BadEntriesAreRefused)
{
    const auto message = [&](const std::string& entries) { return messageOf([&] { at({{0, 0, 0}}, entries); }); };
    EXPECT_TRUE(holds(message("file \"image.png\";"), {"'theta' is missing"}));
    const std::string head = "file \"image.png\"; theta (20 120); origin (0 0 0);";
    EXPECT_TRUE(holds(message(head + "width (0 0 0); height (0 1 0);"), {"width is zero", "line 4"}));
    EXPECT_TRUE(holds(message(head + "width (1 0 0); height (0.1 1 0);"), {"right angles", "line 4"}));
    EXPECT_TRUE(holds(message(rectangle_ + "outside mirror;"), {"mirror", "clamp", "tile"}));
    EXPECT_TRUE(holds(message(rectangle_ + "scale 2;"), {"'scale'"}));
}

TEST_F(ImageTheta, MissingAndDamagedFilesAreRefused)
{
    const auto message = [&] { return messageOf([&] { at({{0, 0, 0}}, rectangle_); }); };
    const std::string whole = folder_.read("constant/image.png");
    for (const std::string text : {"not a picture", ""})
    {
        folder_.write("constant/image.png", text);
        EXPECT_TRUE(holds(message(), {"neither PNG nor JPEG", "constant/image.png"}));
    }
    // Cut off anywhere behind the signature, or with one bit flipped.
    for (std::size_t length = 4; length < whole.size(); length += 3)
    {
        folder_.write("constant/image.png", whole.substr(0, length));
        EXPECT_TRUE(holds(message(), {"damaged", "constant/image.png"}));
    }
    std::string flipped = whole;
    flipped[whole.size()/2] ^= 4;
    folder_.write("constant/image.png", flipped);
    EXPECT_TRUE(holds(message(), {"damaged"}));

    // Checksums are right, but nothing else.
    using namespace std::string_literals;
    const std::string size2 = "\0\0\0\2\0\0\0\2"s, end = "", pixels = "\x78\x9c\x63\x60\0\x01\0\0\x06\0\x01"s;     // black
    const auto header = [](const std::string& size, const std::string& kind) { return std::pair<std::string, std::string>("IHDR", size + kind); };
    const std::string grey = "\x08\0\0\0\0"s, palette = "\x08\3\0\0\0"s, noDepth = "\7\0\0\0\0"s;
    folder_.write("constant/image.png", pngOf({header(size2, grey), {"IDAT", pixels}, {"IEND", end}}));
    EXPECT_EQ(message(), "no error");
    const std::string million = "\0\x0f\x42\x40\0\x0f\x42\x40"s, thousands = "\0\0\x13\x88\0\0\x13\x88"s, none = "\0\0\0\0\0\0\0\2"s;
    const std::vector<std::pair<std::string, std::string>> damaged
    {
        {pngOf({header(million, grey), {"IDAT", pixels}, {"IEND", end}}), "1000000 times 1000000 pixels are too many"},
        {pngOf({header(thousands, grey), {"IDAT", pixels}, {"IEND", end}}), "too short for its pixels"},
        {pngOf({header(none, grey), {"IDAT", pixels}, {"IEND", end}}), "damaged"},
        {pngOf({header(size2, noDepth), {"IDAT", pixels}, {"IEND", end}}), "damaged"},
        {pngOf({header(size2, palette), {"IDAT", pixels}, {"IEND", end}}), "damaged"},
        {pngOf({header(size2, grey), {"IDAT", "abcdefgh"}, {"IEND", end}}), "damaged"},
        {pngOf({header(size2, grey), {"IDAT", pixels.substr(0, 5)}, {"IEND", end}}), "damaged"},
        {pngOf({header(size2, grey), {"IEND", end}}), "damaged"}
    };
    for (const auto& [content, reason] : damaged)
    {
        folder_.write("constant/image.png", content);
        EXPECT_TRUE(holds(message(), {reason, "constant/image.png"}));
    }

    writeImage<vtkJPEGWriter>(file(), 8, 3, Bytes(8*8*3, 102));
    const std::string jpeg = folder_.read("constant/image.png");
    EXPECT_EQ(message(), "no error");
    folder_.write("constant/image.png", jpeg.substr(0, 100));
    EXPECT_TRUE(holds(message(), {"damaged"}));
    std::filesystem::remove(file());
    EXPECT_TRUE(holds(message(), {"missing", "constant/image.png"}));
}

TEST(GreyImage, ColoursDepthsAndFormats)
{
    const ScratchFolder folder;
    // Red, green, blue, white; then with transparency; then 16 bits.
    writeImage<vtkPNGWriter>(folder.path()/"rgb.png", 2, 3, Bytes{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255});
    const GreyImage rgb = readGreyImage(folder.path()/"rgb.png");
    EXPECT_EQ(rgb.width, 2);
    EXPECT_EQ(rgb.height, 2);
    const std::vector<float> expected{0.299f, 0.587f, 0.114f, 1};
    for (int i = 0; i < 4; ++i) EXPECT_FLOAT_EQ(rgb.grey[i], expected[i]);
    writeImage<vtkPNGWriter>(folder.path()/"rgba.png", 1, 4, Bytes{255, 0, 0, 7});
    EXPECT_FLOAT_EQ(readGreyImage(folder.path()/"rgba.png").at(0, 0), 0.299f);
    writeImage<vtkPNGWriter>(folder.path()/"deep.png", 2, 1, std::vector<unsigned short>{13107, 65535});
    EXPECT_FLOAT_EQ(readGreyImage(folder.path()/"deep.png").at(0, 0), 0.2f);
    // JPEG is lossy: of an even area by a few of 255.
    writeImage<vtkJPEGWriter>(folder.path()/"even.jpg", 8, 3, Bytes(8*8*3, 102));
    EXPECT_NEAR(readGreyImage(folder.path()/"even.jpg").at(4, 4), 0.4, 0.02);
}

}
