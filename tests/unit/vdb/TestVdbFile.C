// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/CapMesh.H"
#include "support/ScratchFolder.H"
#include "vdb/VdbFile.H"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetMeasure.h>

using namespace shizuku;
using namespace shizuku::test;

// Read back by OpenVDB from the file: the drop's volume, distances from its surface, and the velocities that were asked for.
TEST(VdbFile, HoldsTheLevelSetAndTheVelocities)
{
    const ScratchFolder folder;
    const double voxel = 5e-5;
    const Cap cap = capOfVolume(90, 4e-9, {{0, 0, 0}, {0, 0, 1}}, {0, 0, 0});
    const TriangleMesh mesh = capMesh(cap, voxel);
    const auto velocities = [](const std::vector<Vector3>& places)
    {
        std::vector<Vector3> there;
        for (const Vector3& x : places) there.push_back({0, 0, 100*x.z});
        return there;
    };
    const auto path = folder.path()/"drop.vdb";
    writeVdb(path, mesh, velocities, voxel, 0.25);

    openvdb::initialize();
    openvdb::io::File file(path.string());
    file.open();
    EXPECT_DOUBLE_EQ(file.getMetadata()->metaValue<double>("time"), 0.25);
    const auto surface = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("surface"));
    const auto velocity = openvdb::gridPtrCast<openvdb::Vec3SGrid>(file.readGrid("velocity"));
    file.close();
    EXPECT_EQ(surface->getGridClass(), openvdb::GRID_LEVEL_SET);
    EXPECT_DOUBLE_EQ(surface->voxelSize()[0], voxel);
    // Edges are cut over a voxel: the sharp one around the base of the 1.24 mm wide drop.
    EXPECT_NEAR(openvdb::tools::levelSetVolume(*surface), mesh.volume(), 0.01*mesh.volume());
    // A voxel below the middle of the base, and one above.
    EXPECT_NEAR(surface->tree().getValue({0, 0, -1}), voxel, 0.01*voxel);
    EXPECT_NEAR(surface->tree().getValue({0, 0, 1}), -voxel, 0.01*voxel);
    EXPECT_EQ(velocity->activeVoxelCount(), surface->activeVoxelCount());
    EXPECT_NEAR(velocity->tree().getValue({0, 0, 2})[2], 100*2*voxel, 1e-8);
}

// Nothing is left of a file that cannot be written.
TEST(VdbFile, IsThereWholeOrNotAtAll)
{
    const ScratchFolder folder;
    folder.write("file", "");
    const auto none = [](const std::vector<Vector3>& places) { return std::vector<Vector3>(places.size()); };
    const TriangleMesh mesh = capMesh(capOfVolume(90, 4e-9, {{0, 0, 0}, {0, 0, 1}}, {0, 0, 0}), 2e-4);
    EXPECT_THROW(writeVdb(folder.path()/"file/drop.vdb", mesh, none, 2e-4, 0), std::exception);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}
