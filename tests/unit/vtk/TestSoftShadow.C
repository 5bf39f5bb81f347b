// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/CapMesh.H"
#include "vtk/SoftShadow.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// A window of four by four around the unit cube's foot, on the plane z = 0.
PlaneImage window() { return {{0.5, 0.5, 0}, {1, 0, 0}, {0, 1, 0}, 2, 400, {}}; }

double shadowedArea(const PlaneImage& image)
{
    const double pixel = 2*image.halfWidth/image.size;
    return std::accumulate(image.values.begin(), image.values.end(), 0.0)*pixel*pixel;
}

}

TEST(SoftShadow, LightFromAboveShadowsTheCubesFoot)
{
    PlaneImage image = window();
    castShadow(image, cubeMesh(1), {0, 0, -1}, 0.1);
    // Blurring keeps the sum; pixels on the outline count as a whole: half a pixel (0.01) along a length of 4.
    EXPECT_NEAR(shadowedArea(image), 1, 4*0.01);
    EXPECT_NEAR(image.at(200, 200), 1, 1e-5);       // floats, averaged three times
    EXPECT_EQ(image.at(20, 200), 0);
}

TEST(SoftShadow, SlantingLightLengthensIt)
{
    // Light along (1 0 -1) carries the top by one to the right: the foot and its shadow, an area of two.
    PlaneImage image = window();
    castShadow(image, cubeMesh(1), {1, 0, -1}, 0.05);
    EXPECT_NEAR(shadowedArea(image), 2, 6*0.01);
    EXPECT_NEAR(image.at(300, 200), 1, 1e-5);       // x = 1.5, right of the cube
    EXPECT_EQ(image.at(100, 200), 0);               // x = -0.5, left of it
}

TEST(SoftShadow, EdgesAreAsWideAsTheBlur)
{
    PlaneImage image = window();
    castShadow(image, cubeMesh(1), {0, 0, -1}, 0.2);
    // The edge x = 1 lies at column 250; three running means over 41 pixels reach 60 pixels to either side.
    EXPECT_NEAR(image.at(250, 200), 0.5, 0.03);     // the outline's half pixel
    EXPECT_LT(image.at(265, 200), 0.4);
    EXPECT_GT(image.at(265, 200), 0.05);
    EXPECT_EQ(image.at(315, 200), 0);
}
