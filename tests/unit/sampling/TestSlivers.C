// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/Slivers.H"
#include "support/ScratchFolder.H"
#include "support/Shapes.H"
#include "unit/sampling/SampledShapes.H"

#include <gtest/gtest.h>

namespace shizuku::test
{

namespace
{

TEST(Slivers, AreLeftOutAndSaid)
{
    std::vector<std::string> report;
    PatchedSurface surface = joined(rectangle(30, 30), moved(sliver(0.05), Vector3(50, 0, 0)));
    leaveOutSlivers(surface, 1, "floor.obj", report);
    EXPECT_EQ(surface.mesh.faces, rectangle(30, 30).mesh.faces);
    EXPECT_EQ(surface.patch.size(), 2u);
    ASSERT_EQ(report.size(), 1u);
    EXPECT_TRUE(holds(report.front(), {"1 sliver ", "left out", "(50 0 0)"}));
}

TEST(Slivers, AloneTheyAreRefusedByName)
{
    for (const double height : {0.3, 0.05, 1e-3})
    {
        PatchedSurface surface = sliver(height);
        std::vector<std::string> report;
        EXPECT_TRUE(holds(messageOf([&] { leaveOutSlivers(surface, 1, "sliver.obj", report); }), {"sliver.obj", "0.25 m"}));
    }
}

TEST(Slivers, AFineMeshOfSingleTrianglesStays)
{
    PatchedSurface soup = soupOf(sphere(3, 4));         // triangles of 0.3 spacings
    const std::size_t faces = soup.mesh.faces.size();
    std::vector<std::string> report;
    leaveOutSlivers(soup, 1, "ball.stl", report);
    EXPECT_EQ(soup.mesh.faces.size(), faces);
    EXPECT_TRUE(report.empty());
}

}

}
